//! A mechanism whose kernels are said to cost something else, so that gradients come from the source a test names.

use eigentol::kernels::{Costs, Kernel, Kernels, PartialMatrices, Second, Sizes};
use eigentol::{DampingKind, Description, PoseMargin, Shared, Violation};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    Partials,
    ResidualPartials,
    Reverse,
}

pub struct Priced<'a> {
    pub machine: &'a dyn Kernels,
    pub from: Source,
    pub damping: DampingKind,
}

impl Kernels for Priced<'_> {
    fn description(&self) -> Shared<Description> {
        let mut description = (*self.machine.description()).clone();
        description.damping = self.damping;
        description.into()
    }

    fn costs(&self) -> Costs {
        let mut costs = self.machine.costs();
        costs.linear_partials = (self.from == Source::Partials).then_some(0);
        costs.residual_partials = (self.from == Source::ResidualPartials).then_some(0);
        costs.mode_gradient = Some(1_000_000);
        costs.pencil_gradient = Some(1_000_000);
        costs.residual_gradient = Some(1_000_000);
        costs
    }

    fn sizes(&self) -> Sizes {
        self.machine.sizes()
    }

    fn evaluate(&self, kernel: Kernel, arguments: &[&[f64]], results: &mut [&mut [f64]]) {
        self.machine.evaluate(kernel, arguments, results);
    }

    fn linear_partials_into(&self, q: &[f64], u: &[f64], b: &[f64], to: &mut PartialMatrices) {
        self.machine.linear_partials_into(q, u, b, to);
    }

    fn violation(&self, u: &[f64], b: &[f64]) -> Option<Violation<f64>> {
        self.machine.violation(u, b)
    }

    fn possible_within(&self, u: &[f64], b: &[f64], reach: &[f64]) -> bool {
        self.machine.possible_within(u, b, reach)
    }

    fn pose_margin(&self, q: &[f64], u: &[f64], b: &[f64]) -> Option<PoseMargin<f64>> {
        self.machine.pose_margin(q, u, b)
    }

    fn held_values_into(&self, u: &[Second], b: &[Second], values: &mut [Second]) {
        self.machine.held_values_into(u, b, values);
    }

    fn spans_into(&self, u: &[Second], b: &[Second], numbers: &mut [Second]) {
        self.machine.spans_into(u, b, numbers);
    }
}
