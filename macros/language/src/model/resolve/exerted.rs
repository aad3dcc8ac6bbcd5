//! The reactions of constraints.

use crate::base::dimension::Dimension;

/// The reaction of a constraint, which determines the functions that return it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Exerted {
    /// Three components in N.
    Force,
    /// Three components in N m.
    Moment,
    /// One number of this dimension.
    Number(Dimension),
}
