//! Machines that nothing holds in some direction, against reference values (`truth/practice`), in any coordinates.

mod along;
mod balanced;
pub(crate) mod common;
mod families;
mod followed;
mod members;
mod pieces;
mod random;
mod reference;
mod unstable;
