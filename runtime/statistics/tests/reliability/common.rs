//! Limit states and exact values used by several tests.

use core::convert::Infallible;

use eigentol_statistics::reliability::lines::{Direction, LineProbability, LineSampler, LineSettings};
use eigentol_statistics::reliability::{DesignPoint, FormSettings, LimitFunction, LimitState, LimitValue, form};

pub(crate) fn limit(
    dimension: usize,
    function: impl Fn(&[f64]) -> (f64, Vec<f64>),
) -> impl LimitState<Error = Infallible> {
    LimitFunction::new(dimension, move |z: &[f64]| {
        let (value, gradient) = function(z);
        Ok(LimitValue { value, gradient })
    })
}

pub(crate) fn linear(distance: f64, gradient: Vec<f64>) -> impl LimitState<Error = Infallible> {
    limit(gradient.len(), move |z| {
        let sum: f64 = gradient.iter().zip(z).map(|(a, z)| a * z).sum();
        (distance + sum, gradient.clone())
    })
}

pub(crate) fn design_point<L: LimitState>(limit: &L) -> DesignPoint {
    form(limit, &FormSettings::default()).expect("has a design point").design_point
}

pub(crate) fn close(value: f64, expected: f64, relative: f64) {
    assert!((value - expected).abs() <= relative * expected.abs(), "found {value}, expected {expected}");
}

/// `Phi(x)`.
pub(crate) fn below(x: f64) -> f64 {
    0.5 * libm::erfc(-x * core::f64::consts::FRAC_1_SQRT_2)
}

/// `phi(x)`.
pub(crate) fn density(x: f64) -> f64 {
    (-0.5 * x * x).exp() / (2.0 * core::f64::consts::PI).sqrt()
}

/// Mean of a function of one standard normal variable, by Simpson's rule on [-10, 10].
pub(crate) fn mean(f: impl Fn(f64) -> f64) -> f64 {
    let panels = 20_000;
    let step = 20.0 / f64::from(panels);
    let weight = |k: i32| match k {
        0 => 1.0,
        k if k == panels => 1.0,
        k if k % 2 == 1 => 4.0,
        _ => 2.0,
    };
    let value = |k: i32| {
        let x = -10.0 + f64::from(k) * step;
        weight(k) * density(x) * f(x)
    };
    (0..=panels).map(value).sum::<f64>() * step / 3.0
}

/// The probability of failure, with what design points tell.
pub(crate) fn estimate<L: LimitState>(limit: &L, points: &[DesignPoint], settings: &LineSettings) -> LineProbability {
    let dimension = limit.dimension();
    let variables: Vec<usize> = (0..dimension).collect();
    let expected = points.iter().map(|point| Direction { along: point.direction.clone(), distance: point.beta });
    let expected: Vec<Direction> = expected.collect();
    LineSampler::new(dimension, &variables, &expected, settings).expect("valid settings").run(limit)
}
