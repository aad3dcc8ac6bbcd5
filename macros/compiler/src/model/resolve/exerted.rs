//! What constraints exert.

use crate::base::dimension::Dimension;

/// What a constraint exerts, which decides what its reaction is called.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Exerted {
    /// Three components in N.
    Force,
    /// Three components in N m.
    Moment,
    /// One number of this dimension.
    Number(Dimension),
}
