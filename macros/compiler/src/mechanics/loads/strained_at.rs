//! Stretch and shear of beams where an output asks for them.

use crate::algebra::{ExprId, Graph};
use crate::base::ids::PointId;
use crate::base::legendre::polynomials;
use crate::mechanics::setup::Context;

/// Stretch and the angles of shear of a beam at a point of it, from the coordinates of both; see
/// [`Expr::Bent`](crate::model::expression::Expr::Bent).
pub(crate) fn strained_at(g: &mut Graph, context: &Context, point: PointId) -> [ExprId; 3] {
    let Some((beam, fraction, _)) = context.mechanism.section_at(point) else {
        return [g.zero(); 3];
    };
    let unknowns = &context.topology.free;
    beam.strains.each_ref().map(|ids| {
        let factors = polynomials(ids.len(), fraction);
        let mut terms = Vec::new();
        for (id, factor) in ids.iter().zip(factors) {
            let value = unknowns.iter().position(|unknown| unknown == id).map(|k| context.symbols.q.values[k]);
            terms.extend(value.map(|value| g.scale(factor, value)));
        }
        g.sum(terms)
    })
}
