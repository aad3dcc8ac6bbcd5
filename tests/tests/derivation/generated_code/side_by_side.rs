//! Kernels with several sets of arguments at once, compiled and interpreted: each lane has the bits of its set alone.

use eigentol::Mechanism;
use eigentol::kernels::lanes::{self, LaneKernel};
use eigentol::kernels::{Extent, Kernel, Kernels, MotionKernel, MotionKernels, Shape, Sizes};
use eigentol::scalar::{Batch, Instructions, WIDTH};
use eigentol_interpreter::Interpreted;
use eigentol_tests::corpus::{Carousel, Rotor, ScrewPress, Visitor, visit};

use super::Numbers;

fn count(extent: Extent, sizes: Sizes) -> usize {
    match extent {
        Extent::Coordinates => sizes.coordinates,
        Extent::Inputs => sizes.inputs,
        Extent::Design => sizes.design,
        Extent::Outputs => sizes.outputs,
        Extent::Excitations => sizes.excitations,
        Extent::Fixed(count) => count,
    }
}

/// Evaluates `WIDTH` random sets of arguments side by side and one by one.
fn check(machine: &dyn Kernels, kernel: Kernel, numbers: &mut Numbers, name: &str) {
    check_lists(
        machine,
        (kernel.arguments(), kernel.results()),
        |arguments, to| machine.evaluate_batch(kernel, arguments, to),
        |arguments, to| machine.evaluate(kernel, arguments, to),
        numbers,
        &format!("{name} {}", kernel.name()),
    );
}

/// The same of a kernel of motion.
fn check_motion(machine: &dyn MotionKernels, kernel: MotionKernel, numbers: &mut Numbers, name: &str) {
    check_lists(
        machine,
        (kernel.arguments(), kernel.results()),
        |arguments, to| machine.evaluate_motion_batch(kernel, arguments, to),
        |arguments, to| machine.evaluate_motion(kernel, arguments, to),
        numbers,
        &format!("{name} {}", kernel.name()),
    );
}

/// The same in vectors that the kernel's type asks for, with every instruction set.
fn check_lanes<K: LaneKernel + Copy, M: Mechanism>(machine: &M, lane: K, kernel: MotionKernel, numbers: &mut Numbers) {
    for set in Instructions::available() {
        check_lists(
            machine,
            (kernel.arguments(), kernel.results()),
            |arguments, to| lanes::evaluate(lane, machine, set, arguments, to),
            |arguments, to| machine.evaluate_motion(kernel, arguments, to),
            numbers,
            &format!("{} {set:?}", kernel.name()),
        );
    }
}

fn check_lists(
    machine: &dyn Kernels,
    (arguments, results): (&[Extent], &[Shape]),
    side_by_side: impl Fn(&[&[Batch]], &mut [&mut [Batch]]),
    one_by_one: impl Fn(&[&[f64]], &mut [&mut [f64]]),
    numbers: &mut Numbers,
    name: &str,
) {
    let sizes = machine.sizes();
    let lengths = arguments.iter();
    let lengths = lengths.map(|item| (["", "b"][usize::from(*item == Extent::Design)], count(*item, sizes)));
    let lengths: Vec<(&str, usize)> = lengths.collect();
    let sets: Vec<Vec<Vec<f64>>> = (0..WIDTH).map(|_| numbers.arguments(machine, &lengths)).collect();
    let lanes: Vec<Vec<Batch>> = (0..lengths.len())
        .map(|k| {
            let entry = |i: usize| Batch::from_fn(|lane| sets[lane][k][i]);
            (0..lengths[k].1).map(entry).collect()
        })
        .collect();
    let shapes: Vec<usize> =
        results.iter().map(|[rows, columns]| count(*rows, sizes) * count(*columns, sizes)).collect();
    let mut together: Vec<Vec<Batch>> = shapes.iter().map(|count| vec![Batch::all(7.0); *count]).collect();
    let arguments: Vec<&[Batch]> = lanes.iter().map(Vec::as_slice).collect();
    let mut to: Vec<&mut [Batch]> = together.iter_mut().map(Vec::as_mut_slice).collect();
    side_by_side(&arguments, &mut to);
    for (lane, set) in sets.iter().enumerate() {
        let arguments: Vec<&[f64]> = set.iter().map(Vec::as_slice).collect();
        let mut alone: Vec<Vec<f64>> = shapes.iter().map(|count| vec![8.0; *count]).collect();
        let mut to: Vec<&mut [f64]> = alone.iter_mut().map(Vec::as_mut_slice).collect();
        one_by_one(&arguments, &mut to);
        for (together, alone) in together.iter().flatten().zip(alone.iter().flatten()) {
            let (found, expected) = (together.0[lane], *alone);
            assert!(found.to_bits() == expected.to_bits(), "{name}: {found:e} {expected:e}");
        }
    }
}

#[derive(Default)]
struct SideBySide {
    /// Excited machines whose gradients are short enough for vectors.
    in_vectors: usize,
}

impl Visitor for SideBySide {
    fn visit<M: Mechanism + Copy>(&mut self, name: &'static str, declaration: &'static str, machine: M) {
        let mut numbers = Numbers::new(9);
        let interpreted = Interpreted::from_text(declaration).expect("a declaration");
        let excited = machine.sizes().excitations > 0;
        let gradients = [Kernel::PencilGradient, Kernel::ForcedGradient];
        // Without excitations the last has no kernel.
        let kernels = if excited { &gradients[..] } else { &gradients[..1] };
        for &kernel in kernels {
            check(&machine, kernel, &mut numbers, name);
            check(&interpreted, kernel, &mut numbers, name);
        }
        check(&machine, Kernel::Linear, &mut numbers, name);
        for kernel in MotionKernel::ALL {
            check_motion(&machine, *kernel, &mut numbers, name);
            check_motion(&interpreted, *kernel, &mut numbers, name);
        }
        let short = |name| {
            let description = Kernels::description(&machine);
            let kernel = description.static_kernel(name);
            kernel.is_some_and(|kernel| kernel.operations <= 2000)
        };
        let is_short = short("pencil_gradient") && short("forced_gradient");
        self.in_vectors += usize::from(excited && is_short);
    }
}

#[test]
fn every_lane_has_the_bits_of_its_arguments_alone() {
    let mut all = SideBySide::default();
    visit(&mut all);
    assert!(all.in_vectors > 0);
}

/// Screws, joints of several turns, loads, dampers, a force without a potential.
#[test]
fn motion_has_lanes_where_a_program_names_it() {
    fn every<M: Mechanism>(machine: &M) {
        let numbers = &mut Numbers::new(4);
        check_lanes(machine, lanes::MotionResidual, MotionKernel::Residual, numbers);
        check_lanes(machine, lanes::Motion, MotionKernel::Motion, numbers);
        check_lanes(machine, lanes::MotionLinear, MotionKernel::Linear, numbers);
    }
    every(&ScrewPress);
    every(&Carousel);
    every(&Rotor);
}
