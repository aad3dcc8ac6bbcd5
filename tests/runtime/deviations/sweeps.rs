//! Sweeps of a deviating input.

use std::ops::ControlFlow;

use super::{Double, OMEGA, Single, all_deviate, frequency_slopes};
use crate::common::close;
use eigentol::kernels::BatchKernels;
use eigentol::scalar::Instructions;
use eigentol::sweep::{Following, SweepPoint, sensitivity_sweep, sweep};
use eigentol::{Error, Policy, Sensitivities};

fn values(count: usize) -> Vec<f64> {
    (0..count).map(|k| 4.5 + 3.5 * k as f64 / count as f64).collect()
}

/// Points and derivatives, with the given instruction set or one by one.
fn swept(
    machine: &dyn BatchKernels,
    (u, b): (&[f64], &[f64]),
    start: &[f64],
    vectors: Option<Instructions>,
) -> Vec<(SweepPoint, Result<Sensitivities, Error>)> {
    let following = Following::from(Policy::Stable).vectors(vectors);
    let mut all = Vec::new();
    let each = |point: &SweepPoint, slopes: &Result<Sensitivities, Error>| {
        all.push((point.clone(), slopes.clone()));
        ControlFlow::Continue(())
    };
    sensitivity_sweep(machine, (u, b), start, following, (OMEGA, &values(60)), each).unwrap();
    all
}

fn compare(machine: &dyn BatchKernels, (u, b): (&[f64], &[f64]), start: &[f64]) {
    let own = b.len() - u.len();
    let alone = swept(machine, (u, b), start, None);
    let together = swept(machine, (u, b), start, Some(Instructions::SCALAR));
    for set in Instructions::available() {
        let other = swept(machine, (u, b), start, Some(set));
        assert!(format!("{other:?}") == format!("{together:?}"), "{set:?}");
    }
    // Rounding differences reveal which points were solved in vectors.
    let differ = alone.iter().zip(&together).filter(|(a, b)| a != b).count();
    assert!(differ >= 30, "{differ}");
    assert_eq!(alone.len(), together.len());
    for ((point, slopes), (expected, expected_slopes)) in together.iter().zip(&alone) {
        let [modes, expected] = [point, expected].map(|point| point.modes.as_ref().unwrap());
        for (mode, expected) in modes.modes.iter().zip(&expected.modes) {
            close(mode.lambda, expected.lambda, 1e-10);
        }
        let [slopes, expected] = [slopes, expected_slopes].map(|slopes| &slopes.as_ref().unwrap().modes);
        for (slopes, expected) in slopes.iter().zip(expected) {
            assert_eq!(slopes.lambda.by_design[own..], *slopes.lambda.by_input);
            let expected = &expected.lambda.by_design;
            let size = expected.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
            for (found, expected) in slopes.lambda.by_design.iter().zip(expected) {
                assert!((found - expected).abs() <= 1e-9 * size);
            }
        }
    }
}

#[test]
fn side_by_side_is_one_by_one() {
    let one = all_deviate(&Single);
    compare(&one, (&[0.0], &one.design(&[3.0, 1.0])), &[1.0]);
    let two = all_deviate(&Double);
    compare(&two, (&[0.0, 2.0], &two.design(&[3.0, 3.0, 1.0, 1.0])), &[1.0, 1.1]);
}

#[test]
fn slopes_along_a_sweep_are_the_closed_form() {
    let deviating = all_deviate(&Single);
    let b = deviating.design(&[3.0, 1.0]);
    for vectors in [None, Some(Instructions::best())] {
        for (point, slopes) in swept(&deviating, (&[0.0], &b), &[1.0], vectors) {
            let [slope, _] = frequency_slopes(point.value);
            let found = slopes.unwrap().modes[0].frequency().unwrap().by_design;
            close(found[2], slope, 1e-10);
        }
    }
}

/// A sweep with a fixed deviation equals the sweep of the shifted values.
#[test]
fn a_fixed_deviation_moves_the_sweep() {
    let deviating = all_deviate(&Single);
    let mut b = deviating.design(&[3.0, 1.0]);
    b[2] = 0.25;
    let set = values(60);
    let moved: Vec<f64> = set.iter().map(|value| value + 0.25).collect();
    let found = sweep(&deviating, &[0.0], &b, &[1.0], Policy::Stable, OMEGA, &set).unwrap();
    let expected = sweep(&Single, &[0.0], &[3.0, 1.0], &[1.0], Policy::Stable, OMEGA, &moved);
    for (found, expected) in found.points.iter().zip(&expected.unwrap().points) {
        let [found, expected] = [found, expected].map(|point| &point.modes.as_ref().unwrap().modes);
        close(found[0].lambda, expected[0].lambda, 1e-11);
    }
}
