//! A resolved value together with the properties that the checks need.

use crate::base::dimension::Dimension;
use crate::model::expression::{Expr, Matrix, Vector};

/// The dimension of a value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Quantity {
    /// The number `0` without a unit, which fits every dimension.
    Zero,
    /// A value of one dimension.
    Of(Dimension),
}

impl Quantity {
    /// The dimension; zero counts as a plain number.
    pub(super) fn dimension(self) -> Dimension {
        match self {
            Quantity::Zero => Dimension::NONE,
            Quantity::Of(dimension) => dimension,
        }
    }

    /// Whether a value of this quantity may be used where `dimension` is expected.
    pub(super) fn fits(self, dimension: Dimension) -> bool {
        match self {
            Quantity::Zero => true,
            Quantity::Of(actual) => actual == dimension,
        }
    }

    /// The common quantity of two terms of a sum.
    pub(super) fn unify(self, other: Quantity) -> Option<Quantity> {
        match (self, other) {
            (Quantity::Zero, other) => Some(other),
            (quantity, Quantity::Zero) => Some(quantity),
            (quantity, other) => (quantity == other).then_some(quantity),
        }
    }
}

/// A resolved value.
#[derive(Clone, Debug)]
pub(super) enum Typed {
    /// One number.
    Scalar(Expr, Quantity),
    /// Three components of one dimension.
    Vector(Vector, Quantity),
    /// Three rows of one dimension.
    Matrix(Matrix, Quantity),
}

impl Typed {
    pub(super) fn number(value: f64, dimension: Dimension) -> Self {
        Typed::Scalar(Expr::Number(value), Quantity::Of(dimension))
    }

    /// The kind of value, with an article.
    pub(super) fn describe(&self) -> &'static str {
        match self {
            Typed::Scalar(..) => "a number",
            Typed::Vector(..) => "a vector",
            Typed::Matrix(..) => "a matrix",
        }
    }

    /// The numbers in the value.
    pub(super) fn components(&self) -> &[Expr] {
        match self {
            Typed::Scalar(a, _) => std::slice::from_ref(a),
            Typed::Vector(a, _) => a,
            Typed::Matrix(a, _) => a.as_flattened(),
        }
    }

    /// Applies a function to each number in the value.
    pub(super) fn map(self, mut change: impl FnMut(Expr) -> Expr, quantity: Quantity) -> Self {
        match self {
            Typed::Scalar(a, _) => Typed::Scalar(change(a), quantity),
            Typed::Vector(a, _) => Typed::Vector(a.map(change), quantity),
            Typed::Matrix(a, _) => Typed::Matrix(a.map(|row| row.map(&mut change)), quantity),
        }
    }

    pub(super) fn quantity(&self) -> Quantity {
        match *self {
            Typed::Scalar(_, quantity) | Typed::Vector(_, quantity) | Typed::Matrix(_, quantity) => quantity,
        }
    }

    /// All numbers in the value, row by row.
    pub(super) fn numbers(&self) -> &[Expr] {
        match self {
            Typed::Scalar(a, _) => std::slice::from_ref(a),
            Typed::Vector(a, _) => a,
            Typed::Matrix(a, _) => a.as_flattened(),
        }
    }
}

/// The place of a value, which determines the names that it may use.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ValueContext {
    /// A nominal value or a tolerance: numbers only.
    Nominal,
    /// The points of a curve: numbers only.
    Points,
    /// The possible values of a quantity: numbers only.
    Values,
    /// Anything about the mechanism itself: numbers, design variables, inputs and constants.
    Parameter,
    /// The law of a tension: also the distance of its ends and its rate.
    Tension,
    /// A generalised force: also coordinates, their rates and points.
    GeneralizedForce,
    /// A potential energy: also coordinates and points.
    Energy,
    /// An expression that must be zero: also coordinates and points.
    Equation,
    /// An output: also coordinates, points, reactions, energies and the rates of coasting coordinates.
    Output,
}

impl ValueContext {
    /// Whether names of values may be used here.
    pub(super) fn knows_names(self) -> bool {
        !matches!(self, ValueContext::Nominal | ValueContext::Points | ValueContext::Values)
    }

    /// Whether coordinates and points may be used here.
    pub(super) fn knows_places(self) -> bool {
        matches!(
            self,
            ValueContext::GeneralizedForce | ValueContext::Energy | ValueContext::Equation | ValueContext::Output
        )
    }
}
