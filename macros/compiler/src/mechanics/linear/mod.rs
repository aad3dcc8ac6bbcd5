//! The equations linearised about a steady motion.

mod columns;
mod jacobians;
mod matrices;

pub(super) use jacobians::Jacobians;
pub(super) use matrices::{Linear, linear_arrays};
