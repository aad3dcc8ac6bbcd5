//! Numbers with bounds on their rounding errors.

use crate::base::operators::{Operator, Unary};

/// Largest relative rounding error of one operation.
const UNIT_ROUNDOFF: f64 = f64::EPSILON / 2.0;

/// A value and a first-order bound on its rounding error (running error analysis; Higham, Accuracy and Stability of
/// Numerical Algorithms, section 3.3). Symbols are exact; constants are not, because they are rounded numbers or were
/// computed from rounded numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Evaluation {
    /// The value.
    pub value: f64,
    /// Bound on the rounding error.
    pub error: f64,
}

impl Evaluation {
    /// Whether rounding alone can explain that the value is not zero.
    pub fn is_negligible(self) -> bool {
        self.value.abs() <= 16.0 * self.error
    }

    /// One.
    pub(super) const ONE: Self = Self {
        value: 1.0,
        error: 0.0,
    };

    /// A number rounded once.
    pub(super) fn nearest(value: f64) -> Self {
        Self::rounded(value, 0.0)
    }

    fn rounded(value: f64, inherited: f64) -> Self {
        Self {
            value,
            error: inherited + UNIT_ROUNDOFF * value.abs(),
        }
    }
}

/// `operator a`.
pub(super) fn unary(operator: Unary, a: Evaluation) -> Evaluation {
    let value = operator.apply(a.value);
    // A value that has underflowed to zero proves nothing.
    if value == 0.0 && matches!(operator, Unary::Exp | Unary::PowerInteger(_)) && a.value != 0.0 {
        return Evaluation {
            value: f64::NAN,
            error: f64::NAN,
        };
    }
    let slope = match operator {
        Unary::Negate => {
            return Evaluation {
                value,
                error: a.error,
            };
        }
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
    let inherited = if a.error == 0.0 {
        0.0
    } else {
        slope.abs() * a.error
    };
    if let Unary::Spline(spline, derivative) = operator {
        // Seven operations, including the difference from the start of the piece.
        let terms = spline.magnitude(a.value, derivative);
        let shift = slope.abs() * a.value.abs();
        return Evaluation {
            value,
            error: inherited + 8.0 * UNIT_ROUNDOFF * (terms + shift),
        };
    }
    Evaluation::rounded(value, inherited)
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
    let nearly_quarter = (result.value.abs() <= 2.0 * f64::EPSILON * a.value.abs())
        && matches!(operator, Unary::Sin | Unary::Cos);
    if nearly_quarter {
        Evaluation::nearest(0.0)
    } else {
        result
    }
}
