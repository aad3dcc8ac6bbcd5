//! Whether an equilibrium lies on a branch that is already known.

use super::Branch;
use super::curve::Curve;
use super::local_scaling::{CurvePosition, Frame};
use crate::equilibrium::{turned_towards, turns_do_not_count};

/// Local distance from a branch below which a point is on it.
const CLOSE: f64 = 1e-6;

impl Curve<'_> {
    /// Whether a point, or an equivalent one that differs by full turns, lies on one of the branches.
    pub(super) fn known(&self, branches: &[Branch], curve_position: &CurvePosition) -> bool {
        branches.iter().any(|branch| self.on(branch, curve_position))
    }

    fn on(&self, branch: &Branch, curve_position: &CurvePosition) -> bool {
        let at =
            |k: usize| CurvePosition { q: branch.points[k].equilibrium.coordinates.clone(), p: branch.points[k].value };
        (1..branch.points.len()).any(|k| {
            let (from, to) = (at(k - 1), at(k));
            let turned =
                CurvePosition { q: turned_towards(&curve_position.q, &from.q, &self.description), p: curve_position.p };
            self.near(&from, &to, &turned) && (turned == *curve_position || self.same(curve_position, &turned))
        })
    }

    /// Whether `position` lies on the piece of a branch between two neighbouring points.
    fn near(&self, from: &CurvePosition, to: &CurvePosition, position: &CurvePosition) -> bool {
        let Ok(system) = self.system(from) else {
            return false;
        };
        let frame: Frame = self.frame(from, &system);
        let (end, target) = (frame.local(to), frame.local(position));
        let length = end.norm();
        let Some(normal) = end.unit() else {
            return target.norm() <= CLOSE;
        };
        let along = target.dot(&normal);
        let across = target.plus(-along, &normal).norm();
        if across > 0.3 * length + CLOSE || along < -CLOSE || along > length + CLOSE {
            return false;
        }
        let tolerance = CLOSE.min(0.01 * length);
        match self.correct(&frame, &normal.scaled(along), &normal, length) {
            Ok(corrected) => corrected.local.plus(-1.0, &target).norm() <= tolerance,
            Err(_) => across <= tolerance,
        }
    }

    /// Whether two points that differ by full turns are the same state.
    fn same(&self, curve_position: &CurvePosition, turned: &CurvePosition) -> bool {
        let inputs = self.inputs_at(curve_position.p);
        turns_do_not_count(&self.operating_point(&inputs), &curve_position.q, &turned.q)
    }
}
