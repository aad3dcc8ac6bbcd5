//! The operators of expressions: their names and their values.

use super::spline::Spline;

/// Binary operators.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Operator {
    /// `a + b`.
    Add,
    /// `a - b`.
    Subtract,
    /// `a * b`.
    Multiply,
    /// `a / b`.
    Divide,
    /// `a ^ b`, `a > 0`.
    Power,
    /// `atan2(a, b)`.
    Atan2,
}

/// Unary operators.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Unary {
    /// `-a`.
    Negate,
    /// Square root.
    Sqrt,
    /// Sine.
    Sin,
    /// Cosine.
    Cos,
    /// Tangent.
    Tan,
    /// Inverse sine.
    Asin,
    /// Inverse cosine.
    Acos,
    /// Exponential.
    Exp,
    /// Natural logarithm.
    Ln,
    /// `a ^ n`.
    PowerInteger(i32),
    /// A curve, or its derivative of the given order.
    Spline(Spline, u8),
}

/// Functions of one argument that have a name in the language.
const NAMED: [Unary; 8] =
    [Unary::Sqrt, Unary::Sin, Unary::Cos, Unary::Tan, Unary::Asin, Unary::Acos, Unary::Exp, Unary::Ln];

impl Operator {
    /// `a operator b`.
    pub fn apply(self, a: f64, b: f64) -> f64 {
        match self {
            Self::Add => a + b,
            Self::Subtract => a - b,
            Self::Multiply => a * b,
            Self::Divide => a / b,
            Self::Power => a.powf(b),
            Self::Atan2 => a.atan2(b),
        }
    }
}

impl Unary {
    /// The function with the given name.
    pub fn named(name: &str) -> Option<Self> {
        NAMED.into_iter().find(|function| function.name() == name)
    }

    /// The name of the operator; for functions, the name in the language and in Rust.
    pub fn name(self) -> &'static str {
        match self {
            Self::Negate => "minus",
            Self::Sqrt => "sqrt",
            Self::Sin => "sin",
            Self::Cos => "cos",
            Self::Tan => "tan",
            Self::Asin => "asin",
            Self::Acos => "acos",
            Self::Exp => "exp",
            Self::Ln => "ln",
            Self::PowerInteger(_) => "power",
            Self::Spline(spline, derivative) => spline.name_of(derivative),
        }
    }

    /// `operator a`.
    pub fn apply(self, a: f64) -> f64 {
        match self {
            Self::Negate => -a,
            Self::Sqrt => a.sqrt(),
            Self::Sin => a.sin(),
            Self::Cos => a.cos(),
            Self::Tan => a.tan(),
            Self::Asin => a.asin(),
            Self::Acos => a.acos(),
            Self::Exp => a.exp(),
            Self::Ln => a.ln(),
            Self::PowerInteger(n) => a.powi(n),
            Self::Spline(spline, derivative) => spline.at(a, derivative),
        }
    }
}
