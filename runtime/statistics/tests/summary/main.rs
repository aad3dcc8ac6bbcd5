//! Summary statistics in one pass: the same bits however samples are split, against exact formulas and exact quantiles.

// Lists of ranges may have just one.
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
