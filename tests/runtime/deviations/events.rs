//! Input values at which an event occurs, when the input itself deviates.

use super::{CRITICAL, Double, OMEGA, Single, all_deviate, frequency_slopes, solved};
use crate::common::branching::Snap;
use crate::common::chain::DOUBLE;
use crate::common::derived::{Derived, Model};
use crate::common::models::Spring;
use crate::common::pendulum::Pendulum;
use crate::common::{METRE, NUMBER, close, coordinate, description, design, input, sizes};
use eigentol::campbell::{Axes, campbell};
use eigentol::kernels::CurvatureKernels;
use eigentol::second_order::{critical_curvature, crossing_curvature};
use eigentol::sweep::{
    Line, Range, critical_sensitivity, critical_state, critical_tolerance, crossing_sensitivity, crossing_tolerance,
    crossings, flutter_onsets,
};
use eigentol::{DampingKind, Description, Policy, Real, Tolerances};

/// The set value moves by minus the deviation, independently of the design.
fn critical_moves_back<K: CurvatureKernels>(machine: &K, b: &[f64], start: &[f64], (low, high): (f64, f64)) {
    let deviating = all_deviate(machine);
    let range = Range::new(OMEGA, low, high).steps(40);
    let b = deviating.design(b);
    let u = vec![0.0; deviating.inputs().len()];
    let own = b.len() - u.len();
    let at = |deviation: f64| {
        let mut b = b.clone();
        b[own] = deviation;
        critical_state(&deviating, &u, &b, start, range).unwrap()
    };
    let exact = at(0.0);
    close(at(0.03).value, exact.value - 0.03, 1e-11);
    let slopes = critical_sensitivity(&deviating, &exact).unwrap();
    close(slopes[own], -1.0, 1e-12);
    let plain = critical_state(machine, &u, &b[..own], start, range).unwrap();
    let without = critical_sensitivity(machine, &plain).unwrap();
    for (slope, expected) in slopes.iter().zip(&without) {
        assert!((slope - expected).abs() <= 1e-10 * expected.abs().max(1.0));
    }
    let bent = critical_curvature(&deviating, &exact).unwrap().second;
    let expected = critical_curvature(machine, &plain).unwrap().second;
    for i in 0..=own {
        for j in 0..=own {
            let expected = if i.max(j) < own { expected[i][j] } else { 0.0 };
            let error = (bent[i][j] - expected).abs();
            assert!(error <= 1e-9 * expected.abs().max(1.0), "{i}, {j}: {error:e}");
        }
    }
}

#[test]
fn a_critical_speed_moves_back_by_the_deviation() {
    critical_moves_back(&Pendulum, &[3.0, 1.0], &[1.047], (0.1, 5.0));
    critical_moves_back(&DOUBLE, &[1.0, 1.0, 3.0, 3.0], &[1.0, 1.0], (0.1, 5.0));
    critical_moves_back(&Single, &[3.0, 1.0], &[1.0], (0.1, 5.0));
    critical_moves_back(&Double, &[3.0, 3.0, 1.0, 1.0], &[1.0, 1.0], (0.1, 5.0));
    // Folds.
    critical_moves_back(&Derived(Snap), &[1.0], &[2.0], (-1.0, 1.0));
    critical_moves_back(&Derived(Spring), &[1.0, -1.0, 1.0], &[0.25], (4.0, 1.0));
}

/// `u_c = sqrt(3 g / 2 l)`: `du_c/dl = -u_c / 2 l`.
#[test]
fn a_critical_speed_spreads_with_the_speed() {
    let deviating = all_deviate(&Pendulum);
    let range = Range::new(OMEGA, 0.1, 5.0).steps(40);
    let b = deviating.design(&[3.0, 1.0]);
    let critical = critical_state(&deviating, &[0.0], &b, &[1.0], range).unwrap();
    let tolerances = Tolerances::new([0.0, 0.03, 0.06], 3.0, None).unwrap();
    let found = critical_tolerance(&deviating, &critical, &tolerances);
    let expected = (0.01 * 0.5 * CRITICAL.sqrt()).hypot(0.02);
    close(found.sigma().unwrap(), expected, 1e-11);
}

/// Where the frequency meets a multiple of the speed, both deviate: the set value moves by minus the deviation. A fixed
/// excitation frequency does not deviate, but the set value moves back all the same.
#[test]
fn crossings_move_back_by_the_deviation() {
    let deviating = all_deviate(&Pendulum);
    let b = deviating.design(&[3.0, 1.0]);
    let range = Range::new(OMEGA, 0.1, 8.0).steps(60);
    let fixed = Line { ratio: 0.0, offset: 3.0 };
    let shifted = Line { ratio: 0.5, offset: 1.5 };
    for line in [Line::from(1.0), Line::from(0.9), fixed, shifted] {
        let met = crossings(&deviating, &[0.0], &b, &[1.0], Policy::Stable, range, line).unwrap();
        assert!(!met.is_empty());
        let mut moved = b.clone();
        moved[2] = 0.2;
        let again = crossings(&deviating, &[0.0], &moved, &[1.0], Policy::Stable, range, line);
        let again = again.unwrap();
        assert_eq!(again.len(), met.len());
        for (met, again) in met.iter().zip(&again) {
            close(again.value, met.value - 0.2, 1e-11);
        }
        for crossing in &met {
            let slopes = crossing_sensitivity(&deviating, crossing).unwrap();
            assert!((slopes[2] + 1.0).abs() < 1e-14, "{}", slopes[2]);
            let bent = crossing_curvature(&deviating, crossing).unwrap().second;
            assert!(bent[2].iter().all(|value| value.abs() < 1e-10), "{bent:?}");
            let tolerances = Tolerances::new([0.0, 0.03, 0.06], 3.0, None).unwrap();
            let spread = crossing_tolerance(&deviating, crossing, &tolerances);
            close(spread.sigma().unwrap(), (0.01 * slopes[1]).hypot(0.02), 1e-12);
        }
    }
}

/// With a second input besides the swept one: derivatives of resonance speeds against differences of located ones.
#[test]
fn crossings_move_with_another_input() {
    let deviating = all_deviate(&Double);
    let range = Range::new(OMEGA, 0.1, 8.0).steps(60);
    let at = |load: f64| {
        let b = deviating.design(&[3.0, 3.0, 1.0, 1.0]);
        let met = crossings(&deviating, &[0.0, load], &b, &[1.0, 1.0], Policy::Stable, range, 1.0);
        met.unwrap().remove(0)
    };
    let crossing = at(2.0);
    let slopes = crossing_sensitivity(&deviating, &crossing).unwrap();
    close(slopes[4], -1.0, 1e-13);
    let difference = (at(2.01).value - at(1.99).value) / 0.02;
    assert!(difference.abs() > 1e-4);
    close(slopes[5], difference, 1e-5);
}

/// `qddot + (d - u) qdot + 4 q`: the mode grows where `u > d`.
#[derive(Clone, Copy, Debug)]
struct Fed;

impl Model for Fed {
    sizes!(1, 1, 1, 0);

    const DESCRIPTION: Description = description!(
        "Fed",
        &[coordinate("q", METRE)],
        &[input("u", NUMBER)],
        &[design("d", NUMBER, 1.0, 0.0)],
        true,
        DampingKind::General
    );

    fn inertia<T: Real>(&self, a: &[T; 1], _: &[T; 1], _: &[T; 1], _: &[T; 1], _: &[T; 1]) -> [T; 1] {
        *a
    }

    fn applied<T: Real>(&self, v: &[T; 1], q: &[T; 1], u: &[T; 1], b: &[T; 1]) -> [T; 1] {
        [-((b[0] - u[0]) * v[0] + T::constant(4.0) * q[0])]
    }
}

#[test]
fn flutter_begins_earlier_by_the_deviation() {
    let machine = Derived(Fed);
    let deviating = all_deviate(&machine);
    let range = Range::new(OMEGA, 0.1, 3.0).steps(40);
    let at = |deviation: f64| {
        let b = [1.0, deviation];
        let found = flutter_onsets(&deviating, &[0.0], &b, &[0.0], Policy::Nearest, range);
        found.unwrap().remove(0)
    };
    close(at(0.0).value, 1.0, 1e-12);
    close(at(0.25).value, 0.75, 1e-12);
    let slopes = crossing_sensitivity(&deviating, &at(0.0)).unwrap();
    close(slopes[0], 1.0, 1e-12);
    close(slopes[1], -1.0, 1e-14);
}

/// A Campbell diagram of a bar with fluctuating speed.
#[test]
fn a_campbell_diagram_has_the_spread_of_the_speed() {
    let deviating = all_deviate(&Single);
    let b = deviating.design(&[3.0, 1.0]);
    let values = [4.5, 5.0, 6.0, 7.0];
    let orders = [Line::from(0.9)];
    let axes = Axes::new(OMEGA, &values, &orders);
    let tolerances = Tolerances::new([0.0, 0.0, 0.3], 3.0, None).unwrap();
    let diagram = campbell(&deviating, &[0.0], &b, &[1.0], Policy::Stable, &axes, &tolerances);
    let diagram = diagram.unwrap();
    for (point, speed) in diagram.points.iter().zip(values) {
        let mode = &point.modes.as_ref().unwrap()[0];
        let [slope, _] = frequency_slopes(speed);
        close(mode.frequency.as_ref().unwrap().sigma, 0.1 * slope, 1e-10);
    }
    // sqrt(u^2 - c^2 / u^2) = 0.9 u where u^4 = c^2 / 0.19.
    assert_eq!(diagram.crossings.len(), 1);
    close(diagram.crossings[0].value, (CRITICAL * CRITICAL / 0.19).powf(0.25), 1e-12);
    close(diagram.crossings[0].sigma().unwrap(), 0.1, 1e-12);
}

/// States of a deviating mechanism equal those of the mechanism at the shifted input.
#[test]
fn a_fixed_deviation_moves_the_input() {
    let deviating = all_deviate(&Single);
    let mut b = deviating.design(&[3.0, 1.0]);
    b[2] = 0.5;
    let (at, modes) = solved(&deviating, &[4.5], &b, &[1.0]);
    let (expected, expected_modes) = solved(&Single, &[5.0], &[3.0, 1.0], &[1.0]);
    assert_eq!(at.coordinates, expected.coordinates);
    assert_eq!(at.linear, expected.linear);
    assert_eq!(modes.modes, expected_modes.modes);
}
