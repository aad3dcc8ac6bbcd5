//! Reliability methods against exact probabilities and published ones.

mod benchmarks;
mod common;
mod coverage;
mod form;
mod lines;
mod random_limits;
mod regions;
mod sampling;
