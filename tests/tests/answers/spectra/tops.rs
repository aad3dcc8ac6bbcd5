//! A top held up by its spin, and a double frequency split by rotation.

use eigentol::clusters::modal_couplings;
use eigentol::{Behaviour, Complex, Family, Stability, Study};
use eigentol_tests::machines::{SleepingTop, SphericalPendulum};

use super::common::{close, design, near};

#[test]
fn precession_and_nutation_of_a_sleeping_top() {
    let study: Study<SleepingTop> = Study::new(SleepingTop);
    let [m, h, transverse, polar] = design(&study);
    let (a, weight) = (transverse + m * h * h, m * 9.81 * h);
    let threshold = 2.0 * (a * weight).sqrt() / polar;
    for share in [1.001, 1.2, 4.0] {
        let spin = share * threshold;
        let at = study.clone().input(SleepingTop::spin, spin);
        let root = ((polar * spin).powi(2) - 4.0 * a * weight).sqrt();
        let found = at.modes().expect("modes");
        for (mode, sign) in found.modes.iter().zip([-1.0, 1.0]) {
            let omega = (polar * spin + sign * root) / (2.0 * a);
            let off = (mode.s - Complex::new(0.0, omega)).norm();
            assert!(off <= 1e-9 * omega, "{share}: {} {omega}", mode.s);
            assert!(matches!(mode.behaviour, Behaviour::Oscillating(_)));
        }
        let held = Stability::GyroscopicallyStabilised { negative: 2 };
        assert_eq!(at.equilibrium().expect("one").stability, held);
    }
    let slow = study.clone().input(SleepingTop::spin, 0.98 * threshold);
    let state = slow.policy(eigentol::Policy::Nearest).equilibrium();
    let stability = state.expect("upright").stability;
    assert_eq!(stability, Stability::Flutter { growing: 1 });
    let still = study.policy(eigentol::Policy::Nearest);
    let stability = still.equilibrium().expect("upright").stability;
    assert_eq!(stability, Stability::Divergent { negative: 2 });
}

/// `sqrt(g / l) +- W` in the turning frame: a double frequency at rest. Its derivatives by the speed, +1 and -1 rad/s
/// per rad/s, belong to the cluster and not to a single mode.
#[test]
fn turning_splits_a_double_frequency() {
    let study: Study<SphericalPendulum> = Study::new(SphericalPendulum);
    let [l, _] = design(&study);
    let omega = (9.81 / l).sqrt();
    let state = study.equilibrium().expect("hanging");
    let found = study.modes().expect("modes");
    assert_eq!(found.family, Family::General);
    assert_eq!(found.modes.len(), 2);
    for mode in &found.modes {
        near(mode.s, Complex::new(0.0, omega));
    }
    let slopes = study.sensitivities().expect("derivatives");
    assert!(slopes.modes.iter().all(|mode| mode.clustered));
    assert!(matches!(study.mode_curvature(0), Err(eigentol::Error::ClusteredMode { mode: 0 })));
    let couplings = modal_couplings(&SphericalPendulum, &state, &found, &[0, 1]).expect("couplings");
    let [a, b, c, d] = *couplings.by_input[0].as_flattened() else { panic!("two modes") };
    // Eigenvalues of the 2 x 2 matrix: s' = +-i.
    let (half, root) = (0.5 * (a + d), (0.25 * (a - d) * (a - d) + b * c).sqrt());
    near(half + root, Complex::new(0.0, (half + root).im.signum()));
    assert!(half.norm() < 1e-9, "{half}");
    for speed in [1e-3, 0.5, 2.0] {
        let at = study.clone().input(SphericalPendulum::speed, speed);
        let found = at.modes().expect("modes");
        let slopes = at.sensitivities().expect("derivatives");
        for (r, sign) in [(0, -1.0), (1, 1.0)] {
            near(found.modes[r].s, Complex::new(0.0, omega + sign * speed));
            let by_speed = slopes.modes[r].frequency().expect("it oscillates").by_input[0];
            close(by_speed, sign);
            let by_length = slopes.modes[r].frequency().expect("it oscillates").by_design[0];
            close(by_length, -0.5 * omega / l);
        }
    }
}

/// A sweep follows a state held by gyroscopic forces: the top keeps sleeping as its spin decreases, until nothing holds
/// it.
#[test]
fn a_sweep_follows_the_sleeping_top_until_it_falls() {
    let study: Study<SleepingTop> = Study::new(SleepingTop);
    let [m, h, transverse, polar] = design(&study);
    let (a, weight) = (transverse + m * h * h, m * 9.81 * h);
    let threshold = 2.0 * (a * weight).sqrt() / polar;
    let spins: Vec<f64> = (0..20).map(|step| threshold * (2.0 - 0.06 * f64::from(step))).collect();
    // Not exactly upright, as with a start value taken from elsewhere.
    let study = study.start(SleepingTop::alpha, 1e-9);
    for point in &study.sweep(SleepingTop::spin, &spins).expect("a sweep") {
        let state = point.equilibrium.as_ref().expect("an equilibrium");
        let upright = state.coordinates.iter().all(|angle| angle.abs() < 1e-3);
        assert_eq!(upright, point.value > threshold, "{}", point.value);
        assert!(state.stability.holds());
    }
}
