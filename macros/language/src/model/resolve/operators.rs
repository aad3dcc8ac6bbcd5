//! Operators: their effect on dimensions, and the operands that each refuses.

use super::bare::bare_number;
use super::resolver::Resolver;
use super::typed::{Quantity, Typed, ValueContext};
use crate::base::dimension::Dimension;
use crate::base::span::Extent;
use crate::model::expression::Expr;
use crate::model::simplify;
use crate::syntax::ast::{Binary, Operator, Value};

impl Resolver<'_> {
    pub(super) fn binary(&mut self, binary: &Binary, value_context: ValueContext) -> Option<Typed> {
        let left = self.value(&binary.left, value_context);
        let right = self.value(&binary.right, value_context);
        let (left, right) = (left?, right?);
        let result = match binary.operator {
            Operator::Add | Operator::Subtract => self.sum(binary, left, right),
            Operator::Multiply => self.product(binary, left, right),
            Operator::Divide => self.quotient(binary, left, right),
            Operator::Power => self.power(binary, left, right),
        }?;
        self.finite(result, binary.sign)
    }

    fn sum(&mut self, binary: &Binary, left: Typed, right: Typed) -> Option<Typed> {
        let combine = match binary.operator {
            Operator::Add => simplify::add,
            _ => simplify::subtract,
        };
        let quantities = (left.quantity(), right.quantity());
        let sum = match (left, right) {
            (Typed::Scalar(a, of_a), Typed::Scalar(b, _)) => Typed::Scalar(combine(a, b), of_a),
            (Typed::Vector(a, of_a), Typed::Vector(b, _)) => {
                Typed::Vector(simplify::componentwise(a, b, combine), of_a)
            }
            (Typed::Matrix(a, of_a), Typed::Matrix(b, _)) => Typed::Matrix(simplify::entrywise(a, b, combine), of_a),
            (left, right) => {
                let kinds = match (&left, &right) {
                    (Typed::Matrix(..), _) => [left.describe(), right.describe()],
                    (_, Typed::Matrix(..)) => [right.describe(), left.describe()],
                    _ => ["a vector", "a number"],
                };
                let message = format!("cannot add or subtract {}", kinds.join(" and "));
                return self.refuse(binary.sign, message);
            }
        };
        let quantity = self.same_dimension(binary, quantities.0, quantities.1)?;
        Some(sum.map(|part| part, quantity))
    }

    /// The common dimension of the terms of a sum.
    fn same_dimension(&mut self, binary: &Binary, a: Quantity, b: Quantity) -> Option<Quantity> {
        let unified = a.unify(b);
        if unified.is_none() {
            let (a, b) = (a.dimension(), b.dimension());
            let message = match binary.operator {
                Operator::Add => format!("cannot add {} and {}", a.describe(), b.describe()),
                _ => format!("cannot subtract {} from {}", b.describe(), a.describe()),
            };
            let unitless = |value: &Value, unit: Dimension| {
                bare_number(value).map(|text| format!("give the number a unit: `{text} {}`", unit.si_symbol()))
            };
            let unitless_name = |value: &Value, dimension: Dimension| {
                let (name, number) = self.declared_without_unit(value)?;
                dimension.is_none().then(|| format!("`{name}` is declared without a unit: `{number}`"))
            };
            let help = self
                .swallowed(&binary.left, a, b)
                .or_else(|| self.swallowed(&binary.right, b, a))
                .or_else(|| unitless(&binary.right, a))
                .or_else(|| unitless(&binary.left, b))
                .or_else(|| unitless_name(&binary.right, b))
                .or_else(|| unitless_name(&binary.left, a));
            self.report(binary.sign, message, help);
        }
        unified
    }

    fn product(&mut self, binary: &Binary, left: Typed, right: Typed) -> Option<Typed> {
        match (left, right) {
            (Typed::Scalar(a, of_a), other) | (other, Typed::Scalar(a, of_a)) => {
                let quantity = self.combined(binary, of_a, other.quantity())?;
                Some(other.map(|part| simplify::multiply(a.clone(), part), quantity))
            }
            (Typed::Vector(..), Typed::Vector(..)) => self.refuse_with_help(
                binary.sign,
                "cannot multiply two vectors with `*`",
                "use `dot(a, b)` or `cross(a, b)`",
            ),
            _ => {
                let message = "a matrix can only be multiplied by a number";
                self.refuse(binary.sign, message)
            }
        }
    }

    fn quotient(&mut self, binary: &Binary, left: Typed, right: Typed) -> Option<Typed> {
        let (divisor, of_divisor) = match right {
            Typed::Scalar(divisor, of_divisor) => (divisor, of_divisor),
            other => {
                let message = format!("cannot divide by {}", other.describe());
                return self.refuse(binary.sign, message);
            }
        };
        if divisor == Expr::Number(0.0) {
            return self.refuse(binary.right.extent, "division by zero");
        }
        let quantity = self.combined(binary, left.quantity(), of_divisor)?;
        Some(left.map(|part| simplify::divide(part, divisor.clone()), quantity))
    }

    /// Dimension of a product or quotient.
    fn combined(&mut self, binary: &Binary, a: Quantity, b: Quantity) -> Option<Quantity> {
        let (a, b) = (a.dimension(), b.dimension());
        let dimension = match binary.operator {
            Operator::Divide => a.over(b),
            _ => a.times(b),
        };
        self.in_range(dimension, binary.sign)
    }

    /// A dimension, or a message if an exponent is out of range: exponents are small numbers unless a power runs away.
    pub(super) fn in_range(&mut self, dimension: Option<Dimension>, at: Extent) -> Option<Quantity> {
        if dimension.is_none() {
            let message = "the exponents of this value's unit are out of range";
            self.diagnostics.error(at, message);
        }
        dimension.map(Quantity::Of)
    }

    fn power(&mut self, binary: &Binary, left: Typed, right: Typed) -> Option<Typed> {
        let (base, of_base, exponent, of_exponent) = match (left, right) {
            (Typed::Scalar(base, of_base), Typed::Scalar(exponent, of_exponent)) => {
                (base, of_base, exponent, of_exponent)
            }
            (Typed::Scalar(..), other) | (other, _) => {
                let message = format!("{} cannot stand in a power", other.describe());
                return self.refuse(binary.sign, message);
            }
        };
        let what = "an exponent";
        self.expect(of_exponent, Dimension::NONE, what, &binary.right)?;
        let dimension = of_base.dimension();
        if let Expr::Number(exponent) = exponent
            && exponent.fract() == 0.0
            && exponent.abs() <= 1000.0
        {
            // The bound makes the conversion exact.
            let n = exponent as i32;
            let quantity = self.in_range(dimension.power(n, 1), binary.sign)?;
            if n < 0 && base == Expr::Number(0.0) {
                return self.refuse(binary.left.extent, "division by zero");
            }
            return Some(Typed::Scalar(simplify::power_integer(base, n), quantity));
        }
        let quantity = match (dimension.is_none(), &exponent) {
            (true, _) => Quantity::Of(Dimension::NONE),
            (false, &Expr::Number(exponent)) => {
                let Some((numerator, denominator)) = fraction(exponent) else {
                    let message =
                        format!("{} can only be raised to a whole number or a simple fraction", dimension.describe());
                    return self.refuse(binary.sign, message);
                };
                self.in_range(dimension.power(numerator, denominator), binary.sign)?
            }
            (false, _) => {
                let message = format!("{} can only be raised to a constant power", dimension.describe());
                let help = "divide it by a reference value first";
                return self.refuse_with_help(binary.sign, message, help);
            }
        };
        Some(Typed::Scalar(simplify::power(base, exponent), quantity))
    }

    /// Rejects a constant that is not finite, such as `sqrt(-1)`: it can only be a mistake.
    pub(super) fn finite(&mut self, typed: Typed, at: Extent) -> Option<Typed> {
        let wrong = |expr: &Expr| matches!(expr, Expr::Number(value) if !value.is_finite());
        if typed.numbers().iter().any(wrong) {
            return self.refuse(at, "the result of this is not a finite real number");
        }
        Some(typed)
    }
}

/// The fraction with a denominator up to 12 that equals an exponent such as `1/3` to double precision.
fn fraction(value: f64) -> Option<(i32, i32)> {
    (1..=12).find_map(|denominator| {
        let numerator = value * f64::from(denominator);
        let near = (numerator - numerator.round()).abs() < 1e-12 && numerator.abs() < 1e4;
        // The bound makes the conversion exact.
        near.then(|| (numerator.round() as i32, denominator))
    })
}
