//! How the sections of a beam stand before it bends.

use crate::algebra::{Graph, Matrix3, Vector3};
use crate::mechanics::setup::Values;
use crate::model::mechanism::Section;

/// The rotation of the axis of the beam from the root to a section: about one direction across the beam.
pub(crate) fn curved(g: &mut Graph, values: &Values, section: &Section) -> Matrix3 {
    let [about_y, about_z] = section.prebend.each_ref().map(|own| values.scalar(g, own));
    let [_, across, up] = Matrix3::identity(g).0;
    match [about_y, about_z].map(|angle| g.is(angle, 0.0)) {
        [_, true] => Matrix3::rotation(g, across, about_y),
        [true, false] => Matrix3::rotation(g, up, about_z),
        [false, false] => {
            let both = Vector3([g.zero(), about_y, about_z]);
            let angle = both.norm(g);
            let direction = Vector3(both.0.map(|own| g.div(own, angle)));
            Matrix3::rotation(g, direction, angle)
        }
    }
}

/// The rotation from the axes of the root to those of a section: along the curved axis, and turned about it.
pub(crate) fn unbent(g: &mut Graph, values: &Values, section: &Section) -> Matrix3 {
    let along = Matrix3::identity(g).0[0];
    let twist = values.scalar(g, &section.twist);
    let twisted = Matrix3::rotation(g, along, twist);
    curved(g, values, section).multiply(g, twisted)
}

/// From the axis to the centre of mass of a section, along the axes of the root.
pub(crate) fn offset(g: &mut Graph, values: &Values, section: &Section) -> Vector3 {
    let [y, z] = section.center.each_ref().map(|own| values.scalar(g, own));
    let own = Vector3([g.zero(), y, z]);
    unbent(g, values, section).apply(g, own)
}
