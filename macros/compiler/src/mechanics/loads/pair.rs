//! A constraint between two sides: its demands on their relative motion, and the pair of forces that enforces them.

use crate::algebra::{ExprId, Graph, Vector3};
use crate::mechanics::motion::{PointMotion, Wrench};
use crate::model::mechanism::Frame;

/// A place fixed in a frame.
#[derive(Clone, Copy)]
pub(crate) struct Side {
    pub(crate) frame: Frame,
    pub(crate) at: PointMotion,
}

/// One equation between two sides, with its force pair: the derivative of the equation by the velocity and the
/// angular velocity of `to` relative to `from`, at the place where the pair acts.
pub(crate) struct Demand {
    /// Name of the equation within its constraint; empty if it is the only one.
    pub(crate) label: &'static str,
    pub(crate) value: ExprId,
    pub(crate) force: Vector3,
    pub(crate) moment: Vector3,
    pub(crate) of_velocities: bool,
}

impl Demand {
    /// The load that a multiplier exerts on the `to` side.
    pub(crate) fn held_by(&self, g: &mut Graph, multiplier: ExprId) -> Wrench {
        Wrench { force: self.force.scale(g, multiplier), moment: self.moment.scale(g, multiplier) }
    }
}

/// Two sides and the demands on them.
pub(crate) struct Pair {
    pub(crate) from: Side,
    pub(crate) to: Side,
    /// From the point of `to` to the place where the pair acts.
    pub(crate) reach: Vector3,
    pub(crate) demands: Vec<Demand>,
}

impl Pair {
    /// From the point of `from` to the place where the pair acts.
    pub(crate) fn gap(&self, g: &mut Graph) -> Vector3 {
        self.to.at.position.sub(g, self.from.at.position).add(g, self.reach)
    }

    pub(crate) fn new(g: &mut Graph, from: Side, to: Side, demands: Vec<Demand>) -> Self {
        let reach = Vector3::zero(g);
        Self { from, to, reach, demands }
    }
}
