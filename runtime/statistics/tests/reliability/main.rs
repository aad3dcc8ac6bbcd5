//! Reliability methods against exact probabilities and published ones.

mod benchmarks;
mod common;
mod coverage;
mod family;
mod form;
mod lines;
mod random_limits;
mod regions;
