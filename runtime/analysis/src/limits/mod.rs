//! Limits of failure: which values of a response fail, and where in the space of designs.

mod deviations;
mod edge;
mod limit_at;

pub(crate) use deviations::Deviations;
pub use edge::Edge;
pub(crate) use limit_at::LimitAt;
