//! Directions perpendicular to an axis.

use crate::algebra::{Graph, Matrix3, Vector3};
use crate::mechanics::setup::Context;

/// Two unit vectors that form a right-handed set with a given unit vector as the third. The first leans towards the
/// frame axis that is farthest from it at the nominal design: a frame axis along the vector would give no direction.
pub(crate) fn perpendiculars(g: &mut Graph, context: &Context, axis: Vector3) -> [Vector3; 2] {
    let leaning = axis.0.map(|component| {
        let is_variable = g.constant_value(component).is_none();
        (context.nominal(g, component).abs(), is_variable)
    });
    let least = (1..3).fold(0, |least, k| if leaning[k] < leaning[least] { k } else { least });
    let unit = Matrix3::identity(g).0[least];
    let along = axis.scale(g, axis.0[least]);
    let first = unit.sub(g, along);
    let first = if g.is(axis.0[least], 0.0) {
        first
    } else {
        let one = g.constant(1.0);
        let length = first.norm(g);
        let inverse = g.div(one, length);
        first.scale(g, inverse)
    };
    [first, axis.cross(g, first)]
}
