//! What is kept of a design variable.

use crate::base::dimension::Dimension;
use crate::base::span::Extent;
use crate::model::mechanism::Tolerance;

/// A design variable as resolved.
#[derive(Clone, Debug)]
pub(super) struct Nominal {
    pub(super) dimension: Dimension,
    pub(super) value: f64,
    pub(super) tolerance: Tolerance,
    /// The declared tolerance, where a message about its reach points.
    pub(super) tolerance_extent: Option<Extent>,
}
