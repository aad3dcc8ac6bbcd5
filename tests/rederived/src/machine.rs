//! Equilibria in hyper-dual numbers, and their matrices.

use eigentol::Real;
use eigentol_compiler::compile;
use eigentol_compiler::mechanics::{Limits, Role};
use eigentol_compiler::program::{Kernel, Program};
use nalgebra::{Complex, DMatrix, DVector};

use super::spectrum::upper_half;
use super::{Derived, pairs};
use crate::hyper::Hyper;
use eigentol_consistency::interpreter::interpret;

/// Repetitions of the Newton step in hyper-dual numbers: two make the second order exact, the rest remove rounding.
pub(super) const REPETITIONS: usize = 4;

/// A declaration whose kernels are run by an interpreter.
pub struct Machine {
    program: Program,
    coordinates: usize,
    holonomic: bool,
    inputs: usize,
    nominal: Vec<f64>,
}

/// A machine at one equilibrium, solved once for every pair of variables and differentiated along both.
pub struct State {
    /// `q*`.
    pub coordinates: Vec<f64>,
    /// Number of design variables and inputs: the variables of differentiation.
    pub(super) variables: usize,
    /// No unknown is a speed or belongs to a velocity constraint: every mode has mass in `Mhat`.
    pub(super) holonomic: bool,
    pub(super) solutions: Vec<Solution>,
}

/// An equilibrium differentiated along two directions. Matrices are stored by rows.
pub(super) struct Solution {
    pub(super) coordinates: Vec<Hyper>,
    pub(super) mass: Vec<Hyper>,
    pub(super) damping: Vec<Hyper>,
    pub(super) stiffness: Vec<Hyper>,
    pub(super) outputs: Vec<Hyper>,
    pub(super) excited: Option<Excited>,
}

/// The results of the kernels of excitations.
pub(super) struct Excited {
    /// Forces in phase, frequencies, direct terms in phase; forces and direct terms a quarter of a period ahead.
    pub(super) forcing: Vec<Vec<Hyper>>,
    /// Derivatives of the outputs by acceleration, velocity and position.
    pub(super) motion: Vec<Vec<Hyper>>,
    /// Number of outputs.
    pub(super) outputs: usize,
}

impl Machine {
    /// Compiles a declaration.
    ///
    /// # Panics
    /// With the compiler's messages, if it refuses the declaration.
    pub fn new(declaration: &str) -> Self {
        let tokens = declaration.parse().expect("the text has tokens");
        // The compiler omits the partial derivatives of large mechanisms; none are used here.
        let limits = Limits { explicit_partials: 0, partial_operations: usize::MAX, motion_linear: 0 };
        let compilation = compile(tokens, limits).unwrap_or_else(|mistakes| panic!("{mistakes}"));
        let design = compilation.mechanism.design.iter();
        let unknowns = &compilation.functions.unknowns;
        Self {
            holonomic: unknowns
                .iter()
                .all(|unknown| matches!(unknown.role, Role::Position(_) | Role::PositionReaction)),
            coordinates: unknowns.len(),
            inputs: compilation.mechanism.inputs.len(),
            nominal: design.map(|variable| variable.nominal).collect(),
            program: compilation.program,
        }
    }

    /// Nominal design variables.
    pub fn nominal(&self) -> &[f64] {
        &self.nominal
    }

    fn kernel(&self, name: &str) -> &Kernel {
        self.program.kernel(name).unwrap_or_else(|| panic!("there is a kernel {name}"))
    }

    /// Eigenvalues of the whole pencil at given coordinates, which need not be an equilibrium, as in
    /// [`State::eigenvalues`]: also available where `Khat` is singular and there is no [`State`].
    pub fn eigenvalues(&self, u: &[f64], b: &[f64], q: &[f64]) -> Vec<Complex<f64>> {
        let n = self.coordinates;
        let mut linear = interpret(self.kernel("linear"), &[q, u, b]).into_iter();
        let mut next = || DMatrix::from_row_slice(n, n, &linear.next().expect("three matrices"));
        let (mass, damping, stiffness) = (next(), next(), next());
        upper_half(&[stiffness, damping, mass].map(|matrix| matrix.map(Complex::from)))
    }

    /// Newton's method in doubles; returns the coordinates and the last Jacobian.
    fn settle(&self, u: &[f64], b: &[f64], start: &[f64]) -> (Vec<f64>, DMatrix<f64>) {
        let n = self.coordinates;
        let kernel = self.kernel("residual_and_stiffness");
        let mut q = DVector::from_column_slice(start);
        let mut last = f64::INFINITY;
        for _ in 0..100 {
            let arrays = interpret(kernel, &[q.as_slice(), u, b]);
            let stiffness = DMatrix::from_row_slice(n, n, &arrays[1]);
            let step = stiffness
                .clone()
                .lu()
                .solve(&DVector::from_column_slice(&arrays[0]))
                .expect("an equilibrium that is not critical");
            let length = step.amax();
            let relative = length / (1e-3 + q.amax());
            // Only rounding is left: the steps no longer shrink.
            if relative <= 1e-15 || relative <= 1e-10 && length >= last {
                return (q.as_slice().to_vec(), stiffness);
            }
            q -= step;
            last = length;
        }
        panic!("no equilibrium from {start:?}: still moving by {last:e} at {q}");
    }

    /// The equilibrium that Newton's method reaches from `start`, differentiated by all variables.
    ///
    /// # Panics
    /// When none is found, or when `Khat` is singular there.
    pub fn at(&self, u: &[f64], b: &[f64], start: &[f64]) -> State {
        let (inputs, design) = (self.inputs, self.nominal.len());
        assert_eq!([u.len(), b.len()], [inputs, design]);
        assert_eq!(start.len(), self.coordinates);
        let (q, jacobian) = self.settle(u, b, start);
        let factors = jacobian.lu();
        let variables = design + inputs;
        let mut directions: Vec<Option<(usize, usize)>> = pairs(variables).map(Some).collect();
        if directions.is_empty() {
            directions.push(None);
        }
        let solve = |direction: &Option<(usize, usize)>| {
            let perturbed = |values: &[f64], first: usize| -> Vec<Hyper> {
                let one = |k: usize, along: Option<usize>| f64::from(along == Some(first + k));
                let parts = |(k, &value): (usize, &f64)| {
                    let (i, j) = (direction.map(|d| d.0), direction.map(|d| d.1));
                    Hyper::new([value, one(k, i), one(k, j), 0.0])
                };
                values.iter().enumerate().map(parts).collect()
            };
            let (b, u) = (perturbed(b, 0), perturbed(u, design));
            let mut q: Vec<Hyper> = q.iter().map(|&value| Hyper::constant(value)).collect();
            let residual = self.kernel("residual");
            for _ in 0..REPETITIONS {
                let rest = &interpret(residual, &[&q, &u, &b])[0];
                let steps: [DVector<f64>; Hyper::PARTS] = std::array::from_fn(|part| {
                    let column = rest.iter().map(|value| value.parts()[part]);
                    let column = DVector::from_iterator(rest.len(), column);
                    factors.solve(&column).expect("factors of a Newton step")
                });
                for (i, value) in q.iter_mut().enumerate() {
                    *value = *value - Hyper::new(std::array::from_fn(|part| steps[part][i]));
                }
            }
            let mut linear = interpret(self.kernel("linear"), &[&q, &u, &b]).into_iter();
            let mut next = || linear.next().expect("three matrices");
            let (mass, damping, stiffness) = (next(), next(), next());
            let outputs = self.program.kernel("outputs");
            let outputs = outputs.map(|kernel| interpret(kernel, &[&q, &u, &b]).concat());
            let outputs = outputs.unwrap_or_default();
            let forcing = self.program.kernel("forcing");
            let excited = forcing.map(|forcing| Excited {
                forcing: interpret(forcing, &[&q, &u, &b]),
                motion: interpret(self.kernel("output_motion"), &[&q, &u, &b]),
                outputs: outputs.len(),
            });
            Solution { coordinates: q, mass, damping, stiffness, outputs, excited }
        };
        State {
            coordinates: q.clone(),
            variables,
            holonomic: self.holonomic,
            solutions: directions.iter().map(solve).collect(),
        }
    }
}

impl State {
    /// Assembles one number from all solutions.
    pub(super) fn derived(&self, number: impl Fn(usize, &Solution) -> Hyper) -> Derived {
        let numbers = self.solutions.iter().enumerate();
        Derived::collect(self.variables, numbers.map(|(k, solution)| number(k, solution)))
    }

    fn all(&self, count: usize, list: fn(&Solution) -> &[Hyper]) -> Vec<Derived> {
        (0..count).map(|i| self.derived(|_, solution| list(solution)[i])).collect()
    }

    /// The coordinates of the equilibrium.
    pub fn equilibrium(&self) -> Vec<Derived> {
        self.all(self.coordinates.len(), |solution| &solution.coordinates)
    }

    /// The outputs.
    pub fn outputs(&self) -> Vec<Derived> {
        let count = self.solutions[0].outputs.len();
        self.all(count, |solution| &solution.outputs)
    }

    /// `Mhat`, `Chat`, `Khat`, row by row.
    pub fn matrices(&self) -> [Vec<Derived>; 3] {
        let count = self.coordinates.len().pow(2);
        [
            self.all(count, |solution| &solution.mass),
            self.all(count, |solution| &solution.damping),
            self.all(count, |solution| &solution.stiffness),
        ]
    }
}
