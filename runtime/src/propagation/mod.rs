//! How tolerances spread any responses, several at once with their covariance: quantities of modes, outputs, critical values of an
//! input.
//!
//! | method | what it takes | what it gives |
//! | --- | --- | --- |
//! | [`sampled`] | some thousand designs, whatever the distribution and the response | everything, failures counted |
//! | [`quadrature`] | few designs while few variables vary | mean, sigma, skewness, covariance |
//! | [`worst_case`] | some corners of the box of limits | least and greatest value |

mod gather;
mod limits;
mod model;
mod quadrature;
mod result;
mod sampled;
mod sampler;
mod space;
mod worst_case;

pub use quadrature::quadrature;
pub use result::{Estimated, Method, Propagation, QUANTILES, Quantile, ResponseSpread};
pub use sampled::{Samples, sampled};
pub use sampler::{Points, Sampler};
pub use worst_case::{Extreme, MissingCorner, ResponseLimits, WorstCase, worst_case};
