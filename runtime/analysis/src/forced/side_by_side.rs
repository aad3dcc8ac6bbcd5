//! Gradients of many forms at one state, several at once.

use crate::Equilibrium;
use crate::algebra::Matrix;
use crate::kernels::{Kernel, Kernels};
use crate::scalar::{Batch, WIDTH};

/// Gradients that a kernel gives at one state with one set of factors after the other.
pub(super) struct SideBySide<'a> {
    mechanism: &'a dyn Kernels,
    at: &'a Equilibrium,
    kernel: Kernel,
    state: [Vec<Batch>; 3],
    factors: Vec<Vec<Batch>>,
    /// By unknowns, inputs and design variables, in each lane.
    found: Vec<Batch>,
    /// Sets of factors so far, and those of them that wait for evaluation.
    count: usize,
    waiting: usize,
    /// A row for each set.
    gradients: Matrix,
}

impl<'a> SideBySide<'a> {
    /// For `count` sets of factors.
    pub(super) fn new(mechanism: &'a dyn Kernels, at: &'a Equilibrium, kernel: Kernel, count: usize) -> Self {
        let state = [&at.coordinates, &at.inputs, &at.design];
        let variables = state.iter().map(|list| list.len()).sum();
        Self {
            mechanism,
            at,
            kernel,
            state: state.map(|list| everywhere(list)),
            factors: Vec::new(),
            found: vec![Batch::default(); variables],
            count: 0,
            waiting: 0,
            gradients: Matrix::zeros(count, variables),
        }
    }

    /// Sets all factors, for the sets that follow.
    pub(super) fn set(&mut self, factors: &[&[f64]]) {
        self.evaluate();
        self.factors = factors.iter().map(|list| everywhere(list)).collect();
    }

    /// Takes the next set, in which the factors at these places have their own values.
    pub(super) fn push(&mut self, factors: &[(usize, &[f64])]) {
        let lane = self.waiting;
        for (k, from) in factors {
            for (to, value) in self.factors[*k].iter_mut().zip(*from) {
                to.0[lane] = *value;
            }
        }
        self.count += 1;
        self.waiting += 1;
        if self.waiting == WIDTH {
            self.evaluate();
        }
    }

    fn evaluate(&mut self) {
        let lanes = core::mem::take(&mut self.waiting);
        if lanes == 0 {
            return;
        }
        let arguments: Vec<&[Batch]> = self.state.iter().chain(&self.factors).map(Vec::as_slice).collect();
        let (coordinates, rest) = self.found.split_at_mut(self.at.coordinates.len());
        let (inputs, design) = rest.split_at_mut(self.at.inputs.len());
        let results = &mut [coordinates, inputs, design];
        self.mechanism.evaluate_batch(self.kernel, &arguments, results);
        for lane in 0..lanes {
            let row = &mut self.gradients[self.count - lanes + lane];
            for (to, from) in row.iter_mut().zip(&self.found) {
                *to = from.0[lane];
            }
        }
    }

    /// The gradients by unknowns, inputs and design variables, a row for each set.
    pub(super) fn gradients(mut self) -> Matrix {
        self.evaluate();
        self.gradients
    }
}

fn everywhere(list: &[f64]) -> Vec<Batch> {
    list.iter().map(|value| Batch::all(*value)).collect()
}
