//! One variable: the event is at most two intervals of it.

use super::normal;
use super::terms::Square;

/// `P(from < c z + nu z^2 / 2 < to)` with `nu` not zero.
pub(super) fn between(square: Square, from: f64, to: f64) -> f64 {
    if square.nu < 0.0 {
        let mirrored = Square {
            c: -square.c,
            nu: -square.nu,
        };
        return between(mirrored, -to, -from);
    }
    // The parabola opens upwards: it lies below `to` inside the outer pair, below `from` inside the inner pair.
    let Some((left, right)) = roots(square, to) else {
        return 0.0;
    };
    match roots(square, from) {
        None => normal::between(left, right),
        Some((inner_left, inner_right)) => {
            normal::between(left, inner_left) + normal::between(inner_right, right)
        }
    }
}

/// Where the upward parabola takes the value `level`, in ascending order; `None` when it lies above.
fn roots(Square { c, nu }: Square, level: f64) -> Option<(f64, f64)> {
    if level == f64::INFINITY {
        return Some((f64::NEG_INFINITY, f64::INFINITY));
    }
    let inside = c * c + 2.0 * nu * level;
    if inside < 0.0 || inside.is_nan() {
        return None;
    }
    let sum = -(c + inside.sqrt().copysign(c));
    if sum == 0.0 {
        return Some((0.0, 0.0));
    }
    let (far, near) = (sum / nu, -2.0 * level / sum);
    Some((far.min(near), far.max(near)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(value: f64, expected: f64) {
        assert!(
            (value - expected).abs() <= 1e-13 * expected,
            "{value:e}, not {expected:e}"
        );
    }

    #[test]
    fn chi_square_of_one_degree() {
        let square = Square { c: 0.0, nu: 2.0 };
        near(
            between(square, f64::NEG_INFINITY, 1.0),
            0.682_689_492_137_085_9,
        );
        near(
            between(square, 25.0, f64::INFINITY),
            2.0 * normal::upper(5.0),
        );
        near(between(square, 1.0, 4.0), 2.0 * normal::between(1.0, 2.0));
        assert_eq!(between(square, -3.0, -1.0), 0.0);
        assert_eq!(between(square, -3.0, 0.0), 0.0);
        let mirrored = Square { c: 0.0, nu: -2.0 };
        near(
            between(mirrored, -1.0, f64::INFINITY),
            0.682_689_492_137_085_9,
        );
    }

    #[test]
    fn slight_curvature_leaves_the_normal_tail() {
        let square = Square { c: 1.0, nu: 1e-17 };
        near(between(square, 8.0, f64::INFINITY), normal::upper(8.0));
        let square = Square {
            c: -1.0,
            nu: -1e-17,
        };
        near(between(square, 8.0, f64::INFINITY), normal::upper(8.0));
    }

    #[test]
    fn shifted_square_is_an_interval() {
        // 3 z + z^2 / 2 < 8 exactly for -8 < z < 2, and < -4 for -4 < z < -2.
        let square = Square { c: 3.0, nu: 1.0 };
        near(
            between(square, f64::NEG_INFINITY, 8.0),
            normal::between(-8.0, 2.0),
        );
        near(
            between(square, -4.0, 8.0),
            normal::between(-8.0, -4.0) + normal::between(-2.0, 2.0),
        );
        assert_eq!(between(square, f64::NEG_INFINITY, -4.6), 0.0);
    }
}
