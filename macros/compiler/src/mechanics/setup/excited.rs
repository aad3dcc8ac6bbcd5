//! What excitations add to a mechanism while their forces are derived.

use crate::base::ids::{BodyId, CoordinateId};

use super::coordinate::CoordinateMotion;
use super::mass_distribution::MassDistribution;

/// What excitations add to a mechanism; nothing in its own equations.
#[derive(Clone, Debug, Default)]
pub(crate) struct Excited {
    /// Additional mass distributions of bodies.
    pub(crate) deviations: Vec<(BodyId, MassDistribution)>,
    /// Additional motion of driven coordinates.
    pub(crate) shaken: Vec<(CoordinateId, CoordinateMotion)>,
}
