//! Checks of the equations, and the properties that these establish.

mod determinacy;
mod freedom;
mod poses;
mod properties;
mod requirements;
mod steady_state;

pub(super) use determinacy::require_determinate_motion;
pub(super) use freedom::free_directions;
pub(super) use poses::poses;
pub(super) use properties::properties;
pub(super) use requirements::requirements;
pub(super) use steady_state::{Unsteady, require_steady_state};
