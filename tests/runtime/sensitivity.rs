//! Total derivatives: closed forms, references, three methods against each other, critical states.

use crate::common::branching::{Exchange, Imperfect, Lopsided, LopsidedSnap, NearlyTwo, Quintic, Snap};
use crate::common::chain::{Bars, DOUBLE};
use crate::common::close;
use crate::common::derived::Derived;
use crate::common::models::{Pair, Plate, Spring};
use crate::common::pendulum::{Pendulum, W};
use crate::common::priced::{Priced, Source};
use eigentol::equilibrium::equilibrium;
use eigentol::kernels::{DirectionalKernels, MotionKernels};
use eigentol::modes::{modes, undamped_modes};
use eigentol::motion::accelerations;
use eigentol::second_order::mode_curvature;
use eigentol::sensitivity::{
    ModeSensitivity, equilibrium_shift, output_sensitivities, sensitivities, sensitivities_by_finite_difference,
    sensitivities_explicit, sensitivities_with_frozen_equilibrium,
};
use eigentol::shapes::shape_sensitivity;
use eigentol::sweep::{Range, critical_state, crossings};
use eigentol::sweep::{critical_sensitivity, crossing_sensitivity};
use eigentol::{DampingKind, Error, Family, Input, Policy, Vector};

const BAR: [f64; 2] = [3.0, 1.0];

/// Solves, differentiates by every method, checks that they agree, and returns `domega/du` and `domega/db` by mode.
fn all_ways(mechanism: &dyn DirectionalKernels, u: &[f64], b: &[f64], start: &[f64]) -> Vec<(Vector, Vector)> {
    let state = equilibrium(mechanism, u, b, start, Policy::Stable).unwrap();
    let undamped_modes = undamped_modes(&state).unwrap();
    let adjoint = sensitivities(mechanism, &state, &undamped_modes).unwrap();
    let explicit = sensitivities_explicit(mechanism, &state, &undamped_modes).unwrap();
    let numeric = sensitivities_by_finite_difference(mechanism, &state, &undamped_modes, 5e-6).unwrap();
    for (r, exact) in adjoint.modes.iter().enumerate() {
        let scale = undamped_modes.modes[r].lambda.abs();
        let rows = [&explicit.modes[r], &numeric.modes[r]].into_iter().zip([1e-11, 1e-6]);
        for (other, tolerance) in rows {
            let pairs = exact.lambda.by_input.iter().zip(&other.lambda.by_input);
            for (a, b) in pairs.chain(exact.lambda.by_design.iter().zip(&other.lambda.by_design)) {
                assert!((a - b).abs() <= tolerance * (a.abs() + scale + 1.0), "{r}: {a} {b}");
            }
        }
    }
    let rates = |mode: &ModeSensitivity| {
        let slopes = mode.frequency().unwrap();
        (slopes.by_input, slopes.by_design)
    };
    adjoint.modes.iter().map(rates).collect()
}

#[test]
fn pendulum_above_and_below_its_critical_speed() {
    for omega in [1.0, 3.0, 3.8, 3.9, 5.0, 8.0] {
        let (by_input, by_design) = &all_ways(&Pendulum, &[omega], &BAR, &[1.0])[0];
        let (expected_l, expected_u) = if omega * omega < W {
            let own = (W - omega * omega).sqrt();
            (-W / (2.0 * own), -omega / own)
        } else {
            let square = omega * omega;
            let own = (square - W * W / square).sqrt();
            (W * W / (square * own), (omega + W * W / (square * omega)) / own)
        };
        close(by_design[1], expected_l, 1e-11);
        close(by_input[0], expected_u, 1e-11);
        assert!(by_design[0].abs() < 1e-10, "mass has no influence");
    }
}

#[test]
fn frozen_equilibrium_is_minus_half_of_the_truth_above() {
    let state = equilibrium(&Pendulum, &[5.0], &BAR, &[1.0], Policy::Stable).unwrap();
    let found = modes(&state).unwrap();
    let truth = sensitivities(&Pendulum, &state, &found).unwrap();
    let frozen = sensitivities_with_frozen_equilibrium(&Pendulum, &state, &found).unwrap();
    close(
        frozen.modes[0].frequency().unwrap().by_design[1],
        -0.5 * truth.modes[0].frequency().unwrap().by_design[1],
        1e-12,
    );
    assert!(frozen.to_string().contains("NOT"));
}

const BARS: [f64; 4] = [0.8, 1.1, 2.5, 3.7];

/// Partial derivatives of the matrices, of the residual alone, or reverse differentiation: [`chains_match_references`]
/// proves one of them.
#[test]
fn every_source_of_gradients_follows_the_equilibrium() {
    let expected = all_ways(&DOUBLE, &[3.2], &BARS, &[1.0; 2]);
    for damping in [DampingKind::Zero, DampingKind::General] {
        for from in [Source::Partials, Source::ResidualPartials, Source::Reverse] {
            let machine = Priced { machine: &DOUBLE, from, damping };
            let at = equilibrium(&machine, &[3.2], &BARS, &[1.0; 2], Policy::Stable).unwrap();
            let rates = sensitivities(&machine, &at, &modes(&at).unwrap()).unwrap();
            for (mode, (by_input, by_design)) in rates.modes.iter().zip(&expected) {
                let slopes = mode.frequency().unwrap();
                let actual = slopes.by_input.iter().chain(&slopes.by_design);
                for (actual, expected) in actual.zip(by_input.iter().chain(by_design)) {
                    close(*actual, *expected, 1e-11);
                }
            }
        }
    }
}

#[test]
fn chains_match_references() {
    // From 50-digit arithmetic (mpmath): d omega / d (lengths, masses), including the equilibrium shift.
    let double = all_ways(&DOUBLE, &[3.2], &BARS, &[1.0; 2]);
    let expected = [
        [1.588_094_273_217_023_7, 1.136_740_249_680_494_1, -0.081_963_130_653_487_3, 0.055_380_493_684_788_715],
        [1.215_665_649_693_897_8, -0.237_222_531_740_692_85, -0.751_485_162_446_697_6, 0.507_760_244_896_417_3],
    ];
    for ((_, actual), expected) in double.iter().zip(expected) {
        for (actual, expected) in actual.iter().zip(expected) {
            close(*actual, expected, 1e-9);
        }
    }
    let design = [1.0, 0.9, 1.2, 0.8, 3.0, 2.5, 3.5, 2.0];
    let four = all_ways(&Derived(Bars::<4>), &[2.5], &design, &[1.0; 4]);
    let lowest = [
        0.329_527_998_895_002_7,
        0.373_172_589_328_717_8,
        0.301_304_717_111_157_2,
        0.107_500_001_116_898_3,
        -0.015_502_511_406_539_76,
        -0.029_293_048_764_126_98,
        -0.004_375_068_273_559_883,
        0.067_526_447_543_698_16,
    ];
    for (actual, expected) in four[0].1.iter().zip(lowest) {
        close(*actual, expected, 1e-9);
    }
}

#[test]
fn plate_matches_closed_form() {
    let rates = all_ways(&Derived(Plate), &[4.0], &[0.5, 40.0, 60.0, 0.0], &[0.1, 0.02]);
    close(rates[0].1[0], -10.0, 1e-12);
    close(rates[0].1[1], 0.125, 1e-12);
    close(rates[0].0[0], -0.5, 1e-12);
    close(rates[1].1[2], 0.098_058_067_569_092_02, 1e-12);
    let state = equilibrium(&Derived(Plate), &[4.0], &[0.5, 40.0, 60.0, 0.0], &[0.0; 2], Policy::Stable);
    let shift = equilibrium_shift(&Derived(Plate), &state.unwrap()).unwrap();
    close(shift.by_design[0][0], 0.0625, 1e-13);
    close(shift.by_design[0][1], -0.000_781_25, 1e-12);
    close(shift.by_input[1][0], 0.001_775_147_928_994_082_8, 1e-12);
}

#[test]
fn outputs_move_with_the_equilibrium() {
    let omega = 5.0;
    let state = equilibrium(&Pendulum, &[omega], &BAR, &[1.0], Policy::Stable).unwrap();
    let tip = output_sensitivities(&Pendulum, &state).unwrap();
    // r = L sin q with cos q = W / (L Omega^2): dr/dL = sin q + cos^2 q / sin q.
    let (sin, cos) = state.coordinates[0].sin_cos();
    close(tip.values[0], sin, 1e-14);
    close(tip.by_design[0].as_ref().unwrap()[1], sin + cos * cos / sin, 1e-12);
    close(tip.by_input[0].as_ref().unwrap()[0], 2.0 * cos * cos / (omega * sin), 1e-12);
}

#[test]
fn critical_speed_and_crossing_move_with_the_length() {
    let range = Range::new(Input::new(0), 0.1, 5.0).steps(60);
    let critical = critical_state(&Pendulum, &[0.0], &BAR, &[1.0], range).unwrap();
    let rates = critical_sensitivity(&Pendulum, &critical).unwrap();
    close(rates[1], -0.5 * W.sqrt(), 1e-10);
    assert!(rates[0].abs() < 1e-10);
    let met = crossings(&Pendulum, &[0.0], &BAR, &[1.0], Policy::Stable, range, 1.0).unwrap();
    close(crossing_sensitivity(&Pendulum, &met[0]).unwrap()[1], -0.5 * (0.5 * W).sqrt(), 1e-10);

    let bars = BARS;
    let value = |b: &[f64; 4]| critical_state(&DOUBLE, &[0.0], b, &[1.0; 2], range).unwrap();
    let exact = critical_sensitivity(&DOUBLE, &value(&bars)).unwrap();
    for j in 0..4 {
        let (mut up, mut down) = (bars, bars);
        up[j] *= 1.0 + 1e-5;
        down[j] *= 1.0 - 1e-5;
        let slope = (value(&up).value - value(&down).value) / (up[j] - down[j]);
        assert!((exact[j] - slope).abs() < 1e-7, "{j}: {} {slope}", exact[j]);
    }
}

#[test]
fn limit_point_moves_with_the_force() {
    // k_c = 3 (force/2)^(2/3) for k q - q^3 = force.
    let range = Range::new(Input::new(0), 4.0, 1.0).steps(20);
    let fold = critical_state(&Derived(Spring), &[0.0], &[1.0, -1.0, 1.0], &[0.25], range).unwrap();
    let rates = critical_sensitivity(&Derived(Spring), &fold).unwrap();
    close(rates[2], 0.5f64.powf(2.0 / 3.0) * 2.0, 1e-10);
}

/// Critical sensitivities against closed forms, and against differences of critical values found again.
fn moves(machine: &dyn DirectionalKernels, b: &[f64], start: &[f64], (low, high): (f64, f64), expected: &[f64]) {
    let range = Range::new(Input::new(0), low, high).steps(20);
    let at = |b: &[f64]| critical_state(machine, &[0.0], b, start, range).unwrap();
    let rates = critical_sensitivity(machine, &at(b)).unwrap();
    for j in 0..b.len() {
        assert!(
            (rates[j] - expected[j]).abs() < 1e-10 * (1.0 + expected[j].abs()),
            "{j}: {} {}",
            rates[j],
            expected[j]
        );
        let (mut up, mut down) = (b.to_vec(), b.to_vec());
        up[j] += 1e-4;
        down[j] -= 1e-4;
        let slope = (at(&up).value - at(&down).value) / (up[j] - down[j]);
        assert!((rates[j] - slope).abs() < 1e-6, "{j}: {} {slope}", rates[j]);
    }
}

#[test]
fn critical_values_move_as_their_closed_forms_do() {
    let root = (1.3 / 3.0f64).sqrt();
    moves(&Derived(Snap), &[1.3], &[2.0], (-1.0, 2.0), &[root]);
    // 2 (a/3)^(3/2) with a = 1 - k/2.
    let root = ((1.0 - 0.1) / 3.0f64).sqrt();
    moves(&Derived(LopsidedSnap), &[0.2], &[2.0, 1.0], (-1.0, 2.0), &[-0.5 * root]);
    let (d, e, s) = (0.1, -0.2, 0.7);
    moves(&Derived(Exchange), &[d, e, s], &[d], (-1.0, 1.0), &[1.0 + 1.0 / s, -1.0 / s, -(d - e) / (s * s)]);
    moves(&Derived(Quintic), &[1.2], &[0.0], (0.0, 2.0), &[1.0]);
    // The determinant of the non-symmetric mechanism is negative from k (3 - 8^(1/2)).
    moves(&Derived(Lopsided), &[1.1], &[0.0; 2], (0.01, 1.0), &[3.0 - 8f64.sqrt()]);
}

#[test]
fn what_destroys_a_bifurcation_has_no_derivative() {
    let range = Range::new(Input::new(0), -1.0, 1.0).steps(20);
    let perfect = [0.0, 0.1];
    let critical = critical_state(&Derived(Imperfect), &[0.0], &perfect, &[0.0], range).unwrap();
    close(critical.value, 0.1, 1e-13);
    assert!(matches!(critical_sensitivity(&Derived(Imperfect), &critical), Err(Error::NoSensitivity { .. })));
    let range = Range::new(Input::new(0), -1.0, 1.9).steps(20);
    let both = critical_state(&Derived(NearlyTwo), &[0.0], &[0.0], &[0.0; 2], range).unwrap();
    assert!(matches!(critical_sensitivity(&Derived(NearlyTwo), &both), Err(Error::ClusteredMode { .. })));
}

#[test]
fn a_critical_state_has_no_ordinary_shift() {
    let state = equilibrium(&Derived(Spring), &[0.0], &[1.0, 0.0, 0.0], &[0.0], Policy::Stable).unwrap();
    assert_eq!(equilibrium_shift(&Derived(Spring), &state), Err(Error::CriticalState));
    let found = modes(&state).unwrap();
    assert_eq!(sensitivities(&Derived(Spring), &state, &found), Err(Error::CriticalState));
}

#[test]
fn clustered_modes_are_flagged() {
    let state = equilibrium(&Derived(Plate), &[1.0], &[0.5, 40.0, 40.0, 0.0], &[0.0; 2], Policy::Stable).unwrap();
    let undamped_modes = undamped_modes(&state).unwrap();
    let rates = sensitivities(&Derived(Plate), &state, &undamped_modes).unwrap();
    assert!(rates.modes.iter().all(|mode| mode.clustered));
    assert!(rates.to_string().contains("does not exist"));
}

#[test]
fn accelerations_solve_the_equation_of_motion() {
    let (q, v) = ([0.4, -0.9], [1.5, -2.5]);
    let (u, b) = ([2.0], BARS);
    let a = accelerations(&DOUBLE, &v, &q, &u, &b).unwrap();
    let rest = (&DOUBLE as &dyn MotionKernels).motion_residual(&a, &v, &q, &u, &b);
    assert!(rest.iter().all(|value| value.abs() < 1e-12));
    let massless = accelerations(&Derived(Spring), &[0.0], &[0.0], &[1.0], &[0.0, 0.0, 1.0]);
    let coordinate = "x".into();
    assert_eq!(massless, Err(Error::SingularMass { coordinate }));
}

#[test]
fn modes_of_a_cluster_have_no_derivatives_beyond_the_first() {
    let pair = Derived(Pair);
    for (gap, clustered) in [(0.0, true), (1e-12, true), (1e-7, true), (1e-5, false)] {
        let b = [100.0, 100.0 * (1.0 + gap), 0.0];
        let state = equilibrium(&pair, &[], &b, &[0.0; 2], Policy::Stable).unwrap();
        let found = modes(&state).unwrap();
        let first = sensitivities(&pair, &state, &found).unwrap();
        assert_eq!(first.modes[0].clustered, clustered);
        let refused = Some(Error::ClusteredMode { mode: 0 }).filter(|_| clustered);
        assert_eq!(mode_curvature(&pair, &state, &found, 0).err(), refused);
        assert_eq!(shape_sensitivity(&pair, &state, &found, 0).err(), refused);
    }
}

/// `lambda = -Re s^2` of a damped oscillator is `k / m - c^2 / (2 m^2)`; the plate at rest consists of two.
#[test]
fn second_derivatives_of_lambda_of_a_damped_oscillator() {
    let (m, springs, c) = (0.5_f64, [40.0, 60.0], 0.7_f64);
    let plate = Derived(Plate);
    let b = [m, springs[0], springs[1], c];
    let state = equilibrium(&plate, &[0.0], &b, &[0.0; 2], Policy::Stable).unwrap();
    let found = modes(&state).unwrap();
    assert_eq!(found.family, Family::General);
    for (r, k) in springs.into_iter().enumerate() {
        let curvature = mode_curvature(&plate, &state, &found, r).unwrap();
        close(found.modes[r].lambda, k / m - c * c / (2.0 * m * m), 1e-12);
        let mut expected = [[0.0; 4]; 4];
        expected[0][0] = 2.0 * k / m.powi(3) - 3.0 * c * c / m.powi(4);
        expected[0][1 + r] = -1.0 / (m * m);
        expected[1 + r][0] = -1.0 / (m * m);
        expected[0][3] = 2.0 * c / m.powi(3);
        expected[3][0] = 2.0 * c / m.powi(3);
        expected[3][3] = -1.0 / (m * m);
        let scale = expected[0][0];
        for (row, expected) in curvature.lambda.by_design.iter().zip(expected) {
            for (value, expected) in row.iter().zip(expected) {
                assert!((value - expected).abs() < 1e-11 * scale, "{value} {expected}");
            }
        }
        // lambda is an even function of the speed.
        assert!(curvature.lambda.by_input_and_design[0].iter().all(|value| value.abs() < 1e-9));
    }
}
