//! Free rolling has a whole family of steady motions: modes and derivatives belong to the current member, which is held.

use eigentol::{Behaviour, Error, Stability, Study};
use eigentol_tests::wheels::{CirclingTrailer, PushedCart, RollingDisk};

use super::common::close;

/// Without drag nothing determines the yaw rate of the disk: one eigenvalue is zero, and
/// `(A + m r^2) s^2 = m g r - (C + m r^2) C spin^2 / A`.
#[test]
fn a_disk_without_drag() {
    let free =
        Study::<RollingDisk>::new(RollingDisk).design(RollingDisk::drag, 0.0).design(RollingDisk::stiffness, 0.0);
    let [m, r, a, c] = [3.0, 0.25, 0.05, 0.09];
    let k = c + m * r * r;
    for spin in [0.0, 1.0, 4.0, 20.0] {
        let study = free.clone().input(RollingDisk::spin, spin);
        let square = (m * 9.81 * r - k * c * spin * spin / a) / (a + m * r * r);
        let state = study.equilibrium().expect("rolling straight ahead");
        let stability =
            if square > 0.0 { Stability::Divergent { negative: 1 } } else { Stability::Neutral { zero: 1 } };
        assert_eq!(state.stability, stability, "{spin} rad/s");
        let modes = study.modes().expect("modes");
        let neutral = |behaviour| matches!(behaviour, Behaviour::Free);
        let count = modes.modes.iter().filter(|mode| neutral(mode.behaviour));
        assert_eq!(count.count(), 1, "{modes:?}");
        let moving = modes.modes.iter().filter(|mode| !neutral(mode.behaviour));
        let moving: Vec<_> = moving.map(|mode| mode.s).collect();
        assert_eq!(moving.len(), if square > 0.0 { 2 } else { 1 });
        for s in moving {
            close((s * s).re, square, 0.0, "the square of an eigenvalue");
            assert!((s * s).im.abs() < 1e-9 * square.abs());
        }
        // The yaw rate is held: it stays upright whatever changes.
        let held = &state.free.held;
        assert_eq!(held.len(), 1);
        assert_eq!(state.description.coordinates[held[0].unknown].name, *"yaw");
        // With any torque there is no such motion.
        for refused in [study.equilibrium_shift().err(), study.sensitivities().err()] {
            assert!(
                matches!(&refused, Some(Error::BalancesHereOnly { variable, coordinates })
                    if *variable == *"torque" && coordinates.contains(&"yaw".into())),
                "{refused:?}"
            );
        }
        // The branch is that of the held member.
        let critical = study.critical_state(RollingDisk::spin, 20.0, 25.0);
        assert!(matches!(critical, Err(Error::NotInRange { .. })), "{critical:?}");
        let critical = study.critical_state(RollingDisk::spin, 25.0, 0.0);
        let least = (m * 9.81 * r * a / (k * c)).sqrt();
        close(critical.expect("a value").value, least, 0.0, "the spin below which it falls");
        // A torque would keep accelerating it.
        let turned = study.input(RollingDisk::torque, 0.1).equilibrium();
        assert!(matches!(turned, Err(Error::NoEquilibrium { .. })), "{turned:?}");
    }
}

/// Without drag a force allows no steady speed of the cart, and without a force every speed is steady. The pendulum
/// swings against the cart: `s^2 = -g b l / (J - b^2 l^2 / m)`, with the bob mass `b`, its inertia `J` about the hinge,
/// and the total mass `m`.
#[test]
fn a_cart_without_drag() {
    let study = Study::<PushedCart>::new(PushedCart).design(PushedCart::drag, 0.0).design(PushedCart::air, 0.0);
    let pushed = study.clone().input(PushedCart::push, 1.0).equilibrium();
    assert!(matches!(pushed, Err(Error::NoEquilibrium { .. })), "{pushed:?}");
    let state = study.equilibrium().expect("at rest");
    assert_eq!(state.stability, Stability::Neutral { zero: 1 });
    let modes = study.modes().expect("modes");
    let omegas: Vec<f64> = modes.modes.iter().filter_map(|mode| mode.frequency()).collect();
    let (bob, length, all) = (1.2_f64, 0.4, 2.0 + 1.0 + 0.02 / (0.15 * 0.15) + 1.2);
    let inertia = bob * length * length + 0.01 - (bob * length * bob * length) / all;
    assert_eq!(omegas.len(), 1);
    close(omegas[0], (9.81 * bob * length / inertia).sqrt(), 0.0, "swing");
    // With any push there is none.
    let refused = study.equilibrium_shift();
    assert!(matches!(&refused, Err(Error::BalancesHereOnly { variable, .. }) if *variable == *"push"), "{refused:?}");
}

/// At rest the trailer stays at any angle: a single zero eigenvalue, because its rate is not a state.
#[test]
fn a_trailer_at_rest() {
    let study = Study::<CirclingTrailer>::new(CirclingTrailer).input(CirclingTrailer::radius, 5.0);
    let state = study.equilibrium().expect("at rest");
    assert_eq!(state.stability, Stability::Neutral { zero: 1 });
    let modes = study.modes().expect("modes");
    assert_eq!(modes.modes.len(), 1);
    assert_eq!(modes.modes[0].behaviour, Behaviour::Free);
}
