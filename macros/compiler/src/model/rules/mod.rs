//! Rules about the mechanism as a whole.

mod composite;
pub(super) mod physical;
pub(super) mod presence;
