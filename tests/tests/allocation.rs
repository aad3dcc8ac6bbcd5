//! Small machines are solved without the heap: a Monte Carlo thread never waits for an allocator.
#![allow(
    unsafe_code,
    reason = "counting allocations takes an allocator, and implementing one is unsafe"
)]

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::hint::black_box;

use eigentol::equilibrium::equilibrium;
use eigentol::modes::{match_modes, modes};
use eigentol::sensitivity::{
    equilibrium_shift, output_sensitivities, sensitivities, sensitivities_explicit,
    sensitivities_with_frozen_equilibrium,
};
use eigentol::tolerance::{Tolerances, first_order, output_tolerances};
use eigentol::{Mechanism, Policy};
use eigentol_tests::corpus::governor::Governor;
use eigentol_tests::corpus::hoist::Hoist;
use eigentol_tests::corpus::rotating_double_pendulum::RotatingDoublePendulum;
use eigentol_tests::corpus::rotating_pendulum::RotatingPendulum;
use eigentol_tests::corpus::sliders_on_plate::SlidersOnPlate;

thread_local! {
    static ALLOCATIONS: Cell<usize> = const { Cell::new(0) };
}

/// The system's allocator, counting calls by thread.
struct Counting;

// SAFETY: every call is the system allocator's own with the same arguments. The counter is a `Cell` of a plain number in
// constant thread-local storage: touching it neither allocates nor runs a destructor.
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

/// Allocations of this thread while `work` runs.
fn allocations<R>(work: impl FnOnce() -> R) -> usize {
    let before = ALLOCATIONS.get();
    black_box(work());
    ALLOCATIONS.get() - before
}

/// The count counts: a test that cannot fail shows nothing.
#[test]
fn allocations_are_seen() {
    assert_eq!(allocations(|| black_box(Box::new(1.0))), 1);
    assert_eq!(allocations(|| black_box([1.0; 64])), 0);
}

/// Every kernel once.
fn kernels<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    machine: &M,
    q: &[f64; N],
    u: &[f64; U],
    b: &[f64; P],
) where
    M: Mechanism<N, U, P, O>,
{
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

fn check<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    machine: M,
    u: [f64; U],
    start: [f64; N],
) where
    M: Mechanism<N, U, P, O>,
{
    let name = M::DESCRIPTION.name;
    let b: [f64; P] = std::array::from_fn(|j| M::DESCRIPTION.design[j].nominal);
    assert_eq!(
        allocations(|| kernels(&machine, &start, &u, &b)),
        0,
        "kernels of {name}"
    );
    for policy in [Policy::Stable, Policy::Nearest] {
        let solve = || equilibrium(&machine, &u, &b, &start, policy);
        assert_eq!(allocations(solve), 0, "equilibrium of {name}, {policy:?}");
    }
    let at = equilibrium(&machine, &u, &b, &start, Policy::Stable).expect("a state");
    assert_eq!(allocations(|| modes(&at)), 0, "modes of {name}");
    let found = modes(&at).expect("modes");
    assert_eq!(
        allocations(|| match_modes(&found, &found, &at.linear)),
        0,
        "matching of {name}"
    );
    let questions = || {
        black_box(equilibrium_shift(&machine, &at)).expect("a shift");
        black_box(output_sensitivities(&machine, &at)).expect("outputs");
        black_box(sensitivities(&machine, &at, &found)).expect("derivatives");
        black_box(sensitivities_explicit(&machine, &at, &found)).expect("derivatives");
        black_box(sensitivities_with_frozen_equilibrium(&machine, &at, &found))
            .expect("derivatives");
    };
    assert_eq!(allocations(questions), 0, "derivatives of {name}");
    let spreads = || {
        let tolerances = Tolerances::declared(&M::DESCRIPTION).expect("declared");
        let all = sensitivities(&machine, &at, &found).expect("derivatives");
        black_box(first_order(&found, &all, &tolerances));
        let outputs = output_sensitivities(&machine, &at).expect("outputs");
        black_box(output_tolerances(&outputs, &tolerances));
    };
    assert_eq!(allocations(spreads), 0, "spread of {name}");
}

#[test]
fn small_machines_need_no_heap() {
    check(RotatingPendulum, [5.0], [0.3]);
    check(RotatingDoublePendulum, [3.5], [0.3, 0.1]);
    check(SlidersOnPlate, [4.0], [0.1, 0.02]);
    check(Governor, [20.0, 0.19], [0.2]);
    check(Hoist, [0.1, 0.5], [0.1, 0.05, 0.02]);
}
