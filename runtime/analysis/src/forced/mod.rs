//! Forced vibration: the steady response to harmonic excitations about an equilibrium, its derivatives, and its peaks.

mod adjoint;
mod answer;
mod curvature;
mod dynamic_stiffness;
mod forces;
mod measure;
mod resolvent;
mod response;
mod sensitivities;

pub use curvature::{ForcedCurvature, HarmonicCurvature, second_derivatives};
pub use measure::Measure;
pub(crate) use resolvent::Resolvent;
pub use response::{ForcedResponse, Harmonic, Share, response};
pub use sensitivities::{ForcedSensitivities, HarmonicSensitivity, sensitivities};
