//! Inverts the characteristic function by the trapezoidal rule, with proven bounds on both its errors.
//!
//! `P(X < y) = 1/2 - sum_k Im(phi(t_k) e^(-i t_k y)) / (pi (k + 1/2))`, `t_k = (k + 1/2) step` (Gil-Pelaez 1951,
//! discretised by Davies, Biometrika 60, 1973, and Applied Statistics 29, 1980, AS 155; for quadratic forms the
//! integral is Imhof's, Biometrika 48, 1961).

use core::f64::consts::{LN_2, PI};

use super::Estimate;
use super::terms::{Square, Terms};

/// Probability outside the period of the rule, by Chernoff's bound.
const ALIASING: f64 = 1e-14;
/// Maximum number of terms of a short rule.
const SHORT: usize = 2000;
/// Number of terms used when a short rule does not suffice.
const LONG: usize = 50_000;

/// Spacing and number of terms for one sum of squares.
pub(super) struct Rule {
    low: f64,
    high: f64,
    step: f64,
    terms: usize,
}

impl Rule {
    pub(super) fn new(terms: &Terms) -> Self {
        let (low, high) = (-reach(terms, -1.0), reach(terms, 1.0));
        let step = 2.0 * PI / (high - low);
        let enough = |number: usize| left_out(terms, number as f64 * step) <= ALIASING;
        let number = if enough(SHORT) { fewest(SHORT, enough) } else { LONG };
        Self { low, high, step, terms: number }
    }

    /// Whether the truncation error is as small as the other errors of the sum.
    pub(super) fn is_short(&self) -> bool {
        self.terms <= SHORT
    }

    pub(super) fn between(&self, terms: &Terms, from: f64, to: f64) -> Estimate {
        if from >= self.high || to <= self.low {
            return Estimate { value: 0.0, error: ALIASING };
        }
        let (from, to) = ((from > self.low).then_some(from), (to < self.high).then_some(to));
        let whole = 0.5 * f64::from(u8::from(from.is_none()) + u8::from(to.is_none()));
        let mut sum = 0.0;
        for k in 0..self.terms {
            let index = k as f64 + 0.5;
            let t = index * self.step;
            let (size, phase) = characteristic(terms, t);
            let at = |end: Option<f64>| end.map_or(0.0, |y| (phase - t * y).sin());
            sum += size * (at(from) - at(to)) / index;
        }
        let rounding = 4.0 * f64::EPSILON * (self.terms as f64).sqrt();
        Estimate {
            value: (whole + sum / PI).clamp(0.0, 1.0),
            error: 2.0 * (ALIASING + left_out(terms, self.terms as f64 * self.step)) + rounding,
        }
    }
}

/// Smallest sufficient number up to `limit`, assuming that `limit` suffices and so does every number above a sufficient
/// one.
fn fewest(limit: usize, enough: impl Fn(usize) -> bool) -> usize {
    let (mut low, mut high) = (0, limit);
    while high - low > 1 {
        let middle = low.midpoint(high);
        if enough(middle) {
            high = middle;
        } else {
            low = middle;
        }
    }
    high
}

/// Modulus and phase of the characteristic function at `t`.
fn characteristic(terms: &Terms, t: f64) -> (f64, f64) {
    let mut phase = 0.0;
    for &Square { c, nu } in &terms.squares {
        let turn = t * nu;
        phase += 0.5 * turn.atan() - 0.5 * (c * t) * (c * t) * turn / (1.0 + turn * turn);
    }
    (log_modulus(terms, t).exp(), phase)
}

/// Logarithm of the modulus of the characteristic function; it decreases with `t`.
fn log_modulus(terms: &Terms, t: f64) -> f64 {
    let normal = terms.normal * t;
    let squares = terms.squares.iter().map(|&Square { c, nu }| {
        let turn = (t * nu) * (t * nu);
        0.25 * turn.ln_1p() + 0.5 * (c * t) * (c * t) / (1.0 + turn)
    });
    -0.5 * normal * normal - squares.sum::<f64>()
}

/// Bound on the sum beyond `t`. The modulus decreases, so each octave of `int |phi| dt / (pi t)` is at most `ln 2 / pi`
/// times its value at the low end.
fn left_out(terms: &Terms, t: f64) -> f64 {
    const OCTAVES: usize = 400;
    let mut sum = 0.0;
    let mut low = t;
    for _ in 0..OCTAVES {
        let size = log_modulus(terms, low).exp();
        sum += size;
        if size <= 1e-3 * f64::EPSILON * sum {
            break;
        }
        low *= 2.0;
    }
    sum * LN_2 / PI
}

/// A distance that `X` (`side` 1) or `-X` (`side` -1) exceeds with probability at most [`ALIASING`]: for any `u > 0`,
/// `P(X > K'(u)) <= exp(K(u) - u K'(u))`.
fn reach(terms: &Terms, side: f64) -> f64 {
    let bound = ALIASING.ln();
    let most = terms.squares.iter().fold(0.0, |most: f64, square| most.max(side * square.nu));
    // u = limit x / (1 + x), or u = x without a limit; any x > 0 is admissible.
    let at = |x: f64| {
        let u = if most > 0.0 { x / (1.0 + x) / most } else { x };
        real_cumulants(terms, side, u)
    };
    let exponent = |x: f64| {
        let (value, slope, u) = at(x);
        value - u * slope
    };
    let mut high = 1.0;
    for _ in 0..60 {
        if exponent(high) <= bound {
            break;
        }
        high *= 2.0;
    }
    let mut low = 0.0;
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        if exponent(middle) <= bound {
            high = middle;
        } else {
            low = middle;
        }
    }
    at(high).1
}

/// `K(u)` and `K'(u)` of `side X`, and `u`.
fn real_cumulants(terms: &Terms, side: f64, u: f64) -> (f64, f64, f64) {
    let variance = terms.normal * terms.normal;
    let (mut value, mut slope) = (0.5 * variance * u * u, variance * u);
    for &Square { c, nu } in &terms.squares {
        let nu = side * nu;
        let rest = 1.0 - u * nu;
        value += -0.5 * (-u * nu).ln_1p() + 0.5 * (c * u) * (c * u) / rest;
        slope += 0.5 * nu / rest + 0.5 * c * c * u * (1.0 + rest) / (rest * rest);
    }
    (value, slope, u)
}
