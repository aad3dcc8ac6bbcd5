//! The standard normal distribution, with full relative accuracy in the tails.

use core::f64::consts::{FRAC_1_SQRT_2, PI};

use libm::{erf, erfc};

/// `P(Z > z)`.
pub(in crate::second_order) fn upper(z: f64) -> f64 {
    0.5 * erfc(z * FRAC_1_SQRT_2)
}

/// `P(from < Z < to)`, computed from the nearer tails so that a small value loses no digits to a large one.
pub(in crate::second_order) fn between(from: f64, to: f64) -> f64 {
    if from >= to {
        0.0
    } else if from >= 0.0 {
        upper(from) - upper(to)
    } else if to <= 0.0 {
        upper(-to) - upper(-from)
    } else {
        0.5 * (erf(to * FRAC_1_SQRT_2) + erf(-from * FRAC_1_SQRT_2))
    }
}

/// Rounding error of [`between`] due to an end at `z` that is itself uncertain by `slack`.
pub(super) fn end_error(z: f64, slack: f64) -> f64 {
    if z.is_infinite() {
        return 0.0;
    }
    density(z) * (slack + 2.0 * f64::EPSILON * z.abs()) + 2.0 * f64::EPSILON * upper(z.abs())
}

/// Probability density at `z`.
pub(in crate::second_order) fn density(z: f64) -> f64 {
    (-0.5 * z * z).exp() / (2.0 * PI).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(value: f64, expected: f64) {
        assert!((value - expected).abs() <= 1e-13 * expected, "{value:e}, not {expected:e}");
    }

    #[test]
    fn tails_keep_their_digits() {
        // Reference values from 50-digit arithmetic.
        near(upper(5.0), 2.866_515_718_791_939e-7);
        near(upper(10.0), 7.619_853_024_160_526e-24);
        near(upper(30.0), 4.906_713_927_148_187e-198);
        near(between(5.0, f64::INFINITY), 2.866_515_718_791_939e-7);
        near(between(f64::NEG_INFINITY, -10.0), 7.619_853_024_160_526e-24);
        near(between(-1.0, 1.0), 0.682_689_492_137_085_9);
        near(between(-1e-12, 1e-12), 2e-12 * density(0.0));
        assert_eq!(between(f64::NEG_INFINITY, f64::INFINITY), 1.0);
        assert_eq!(between(2.0, 1.0), 0.0);
        near(density(3.0), 4.431_848_411_938_007_6e-3);
    }
}
