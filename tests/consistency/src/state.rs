//! Where kernels are compared.

use eigentol_oracle::random::Random;

/// Every argument of every kernel, by its name in the kernel's parameters.
#[derive(Clone, Debug)]
pub struct State {
    /// Unknowns, inputs, design variables.
    pub at: [Vec<f64>; 3],
    /// A direction of all three.
    pub along: [Vec<f64>; 3],
    /// `qddot`.
    pub acceleration: Vec<f64>,
    /// `qdot`.
    pub velocity: Vec<f64>,
    /// `phi` of a mode, or `w`.
    pub shape: Vec<f64>,
    /// Its eigenvalue.
    pub lambda: f64,
    /// `left`, `acceleration`, `velocity`, `position` of a pencil.
    pub pencil: [Vec<f64>; 4],
}

impl State {
    /// A state at `at` with full directions, nowhere near an equilibrium.
    pub fn random(at: [Vec<f64>; 3], random: &mut Random) -> Self {
        let [n, inputs, design] = [0, 1, 2].map(|k| at[k].len());
        let mut full =
            |count: usize| -> Vec<f64> { (0..count).map(|_| random.between(-1.0, 1.0)).collect() };
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
