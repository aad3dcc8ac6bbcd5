//! Checks of the equations, and the properties that these establish.
//!
//! # The compiler decides zeros with error bounds
//!
//! Steady state, symmetry of `Khat` and the kind of `Chat` are evaluated at random states with a running bound on the
//! rounding error; a fixed relative tolerance misjudges deep trees. Computed constants keep their bound, or the
//! remainder of a cancelling sum would pass for a number.

mod beams;
mod blades;
mod determinacy;
mod freedom;
mod harmonic;
mod poses;
mod properties;
mod requirements;
mod steady_state;

pub(super) use beams::{notes_on_beams, notes_on_planes};
pub(super) use blades::{Drive, drives, multiblade, remaining_orders, require_symmetry};
pub(super) use determinacy::require_determinate_motion;
pub(super) use freedom::free_directions;
pub(super) use harmonic::{Turning, require_harmonic};
pub(super) use poses::poses;
pub(super) use properties::properties;
pub(super) use requirements::requirements;
pub(super) use steady_state::{Unsteady, is_steady, require_steady_state};
