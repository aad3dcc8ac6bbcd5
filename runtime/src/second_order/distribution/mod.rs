//! The distribution of a quadratic form. In normal variables exactly: its normal form and three ways to its probabilities; in others
//! from the form at many points.

mod contour;
mod davies;
mod interval;
pub(super) mod normal_cdf;
mod sampled;
mod single;
mod standard;
mod terms;

pub(super) use sampled::Sampled;
pub(super) use standard::Standard;
pub(super) use terms::Terms;

/// A probability and a bound or estimate of its absolute error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Estimate {
    pub(super) value: f64,
    pub(super) error: f64,
}
