//! Failure probabilities of limit states in independent standard normal variables.
//!
//! A [`LimitState`] is a function `g(z)` that is not positive in failure. [`form`] finds its design point, [`sorm`]
//! corrects for the curvature of the limit there, [`sampling`] and [`lines`] give unbiased estimates, and [`system`]
//! combines several requirements. The caller transforms physical variables to standard normal ones.

mod counted;
mod form;
mod limit_state;
pub mod lines;
mod random;
pub mod sampling;
mod sorm;
pub mod system;
mod vector;

pub use counted::Evaluations;
pub use form::{
    Closest, DesignPoint, FailureRegions, FormResult, FormSensitivity, FormSettings, Residuals, failure_regions, form,
};
pub use limit_state::{LimitFunction, LimitFunctionWithHessian, LimitState, LimitValue};
pub use sorm::{Sorm, sorm};
