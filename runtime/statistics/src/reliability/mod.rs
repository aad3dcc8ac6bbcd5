//! Failure probabilities of limit states in independent standard normal variables.
//!
//! A [`LimitState`] is a function `g(z)` that is not positive in failure. [`form`] finds its design point,
//! [`lines`] give an unbiased estimate, and [`sampling`] intervals of plain samples. The caller transforms physical variables to standard normal ones.

mod counted;
mod form;
mod limit_state;
pub mod lines;
mod random;
pub mod sampling;
mod vector;

pub use counted::Evaluations;
pub use form::{
    Closest, DesignPoint, FailureRegions, FormResult, FormSensitivity, FormSettings, Residuals, failure_regions, form,
};
pub use limit_state::{LimitFunction, LimitState, LimitValue};
