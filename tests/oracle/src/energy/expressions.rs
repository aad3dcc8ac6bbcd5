//! Expressions of coordinates and points; the caller supplies rates and lengths as numbers.

use super::poses::{Poses, get};
use crate::matrices::Scalar;
use crate::model::{Coordinate, Expr};

/// The quantities that an energy cannot depend on.
pub(super) struct Rates<'a, D> {
    pub(super) of: &'a dyn Fn(Coordinate) -> D,
    pub(super) length: D,
    pub(super) length_rate: D,
}

/// Evaluates an energy.
pub(super) fn evaluate<D: Scalar>(expr: &Expr, inputs: &[f64], poses: &Poses<D>) -> D {
    let none =
        Rates { of: &|_| unreachable!("an energy depends on no rate"), length: D::zero(), length_rate: D::zero() };
    evaluate_with(expr, inputs, poses, &none)
}

/// Evaluates any expression.
pub(super) fn evaluate_with<D: Scalar>(expr: &Expr, inputs: &[f64], poses: &Poses<D>, rates: &Rates<D>) -> D {
    let of = |part: &Expr| evaluate_with(part, inputs, poses, rates);
    match expr {
        Expr::Value(value, _) => get(*value, &poses.design),
        Expr::Input(input) => D::from(inputs[*input]),
        Expr::Coordinate(coordinate) => poses.coordinate(*coordinate),
        Expr::Rate(coordinate) => (rates.of)(*coordinate),
        Expr::Position(point, axis) => poses.position(*point)[*axis],
        Expr::Distance(from, to) => poses.distance(*from, *to),
        Expr::Length => rates.length,
        Expr::LengthRate => rates.length_rate,
        Expr::Sum(parts) => parts.iter().map(of).sum(),
        Expr::Product(parts) => parts.iter().map(of).product(),
        Expr::Power(base, exponent) => of(base).powi(*exponent),
        Expr::Sine(angle) => of(angle).sin(),
        Expr::Cosine(angle) => of(angle).cos(),
        Expr::Curve(curve, argument) => curve.at(of(argument)),
    }
}
