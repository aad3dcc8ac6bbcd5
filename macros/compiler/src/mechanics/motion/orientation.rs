//! Orientation of a body relative to the axes of its motion: those of the common frame or those of the layout.

use crate::algebra::{ExprId, Graph, Matrix3, Unary, Vector3};
use crate::census::taken;

/// A rotation `R_GB = base * rotation(axis, angle)`. Successive rotations about one axis add their angles, so a
/// chain of parallel joints needs one sine and cosine per body and no matrix products.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Orientation {
    base: Matrix3,
    turn: Option<(Vector3, ExprId)>,
    /// The angle about the same axis before the last turn, or before all turns of a run.
    before: Option<ExprId>,
    /// The body axes, in the axes of the motion.
    pub(crate) axes: Matrix3,
}

impl Orientation {
    /// No rotation.
    pub(crate) fn aligned(g: &mut Graph) -> Self {
        Self::fixed(Matrix3::identity(g))
    }

    fn fixed(axes: Matrix3) -> Self {
        Self { base: axes, turn: None, before: None, axes }
    }

    /// This rotation followed by a constant one.
    pub(crate) fn then_fixed(self, g: &mut Graph, rotation: Option<Matrix3>) -> Self {
        match rotation {
            Some(rotation) => Self::fixed(self.axes.multiply(g, rotation)),
            None => self,
        }
    }

    /// This rotation followed by one by `angle` about the body's own unit vector `axis`.
    pub(crate) fn then_turned(self, g: &mut Graph, axis: Vector3, angle: ExprId, name: &str) -> Self {
        let (base, before) = match self.turn {
            Some((same, before)) if same == axis => {
                taken(|| "orientation: angles about one axis added".into());
                (self.base, Some(before))
            }
            _ => (self.axes, None),
        };
        if g.is(angle, 0.0) {
            return self;
        }
        Self { base, before, ..self }.turned_on(g, axis, angle, name)
    }

    /// The orientation after turning about `axis` by `angle` since the last turn or since the beginning of a run of
    /// turns.
    pub(crate) fn turned_on(self, g: &mut Graph, axis: Vector3, angle: ExprId, name: &str) -> Self {
        let total = match self.before {
            Some(before) => g.add(before, angle),
            None => angle,
        };
        if g.is(total, 0.0) {
            return self;
        }
        g.set_name(total, || format!("{name}_angle"));
        for (operator, function) in [(Unary::Sin, "sin"), (Unary::Cos, "cos")] {
            let value = g.unary(operator, total);
            let angle = g.name(total).unwrap_or(name).to_owned();
            g.set_name(value, || format!("{function}_{angle}"));
        }
        let rotation = Matrix3::rotation(g, axis, total);
        let axes = self.base.multiply(g, rotation);
        Self { turn: Some((axis, total)), axes, ..self }
    }

    /// A body-fixed vector in the axes of the motion. Along the axis of a pure turn this does not need the angle.
    pub(crate) fn express(self, g: &mut Graph, vector: Vector3) -> Vector3 {
        match self.turn {
            Some((axis, _)) if axis == vector => self.base.apply(g, vector),
            _ => self.axes.apply(g, vector),
        }
    }
}
