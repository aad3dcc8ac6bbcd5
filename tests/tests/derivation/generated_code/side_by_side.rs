//! Kernels with several sets of arguments at once, compiled and interpreted: each lane has the bits of its set alone.

use eigentol::Mechanism;
use eigentol::kernels::{Extent, Kernel, Kernels, Sizes};
use eigentol::scalar::{Batch, WIDTH};
use eigentol_interpreter::Interpreted;
use eigentol_tests::corpus::{Visitor, visit};

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
    let sizes = machine.sizes();
    let lengths = kernel.arguments().iter().enumerate();
    // The third argument are the design variables.
    let lengths = lengths.map(|(k, item)| (["", "b"][usize::from(k == 2)], count(*item, sizes)));
    let lengths: Vec<(&str, usize)> = lengths.collect();
    let sets: Vec<Vec<Vec<f64>>> = (0..WIDTH).map(|_| numbers.arguments(machine, &lengths)).collect();
    let lanes: Vec<Vec<Batch>> = (0..lengths.len())
        .map(|k| {
            let entry = |i: usize| Batch::from_fn(|lane| sets[lane][k][i]);
            (0..lengths[k].1).map(entry).collect()
        })
        .collect();
    let shapes = kernel.results().iter();
    let shapes: Vec<usize> = shapes.map(|[rows, columns]| count(*rows, sizes) * count(*columns, sizes)).collect();
    let mut together: Vec<Vec<Batch>> = shapes.iter().map(|count| vec![Batch::all(7.0); *count]).collect();
    let arguments: Vec<&[Batch]> = lanes.iter().map(Vec::as_slice).collect();
    let mut to: Vec<&mut [Batch]> = together.iter_mut().map(Vec::as_mut_slice).collect();
    machine.evaluate_batch(kernel, &arguments, &mut to);
    for (lane, set) in sets.iter().enumerate() {
        let arguments: Vec<&[f64]> = set.iter().map(Vec::as_slice).collect();
        let mut alone: Vec<Vec<f64>> = shapes.iter().map(|count| vec![8.0; *count]).collect();
        let mut to: Vec<&mut [f64]> = alone.iter_mut().map(Vec::as_mut_slice).collect();
        machine.evaluate(kernel, &arguments, &mut to);
        for (together, alone) in together.iter().flatten().zip(alone.iter().flatten()) {
            let (found, expected) = (together.0[lane], *alone);
            assert!(found.to_bits() == expected.to_bits(), "{name} {}: {found:e} {expected:e}", kernel.name());
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
