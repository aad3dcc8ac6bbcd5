//! Design points, and cases in which other programs failed.

use core::cell::Cell;

use eigentol_statistics::Error;
use eigentol_statistics::reliability::{FormSettings, LimitFunction, LimitState, LimitValue, form};
use proptest::prelude::*;

use crate::common::{below, close, density, design_point, limit, linear};

/// `beta = 1.5` to the last digits; only the first two variables matter.
#[test]
fn linear_limits_are_exact_and_ignore_what_does_not_matter() {
    for irrelevant in [0, 1, 6, 400] {
        let mut gradient = vec![-3.0, 4.0];
        gradient.extend(vec![0.0; irrelevant]);
        let found = form(&linear(7.5, gradient), &FormSettings::default()).unwrap();
        let at = &found.design_point;
        close(at.beta, 1.5, 1e-14);
        close(at.probability(), below(-1.5), 1e-13);
        close(at.point[0], 0.9, 1e-14);
        close(at.point[1], -1.2, 1e-14);
        assert!(at.point[2..].iter().all(|&z| z == 0.0));
        let factors = at.importance_factors();
        close(factors[0], 0.36, 1e-14);
        close(factors.iter().sum(), 1.0, 1e-14);
        assert!(found.evaluations.total < 30, "{:?}", found.evaluations);
    }
}

/// A curved limit in two variables (as in OpenTURNS issue 1447): hundreds of additional variables do not change the
/// result.
#[test]
fn curved_limits_ignore_what_does_not_matter() {
    let curved = |dimension| {
        limit(dimension, |z| {
            let mut gradient = vec![0.0; z.len()];
            gradient[0] = -(0.3 * z[0]).exp() * 0.3;
            gradient[1] = -0.2 - 0.1 * z[1];
            (2.6 - (0.3 * z[0]).exp() - 0.2 * z[1] - 0.05 * z[1] * z[1], gradient)
        })
    };
    let alone = design_point(&curved(2));
    for dimension in [3, 9, 300] {
        let design_point = design_point(&curved(dimension));
        close(design_point.beta, alone.beta, 1e-9);
        assert!(design_point.point[2..].iter().all(|z| z.abs() < 1e-8));
    }
}

#[test]
fn units_do_not_matter() {
    let scaled = |unit: f64| {
        limit(3, move |z| {
            let cubic = 3.0 - z[0] - 0.1 * z[1].powi(3) + 0.2 * z[2] * z[0];
            let gradient = [-1.0 + 0.2 * z[2], -0.3 * z[1] * z[1], 0.2 * z[0]];
            (unit * cubic, gradient.map(|x| unit * x).to_vec())
        })
    };
    let expected = design_point(&scaled(1.0));
    for exponent in [-900, -300, -40, 40, 300, 900] {
        let unit = 2.0_f64.powi(exponent);
        let design_point = design_point(&scaled(unit));
        assert_eq!(design_point.point, expected.point, "unit 2^{exponent}");
        assert_eq!(design_point.residuals, expected.residuals);
        close(design_point.gradient_norm, unit * expected.gradient_norm, 1e-14);
    }
}

/// Residuals have their stated meaning.
#[test]
fn design_points_lie_on_the_limit_and_on_its_normal() {
    let ball = limit(3, |z| {
        let away = [z[0] - 2.0, z[1] + 1.0, z[2] - 2.0];
        let square: f64 = away.iter().map(|x| x * x).sum();
        (square - 1.0, away.map(|x| 2.0 * x).to_vec())
    });
    let at = design_point(&ball);
    close(at.beta, 2.0, 2e-9);
    assert!(ball.evaluate(&at.point).unwrap().value.abs() < 1e-8);
    for (z, n) in at.point.iter().zip(&at.direction) {
        assert!((z - at.beta * n).abs() < 1e-8);
    }
    assert!(at.residuals.largest() <= FormSettings::default().tolerance);
}

#[test]
fn a_failing_origin_has_negative_beta() {
    let at = design_point(&linear(-2.0, vec![-0.6, 0.8]));
    close(at.beta, -2.0, 1e-14);
    close(at.probability(), below(2.0), 1e-14);
    close(at.point[0], -1.2, 1e-14);
    close(at.direction[0], 0.6, 1e-14);
    let curved = limit(2, |z| (-1.5 - z[0] + 0.1 * z[1] * z[1], vec![-1.0, 0.2 * z[1]]));
    close(design_point(&curved).beta, -1.5, 1e-12);
}

#[test]
fn a_limit_through_the_origin_has_beta_zero() {
    let at = design_point(&limit(2, |z| (z[0] * (1.0 + z[1]), vec![1.0 + z[1], z[0]])));
    assert_eq!(at.beta, 0.0);
    assert_eq!(at.probability(), 0.5);
    assert_eq!(at.importance_factors(), [1.0, 0.0]);
}

/// No failure within reach gives an error that says so, not a probability.
#[test]
fn no_failure_is_an_error() {
    type Function = dyn Fn(&[f64]) -> (f64, Vec<f64>);
    let cases: [Box<Function>; 5] = [
        Box::new(|z| (1.0 + z[0] * z[0], vec![2.0 * z[0], 0.0])),
        Box::new(|_| (1.0, vec![0.0, 0.0])),
        Box::new(|z| ((-z[0]).exp(), vec![-(-z[0]).exp(), 0.0])),
        Box::new(|z| (1e4 - z[0], vec![-1.0, 0.0])),
        Box::new(|z| (150.0 - z[0], vec![-1.0, 0.0])),
    ];
    for (case, function) in cases.into_iter().enumerate() {
        let error = form(&limit(2, function), &FormSettings::default()).unwrap_err();
        let Error::NoDesignPoint { closest, radius } = error else {
            panic!("case {case}: {error}");
        };
        assert_eq!(radius, 100.0);
        assert_eq!(closest.point.len(), 2);
        assert!(closest.evaluations.total > 0);
        assert!(closest.point.iter().all(|z| z.is_finite()), "case {case}");
    }
}

/// Far below the smallest representable probability: its logarithm is still available.
#[test]
fn probabilities_below_the_least_number_have_a_logarithm() {
    let at = design_point(&linear(60.0, vec![1.0]));
    assert_eq!(at.probability(), 0.0);
    // Mills: Phi(-b) = phi(b) / b (1 - 1/b^2 + 3/b^4 - ...).
    let b = 60.0_f64;
    let series = 1.0 - 1.0 / (b * b) + 3.0 / b.powi(4) - 15.0 / b.powi(6);
    let expected = -0.5 * b * b - (2.0 * core::f64::consts::PI).sqrt().ln() - b.ln() + series.ln();
    close(at.ln_probability(), expected, 1e-13);
}

/// Flat around the origin, where the gradient is zero.
#[test]
fn flat_regions_are_crossed() {
    let flat = limit(2, |z| {
        let rise = (z[0] - 1.0).max(0.0);
        (4.0 - rise * rise, vec![-2.0 * rise, 0.0])
    });
    let settings = FormSettings { restarts: 8, ..FormSettings::default() };
    close(form(&flat, &settings).unwrap().design_point.beta, 3.0, 1e-9);
}

/// The limit state is undefined beyond 2.5: the first step overshoots, and the search steps back.
#[test]
fn searches_step_back_from_where_there_is_no_value() {
    let asked_beyond = Cell::new(0);
    let root = LimitFunction::new(2, |z: &[f64]| {
        let rest = 2.5 - z[0];
        if rest <= 0.0 {
            asked_beyond.set(asked_beyond.get() + 1);
            return Err("the legs do not reach");
        }
        let slope = -0.5 / rest.sqrt();
        Ok(LimitValue { value: rest.sqrt() - 0.2, gradient: vec![slope, 0.0] })
    });
    // The iteration alone, without the optimiser.
    let settings = FormSettings { restarts: 0, optimiser_evaluations: 0, ..FormSettings::default() };
    let found = form(&root, &settings).unwrap();
    close(found.design_point.beta, 2.46, 1e-9);
    assert!(asked_beyond.get() > 0);
    assert_eq!(found.evaluations.without_value, asked_beyond.get());
}

/// Flat around the origin, and undefined where restarts begin: they are pulled back towards the origin.
#[test]
fn starts_without_a_value_are_pulled_back() {
    let island = LimitFunction::new(1, |z: &[f64]| {
        if z[0].abs() > 2.8 {
            return Err("does not exist");
        }
        let rise = (z[0] - 0.5).max(0.0);
        Ok(LimitValue { value: 4.0 - rise * rise, gradient: vec![-2.0 * rise] })
    });
    let settings = FormSettings { restarts: 2, ..FormSettings::default() };
    close(form(&island, &settings).unwrap().design_point.beta, 2.5, 1e-9);
}

#[test]
fn values_that_are_no_numbers_are_no_values() {
    let logarithm = limit(1, |z| ((3.0 - z[0]).ln(), vec![-1.0 / (3.0 - z[0])]));
    let found = form(&logarithm, &FormSettings::default()).unwrap();
    close(found.design_point.beta, 2.0, 1e-9);
    let never = limit(1, |_| (f64::NAN, vec![1.0]));
    let error = form(&never, &FormSettings::default()).unwrap_err();
    assert!(matches!(error, Error::NoLimitValue { .. }), "{error}");
    let short = limit(2, |_| (1.0, vec![1.0]));
    let error = form(&short, &FormSettings::default()).unwrap_err();
    assert!(error.to_string().contains("1 entries, expected 2"), "{error}");
}

#[test]
fn nothing_to_search_is_refused() {
    assert!(form(&linear(1.0, vec![]), &FormSettings::default()).is_err());
    for tolerance in [0.0, f64::NAN] {
        let settings = FormSettings { tolerance, ..FormSettings::default() };
        assert!(form(&linear(1.0, vec![1.0]), &settings).is_err());
    }
}

/// From the origin the search reaches the apex, the farthest point of its neighbourhood; the nearest points lie beside
/// it.
#[test]
fn a_point_that_is_nearest_in_some_directions_only_is_left() {
    // (b - z1) = k z0^2 / 2 with b k > 1: the nearest points are at z1 = 1/k.
    let (b, k) = (4.0, 0.5);
    let valley = limit(2, move |z| (b - z[1] - 0.5 * k * z[0] * z[0], vec![-k * z[0], -1.0]));
    let z1 = 1.0 / k;
    let z0_square = 2.0 * (b - z1) / k;
    let expected = (z1 * z1 + z0_square).sqrt();
    assert!(expected < b);
    // Without restarts, which would find the same point.
    let settings = FormSettings { restarts: 0, ..FormSettings::default() };
    let design_point = form(&valley, &settings).unwrap().design_point;
    close(design_point.beta, expected, 1e-8);
}

/// The optimiser takes over where the iteration cycles: strongly curved limits.
#[test]
fn strongly_curved_limits() {
    for k in [5.0, 50.0, 500.0] {
        let narrow = limit(3, move |z| {
            let off = z[1] - 0.3;
            (2.0 - z[0] + 0.5 * k * off * off, vec![-1.0, k * off, 0.0])
        });
        let at = design_point(&narrow);
        // Stationarity: z1 = -k (z1 - 0.3) z0 on z0 = 2 + k/2 (z1 - 0.3)^2, by bisection.
        let z0 = |z1: f64| 2.0 + 0.5 * k * (z1 - 0.3).powi(2);
        let (mut left, mut right) = (0.0, 0.3);
        for _ in 0..80 {
            let z1 = 0.5 * (left + right);
            if z1 + k * (z1 - 0.3) * z0(z1) < 0.0 {
                left = z1;
            } else {
                right = z1;
            }
        }
        close(at.beta, f64::hypot(left, z0(left)), 1e-9);
    }
}

/// `g = theta - 3 z0 - 4 z1`: `beta = theta / 5`.
#[test]
fn sensitivities_are_derivatives() {
    let at = |theta: f64| design_point(&linear(theta, vec![-3.0, -4.0]));
    let found = at(10.0).sensitivity(1.0);
    close(found.beta, 0.2, 1e-14);
    close(found.probability, -0.2 * density(2.0), 1e-13);
    let step = 1e-4;
    let difference = (at(10.0 + step).probability() - at(10.0 - step).probability()) / (2.0 * step);
    close(found.probability, difference, 1e-7);
    // A curved limit with a parameter that affects its curvature.
    let bent = |theta: f64| {
        limit(2, move |z| {
            let value = 3.0 - z[0] - theta * (0.5 * z[1]).exp();
            (value, vec![-1.0, -0.5 * theta * (0.5 * z[1]).exp()])
        })
    };
    let at = design_point(&bent(0.5));
    let beta = at.sensitivity(-(0.5 * at.point[1]).exp()).beta;
    let ahead = design_point(&bent(0.5 + step)).beta;
    let behind = design_point(&bent(0.5 - step)).beta;
    close(beta, (ahead - behind) / (2.0 * step), 1e-6);
}

proptest! {
    /// Any linear limit: `beta = distance / |gradient|`.
    #[test]
    fn linear_limits(
        distance in -30.0..30.0_f64,
        gradient in proptest::collection::vec(-5.0..5.0_f64, 1..8),
        exponent in -100..100_i32,
    ) {
        let length = gradient.iter().map(|g| g * g).sum::<f64>().sqrt();
        prop_assume!(length > 0.5);
        let unit = 10.0_f64.powi(exponent);
        let scaled = gradient.iter().map(|g| unit * g).collect();
        let at = design_point(&linear(unit * distance, scaled));
        prop_assert!((at.beta - distance / length).abs() <= 1e-12 * (distance / length).abs());
    }
}
