//! Failure probabilities of limit states in independent standard normal variables.
//!
//! A [`LimitState`] is a function `g(z)` that is not positive in failure. [`form`] finds its design point,
//! [`lines`] give an unbiased estimate, and [`sampling`] intervals of plain samples. The caller transforms physical variables to standard normal ones.

mod closest;
#[cfg(feature = "analysis")]
mod counted;
#[cfg(feature = "analysis")]
mod form;
#[cfg(feature = "analysis")]
mod limit_state;
#[cfg(feature = "analysis")]
pub mod lines;
#[cfg(feature = "analysis")]
mod random;
pub mod sampling;
#[cfg(feature = "analysis")]
mod vector;

pub use closest::{Closest, Evaluations, Residuals};
#[cfg(feature = "analysis")]
pub use form::{DesignPoint, FailureRegions, FormResult, FormSensitivity, FormSettings, failure_regions, form};
#[cfg(feature = "analysis")]
pub use limit_state::{LimitFunction, LimitState, LimitValue};
