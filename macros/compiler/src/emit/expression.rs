//! Single expressions as Rust text.

use crate::algebra::{Operator, Unary};
use eigentol_symbolic::base::spline::Spline;

/// The constant that holds the pieces of a curve. Unlike local variables, it does not end in an underscore.
pub(super) fn pieces_of(spline: Spline) -> String {
    format!("PIECES_OF_{}", spline.name().trim_start_matches("r#"))
}

/// How tightly a piece of text binds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Binding {
    Sum,
    Product,
    Sign,
    Atom,
}

/// A piece of Rust text.
#[derive(Clone, Debug)]
pub(super) struct Text {
    pub(super) text: String,
    pub(super) binding: Binding,
}

impl Text {
    /// A name or a call.
    pub(super) fn atom(text: impl Into<String>) -> Self {
        Self { text: text.into(), binding: Binding::Atom }
    }

    /// A number.
    pub(super) fn constant(value: f64) -> Self {
        Self::atom(format!("T::constant({value:?})"))
    }

    fn within(&self, least: Binding) -> String {
        if self.binding >= least { self.text.clone() } else { format!("({})", self.text) }
    }

    /// A unary operator.
    pub(super) fn unary(operator: Unary, a: &Self) -> Self {
        match operator {
            Unary::Negate => Self { text: format!("-{}", a.within(Binding::Atom)), binding: Binding::Sign },
            Unary::PowerInteger(n) => Self::atom(format!("{}.powi({n})", a.within(Binding::Atom))),
            Unary::Spline(spline, derivative) => {
                let pieces = pieces_of(spline);
                let a = a.within(Binding::Atom);
                Self::atom(format!("{a}.spline(&{pieces}, {derivative})"))
            }
            function => {
                let function = function.name();
                Self::atom(format!("{}.{function}()", a.within(Binding::Atom)))
            }
        }
    }

    /// Sine and cosine together.
    pub(super) fn sin_cos(a: &Self) -> Self {
        Self::atom(format!("{}.sin_cos()", a.within(Binding::Atom)))
    }

    /// Sines and cosines of several angles.
    pub(super) fn sin_cos_all(angles: &[Self]) -> Self {
        let angles: Vec<&str> = angles.iter().map(|angle| angle.text.as_str()).collect();
        Self::atom(format!("T::sin_cos_all([{}])", angles.join(", ")))
    }

    /// A binary operator. The order of evaluation follows the graph: the right operand keeps its parentheses.
    pub(super) fn binary(operator: Operator, a: &Self, b: &Self) -> Self {
        let infix = |sign, left, right, binding| Self {
            text: format!("{} {sign} {}", a.within(left), b.within(right)),
            binding,
        };
        match operator {
            Operator::Add => infix("+", Binding::Sum, Binding::Product, Binding::Sum),
            Operator::Subtract => infix("-", Binding::Sum, Binding::Product, Binding::Sum),
            Operator::Multiply => infix("*", Binding::Product, Binding::Sign, Binding::Product),
            Operator::Divide => infix("/", Binding::Product, Binding::Sign, Binding::Product),
            Operator::Power => Self::atom(format!("{}.powf({})", a.within(Binding::Atom), b.text)),
            Operator::Atan2 => Self::atom(format!("{}.atan2({})", a.within(Binding::Atom), b.text)),
        }
    }
}
