//! The macro's output as compiled by rustc, against the interpreter for the same declaration, and in other scalars.

mod agreement;
mod constraints;
mod scalars;
mod side_by_side;

use eigentol::Kernels;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

/// Reproducible numbers.
struct Numbers(ChaCha8Rng);

impl Numbers {
    fn new(seed: u64) -> Self {
        Self(ChaCha8Rng::seed_from_u64(seed))
    }

    /// Between -1 and 1.
    fn next(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    fn list(&mut self, count: usize) -> Vec<f64> {
        (0..count).map(|_| self.next()).collect()
    }

    /// Kernel arguments by parameter name: design variables near their nominal values, everything else between -1 and
    /// 1.
    fn arguments(&mut self, machine: &dyn Kernels, parameters: &[(&str, usize)]) -> Vec<Vec<f64>> {
        let description = machine.description();
        let near = |numbers: &mut Self| {
            let nominal = description.design.iter().map(|info| info.nominal);
            nominal.map(|value| value * (1.0 + 0.05 * numbers.next())).collect()
        };
        parameters
            .iter()
            .map(|&(name, length)| match name {
                "b" => near(self),
                _ => self.list(length),
            })
            .collect()
    }

    /// Arguments `q`, `u` and `b`.
    fn point(&mut self, machine: &dyn Kernels) -> Vec<Vec<f64>> {
        let sizes = machine.sizes();
        let lengths = [("q", sizes.coordinates), ("u", sizes.inputs), ("b", sizes.design)];
        self.arguments(machine, &lengths)
    }
}
