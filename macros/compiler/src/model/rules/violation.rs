//! What is said of a requirement that is not met.

use crate::base::span::Extent;

/// A requirement that is not met: "the mass of `bar`" "is -3 kg; it must be positive".
pub(super) struct Violation {
    pub(super) what: String,
    pub(super) problem: String,
    pub(super) extent: Extent,
    pub(super) help: Option<String>,
}

/// A number with so many significant digits.
pub(super) fn digits(value: f64, count: usize) -> f64 {
    format!("{value:.*e}", count - 1).parse().unwrap_or(value)
}
