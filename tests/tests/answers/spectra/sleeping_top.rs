//! The sleeping top: above its critical speed an upright top is held by its spin alone, `J_z w > 2 sqrt(J m g h)`
//! (L. D. Landau and E. M. Lifshitz, Mechanics, section 35, problem 3).

use eigentol::sweep::Event;
use eigentol::{Stability, Study, mechanism};

mechanism! {
    /// A top on a point, driven at a constant spin.
    mechanism Top {
        input spin: rad/s;
        design height = 60 mm +/- 1%;
        design across = 3.6e-4 kg*m^2 +/- 1%;
        design along = 1.2e-4 kg*m^2 +/- 1%;
        gravity 9.81 m/s^2 along -z;
        body gimbal: massless;
        body top: rigid(mass: 80 g, inertia: [across, across, along], center: [0, 0, height], about: [0, 0, 0]);
        joint tilt: universal(a: x, b: y) from ground to gimbal;
        joint turn: revolute(z) from gimbal to top, driven at spin;
    }
}

fn critical() -> f64 {
    2.0 * f64::sqrt(3.6e-4 * 0.08 * 9.81 * 0.06) / 1.2e-4
}

#[test]
fn the_speed_below_which_a_top_falls_is_found() {
    for (from, to) in [(1.4, 0.8), (1.02, 0.98), (3.0, 0.1)] {
        let ends = [from * critical(), to * critical()];
        for points in [2, 5, 40] {
            let values: Vec<f64> =
                (0..points).map(|k| ends[0] + (ends[1] - ends[0]) * f64::from(k) / f64::from(points - 1)).collect();
            let found = Study::new(Top).campbell(Top::spin, &values, &[] as &[f64]).expect("a diagram");
            let [only] = &found.flutter_onsets[..] else {
                panic!("{from} to {to}, {points}: {:?}", found.flutter_onsets)
            };
            assert!((only.value / critical() - 1.0).abs() < 1e-8, "{}", only.value);
            assert!(matches!(only.event, Event::Crossing { .. }));
        }
    }
}

#[test]
fn a_top_that_falls_hangs_without_having_gone_round() {
    for points in [2, 3, 4, 9, 30] {
        let values: Vec<f64> =
            (0..points).map(|k| critical() * (1.11 - 0.3 * f64::from(k) / f64::from(points - 1))).collect();
        let found = Study::new(Top).sweep(Top::spin, &values).expect("a sweep");
        for point in &found.points {
            let state = point.equilibrium.as_ref().expect("an equilibrium");
            let [a, b] = [0, 1].map(|i| state.coordinates[i].abs());
            if point.value > critical() {
                assert!(matches!(state.stability, Stability::GyroscopicallyStabilised { .. }));
                assert_eq!([a, b], [0.0, 0.0]);
            } else {
                assert_eq!(state.stability, Stability::Stable);
                assert!((a.max(b) - core::f64::consts::PI).abs() < 1e-9, "{a} {b}");
            }
        }
    }
}
