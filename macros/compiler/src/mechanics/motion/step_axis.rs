//! An elementary motion of a joint: its place, its direction and its coordinate.

use crate::algebra::{ExprId, Graph, Vector3};
use crate::base::ids::CoordinateId;

/// The geometry of an elementary motion.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StepAxis {
    pub(crate) coordinate: CoordinateId,
    /// Axis of rotation; `None` for a slide.
    pub(crate) turn: Option<Vector3>,
    /// Direction and amount of translation per unit of the coordinate; `None` for a turn.
    pub(crate) slide: Option<Vector3>,
    /// The axis of the turn or slide in the body frame.
    pub(crate) own_axis: Vector3,
    /// A point of the axis, from the body's origin.
    pub(crate) point: Vector3,
}

impl StepAxis {
    /// Power of a force and its moment about the body's origin per unit rate of the coordinate.
    pub(crate) fn project(&self, g: &mut Graph, force: Vector3, moment: Vector3) -> ExprId {
        let mut power = g.zero();
        if let Some(axis) = self.turn {
            let shift = self.point.cross(g, force);
            let about_axis = moment.sub(g, shift);
            power = axis.dot(g, about_axis);
        }
        if let Some(slide) = self.slide {
            let along = slide.dot(g, force);
            power = g.add(power, along);
        }
        power
    }

    /// Velocity, per unit rate of the coordinate, of a point given from the body's origin.
    pub(crate) fn velocity(&self, g: &mut Graph, arm: Vector3) -> Vector3 {
        let mut velocity = Vector3::zero(g);
        if let Some(axis) = self.turn {
            let lever = arm.sub(g, self.point);
            velocity = axis.cross(g, lever);
        }
        if let Some(slide) = self.slide {
            velocity = velocity.add(g, slide);
        }
        velocity
    }
}
