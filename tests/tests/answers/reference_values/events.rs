//! Critical speeds and resonances, and their derivatives by the design.

use eigentol::branches::SpecialKind;
use eigentol::equilibrium::Policy;
use eigentol::kernels::BatchKernels;
use eigentol::second_order::critical_curvature;
use eigentol::sweep::{critical_sensitivity, crossing_sensitivity};
use eigentol::{DesignVariable, Input, Stability, Study};
use eigentol_oracle::truth::Truth;
use eigentol_tests::corpus::chain_of_eight::ChainOfEight;
use eigentol_tests::corpus::chain_of_four::ChainOfFour;
use eigentol_tests::corpus::rotating_double_pendulum::RotatingDoublePendulum;
use eigentol_tests::corpus::rotating_pendulum::RotatingPendulum;

use super::common::{assert_close, assert_equilibrium, frequencies};

#[test]
fn of_the_single_bar() {
    let truth = Truth::load("P1");
    let study = Study::new(RotatingPendulum);
    let critical = study.critical_state(RotatingPendulum::omega, 0.5, 8.0).expect("a critical speed");
    let expected = truth.get("Omega_critical").number();
    assert_close(&[critical.value], &[expected], 0.0, "critical");
    // Omega_c = sqrt(3 g / (2 L)).
    let found = critical_sensitivity(&RotatingPendulum, &critical).expect("a bifurcation");
    assert_close(&found, &[-expected / 2.0, 0.0], 1e-3, "of the critical speed");

    let resonances = study.crossings(RotatingPendulum::omega, 0.1, 8.0, 1.0).expect("a range");
    assert_eq!(resonances.len(), 1);
    let expected = truth.get("Omega_resonance").number();
    assert_close(&[resonances[0].value], &[expected], 0.0, "resonance");
    let found = crossing_sensitivity(&RotatingPendulum, &resonances[0]).expect("a crossing");
    assert_close(&found, &[-expected / 2.0, 0.0], 1e-3, "of the resonance");
}

#[test]
fn of_the_double_bar() {
    let truth = Truth::load("P2");
    let study = Study::new(RotatingDoublePendulum);
    let critical = study.critical_state(RotatingDoublePendulum::omega, 0.5, 6.0).expect("a critical speed");
    let expected = truth.get("Omega_critical").number();
    assert_close(&[critical.value], &[expected], 0.0, "critical");
    // On theta = 0 omega_1^2 = lambda_1 - Omega^2, so the critical speed has the same derivative as omega_1 at rest.
    let mode_at_rest = truth.get("conditions").list()[0].get("undamped_modes").list()[0].clone();
    let at_rest = mode_at_rest.get("domega_db");
    let names = ["L1", "L2", "m1", "m2"];
    let expected = names.map(|name| at_rest.get(name).number());
    let found = critical_sensitivity(&RotatingDoublePendulum, &critical).expect("a bifurcation");
    assert_close(&found, &expected, 1e-3, "of the critical speed");
    let bent = mode_at_rest.get("d2omega_db2");
    let found = critical_curvature(&RotatingDoublePendulum, &critical).expect("a bifurcation");
    for (row, expected) in found.second.iter().zip(bent.list()) {
        assert_close(row, &expected.numbers(), 1e-3, "of the critical speed, twice");
    }

    let resonances = study.crossings(RotatingDoublePendulum::omega, 0.1, 8.0, 1.0).expect("a range");
    assert_eq!(truth.get("resonances_on_bent_branch_up_to_8").list().len(), 0);
    assert_eq!(resonances.len(), 1);
    let expected = truth.get("Omega_resonance_mode1").number();
    assert_close(&[resonances[0].value], &[expected], 0.0, "resonance");
    assert_eq!(resonances[0].mode, 0);
}

/// The hanging branch continues, unstable, beyond its critical speed; its second mode still meets the speed.
#[test]
fn of_the_double_bar_on_the_unstable_branch() {
    let truth = Truth::load("P2");
    let study = Study::new(RotatingDoublePendulum).policy(Policy::Nearest);
    let resonances = study.crossings(RotatingDoublePendulum::omega, 3.0, 7.0, 1.0).expect("a range");
    assert_eq!(resonances.len(), 1);
    let expected = truth.get("Omega_resonance_mode2_on_theta0_branch").number();
    assert_close(&[resonances[0].value], &[expected], 0.0, "resonance");

    let second = truth.get("Omega_critical_2(of theta=0 branch, already unstable)").number();
    for (omega, divergent) in [(second * (1.0 - 1e-6), 1), (second * (1.0 + 1e-6), 2)] {
        let modes = study.clone().input(RotatingDoublePendulum::omega, omega).modes().expect("modes");
        let negative = modes.modes.iter().filter(|mode| mode.lambda < 0.0).count();
        assert_eq!(negative, divergent);
    }
}

/// 54 points from 8 rad/s down to the critical speed, each started from the previous one.
#[test]
fn the_bent_branch_is_followed() {
    let field = "bent_branch_sweep [Omega, theta1, theta2_abs, omega1, omega2]";
    let rows: Vec<Vec<f64>> = Truth::load("P2").get(field).list().iter().map(Truth::numbers).collect();
    let speeds: Vec<f64> = rows.iter().map(|row| row[0]).collect();
    let study = Study::new(RotatingDoublePendulum).start(RotatingDoublePendulum::theta1, 1.4);
    let points = study.sweep(RotatingDoublePendulum::omega, &speeds).expect("a sweep").points;
    assert_eq!(points.len(), 54);
    for (point, row) in points.iter().zip(&rows) {
        let what = format!("{} rad/s", row[0]);
        let at = point.equilibrium.as_ref().expect("an equilibrium");
        let angles = [at.coordinates[0], at.coordinates[0] + at.coordinates[1]];
        assert_equilibrium(&angles, &row[1..3], &what);
        let modes = point.modes.as_ref().expect("modes");
        assert_close(&frequencies(modes), &row[3..5], 0.0, &what);
    }
}

/// From rest upwards with default settings, both pendulums leave the axis at the critical speed, which the sweep
/// reports; downwards they return to it.
#[test]
fn a_default_sweep_bends_and_reports_the_critical_speed() {
    fn check<M: BatchKernels + Copy>(machine: M, critical: f64) {
        let mut speeds: Vec<f64> = (0..=80).map(|step| 0.1 * f64::from(step)).collect();
        for direction in ["up", "down"] {
            let swept = Study::new(machine).sweep(Input::new(0), &speeds).expect("a sweep");
            for point in &swept {
                let at = point.equilibrium.as_ref().expect("an equilibrium");
                assert_eq!(at.stability, Stability::Stable, "{direction}");
                let bent = at.coordinates[0].abs() > 1e-3;
                assert_eq!(bent, point.value > critical, "{direction} {}", point.value);
            }
            let [found] = &swept.critical[..] else { panic!("{direction}: {:?}", swept.critical) };
            assert_close(&[found.value], &[critical], 0.0, direction);
            let soft = SpecialKind::Pitchfork { supercritical: Some(true) };
            assert_eq!(found.kind, soft, "{direction}");
            speeds.reverse();
        }
    }
    check(RotatingPendulum, (1.5_f64 * 9.81).sqrt());
    check(RotatingDoublePendulum, (9.81 * (3.0 - 6.0 / 7f64.sqrt())).sqrt());
}

fn critical<M: BatchKernels>(machine: M, name: &str) {
    let case = Truth::load("w1_w2_w3").get(name);
    let values = [case.get("L").numbers(), case.get("m").numbers()].concat();
    let mut study = Study::new(machine);
    for (j, value) in values.into_iter().enumerate() {
        study = study.design(DesignVariable::new(j), value);
    }
    let found = study.critical_state(Input::new(0), 0.2, 5.0).expect("a critical speed");
    assert_close(&[found.value], &[case.get("Omega_crit").number()], 0.0, name);
    let hanging = vec![0.0; study.start_values().len()];
    assert_equilibrium(&found.equilibrium.coordinates, &hanging, name);
}

#[test]
fn critical_speeds_of_chains() {
    critical(RotatingPendulum, "W1");
    critical(RotatingDoublePendulum, "W2");
    critical(RotatingDoublePendulum, "W2_varied");
    critical(ChainOfFour, "W3_n4");
    critical(ChainOfFour, "W3_n4_varied");
    critical(ChainOfEight, "W3_n8");
    critical(ChainOfEight, "W3_n8_varied");
}
