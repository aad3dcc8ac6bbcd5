//! The states at which kernels are compared.

use eigentol_oracle::random::Random;

/// Every kernel argument, under its name in the kernel's parameters.
#[derive(Clone, Debug)]
pub struct State {
    /// Unknowns, inputs, design variables.
    pub at: [Vec<f64>; 3],
    /// A direction in all three.
    pub along: [Vec<f64>; 3],
    /// `qddot`.
    pub acceleration: Vec<f64>,
    /// `qdot`.
    pub velocity: Vec<f64>,
    /// `phi` of a mode, or the weights `w`.
    pub shape: Vec<f64>,
    /// The eigenvalue of the mode.
    pub lambda: f64,
    /// `left`, `acceleration`, `velocity`, `position` of the pencil form.
    pub pencil: [Vec<f64>; 4],
}

impl State {
    /// A random state at `at`, not near any equilibrium, with no zero component in its directions.
    pub fn random(at: [Vec<f64>; 3], random: &mut Random) -> Self {
        let [n, inputs, design] = [0, 1, 2].map(|k| at[k].len());
        let mut full = |count: usize| -> Vec<f64> { (0..count).map(|_| random.between(-1.0, 1.0)).collect() };
        Self {
            along: [full(n), full(inputs), full(design)],
            acceleration: full(n),
            velocity: full(n),
            shape: full(n),
            lambda: 7.3,
            pencil: [full(n), full(n), full(n), full(n)],
            at,
        }
    }
}
