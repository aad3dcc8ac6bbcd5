//! The exact distribution of a quadratic form in normal variables: its normal form and three ways to its probabilities.

mod contour;
mod davies;
mod interval;
pub(super) mod normal_cdf;
mod single;
mod standard;
mod terms;

pub(super) use standard::Standard;
pub(super) use terms::Terms;

/// A probability and a bound or estimate of its absolute error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Estimate {
    pub(super) value: f64,
    pub(super) error: f64,
}
