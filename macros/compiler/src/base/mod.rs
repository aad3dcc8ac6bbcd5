//! Shared by all stages: typed ids, source positions, diagnostics, units and dimensions.

pub mod census;
pub mod diagnostics;
pub mod dimension;
pub mod ids;
pub mod nearest;
pub mod operators;
pub mod span;
pub mod spline;
pub mod units;
