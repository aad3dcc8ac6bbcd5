//! What every stage shares: typed ids, source positions, diagnostics, units and dimensions.

pub mod ids;
