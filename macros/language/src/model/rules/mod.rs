//! Rules about the mechanism as a whole.

pub(super) mod attributes;
pub(super) mod composite;
mod moments;
pub(super) mod physical;
pub(super) mod presence;
pub(super) mod tensor;
mod violation;
