//! Derivatives of the kernels of excitations, against central differences of `forcing` and `output_motion`; compiled
//! and interpreted.

use eigentol::Mechanism;
use eigentol::kernels::{Curvature, CurvatureKernels, Extent, Kernel};
use eigentol_interpreter::Interpreted;
use eigentol_tests::corpus::{self, Visitor};
use eigentol_tests::loops;

use crate::forcing::compared::{Random, length, results, room};

type Lists = Vec<Vec<f64>>;

fn views(lists: &Lists) -> Vec<&[f64]> {
    lists.iter().map(Vec::as_slice).collect()
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn moved(at: &Lists, along: &Lists, step: f64) -> Lists {
    let pairs = at.iter().zip(along);
    pairs.map(|(at, along)| at.iter().zip(along).map(|(a, d)| a + step * d).collect()).collect()
}

/// The derivative of lists along a step, by central differences, extrapolated twice.
fn slope(f: impl Fn(f64) -> Vec<f64>) -> Vec<f64> {
    const STEP: f64 = 1e-2;
    let difference = |step: f64| -> Vec<f64> {
        let (up, down) = (f(step), f(-step));
        let pairs = up.iter().zip(&down);
        pairs.map(|(up, down)| (up - down) / (2.0 * step)).collect()
    };
    let better = |coarse: &[f64], fine: &[f64], power: f64| -> Vec<f64> {
        let pairs = coarse.iter().zip(fine);
        pairs.map(|(coarse, fine)| (power * fine - coarse) / (power - 1.0)).collect()
    };
    let mut columns: Vec<Vec<f64>> = (0..4).map(|k| difference(STEP / f64::from(1 << k))).collect();
    for power in [4.0, 16.0, 64.0] {
        columns = columns.windows(2).map(|pair| better(&pair[0], &pair[1], power)).collect();
    }
    columns.swap_remove(0)
}

fn assert_near(values: &[f64], expected: &[f64], what: &str) {
    assert_eq!(values.len(), expected.len(), "{what}");
    let size = expected.iter().fold(1e-6_f64, |most, x| most.max(x.abs()));
    for (found, expected) in values.iter().zip(expected) {
        let near = (found - expected).abs() < 1e-8 * size;
        assert!(near, "{what}: {found} instead of {expected}, of {size}");
    }
}

/// The functional of which `forced_gradient` is the gradient, at `at` (coordinates, inputs, design).
fn functional(machine: &dyn CurvatureKernels, at: &Lists, weights: &[Vec<f64>]) -> f64 {
    let at = views(at);
    let forcing = results(machine, Kernel::Forcing, &at);
    let motion = results(machine, Kernel::OutputMotion, &at);
    let [output, acceleration, velocity, position, share] = [0, 1, 2, 3, 4].map(|k| &weights[k]);
    let n = acceleration.len();
    let mut sum = dot(&weights[9], &forcing[1]);
    for (o, weight) in output.iter().enumerate() {
        for (rows, by) in motion.iter().zip([acceleration, velocity, position]) {
            sum += weight * dot(&rows[o * n..(o + 1) * n], by);
        }
    }
    for (k, share) in share.iter().enumerate() {
        // cosine, sine, direct cosine, direct sine
        for (weights, result) in weights[5..9].iter().zip([0, 3, 2, 4]) {
            let width = weights.len();
            sum += share * dot(weights, &forcing[result][k * width..(k + 1) * width]);
        }
    }
    sum
}

/// Steps in the size of what they change.
fn directions(machine: &dyn CurvatureKernels, at: &Lists, random: &mut Random) -> Lists {
    let description = machine.description();
    let mut along: Lists = at.iter().map(|list| random.numbers(list.len())).collect();
    for list in [1, 2] {
        for (along, value) in along[list].iter_mut().zip(&at[list]) {
            *along *= value.abs();
        }
    }
    for (k, along) in along[0].iter_mut().enumerate() {
        *along *= description.large(k).min(1.0);
    }
    along
}

fn check(machine: &dyn CurvatureKernels, name: &str, seed: u64) {
    let mut random = Random::new(seed);
    let description = machine.description();
    let sizes = machine.sizes();
    let nominal = description.design.iter().map(|value| value.nominal).collect();
    let at: Lists = vec![
        random.numbers(sizes.coordinates).iter().map(|x| 0.3 * x).collect(),
        (0..sizes.inputs).map(|_| 20.0 + 5.0 * random.number()).collect(),
        nominal,
    ];
    let along = directions(machine, &at, &mut random);
    let weights: Lists = Kernel::ForcedGradient.arguments()[3..]
        .iter()
        .map(|extent: &Extent| random.numbers(length(machine, *extent)))
        .collect();
    let arguments: Lists = at.iter().chain(&weights).cloned().collect();

    let gradient = results(machine, Kernel::ForcedGradient, &views(&arguments));
    for (list, what) in ["coordinates", "inputs", "design"].iter().enumerate() {
        for k in 0..at[list].len() {
            let mut one: Lists = at.iter().map(|list| vec![0.0; list.len()]).collect();
            one[list][k] = along[list][k];
            let expected = slope(|step| vec![functional(machine, &moved(&at, &one, step), &weights)]);
            let found = [gradient[list][k] * along[list][k]];
            let scale = functional(machine, &at, &weights).abs();
            let error = (found[0] - expected[0]).abs();
            assert!(
                error < 1e-8 * scale.max(expected[0].abs()),
                "{name}: by {what} {k} {found:?} instead of {expected:?}"
            );
        }
    }

    for (kernel, curvature) in [(Kernel::Forcing, Curvature::Forcing), (Kernel::OutputMotion, Curvature::OutputMotion)]
    {
        let found = curved(machine, curvature, &at, &along);
        let parts = found.len();
        for (part, found) in found.iter().enumerate() {
            let expected = slope(|step| results(machine, kernel, &views(&moved(&at, &along, step))).swap_remove(part));
            assert_near(found, &expected, &format!("{name}: {curvature:?} {part} of {parts}"));
        }
    }
    let along: Lists = arguments
        .iter()
        .enumerate()
        .map(|(k, list)| along.get(k).cloned().unwrap_or_else(|| random.numbers(list.len())))
        .collect();
    let found = curved(machine, Curvature::ForcedGradient, &arguments, &along);
    for (part, found) in found.iter().enumerate() {
        let expected = slope(|step| {
            results(machine, Kernel::ForcedGradient, &views(&moved(&arguments, &along, step))).swap_remove(part)
        });
        assert_near(found, &expected, &format!("{name}: curvature of gradient {part}"));
    }
}

fn curved(machine: &dyn CurvatureKernels, kernel: Curvature, arguments: &Lists, along: &Lists) -> Lists {
    let mut all = room(machine, kernel.into());
    let mut results: Vec<&mut [f64]> = all.iter_mut().map(Vec::as_mut_slice).collect();
    machine.evaluate_curvature(kernel, &views(arguments), &views(along), &mut results);
    all
}

struct Checked(usize);

impl Visitor for Checked {
    fn visit<M: Mechanism + Copy>(&mut self, name: &'static str, declaration: &'static str, machine: M) {
        if M::DESCRIPTION.excitations.is_empty() {
            return;
        }
        self.0 += 1;
        let twin = Interpreted::from_text(declaration).expect("a declaration");
        for seed in 0..3 {
            check(&twin, name, seed);
            check(&machine, name, seed);
        }
        alike(&twin, &machine, name);
    }
}

/// Compiled and interpreted, bit for bit.
fn alike(twin: &dyn CurvatureKernels, machine: &dyn CurvatureKernels, name: &str) {
    let mut random = Random::new(7);
    for kernel in [Kernel::Forcing, Kernel::OutputMotion, Kernel::ForcedGradient] {
        let mut list = |extent: &Extent| random.numbers(length(machine, *extent));
        let arguments: Lists = kernel.arguments().iter().map(&mut list).collect();
        let [one, other] = [twin, machine].map(|x| results(x, kernel, &views(&arguments)));
        assert_eq!(format!("{one:?}"), format!("{other:?}"), "{name} {kernel:?}");
    }
    for curvature in [Curvature::Forcing, Curvature::OutputMotion, Curvature::ForcedGradient] {
        let kernel = Kernel::from(curvature);
        let mut list = |extent: &Extent| random.numbers(length(machine, *extent));
        let arguments: Lists = kernel.arguments().iter().map(&mut list).collect();
        let along: Lists = kernel.arguments().iter().map(&mut list).collect();
        let [one, other] = [twin, machine].map(|x| curved(x, curvature, &arguments, &along));
        for (one, other) in one.iter().zip(&other) {
            for (one, other) in one.iter().zip(other) {
                let near = (one - other).abs() <= 1e-12 * one.abs().max(1e-9);
                assert!(near || one.is_nan() && other.is_nan(), "{name} {curvature:?}: {one} {other}");
            }
        }
    }
}

#[test]
fn derivatives_of_machines_with_excitations() {
    let mut checked = Checked(0);
    corpus::visit(&mut checked);
    loops::visit(&mut checked);
    assert!(checked.0 >= 4, "{}", checked.0);
}
