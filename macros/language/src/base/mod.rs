//! Shared by all stages: typed ids, source positions, diagnostics, units and dimensions.

pub mod diagnostics;
pub mod dimension;
pub mod ids;
pub mod legendre;
pub mod names;
pub mod nearest;
pub(crate) mod quoted;
pub mod span;
pub mod units;
