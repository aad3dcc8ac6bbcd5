//! Shared by algebra and programs: typed ids, operators, splines, and a census of special cases.

pub mod census;
pub mod ids;
pub mod operators;
pub mod spline;
