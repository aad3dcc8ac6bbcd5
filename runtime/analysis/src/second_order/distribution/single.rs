//! A single variable: the event consists of at most two intervals.

use super::terms::Square;
use super::{Estimate, normal_cdf};

/// `P(from < c z + nu z^2 / 2 < to)` for nonzero `nu`.
pub(super) fn between(square: Square, from: f64, to: f64) -> Estimate {
    if square.nu < 0.0 {
        let mirrored = Square { c: -square.c, nu: -square.nu };
        return between(mirrored, -to, -from);
    }
    // The parabola opens upwards: it is below `to` between the outer pair and below `from` between the inner pair.
    let outer = Pair::of(square, to);
    let inner = Pair::of(square, from);
    let value = match (&outer, &inner) {
        (None, _) => 0.0,
        (Some(outer), None) => normal_cdf::between(outer.left, outer.right),
        (Some(outer), Some(inner)) => {
            normal_cdf::between(outer.left, inner.left) + normal_cdf::between(inner.right, outer.right)
        }
    };
    let error: f64 = [outer, inner].iter().flatten().map(Pair::error).sum();
    Estimate { value: value.clamp(0.0, 1.0), error }
}

/// The two points where the parabola takes a value, in ascending order.
struct Pair {
    left: f64,
    right: f64,
    /// Their relative uncertainty due to rounding: large near the vertex, where the two meet.
    slack: f64,
}

impl Pair {
    /// `None` if the upward parabola lies above the level everywhere.
    fn of(Square { c, nu }: Square, level: f64) -> Option<Self> {
        if level == f64::INFINITY {
            return Some(Self { left: f64::NEG_INFINITY, right: f64::INFINITY, slack: 0.0 });
        }
        let inside = c * c + 2.0 * nu * level;
        if inside < 0.0 || inside.is_nan() {
            return None;
        }
        let root = inside.sqrt();
        let rounding = 2.0 * f64::EPSILON * (c * c + (2.0 * nu * level).abs());
        let lost = (rounding / root).min(rounding.sqrt());
        let sum = -(c + root.copysign(c));
        let (far, near) = if sum == 0.0 { (0.0, 0.0) } else { (sum / nu, -2.0 * level / sum) };
        Some(Self { left: far.min(near), right: far.max(near), slack: if sum == 0.0 { 0.0 } else { lost / sum.abs() } })
    }

    fn error(&self) -> f64 {
        let ends = [self.left, self.right];
        let errors = ends.map(|z| normal_cdf::end_error(z, z.abs() * self.slack));
        errors[0] + errors[1]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chance(square: Square, from: f64, to: f64) -> f64 {
        between(square, from, to).value
    }

    fn near(value: f64, expected: f64) {
        assert!((value - expected).abs() <= 1e-13 * expected, "{value:e}, not {expected:e}");
    }

    #[test]
    fn chi_square_of_one_degree() {
        let square = Square { c: 0.0, nu: 2.0 };
        near(chance(square, f64::NEG_INFINITY, 1.0), 0.682_689_492_137_085_9);
        near(chance(square, 25.0, f64::INFINITY), 2.0 * normal_cdf::upper(5.0));
        near(chance(square, 1.0, 4.0), 2.0 * normal_cdf::between(1.0, 2.0));
        assert_eq!(chance(square, -3.0, -1.0), 0.0);
        assert_eq!(chance(square, -3.0, 0.0), 0.0);
        let mirrored = Square { c: 0.0, nu: -2.0 };
        near(chance(mirrored, -1.0, f64::INFINITY), 0.682_689_492_137_085_9);
    }

    #[test]
    fn slight_curvature_leaves_the_normal_tail() {
        let square = Square { c: 1.0, nu: 1e-17 };
        near(chance(square, 8.0, f64::INFINITY), normal_cdf::upper(8.0));
        let square = Square { c: -1.0, nu: -1e-17 };
        near(chance(square, 8.0, f64::INFINITY), normal_cdf::upper(8.0));
    }

    #[test]
    fn shifted_square_is_an_interval() {
        // 3 z + z^2 / 2 < 8 exactly for -8 < z < 2, and < -4 for -4 < z < -2.
        let square = Square { c: 3.0, nu: 1.0 };
        near(chance(square, f64::NEG_INFINITY, 8.0), normal_cdf::between(-8.0, 2.0));
        near(chance(square, -4.0, 8.0), normal_cdf::between(-8.0, -4.0) + normal_cdf::between(-2.0, 2.0));
        assert_eq!(chance(square, f64::NEG_INFINITY, -4.6), 0.0);
    }

    #[test]
    fn error_grows_at_the_vertex() {
        // The vertex of z + z^2 / 2 is at -1/2.
        let square = Square { c: 1.0, nu: 1.0 };
        let of = |to: f64| between(square, f64::NEG_INFINITY, to);
        assert!(of(0.0).error < 1e-15);
        let (at, beside) = (of(-0.5), of(-0.5 + f64::EPSILON));
        assert!(beside.value > 1e-9 && (at.value - beside.value).abs() <= at.error);
        assert!(at.error < 1e-7);
        let slight = between(Square { c: 1.0, nu: 1e-12 }, 0.5, 1.0);
        assert!(slight.error < 1e-15);
        // A far tail is accurate to its own digits.
        let far = between(square, 60.0, f64::INFINITY);
        assert!(far.error < 1e-12 * far.value);
    }
}
