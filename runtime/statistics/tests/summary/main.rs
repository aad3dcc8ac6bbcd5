//! Summary statistics in one pass: the same bits however the samples are split, checked against exact formulas and
//! exact quantiles.

// A list of ranges may have just one element.
#![allow(clippy::single_range_in_vec_init)]

mod common;
mod distributions;
mod errors;
mod intervals;
mod moments;
#[cfg(feature = "serde")]
mod serialized;
mod sketches;
mod splits;
