//! A declaration whose kernels are compared.

use eigentol_compiler::mechanics::{Limits, Role};
use eigentol_compiler::program::Program;
use eigentol_compiler::{Compilation, compile};
use eigentol_oracle::random::Random;

use crate::state::State;

/// The kernels of a declaration, and the data needed to choose a state.
#[derive(Clone)]
pub struct Subject {
    /// The kernels.
    pub program: Program,
    /// Names of the unknowns, in the order of `q`.
    pub unknowns: Vec<String>,
    /// Roles of the unknowns, in the same order.
    pub roles: Vec<Role>,
    /// Names of the design variables.
    pub design: Vec<String>,
    positions: usize,
    inputs: usize,
    nominal: Vec<f64>,
}

impl Subject {
    /// Compiles a declaration.
    ///
    /// # Errors
    /// The compiler's messages.
    pub fn new(declaration: &str, limits: Limits) -> Result<Self, Vec<String>> {
        let tokens = declaration.parse().map_err(|error| vec![format!("{error}")])?;
        let compiled = compile(tokens, limits);
        let compiled = compiled.map_err(|mistakes| {
            let messages = mistakes.iter().map(|mistake| mistake.message.clone());
            messages.collect::<Vec<_>>()
        })?;
        Ok(Self::of(compiled))
    }

    fn of(compiled: Compilation) -> Self {
        let mechanism = &compiled.mechanism;
        let unknowns = &compiled.functions.unknowns;
        let is_position = |role: &Role| matches!(role, Role::Position(_));
        Self {
            unknowns: unknowns.iter().map(|one| one.name.clone()).collect(),
            roles: unknowns.iter().map(|one| one.role).collect(),
            design: mechanism.design.iter().map(|one| one.name.to_string()).collect(),
            positions: unknowns.iter().filter(|one| is_position(&one.role)).count(),
            inputs: mechanism.inputs.len(),
            nominal: mechanism.design.iter().map(|one| one.nominal).collect(),
            program: compiled.program,
        }
    }

    /// A random state: coordinates of order one, drives on, design variables off their nominal values.
    pub fn state(&self, seed: u64) -> State {
        let mut random = Random::new(seed);
        let q = (0..self.unknowns.len())
            .map(|k| random.between(-1.0, 1.0) * if k < self.positions { 1.2 } else { 3.0 })
            .collect();
        let u = (0..self.inputs).map(|_| random.between(0.5, 4.0)).collect();
        let b = self.nominal.iter().map(|&b| match b == 0.0 {
            true => random.between(-0.1, 0.1),
            false => b * random.between(0.9, 1.1),
        });
        let b = b.collect();
        State::random([q, u, b], &mut random)
    }
}
