//! The motion of a joint coordinate.

use crate::algebra::ExprId;

/// A joint coordinate and its two time derivatives.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CoordinateMotion {
    pub(crate) position: ExprId,
    pub(crate) velocity: ExprId,
    pub(crate) acceleration: ExprId,
}
