//! Tolerances and distributions of values.

use std::fmt::{self, Display, Formatter};

/// Limits about a value, and the distribution between them.
#[derive(Clone, Debug, PartialEq)]
pub struct Tolerance {
    /// Lower limit minus the value, SI or a fraction of the value.
    pub lower: f64,
    /// Upper limit minus the value, SI or a fraction of the value; not below the lower one.
    pub upper: f64,
    /// Whether the limits are fractions of the value.
    pub relative: bool,
    /// The distribution.
    pub law: Law,
}

impl Tolerance {
    /// A value that does not vary.
    pub const NONE: Self = Self { lower: 0.0, upper: 0.0, relative: false, law: Law::Normal };

    /// Whether the value can differ from the nominal one.
    pub fn varies(&self) -> bool {
        self.lower != 0.0 || self.upper != 0.0
    }

    /// Whether both limits are equally far from the value.
    pub fn is_symmetric(&self) -> bool {
        self.lower == -self.upper
    }

    /// The midpoint between the limits, minus the value.
    pub fn middle(&self) -> f64 {
        0.5 * self.lower + 0.5 * self.upper
    }
}

/// The distribution of values.
#[derive(Clone, Debug, PartialEq)]
pub enum Law {
    /// Normal.
    Normal,
    /// Normal, truncated at the limits.
    TruncatedNormal,
    /// Uniform between the limits.
    Uniform,
    /// Triangular, with the peak midway between the limits.
    Triangular,
    /// Lognormal.
    Lognormal,
    /// Two-parameter Weibull.
    Weibull,
    /// Beta between the limits, with density `x^(alpha - 1) (1 - x)^(beta - 1)` over them.
    Beta {
        /// First shape, positive.
        alpha: f64,
        /// Second shape, positive.
        beta: f64,
    },
    /// One of several values: the position of each between the lower and the upper limit, from 0 to 1, and its weight.
    OneOf(Vec<(f64, f64)>),
}

impl Display for Law {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        f.write_str(match self {
            Law::Normal => "normal",
            Law::TruncatedNormal => "truncated normal",
            Law::Uniform => "uniform",
            Law::Triangular => "triangular",
            Law::Lognormal => "lognormal",
            Law::Weibull => "weibull",
            Law::Beta { alpha, beta } => return write!(f, "beta({alpha}, {beta})"),
            Law::OneOf(values) => return write!(f, "one of {} values", values.len()),
        })
    }
}
