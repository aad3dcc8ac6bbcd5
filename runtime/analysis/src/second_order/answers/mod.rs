//! Second derivatives, and spreads and margins to second order, as text and tables.

mod curvature;
mod margin;
mod mode_margin;
mod spreads;

pub use margin::MarginTable;
