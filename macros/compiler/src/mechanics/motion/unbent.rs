//! How the sections of a beam stand before it bends.

use crate::algebra::{ExprId, Graph, Matrix3, Vector3};
use crate::mechanics::setup::Values;
use crate::model::mechanism::Section;

/// The rotation of the axis of the beam from the root to a section: about one direction across the beam.
pub(crate) fn curved(g: &mut Graph, values: &Values, section: &Section) -> Matrix3 {
    let [about_y, about_z] = section.prebend.each_ref().map(|prebend| values.scalar(g, prebend));
    let [_, across, up] = Matrix3::identity(g).0;
    match [about_y, about_z].map(|angle| g.is(angle, 0.0)) {
        [_, true] => Matrix3::rotation(g, across, about_y),
        [true, false] => Matrix3::rotation(g, up, about_z),
        [false, false] => about_both(g, about_y, about_z),
    }
}

/// Terms of the series of a cosine, and of a sine by its angle, that leave less than 1e-19 up to half a turn.
const TERMS: u32 = 16;

/// The rotation by the vector `(0, y, z)`, from the half-angle's cosine `c` and its sine by the angle, `s`. Both are entire
/// functions of `(y^2 + z^2) / 4`, here their series: a straight axis is no special case, nor are its derivatives.
fn about_both(g: &mut Graph, y: ExprId, z: ExprId) -> Matrix3 {
    let both = Vector3([g.zero(), y, z]);
    let quarter = g.constant(0.25);
    let square = both.dot(g, both);
    let square = g.mul(quarter, square);
    let cosine = alternating(g, square, |n| (2 * n - 1) * (2 * n));
    let sine = alternating(g, square, |n| (2 * n) * (2 * n + 1));
    let half = g.constant(0.5);
    let sine = g.mul(half, sine);
    let [b, d] = [y, z].map(|x| g.mul(sine, x));
    let mut twice = |a: ExprId, b: ExprId| {
        let product = g.mul(a, b);
        g.add(product, product)
    };
    let (bb, dd, bd) = (twice(b, b), twice(d, d), twice(b, d));
    let (cb, cd) = (twice(cosine, b), twice(cosine, d));
    let one = g.constant(1.0);
    let both = g.add(bb, dd);
    let [less_both, less_b, less_d] = [both, bb, dd].map(|x| g.sub(one, x));
    let [minus_cb, minus_cd] = [cb, cd].map(|x| g.neg(x));
    Matrix3([Vector3([less_both, cd, minus_cb]), Vector3([minus_cd, less_d, bd]), Vector3([cb, bd, less_b])])
}

/// `1 - u/a(1) (1 - u/a(2) (1 - ..))`.
fn alternating(g: &mut Graph, u: ExprId, a: impl Fn(u32) -> u32) -> ExprId {
    let one = g.constant(1.0);
    (1..TERMS).rev().fold(one, |rest, n| {
        let share = g.constant(1.0 / f64::from(a(n)));
        let share = g.mul(share, u);
        let term = g.mul(share, rest);
        g.sub(one, term)
    })
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
    let [y, z] = section.center.each_ref().map(|center| values.scalar(g, center));
    let vector = Vector3([g.zero(), y, z]);
    unbent(g, values, section).apply(g, vector)
}
