//! Small machines are solved without heap allocation except for the lists in the results, so a Monte Carlo thread
//! hardly ever waits for the allocator.
#![allow(unsafe_code, reason = "counting allocations takes an allocator, and implementing one is unsafe")]

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::hint::black_box;

use eigentol::equilibrium::equilibrium;
use eigentol::kernels::{
    Curvature, CurvatureKernels, Gradient, Kernels, Linear, MotionKernels, PartialMatrices, RestParts, Sizes,
    gradient_results,
};
use eigentol::modes::{match_modes, modes};
use eigentol::scalar::Instructions;
use eigentol::sensitivity::{
    equilibrium_shift, output_sensitivities, sensitivities, sensitivities_explicit,
    sensitivities_with_frozen_equilibrium,
};
use eigentol::tolerance::{Tolerances, first_order, output_tolerances};
use eigentol::{Array, Equilibrium, Error, Family, Matrix, Mechanism, Modes, Policy, Sensitivities, Study, Vector};
use eigentol_tests::corpus::governor::Governor;
use eigentol_tests::corpus::hoist::Hoist;
use eigentol_tests::corpus::rotating_double_pendulum::RotatingDoublePendulum;
use eigentol_tests::corpus::rotating_pendulum::RotatingPendulum;
use eigentol_tests::corpus::sliders_on_plate::SlidersOnPlate;

thread_local! {
    static ALLOCATIONS: Cell<usize> = const { Cell::new(0) };
}

/// The system allocator, with a count of calls per thread.
struct Counting;

// SAFETY: every call forwards to the system allocator with the same arguments. The counter is a `Cell` of a plain
// number in constant thread-local storage: accessing it neither allocates nor runs a destructor.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.set(ALLOCATIONS.get() + 1);
        // SAFETY: the caller's promise about `layout` is passed on.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: the pointer comes from `System` with this layout.
        unsafe { System.dealloc(pointer, layout) }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        ALLOCATIONS.set(ALLOCATIONS.get() + 1);
        // SAFETY: the pointer comes from `System` with this layout.
        unsafe { System.realloc(pointer, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Number of allocations on this thread while `work` runs.
fn allocations<R>(work: impl FnOnce() -> R) -> usize {
    let before = ALLOCATIONS.get();
    black_box(work());
    ALLOCATIONS.get() - before
}

/// The counter works: a test that cannot fail shows nothing.
#[test]
fn allocations_are_seen() {
    assert_eq!(allocations(|| black_box(Box::new(1.0))), 1);
    assert_eq!(allocations(|| black_box([1.0; 64])), 0);
}

/// Calls every kernel of the generated code once.
fn generated<M: Mechanism>(machine: &M, q: &M::Coordinates<f64>, u: &M::Inputs<f64>, b: &M::Design<f64>) {
    black_box(machine.residual(q, u, b));
    black_box(machine.residual_parts(q, u, b));
    black_box(machine.motion_residual(q, q, q, u, b));
    black_box(machine.motion(q, q, u, b));
    black_box(machine.residual_and_stiffness(q, u, b));
    black_box(machine.linear(q, u, b));
    black_box(machine.residual_partials(q, u, b));
    black_box(machine.linear_partials(q, u, b));
    black_box(machine.linear_along(q, u, b, q, u, b));
    black_box(machine.mode_gradient(q, u, b, q, 1.0));
    black_box(machine.pencil_gradient(q, u, b, q, q, q, q));
    black_box(machine.residual_gradient(q, u, b, q));
    black_box(machine.mode_gradient_along(q, u, b, q, 1.0, q, u, b, q, 1.0));
    black_box(machine.pencil_gradient_along(q, u, b, q, q, q, q, q, u, b, q, q, q, q));
    black_box(machine.residual_gradient_along(q, u, b, q, q, u, b, q));
    black_box(machine.whirl(q, u, b, q, q));
    black_box(machine.outputs(q, u, b));
    black_box(machine.output_partials(q, u, b));
    black_box(machine.violation(u, b));
}

/// Buffers for the kernels of the table.
struct Buffers {
    numbers: Vector,
    outputs: Vector,
    parts: RestParts,
    matrix: Matrix,
    linear: Linear,
    residual_partials: (Matrix, Matrix),
    linear_partials: PartialMatrices,
    output_partials: [Matrix; 3],
    gradient: Gradient,
}

impl Buffers {
    fn new(sizes: Sizes) -> Self {
        let Sizes { coordinates, inputs, design, outputs, excitations: _ } = sizes;
        let columns = [coordinates, inputs, design];
        Self {
            numbers: Vector::zeros(coordinates),
            outputs: Vector::zeros(outputs),
            parts: RestParts::zeros(coordinates),
            matrix: Matrix::zeros(coordinates, coordinates),
            linear: Linear::zeros(coordinates),
            residual_partials: (Matrix::zeros(coordinates, inputs), Matrix::zeros(coordinates, design)),
            linear_partials: PartialMatrices::zeros(sizes),
            output_partials: columns.map(|columns| Matrix::zeros(outputs, columns)),
            gradient: Gradient::zeros(sizes),
        }
    }

    /// Calls every kernel of the table once.
    fn fill(&mut self, machine: &dyn EveryKernel, q: &[f64], u: &[f64], b: &[f64]) {
        let Self {
            numbers,
            outputs,
            parts,
            matrix,
            linear,
            residual_partials,
            linear_partials,
            output_partials,
            gradient,
        } = self;
        machine.residual_into(q, u, b, numbers);
        machine.residual_parts_into(q, u, b, parts);
        machine.motion_residual_into(q, q, q, u, b, numbers);
        machine.motion_into(q, q, u, b, matrix, numbers);
        machine.motion_linear_into(q, q, q, u, b, linear);
        machine.residual_and_stiffness_into(q, u, b, numbers, matrix.as_flattened_mut());
        machine.linear_into(q, u, b, linear);
        machine.parts_and_linear_into(q, u, b, parts, linear);
        machine.residual_partials_into(q, u, b, residual_partials);
        machine.linear_partials_into(q, u, b, linear_partials);
        machine.partials_into(q, u, b, linear_partials, residual_partials);
        machine.linear_along_into(q, u, b, [q, u, b], linear);
        machine.mode_gradient_into(q, u, b, q, 1.0, gradient);
        machine.pencil_gradient_into(q, u, b, [q; 4], gradient);
        machine.residual_gradient_into(q, u, b, q, gradient);
        let lists: [&[f64]; 5] = [q, u, b, q, &[1.0]];
        machine.evaluate_curvature(Curvature::ModeGradient, &lists, &lists, &mut gradient_results(gradient));
        let lists = [q, u, b, q, q, q, q];
        machine.evaluate_curvature(Curvature::PencilGradient, &lists, &lists, &mut gradient_results(gradient));
        machine.residual_gradient_along_into(q, u, b, q, [q, u, b, q], gradient);
        black_box(machine.whirl(q, u, b, q, q));
        black_box(machine.violation(u, b));
        black_box(machine.possible_within(u, b, b));
        black_box(machine.pose_margin(q, u, b));
        machine.outputs_into(q, u, b, outputs);
        let [by_coordinate, by_input, by_design] = output_partials;
        machine.output_partials_into(q, u, b, [by_coordinate, by_input, by_design]);
    }
}

type Derivatives = fn(&dyn Kernels, &Equilibrium, &Modes) -> Result<Sensitivities, Error>;

fn check<M: Mechanism>(machine: M, u: &[f64], start: &[f64]) {
    let description = machine.description();
    let b: Vec<f64> = description.design.iter().map(|info| info.nominal).collect();
    let arrays = (Array::view(start), Array::view(u), Array::view(&b));
    assert_eq!(
        allocations(|| generated(&machine, arrays.0, arrays.1, arrays.2)),
        0,
        "generated code of {}",
        description.name
    );
    questions(&machine, u, &b, start);
}

/// The whole table.
trait EveryKernel: MotionKernels + CurvatureKernels {}

impl<M: MotionKernels + CurvatureKernels> EveryKernel for M {}

/// Results hold their numbers inline; only their lists are on the heap.
fn questions(machine: &dyn EveryKernel, u: &[f64], b: &[f64], start: &[f64]) {
    let description = machine.description();
    let name = &description.name;
    let mut buffers = Buffers::new(machine.sizes());
    assert_eq!(allocations(|| buffers.fill(machine, start, u, b)), 0, "kernels of {name}");
    for policy in [Policy::Stable, Policy::Nearest] {
        let solve = || equilibrium(machine, u, b, start, policy);
        assert_eq!(allocations(solve), 0, "equilibrium of {name}, {policy:?}");
    }
    let at = equilibrium(machine, u, b, start, Policy::Stable).expect("a state");
    let shift = || equilibrium_shift(machine, &at).expect("a shift");
    assert_eq!(allocations(shift), 0, "shift of {name}");

    let found = modes(&at).expect("modes");
    // One list; general modes also need their roots and work lists of the eigenproblem, more if some are real.
    let lists = match found.family {
        Family::Undamped => 1..=1,
        Family::General => 7..=11,
    };
    let used = allocations(|| modes(&at));
    assert!(lists.contains(&used), "modes of {name}: {used}");
    // One list; for several general modes also their places and the sizes of their shapes.
    assert!(allocations(|| match_modes(&found, &found, &at.linear)) <= 5, "matching of {name}");

    // Lists by mode, and of partial derivatives by coordinates, inputs and design if these are computed.
    let ways: [Derivatives; 3] = [sensitivities, sensitivities_explicit, sensitivities_with_frozen_equilibrium];
    for way in ways {
        let derivatives = || way(machine, &at, &found).expect("derivatives");
        assert!(allocations(derivatives) <= 4, "derivatives of {name}");
    }
    let all = sensitivities(machine, &at, &found).expect("derivatives");
    let outputs = || output_sensitivities(machine, &at).expect("outputs");
    assert_eq!(allocations(outputs), 2, "outputs of {name}");

    // Five design variables have a matrix of 25 entries.
    let declared = || Tolerances::declared(&description).expect("declared");
    let large = usize::from(b.len() > 4);
    assert_eq!(allocations(declared), large, "tolerances of {name}");
    let (tolerances, outputs) = (declared(), outputs());
    let spread = || first_order(&found, &all, &tolerances).expect("a spread");
    assert_eq!(allocations(spread), 1, "spread of {name}");
    let spread = || output_tolerances(&outputs, &tolerances).expect("a spread");
    assert_eq!(allocations(spread), 1, "spread of the outputs of {name}");
}

#[test]
fn small_machines_need_no_heap() {
    check(RotatingPendulum, &[5.0], &[0.3]);
    check(RotatingDoublePendulum, &[3.5], &[0.3, 0.1]);
    check(SlidersOnPlate, &[4.0], &[0.1, 0.02]);
    check(Governor, &[20.0, 0.19], &[0.2]);
    check(Hoist, &[0.1, 0.5], &[0.1, 0.05, 0.02]);
}

/// Solving side by side, 256 samples at a time need one list, and their results occasionally another. Twice as many
/// samples come twice as close to the nominal value: for each of the two frequencies the sketch then counts one more
/// octave of deviations on either side, occasionally two.
#[test]
fn samples_need_no_heap() {
    let run = |samples: usize| {
        let study = Study::new(RotatingDoublePendulum)
            .input(RotatingDoublePendulum::omega, 3.5)
            .start(RotatingDoublePendulum::theta1, 0.3)
            .vectors(Some(Instructions::best()))
            .threads(1)
            .samples(samples);
        study.modes().expect("modes");
        allocations(|| study.monte_carlo().expect("samples"))
    };
    let more = run(4096) - run(2048);
    assert!(more <= 2048 / 256 + 1 + 2 * 2 * 2, "{more}");
}
