//! Numbers with bounds on their rounding errors.

use crate::base::operators::{Operator, Unary};

/// Largest relative rounding error of one operation.
pub(super) const UNIT_ROUNDOFF: f64 = f64::EPSILON / 2.0;

/// A value and a first-order bound on its rounding error (running error analysis; Higham, Accuracy and Stability of
/// Numerical Algorithms, section 3.3). Symbols are exact; constants are not, because they are rounded numbers or were
/// computed from rounded numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Evaluation {
    /// The value.
    pub(super) value: f64,
    /// Bound on the rounding error.
    pub(super) error: f64,
}

impl Evaluation {
    /// One.
    pub(super) const ONE: Self = Self { value: 1.0, error: 0.0 };

    /// A number rounded once.
    pub(super) fn nearest(value: f64) -> Self {
        Self::rounded(value, 0.0)
    }

    fn rounded(value: f64, inherited: f64) -> Self {
        Self { value, error: inherited + UNIT_ROUNDOFF * value.abs() }
    }
}

/// `operator a`.
fn unary(operator: Unary, a: Evaluation) -> Evaluation {
    let value = operator.apply(a.value);
    let slope = match operator {
        Unary::Negate => 1.0,
        Unary::Sqrt => 0.5 / value,
        Unary::Sin => a.value.cos(),
        Unary::Cos => a.value.sin(),
        Unary::Tan => 1.0 + value * value,
        Unary::Asin | Unary::Acos => 1.0 / (1.0 - a.value * a.value).sqrt(),
        Unary::Exp => value,
        Unary::Ln => 1.0 / a.value,
        Unary::PowerInteger(n) => f64::from(n) * a.value.powi(n - 1),
        Unary::Spline(spline, derivative) => spline.at(a.value, derivative + 1),
    };
    let inherited = if a.error == 0.0 { 0.0 } else { slope.abs() * a.error };
    let error = inherited + rounding_of(operator, a.value, value);
    Evaluation { value, error }
}

/// What rounding adds in `value = operator a`.
pub(super) fn rounding_of(operator: Unary, a: f64, value: f64) -> f64 {
    match operator {
        Unary::Negate => 0.0,
        // A value that has underflowed to zero proves nothing.
        Unary::Exp | Unary::PowerInteger(_) if value == 0.0 && a != 0.0 => f64::NAN,
        // Seven operations, including the difference from the start of the piece.
        Unary::Spline(spline, derivative) => {
            let terms = spline.magnitude(a, derivative);
            let shift = spline.at(a, derivative + 1).abs() * a.abs();
            8.0 * UNIT_ROUNDOFF * (terms + shift)
        }
        _ => UNIT_ROUNDOFF * value.abs(),
    }
}

/// `a operator b`.
pub(super) fn combined(operator: Operator, a: Evaluation, b: Evaluation) -> Evaluation {
    let value = operator.apply(a.value, b.value);
    let (x, y) = (a.value.abs(), b.value.abs());
    let inherited = match operator {
        Operator::Add | Operator::Subtract => a.error + b.error,
        Operator::Multiply => x * b.error + y * a.error,
        Operator::Divide => (a.error + value.abs() * b.error) / y,
        Operator::Power => value.abs() * (y / x * a.error + x.ln().abs() * b.error),
        Operator::Atan2 => (y * a.error + x * b.error) / (x * x + y * y),
    };
    Evaluation::rounded(value, inherited)
}

/// `operator a` for a number known to the compiler: sine and cosine are exact at the doubles nearest to quarter turns,
/// so that a frame declared as turned by 90 degrees has axes with zeros.
pub(super) fn folded(operator: Unary, a: Evaluation) -> Evaluation {
    let result = unary(operator, a);
    let nearly_quarter =
        (result.value.abs() <= 2.0 * f64::EPSILON * a.value.abs()) && matches!(operator, Unary::Sin | Unary::Cos);
    if nearly_quarter { Evaluation::nearest(0.0) } else { result }
}
