//! Derivatives of the residual with respect to everything it is linearised in (eqs. 13-17).

use crate::algebra::Graph;
use crate::mechanics::equations::Equations;
use crate::mechanics::setup::{Context, added, at_rest, columns};

use super::columns::{Columns, folded};
use super::inertial::Inertial;

/// All first derivatives of the residual at rest: `matrix[j][i]` is the derivative of residual `i` by coordinate `j`.
pub(crate) struct Jacobians {
    /// `Mhat = dg/dqddot` (eq. 15). It holds at any velocity.
    pub(crate) mass: Columns,
    /// `Chat = dg/dqdot` (eq. 16, of the complete residual).
    pub(crate) damping: Columns,
    /// `Khat = dg/dq` (eq. 17).
    pub(crate) stiffness: Columns,
}

impl Jacobians {
    /// Inertia and weight are differentiated by the absolute angles, forces and constraints by the coordinates. In
    /// multiblade coordinates, the matrices hold where all blades do the same, as they do in steady motion.
    pub(crate) fn new(g: &mut Graph, context: &Context, e: &Equations) -> Self {
        let s = context.symbols;
        if !context.harmonics.is_empty() {
            let by_rates = [&s.acceleration, &s.velocity].map(|list| columns(g, &e.motion, list));
            let [mass, damping] = by_rates.map(|columns| columns.iter().map(|column| at_rest(g, s, column)).collect());
            return Self { mass, damping, stiffness: columns(g, &e.rest, &s.q) };
        }
        let [mass, damping, stiffness] = Inertial::new(g, context, e).matrices(g);

        let applied = &e.parts.applied;
        let applied_at_rest = at_rest(g, s, applied);
        let by_position = columns(g, &applied_at_rest, &s.q);
        let [by_acceleration, by_velocity] = [&s.acceleration, &s.velocity].map(|list| -> Columns {
            let moving = columns(g, applied, list);
            moving.iter().map(|column| at_rest(g, s, column)).collect()
        });
        // less moves with the coordinates further out
        let inward: Vec<usize> = context.outward_order().into_iter().map(|order| usize::MAX - order).collect();
        let [by_acceleration, by_velocity, by_position] =
            [by_acceleration, by_velocity, by_position].map(|matrix| folded(g, context, &matrix, &inward));
        let mut in_unknowns = |columns: Columns| -> Columns {
            context.in_unknowns(g, &columns.concat()).chunks(columns.len().max(1)).map(<[_]>::to_vec).collect()
        };
        let [mass, damping, stiffness] = [mass, damping, stiffness].map(&mut in_unknowns);
        let matrices =
            [added(g, &mass, &by_acceleration), added(g, &damping, &by_velocity), added(g, &stiffness, &by_position)];
        let [mass, damping, stiffness] = context.multiblade.matrices(g, matrices);
        Self { mass, damping, stiffness }
    }
}
