//! Messages for violated requirements.

use crate::base::span::Extent;

/// A violated requirement: "the mass of `bar`" "is -3 kg; it must be positive".
pub(super) struct Violation {
    pub(super) what: String,
    pub(super) problem: String,
    pub(super) extent: Extent,
    pub(super) help: Option<String>,
}

/// A number rounded to the given number of significant digits.
pub(super) fn digits(value: f64, count: usize) -> f64 {
    format!("{value:.*e}", count - 1).parse().unwrap_or(value)
}
