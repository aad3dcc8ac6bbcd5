//! The distribution of a quadratic form. For normal variables it is exact: a normal form and three ways to compute its
//! probabilities. For other variables it comes from the form evaluated at many points.
//!
//! # Probability of a band
//!
//! "Corrected" means the exact distribution of the second-order model, by inversion of its characteristic function
//! (Imhof, Davies), not a series: no negative probabilities, and an error bound beside the value.

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
