//! Rules about the mechanism as a whole.

pub(super) mod physical;
pub(super) mod presence;
