//! Inverts the moment generating function along a tilted ray, for characteristic functions that decay too slowly for
//! the trapezoidal rule on the axis: with `m` squares without slope they decay as `t^(-m/2)`.
//!
//! `P(X > y) = 1/(2 pi i) int e^(K(s) - s y) ds / s` along any path from below to above that passes to the right of the
//! origin. On the two rays `s = r e^(+-i theta)` it becomes `theta/pi + 1/pi int_0^inf Im e^(K(s) - s y) dr / r`. All
//! singularities of `K` lie on the real axis (at `1/nu_j`), so a ray tilted from the imaginary axis to either side
//! meets none; the one on which the integrand stays smaller is used. With `r = e^w` the integrand is analytic in a
//! strip about the real `w` at every scale of the curvatures, and the trapezoidal rule in `w` converges exponentially
//! (Trefethen and Weideman, SIAM Review 56, 2014).

use core::f64::consts::PI;

use nalgebra::Complex;

use super::Estimate;
use super::terms::Terms;

/// Angle between the ray and the imaginary axis. The normal term decays on rays within `PI / 4` of the axis.
const TILT: f64 = PI / 8.0;
/// Logarithm of a modulus that is negligible.
const NOTHING: f64 = -42.0;
/// Maximum logarithm of the modulus: beyond it, cancellation costs more digits than the result may lose.
const LARGEST: f64 = 10.0;
/// Initial step in `w`.
const STEP: f64 = 0.25;
const HALVINGS: usize = 6;
/// Step of the search for the end of the ray, and the value of `w` where it gives up.
const STRIDE: f64 = 0.125;
const FARTHEST: f64 = 300.0;

/// `P(from < X < to)`; `None` if neither ray is suitable.
pub(super) fn between(terms: &Terms, from: f64, to: f64) -> Option<Estimate> {
    let (from, to) = (beyond(terms, from)?, beyond(terms, to)?);
    Some(Estimate { value: (from.value - to.value).clamp(0.0, 1.0), error: from.error + to.error })
}

/// `P(X > y)`.
fn beyond(terms: &Terms, y: f64) -> Option<Estimate> {
    if y.is_infinite() {
        return Some(Estimate { value: f64::from(u8::from(y < 0.0)), error: 0.0 });
    }
    let right = Ray::new(terms, y, 0.5 * PI - TILT);
    let left = Ray::new(terms, y, 0.5 * PI + TILT);
    let ray = match (right, left) {
        (Some(a), Some(b)) => Some(if b.largest < a.largest { b } else { a }),
        (a, b) => a.or(b),
    }?;
    ray.integrate(terms, y)
}

/// A ray on which the integrand decays, and its significant part.
struct Ray {
    angle: f64,
    start: f64,
    end: f64,
    /// Largest logarithm of the integrand's modulus.
    largest: f64,
}

impl Ray {
    fn new(terms: &Terms, y: f64, angle: f64) -> Option<Self> {
        // Near the origin the integrand is `r` times at most about `1 + |y|`.
        let start = NOTHING - (1.0 + y.abs()).ln();
        let mut ray = Self { angle, start, end: start, largest: f64::NEG_INFINITY };
        let mut w = start;
        loop {
            w += STRIDE;
            let modulus = exponent(terms, y, Complex::from_polar(w.exp(), angle)).0.re;
            ray.largest = ray.largest.max(modulus);
            if modulus.is_nan() || ray.largest > LARGEST || w > FARTHEST {
                return None;
            }
            if modulus >= NOTHING {
                ray.end = w + STRIDE;
            } else if can_return(terms, y, angle, w) {
                return Some(ray);
            }
        }
    }

    /// Integrates with the step halved until the sum no longer changes.
    fn integrate(&self, terms: &Terms, y: f64) -> Option<Estimate> {
        let mut step = STEP;
        let (mut sum, mut noise) = self.sum(terms, y, 0.0, step);
        let mut change = f64::INFINITY;
        for _ in 0..HALVINGS {
            let (midpoints, their_noise) = self.sum(terms, y, 0.5 * step, step);
            step *= 0.5;
            change = step * (midpoints - sum).abs();
            sum += midpoints;
            noise += their_noise;
            if change <= 4.0 * step * noise {
                break;
            }
        }
        let estimate =
            Estimate { value: (self.angle + step * sum) / PI, error: (change + step * noise) / PI + f64::EPSILON };
        estimate.error.is_finite().then_some(estimate)
    }

    /// Sum of the integrand over `start + offset + k step`, and of its rounding errors.
    fn sum(&self, terms: &Terms, y: f64, offset: f64, step: f64) -> (f64, f64) {
        let (mut sum, mut noise) = (0.0, 0.0);
        let points = ((self.end - self.start) / step).ceil() as usize;
        for k in 0..points {
            let w = self.start + offset + k as f64 * step;
            let s = Complex::from_polar(w.exp(), self.angle);
            let (exponent, size) = exponent(terms, y, s);
            let modulus = exponent.re.exp();
            sum += modulus * exponent.im.sin();
            noise += modulus * f64::EPSILON * (exponent.im.abs().min(1.0) + size);
        }
        (sum, noise)
    }
}

/// Whether the arc from `s = e^(w + i angle)` back to the imaginary axis, along which the modulus only decreases,
/// contributes nothing: then everything beyond may be neglected, on the ray as well.
fn can_return(terms: &Terms, y: f64, angle: f64, w: f64) -> bool {
    const POINTS: usize = 8;
    let nothing = |s| exponent(terms, y, s).0.re < NOTHING + 4.0;
    // Use the axis itself, exactly: a rounded angle would let a large `s y` grow.
    nothing(Complex::new(0.0, w.exp()))
        && (1..POINTS).all(|k| {
            let part = k as f64 / POINTS as f64;
            let between = 0.5 * PI * (1.0 - part) + angle * part;
            nothing(Complex::from_polar(w.exp(), between))
        })
}

/// `K(s) - s y`, and the magnitude of its terms.
fn exponent(terms: &Terms, y: f64, s: Complex<f64>) -> (Complex<f64>, f64) {
    let (log, size) = terms.log_generating(s);
    (log - s * y, size + (s * y).norm())
}
