//! The equations of motion and the outputs.

mod energy;
mod excited;
mod outputs;
mod residual;
mod steady_equations;

pub(super) use excited::{Response, excited};
pub(super) use outputs::{carried, outputs};
pub(super) use residual::Residual;
pub(super) use steady_equations::Equations;
