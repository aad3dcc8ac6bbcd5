//! Second derivatives, and spreads to second order, as text and tables.

mod curvature;
mod spreads;

pub(crate) use curvature::{Pair, names, pairs};
