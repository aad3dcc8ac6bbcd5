//! The stored data of a design variable.

use crate::base::dimension::Dimension;
use crate::base::span::Extent;
use crate::model::mechanism::Tolerance;

/// A design variable as resolved.
#[derive(Clone, Debug)]
pub(super) struct Nominal {
    pub(super) dimension: Dimension,
    pub(super) value: f64,
    pub(super) tolerance: Tolerance,
    /// The position of the declared tolerance, for messages about its limits.
    pub(super) tolerance_extent: Option<Extent>,
}
