//! Forced vibration: the steady response to harmonic excitations about an equilibrium, and its derivatives.

mod adjoint;
mod answer;
mod curvature;
mod dynamic_stiffness;
mod extent;
mod forces;
mod line;
mod measure;
mod orbit;
mod resolvent;
mod response;
mod sensitivities;
mod shares;
mod side_by_side;
mod unknown_phases;
mod vibration;

pub(crate) use answer::CONVENTIONS;
pub use curvature::{ForcedCurvature, HarmonicCurvature, second_derivatives};
pub use eigentol_statistics::random_phases::RandomPhases;
pub use extent::Extent;
pub(crate) use line::{Curving, CurvingLine, Line, Lines, Wanted};
pub use measure::Measure;
pub use orbit::{Orbit, Turning};
#[doc(hidden)]
pub use resolvent::Resolvent;
pub(crate) use response::resonance;
pub use response::{ForcedResponse, Harmonic, Share, response};
pub use sensitivities::{ForcedSensitivities, HarmonicSensitivity, sensitivities};
pub use shares::share_sensitivities;
pub use vibration::Vibration;
pub(crate) use vibration::check_output;
