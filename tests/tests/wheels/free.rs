//! What rolls freely has a whole family of steady motions: an answer or a typed error, never a number that is none.

use eigentol::Study;
use eigentol_tests::wheels::{PushedCart, RollingDisk};

/// Without drag nothing decides how fast the disk turns about the vertical.
#[test]
fn a_disk_without_drag() {
    for spin in [0.0, 4.0, 20.0] {
        let study = Study::<RollingDisk, 8, 2, 6, 2>::new(RollingDisk)
            .input(RollingDisk::spin, spin)
            .design(RollingDisk::drag, 0.0)
            .design(RollingDisk::stiffness, 0.0);
        let Ok(state) = study.equilibrium() else {
            continue;
        };
        assert!(state.coordinates.iter().all(|value| value.is_finite()));
        let [m, r, a, c] = [3.0, 0.25, 0.05, 0.09];
        let k = c + m * r * r;
        // (A + m r^2) lean'' + (k C spin^2 / A - m g r) lean = 0
        let square = (k * c * spin * spin / a - m * 9.81 * r) / (a + m * r * r);
        let modes = study.modes().expect("modes");
        for mode in &modes.modes {
            assert!(mode.s.re.is_finite() && mode.s.im.is_finite());
        }
        let own = modes.modes.iter().filter(|mode| mode.s.norm() > 1e-3);
        for mode in own {
            let off = (mode.s * mode.s + square).norm();
            assert!(off < 1e-6 * square.abs(), "{spin}: {}", mode.s);
        }
    }
}

/// Without drag no force gives the cart a steady speed.
#[test]
fn a_cart_without_drag() {
    let study = Study::<PushedCart, 4, 1, 9, 1>::new(PushedCart)
        .design(PushedCart::drag, 0.0)
        .design(PushedCart::air, 0.0);
    assert!(
        study
            .clone()
            .input(PushedCart::push, 1.0)
            .equilibrium()
            .is_err()
    );
    if let Ok(state) = study.equilibrium() {
        assert!(state.coordinates.iter().all(|value| value.is_finite()));
    }
}
