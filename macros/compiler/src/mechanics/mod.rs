//! From bodies and joints to equations: recursive kinematics and Newton-Euler on the expression graph, linearised by
//! differentiating the graph.
//!
//! The only bridge between the wing that knows mechanisms and the wing that knows expressions.

mod adjoint;
mod augmented;
mod closure;
mod composite;
mod constraints;
mod derive;
mod energy;
mod forces;
mod frame;
mod functions;
mod inertia;
mod inertial;
mod kernels;
mod kinematics;
mod layout;
mod linearise;
mod loads;
mod momentum;
mod orientation;
mod outputs;
mod path;
mod poses;
mod print;
mod problem;
mod properties;
mod requirements;
mod rolling;
mod setting;
mod sources;
mod steady_state;
mod step_axis;
mod symbols;
mod values;
mod variation;
mod whirl;

pub use derive::derive;
pub use functions::{Damping, Functions, Limits, Pose, Properties, Requirement, Role, Unknown};
#[cfg(test)]
pub(crate) use variation::compared;
