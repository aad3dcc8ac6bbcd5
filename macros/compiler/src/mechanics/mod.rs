//! From bodies and joints to equations: recursive kinematics and Newton-Euler equations on the expression graph,
//! linearised by differentiating the graph.
//!
//! This is the only bridge between the modules that know mechanisms and those that know expressions.

mod checks;
mod derive;
mod equations;
mod functions;
mod inertia;
mod kernel_name;
mod kernels;
mod linear;
mod loads;
mod motion;
mod picture;
mod print;
mod resolved;
mod setup;

#[cfg(test)]
pub(crate) use derive::compared_at_rest;
pub use derive::derive;
pub use functions::{
    Damping, Excitation, FreeDirections, Functions, Limits, Pose, Properties, Requirement, RingPlaces, Role,
    SpanPlaces, Unknown,
};
#[cfg(test)]
pub(crate) use inertia::compared;
pub use kernel_name::KernelName;
pub use picture::{Picture, PictureBeam, PictureBody, PictureJoint, PictureLink, SolidKind};
pub use resolved::resolved_modes;
