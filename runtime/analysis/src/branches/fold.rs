//! Limit points: Newton's method on `(g, h) = 0` with `h` from `[Khat c; d^T 0] [v; h] = [0; 1]`, which vanishes where
//! `Khat` is singular (Griewank and Reddien, 1984).

use super::bordered::Bordered;
use super::curve::{ContinuationFailure, Curve};
use super::curve_point::CurvePoint;
use super::local_scaling::CurvePosition;
use super::special::{SpecialKind, SpecialPoint};
use crate::algebra::{Values, Vector, dot, largest};
use crate::error::NotFound;

const MAX_ITERATIONS: usize = 30;
/// After a Newton step this small, in local units, only rounding remains.
pub(super) const LAST_STEP: f64 = 1e-14;
/// Below this size, a step that no longer shrinks has reached rounding.
pub(super) const ROUNDING: f64 = 1e-8;

impl Curve<'_> {
    /// The limit point between two stations, and the direction of the branch there.
    pub(crate) fn fold(
        &self,
        a: &CurvePoint,
        b: &CurvePoint,
    ) -> Result<(SpecialPoint, CurvePosition), ContinuationFailure> {
        let frame = &a.frame;
        let end = frame.local(&b.place);
        let end_tangent = frame.direction(&b.direction());
        let singular = || ContinuationFailure::Missed(NotFound::UnusualLimitPoint);
        // The input component of the tangent falls to zero on the way.
        let (p_a, p_b) = (a.tangent.p, end_tangent.unit().map_or(0.0, |t| t.p));
        let fraction = p_a / (p_a - p_b);
        let mut local = end.scaled(if (0.0..=1.0).contains(&fraction) { fraction } else { 0.5 });
        let mut v = a.tangent.plus(1.0, &end_tangent).q;
        let mut w = frame.scaled(&self.system(&a.place)?).by_input;
        let zeros = Vector::zeros(self.size());
        let mut last = f64::INFINITY;
        for _ in 0..MAX_ITERATIONS {
            let position = frame.place(&local);
            let scaled = frame.scaled(&self.system(&position)?);
            let (d, c) = (unit(&v).ok_or_else(singular)?, unit(&w).ok_or_else(singular)?);
            let bordered = Bordered::new(&scaled.stiffness, [&c], [&d], [[0.0]]).ok_or_else(singular)?;
            let (right, [h]) = bordered.solve(&zeros, [1.0]);
            let (left, _) = bordered.solve_transposed(&zeros, [1.0]);
            (v, w) = (right, left);
            let along = frame.stretched(&CurvePosition { q: v.clone(), p: 0.0 });
            let weights = frame.weights(&w);
            if last <= LAST_STEP {
                let special = self.special(SpecialKind::Fold, &position, (&along.q, &weights), 1, None)?;
                let direction = along.scaled(dot(&v, &end.q).signum());
                return Ok((special, direction));
            }
            let slope = frame.stretched(&self.curvature(&position, &weights, &along)?);
            let slope = slope.scaled(-1.0);
            let (q, [p]) = Bordered::new(&scaled.stiffness, [&scaled.by_input], [&slope.q], [[slope.p]])
                .map(|lu| lu.solve(&scaled.residual.map(|value| -value), [-h]))
                .ok_or_else(singular)?;
            let step = CurvePosition { q, p };
            let size = step.norm();
            if !step.finite() {
                return Err(singular());
            }
            if last <= ROUNDING && size >= 0.5 * last {
                last = 0.0;
                continue;
            }
            local = local.plus(1.0, &step);
            last = size;
            if !beside(&local, &end) {
                return Err(ContinuationFailure::Missed(NotFound::LimitPointOutside));
            }
        }
        Err(ContinuationFailure::Missed(NotFound::LimitPointLost))
    }
}

fn unit(x: &[f64]) -> Option<Vector> {
    let most = largest(x);
    let scaled = x.map(|value| value / most);
    let length = dot(&scaled, &scaled).sqrt();
    (most > 0.0 && most.is_finite()).then(|| scaled.map(|value| value / length))
}

/// Whether a local point lies between the origin and `end`, and not far from the line.
pub(super) fn beside(local: &CurvePosition, end: &CurvePosition) -> bool {
    let length = end.norm();
    let along = local.dot(end) / length;
    let across = local.plus(-along / length, end).norm();
    let slack = 1e-6 * length;
    along >= -slack && along <= length + slack && across <= 0.5 * length
}
