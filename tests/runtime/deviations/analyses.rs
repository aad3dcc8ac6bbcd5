//! Questions about one state: a deviation has the same effect as its input.

use super::{Double, Governor, OMEGA, Single, Spherical, all_deviate, frequency, frequency_slopes, nominal, solved};
use crate::common::branching::{NearlyTwo, Rotor};
use crate::common::chain::DOUBLE;
use crate::common::close;
use crate::common::derived::Derived;
use crate::common::models::{Follower, Plate};
use crate::common::pendulum::Pendulum;
use eigentol::clusters::{clusters, directional_derivatives};
use eigentol::kernels::{CurvatureKernels, DeviatingInputs, Kernels, SummaryKernels};
use eigentol::second_order::{mode_curvature, output_curvature, second_order};
use eigentol::sensitivity::{equilibrium_shift, output_sensitivities, sensitivities};
use eigentol::shapes::shape_sensitivity;
use eigentol::summary::summary;
use eigentol::tolerance::{first_order, output_tolerances};
use eigentol::{Complex, Output, Quantity, Tolerances};

/// Checks all derivatives of a state by deviations against those by inputs, and the others against the mechanism
/// without deviations.
fn state<K: CurvatureKernels>(machine: &K, u: &[f64], start: &[f64]) {
    let plain: &dyn Kernels = machine;
    let deviating = all_deviate(machine);
    let b = nominal(machine);
    let own = b.len();
    let (plain_state, plain_modes) = solved(plain, u, &b, start);
    let (at, modes) = solved(&deviating, u, &deviating.design(&b), start);
    // A state found without deviations equals the state found with them.
    assert_eq!(at, plain_state.with_deviations(&deviating));
    assert_eq!(modes, plain_modes.with_deviations(&deviating));

    let shift = equilibrium_shift(&deviating, &at).unwrap();
    let without = equilibrium_shift(machine, &plain_state).unwrap();
    for (i, by_input) in shift.by_input.iter().enumerate() {
        assert_eq!(&shift.by_design[i][own..], by_input);
        assert_eq!(shift.by_design[i][..own], without.by_design[i]);
    }
    let outputs = output_sensitivities(&deviating, &at).unwrap();
    for (by_input, by_design) in outputs.by_input.iter().zip(&outputs.by_design) {
        let (by_input, by_design) = (by_input.as_ref().unwrap(), by_design.as_ref().unwrap());
        assert_eq!(by_design[own..], **by_input);
    }
    for output in 0..outputs.values.len() {
        let found = output_curvature(&deviating, &at, Output::new(output)).unwrap();
        let without = output_curvature(machine, &plain_state, Output::new(output)).unwrap();
        let (second, plain) = (&found.second, &without.second);
        let entries = second.by_design.as_flattened().iter();
        let scale = entries.fold(1.0, |most: f64, value| most.max(value.abs()));
        let near = |a: f64, b: f64| assert!((a - b).abs() <= 1e-11 * scale, "{a:e} {b:e}");
        for i in 0..u.len() {
            for j in 0..u.len() {
                near(second.by_design[own + i][own + j], plain.by_input[i][j]);
            }
            for k in 0..own {
                near(second.by_design[own + i][k], plain.by_input_and_design[i][k]);
            }
        }
    }

    let slopes = sensitivities(&deviating, &at, &modes).unwrap();
    let without = sensitivities(machine, &plain_state, &plain_modes).unwrap();
    let mut moving = 0;
    for (mode, without) in slopes.modes.iter().zip(&without.modes) {
        assert_eq!(mode.lambda.by_design[own..], *mode.lambda.by_input);
        let s = mode.s().unwrap();
        assert_eq!(s.by_design[own..], *s.by_input);
        moving += s.by_input.iter().filter(|slope| slope.norm() > 0.0).count();
        let without = without.s().unwrap().by_design;
        for (found, expected) in s.by_design.iter().zip(&without) {
            let scale = without.iter().fold(1.0, |most: f64, slope| most.max(slope.norm()));
            assert!((found - expected).norm() <= 1e-12 * scale, "{found} {expected}");
        }
    }
    assert!(moving > 0);

    for mode in 0..modes.modes.len() {
        let shapes = shape_sensitivity(&deviating, &at, &modes, mode).unwrap();
        let rows = shapes.right_by_input.iter().zip(shapes.right_by_design.iter().skip(own));
        rows.for_each(|(by_input, by_design)| assert_eq!(by_input, by_design));

        let curvature = mode_curvature(&deviating, &at, &modes, mode).unwrap();
        let second = &curvature.lambda;
        let scale = [&second.by_input, &second.by_design, &second.by_input_and_design];
        let scale = scale.map(|matrix| matrix.as_flattened()).concat();
        let scale = scale.iter().fold(1.0, |most: f64, x| most.max(x.abs()));
        let near = |a: f64, b: f64| assert!((a - b).abs() <= 1e-12 * scale, "{a:e} {b:e}");
        for i in 0..u.len() {
            for j in 0..u.len() {
                near(second.by_design[own + i][own + j], second.by_input[i][j]);
                near(second.by_input_and_design[i][own + j], second.by_input[i][j]);
            }
            for j in 0..own {
                near(second.by_design[own + i][j], second.by_input_and_design[i][j]);
            }
        }
    }
}

#[test]
fn derivatives_by_deviations_are_those_by_inputs() {
    state(&Pendulum, &[5.0], &[1.0]);
    state(&DOUBLE, &[5.0], &[1.0, 1.2]);
    state(&Derived(Plate), &[3.0], &[0.0; 2]);
    state(&Derived(Follower), &[1.0], &[0.0; 2]);
    state(&Single, &[5.0], &[1.0]);
    state(&Double, &[5.0, 3.0], &[1.0, 1.2]);
    state(&Spherical, &[2.0, 0.7, 0.5], &[0.0; 3]);
    state(&Governor, &[5.0], &[0.4, -0.5, 20.0]);
}

/// `sqrt(u^2 - c^2 / u^2)` with a deviating speed, for the hand-written and the compiled pendulum.
fn of_the_pendulum(machine: &dyn SummaryKernels, speed: f64, sigma: f64) {
    let deviating = DeviatingInputs::new(machine, &[OMEGA]).unwrap();
    let (at, modes) = solved(&deviating, &[speed], &deviating.design(&[3.0, 1.0]), &[1.0]);
    let tolerances = Tolerances::new([0.0, 0.0, 2.0 * sigma], 2.0, None).unwrap();
    let slopes = sensitivities(&deviating, &at, &modes).unwrap();
    let spread = first_order(&modes, &slopes, &tolerances).unwrap();
    let [slope, bend] = frequency_slopes(speed);
    let found = spread.modes[0].frequency().unwrap();
    close(found.mean, frequency(speed), 1e-13);
    close(found.sigma, slope.abs() * sigma, 1e-12);
    assert_eq!(found.variance_shares, [0.0, 0.0, 1.0]);

    let second = second_order(&deviating, &at, &modes, &tolerances);
    let frequency = &second.modes[0].as_ref().unwrap().frequency;
    close(frequency.model.slopes[2], slope, 1e-12);
    close(frequency.model.curvature[2][2], bend, 1e-11);
    close(frequency.moments.mean_shift, 0.5 * bend * sigma * sigma, 1e-11);
    let variance = (slope * sigma).powi(2) + 0.5 * (bend * sigma * sigma).powi(2);
    close(frequency.moments.sigma, variance.sqrt(), 1e-11);
    let curvature = mode_curvature(&deviating, &at, &modes, 0).unwrap();
    let by_input = curvature.of(Quantity::Frequency).unwrap().by_input[0][0];
    close(frequency.model.curvature[2][2], by_input, 1e-13);

    let whole = summary(&deviating, &at, &modes, &tolerances).unwrap();
    assert_eq!(whole.first, spread);
}

#[test]
fn a_wandering_speed_spreads_the_frequency_as_the_closed_form() {
    for (speed, sigma) in [(4.5, 0.02), (5.0, 0.1), (8.0, 0.3)] {
        of_the_pendulum(&Pendulum, speed, sigma);
        of_the_pendulum(&Single, speed, sigma);
    }
}

/// Speed and length together, also correlated.
#[test]
fn deviations_take_part_in_correlations() {
    let deviating = all_deviate(&Pendulum);
    let (at, modes) = solved(&deviating, &[5.0], &deviating.design(&[3.0, 1.0]), &[1.0]);
    let slopes = sensitivities(&deviating, &at, &modes).unwrap();
    let rates = slopes.modes[0].frequency().unwrap().by_design;
    let correlation = [[1.0, 0.0, 0.0], [0.0, 1.0, -1.0], [0.0, -1.0, 1.0]];
    let half_widths = [0.0, 0.03, 0.3];
    let together = Tolerances::new(half_widths, 3.0, Some(correlation.into())).unwrap();
    let spread = first_order(&modes, &slopes, &together).unwrap();
    let sigma = spread.modes[0].frequency().unwrap().sigma;
    close(sigma, (rates[1] * 0.01 - rates[2] * 0.1).abs(), 1e-12);
}

/// The tip height of a bar and twice its speed, the latter a direct function of the input.
#[test]
fn outputs_spread_with_inputs() {
    let deviating = all_deviate(&Spherical);
    let b = deviating.design(&[20.0, 0.3]);
    let (at, _) = solved(&deviating, &[2.0, 0.7, 0.5], &b, &[0.0; 3]);
    let outputs = output_sensitivities(&deviating, &at).unwrap();
    let tolerances = Tolerances::new([0.0, 0.0, 0.0, 0.06, 0.0], 3.0, None).unwrap();
    let spread = output_tolerances(&outputs, &tolerances).unwrap();
    for (o, spread) in spread.spreads.iter().enumerate() {
        let by_speed = outputs.by_input[o].as_ref().unwrap()[1];
        close(spread.as_ref().unwrap().sigma, 0.02 * by_speed.abs(), 1e-12);
    }
    assert!(spread.spreads[1].as_ref().unwrap().sigma > 0.03);
}

/// Two equal stiffnesses `1 - u`: both eigenvalues decrease with `u`. Two nearly equal ones move together.
#[test]
fn clusters_move_with_inputs() {
    let rotor = Derived(Rotor);
    let deviating = all_deviate(&rotor);
    let (at, modes) = solved(&deviating, &[0.4], &[0.0], &[0.0; 2]);
    let tolerances = Tolerances::new([0.03], 3.0, None).unwrap();
    let found = clusters(&deviating, &at, &modes, &tolerances).unwrap();
    assert_eq!(found.len(), 1);
    assert_eq!(found[0].modes, [0, 1]);
    let mean = found[0].mean.as_ref().unwrap();
    assert_eq!(mean.by_design[..], mean.by_input[..]);
    close(mean.by_design[0].re, -1.0, 1e-13);
    close(mean.sigma_re, 0.01, 1e-12);

    let nearly = Derived(NearlyTwo);
    let deviating = all_deviate(&nearly);
    let b = deviating.design(&[0.0]);
    let (at, modes) = solved(&deviating, &[0.4], &b, &[0.0; 2]);
    let along = |du: f64, db: [f64; 2]| directional_derivatives(&deviating, &at, &modes, 0, (&[du], &db)).unwrap();
    assert_eq!(along(0.7, [0.2, 0.0]), along(0.0, [0.2, 0.7]));
    assert_eq!(along(0.7, [0.2, 0.0]), along(0.5, [0.2, 0.2]));
    let eigenvalues = along(0.0, [0.2, 0.7]).eigenvalues;
    for (found, expected) in eigenvalues.iter().zip([-0.7, -0.5]) {
        assert!((found - Complex::from(expected)).norm() < 1e-13);
    }
}
