//! What a result costs, counted in calls of kernels: it calls none of another result, and what belongs to all modes once.

use std::sync::atomic::{AtomicUsize, Ordering};

use eigentol::clusters::clusters;
use eigentol::kernels::{
    BatchKernels, BatchLinear, BatchPartials, BatchParts, BatchPoint, Curvature, CurvatureKernels, Directional,
    DirectionalKernels, Kernel, Kernels, PartialMatrices, Second, Sizes, SummaryKernels,
};
use eigentol::scalar::{Batch, Instructions};
use eigentol::second_order::second_order;
use eigentol::sensitivity::sensitivities;
use eigentol::summary::summary_within;
use eigentol::tolerance::first_order;
use eigentol::{Description, Input, Mechanism, PoseMargin, Shared, Study, Violation, mechanism};

/// Kinds of kernels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    /// At one state, without derivatives along a direction.
    Plain,
    /// Derivatives of the matrices along a direction.
    LinearAlong,
    /// Derivatives of gradients along a direction.
    GradientAlong,
    /// Several states at once.
    Batch,
}

/// Kernels that count their calls.
struct Counting<'a> {
    inner: &'a dyn SummaryKernels,
    calls: [AtomicUsize; 4],
}

impl<'a> Counting<'a> {
    fn new(inner: &'a dyn SummaryKernels) -> Self {
        Self { inner, calls: Default::default() }
    }

    fn count(&self, kind: Kind) {
        self.calls[kind as usize].fetch_add(1, Ordering::Relaxed);
    }

    /// The calls since the last time, by kind.
    fn taken(&self) -> [usize; 4] {
        self.calls.each_ref().map(|call| call.swap(0, Ordering::Relaxed))
    }
}

impl Kernels for Counting<'_> {
    fn description(&self) -> Shared<Description> {
        self.inner.description()
    }

    fn sizes(&self) -> Sizes {
        self.inner.sizes()
    }

    fn evaluate(&self, kernel: Kernel, arguments: &[&[f64]], results: &mut [&mut [f64]]) {
        if kernel != Kernel::Whirl {
            self.count(Kind::Plain);
        }
        self.inner.evaluate(kernel, arguments, results);
    }

    fn linear_partials_into(&self, q: &[f64], u: &[f64], b: &[f64], partials: &mut PartialMatrices) {
        self.count(Kind::Plain);
        self.inner.linear_partials_into(q, u, b, partials);
    }

    fn violation(&self, u: &[f64], b: &[f64]) -> Option<Violation<f64>> {
        self.inner.violation(u, b)
    }

    fn possible_within(&self, u: &[f64], b: &[f64], reach: &[f64]) -> bool {
        self.inner.possible_within(u, b, reach)
    }

    fn pose_margin(&self, q: &[f64], u: &[f64], b: &[f64]) -> Option<PoseMargin<f64>> {
        self.inner.pose_margin(q, u, b)
    }

    fn held_values_into(&self, u: &[Second], b: &[Second], values: &mut [Second]) {
        self.inner.held_values_into(u, b, values);
    }

    fn spans_into(&self, u: &[Second], b: &[Second], numbers: &mut [Second]) {
        self.inner.spans_into(u, b, numbers);
    }
}

impl DirectionalKernels for Counting<'_> {
    fn evaluate_along(
        &self,
        kernel: Directional,
        arguments: &[&[f64]],
        direction: &[&[f64]],
        results: &mut [&mut [f64]],
    ) {
        self.count(match kernel {
            Directional::Linear => Kind::LinearAlong,
            Directional::ResidualGradient => Kind::GradientAlong,
        });
        self.inner.evaluate_along(kernel, arguments, direction, results);
    }
}

impl CurvatureKernels for Counting<'_> {
    fn evaluate_curvature(
        &self,
        kernel: Curvature,
        arguments: &[&[f64]],
        direction: &[&[f64]],
        results: &mut [&mut [f64]],
    ) {
        self.count(Kind::GradientAlong);
        self.inner.evaluate_curvature(kernel, arguments, direction, results);
    }
}

impl BatchKernels for Counting<'_> {
    fn evaluate_states(
        &self,
        instructions: Instructions,
        kernel: Kernel,
        arguments: &[&[Batch]],
        results: &mut [&mut [Batch]],
    ) {
        self.count(Kind::Batch);
        self.inner.evaluate_states(instructions, kernel, arguments, results);
    }

    fn parts_and_linear_batch(
        &self,
        instructions: Instructions,
        at: BatchPoint<'_>,
        parts: &mut BatchParts<'_>,
        linear: &mut BatchLinear<'_>,
    ) {
        self.count(Kind::Batch);
        self.inner.parts_and_linear_batch(instructions, at, parts, linear);
    }

    fn partials_batch(
        &self,
        instructions: Instructions,
        at: BatchPoint<'_>,
        matrices: &mut BatchPartials<'_>,
        residual: [&mut [Batch]; 2],
    ) {
        self.count(Kind::Batch);
        self.inner.partials_batch(instructions, at, matrices, residual);
    }
}

mechanism! {
    mechanism Three {
        input omega: rad/s;
        design l1 = 1.0 m +/- 1%;
        design l2 = 0.8 m +/- 1%;
        design l3 = 0.6 m +/- 1%;
        design m = 2.0 kg +/- 1%;
        gravity 9.81 m/s^2 along -z;
        body shaft: massless;
        body bar1: rod(mass: m, length: l1, along: -z);
        body bar2: rod(mass: m, length: l2, along: -z);
        body bar3: rod(mass: m, length: l3, along: -z);
        joint spin: revolute(z) from ground to shaft, driven at omega;
        joint q1: revolute(y) from shaft to bar1;
        joint q2: revolute(y) from bar1 to bar2 at [0, 0, -l1];
        joint q3: revolute(y) from bar2 to bar3 at [0, 0, -l2];
        output reach = l1 * sin(q1);
    }
}

fn solved<M: Mechanism>(study: &Study<M>) -> (eigentol::Equilibrium, eigentol::Modes) {
    (study.equilibrium().unwrap(), study.modes().unwrap())
}

#[test]
fn a_study_solves_its_operating_point_once() {
    let study = Study::new(Counting::new(&Three)).input(Input::new(0), 1.0);
    let modes = study.modes().unwrap();
    assert!(study.mechanism().taken()[Kind::Plain as usize] > 0);
    let kept = |study: &Study<Counting<'_>>| {
        assert_eq!(study.modes().unwrap(), modes);
        assert_eq!(study.equilibrium().unwrap().inputs[..], [1.0]);
        assert_eq!(study.mechanism().taken(), [0; 4]);
    };
    kept(&study);
    let study = study.samples(10).sigma_level(2.0).threads(1);
    kept(&study);
    let study = study.input(Input::new(0), 1.1);
    assert_ne!(study.modes().unwrap(), modes);
    assert!(study.mechanism().taken()[Kind::Plain as usize] > 0);
}

#[test]
fn a_result_calls_no_kernel_of_another() {
    let study = Study::new(Three).input(Three::omega, 1.0);
    let (at, modes) = solved(&study);
    let tolerances = study.tolerances().unwrap();
    let counting = Counting::new(&Three);
    let slopes = sensitivities(&counting, &at, &modes).unwrap();
    let _ = first_order(&modes, &slopes, &tolerances).unwrap();
    let [plain, linear, gradient, batch] = counting.taken();
    assert!(plain > 0 && plain <= 2 + modes.modes.len() + 1, "{plain}");
    assert_eq!([linear, gradient, batch], [0; 3]);
    // Clusters: the matrices along each design variable once, nothing of second order, no samples of the machine.
    let found = clusters(&counting, &at, &modes, &tolerances).unwrap();
    assert!(found.is_empty());
    let [_, linear, gradient, batch] = counting.taken();
    assert_eq!([linear, gradient, batch], [at.design.len(), 0, 0]);
    // Second order: the matrices along each variable once for all modes, and two gradients for each of both.
    let _ = second_order(&counting, &at, &modes, &tolerances);
    let [_, linear, gradient, batch] = counting.taken();
    let variables = at.design.len() + at.inputs.len();
    assert_eq!(linear, variables);
    assert_eq!(gradient, 2 * variables * modes.modes.len());
    assert_eq!(batch, 0);
    // Without a budget for samples, a summary is these and nothing else.
    let _ = summary_within(&counting, &at, &modes, &tolerances, 0.0).unwrap();
    let [_, linear, gradient, batch] = counting.taken();
    assert_eq!(linear, variables + at.design.len());
    assert_eq!((gradient, batch), (2 * variables * modes.modes.len(), 0));
}
