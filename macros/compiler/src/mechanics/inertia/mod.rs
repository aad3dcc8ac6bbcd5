//! Inertia and weight: the forces that the motion of the masses requires.

mod augmented;
#[cfg(test)]
mod compared_tests;
mod composite;
mod deviation;
mod flexible;
mod linearised_beam;
mod mass_distribution;
mod momentum;
mod newton_euler;
mod variation;

#[cfg(test)]
pub(crate) use compared_tests::compared;
pub(super) use composite::mass_matrix;
pub(super) use deviation::{Direction, deviation, size};
pub(super) use flexible::{BeamInertia, FromStations};
pub(super) use newton_euler::{BeamForces, Inertial, inertial_at};
pub(super) use variation::{Variation, variation, variation_at_rest};
