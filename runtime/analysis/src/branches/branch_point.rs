//! Branch points, where two branches cross.
//!
//! Near a branch point the equations reduce to one scalar equation in two variables (Lyapunov and Schmidt): with
//! `g(x) + mu c = 0`, `n1 . x = xi`, `n2 . x = eta`, `x = (q, u_k)`, the branches are the curves `mu(xi, eta) = 0`, and
//! they cross where `mu` has a saddle of height zero. Newton's method on the gradient of `mu` is regular there, and the
//! second derivatives give the directions of both branches (algebraic branching equation).

use super::bordered::Bordered;
use super::curve::{ContinuationFailure, Curve, plane};
use super::curve_point::{CurvePoint, symmetric_to_rounding};
use super::fold::{LAST_STEP, ROUNDING, beside};
use super::local_scaling::{CurvePosition, Frame};
use super::special::{Junction, SpecialKind};
use crate::algebra::{Vector, dot, form};
use crate::equilibrium::ACCEPTED;
use crate::error::NotFound;
use crate::modes::{Behaviour, Family, solve_modes};

const MAX_ITERATIONS: usize = 30;
/// With an input component below this, a tangent counts as parallel to the critical vector.
const STATIONARY: f64 = 1e-6;
/// Height of the saddle, relative to its second order, that counts as zero: the branches then pass within 3e-7 of each
/// other.
const CROSSING: f64 = 1e-13;
/// Maximum number of bisections towards the sign change when looking for the critical vectors.
const NEARER: usize = 12;
/// Distance along the critical vector, in local units, at which the arms of a pitchfork are probed.
const PROBE: f64 = 4e-3;
/// Newton steps to a point on an arm.
const ON_THE_ARM: usize = 8;

/// `mu` and its derivatives at a point.
struct Reduced {
    /// Newton step to `g + mu c = 0`; `mu` is the value after it.
    correction: CurvePosition,
    mu: f64,
    /// `dx/dxi`, `dx/deta`.
    tangents: [CurvePosition; 2],
    w: Vector,
    gradient: [f64; 2],
    hessian: [[f64; 2]; 2],
}

/// The rows (directions) and the column that border the equations.
struct Borders {
    normals: [CurvePosition; 2],
    column: Vector,
}

impl Curve<'_> {
    /// Finds the branch point between two stations.
    pub(crate) fn branch_point(&self, a: &CurvePoint, b: &CurvePoint) -> Result<Junction, ContinuationFailure> {
        let frame = &a.frame;
        let end = frame.local(&b.place);
        let (mut local, borders) = self.saddle(a, &end)?;
        // Two more inner steps reduce the residual to rounding.
        for _ in 0..2 {
            let reduced = self.reduced(frame, &local, 0.0, &borders)?;
            local = local.plus(1.0, &reduced.correction);
        }
        let position = frame.place(&local);
        let reduced = self.reduced(frame, &local, 0.0, &borders)?;
        let [first, second] = directions(&reduced)?;
        let incoming_is_first = first.dot(&end).abs() >= second.dot(&end).abs();
        let (incoming, other) = if incoming_is_first { (first, second) } else { (second, first) };
        let incoming = incoming.scaled(if incoming.dot(&end) < 0.0 { -1.0 } else { 1.0 });
        let stationary = |direction: &CurvePosition| direction.p.abs() <= STATIONARY;
        let v = critical(&reduced.tangents).ok_or_else(not_simple)?;
        let pitchfork = |crossed| -> Result<SpecialKind, ContinuationFailure> {
            let known = (&borders, &reduced);
            Ok(SpecialKind::Pitchfork { supercritical: self.supercritical(frame, &local, known, [crossed, &v])? })
        };
        let kind = match (stationary(&incoming), stationary(&other)) {
            (true, true) => return Err(not_simple()),
            (false, false) => SpecialKind::Transcritical,
            (false, true) => pitchfork(&incoming)?,
            (true, false) => pitchfork(&other)?,
        };
        let critical = frame.stretched(&v);
        // The branches pass each other at a distance of sqrt(mu / H).
        let size = reduced.hessian.iter().flatten().fold(0.0, |most: f64, h| most.max(h.abs()));
        let gap = reduced.mu.abs() / size;
        let also = ACCEPTED * gap / CROSSING;
        let weights = frame.weights(&reduced.w);
        let special = self.special(kind, &position, (&critical.q, &weights), 1, Some(also))?;
        Ok(Junction { special, frame: frame.at(position), incoming, other })
    }

    /// Finds the saddle of `mu` between the origin of the frame and `end`, both on the branch.
    fn saddle(&self, a: &CurvePoint, end: &CurvePosition) -> Result<(CurvePosition, Borders), ContinuationFailure> {
        let frame = &a.frame;
        let mut borders = self.borders(a, end)?;
        let mut local = end.scaled(0.5);
        let (mut mu, mut last) = (0.0, f64::INFINITY);
        for _ in 0..MAX_ITERATIONS {
            let reduced = self.reduced(frame, &local, mu, &borders)?;
            if last <= LAST_STEP {
                return Ok((local, borders));
            }
            let [[a, b], [c, d]] = reduced.hessian;
            let det = a * d - b * c;
            let size = a.abs().max(b.abs()).max(d.abs());
            if det.is_nan() || det.abs() <= 1e-12 * size * size {
                return Err(not_simple());
            }
            let [x, y] = reduced.gradient.map(|value| -value);
            let amounts = [(d * x - b * y) / det, (a * y - c * x) / det];
            let step = reduced.correction.plus(amounts[0], &reduced.tangents[0]).plus(amounts[1], &reduced.tangents[1]);
            let size = step.norm();
            if !step.finite() {
                return Err(not_simple());
            }
            if last <= ROUNDING && size >= 0.5 * last {
                return Ok((local, borders));
            }
            local = local.plus(1.0, &step);
            (mu, last) = (reduced.mu, size);
            if !beside(&local, end) {
                return Err(ContinuationFailure::Missed(NotFound::BranchPointOutside));
            }
            if let Some(column) = unit(&reduced.w) {
                mu *= dot(&column, &borders.column);
                borders.column = column;
            }
        }
        Err(ContinuationFailure::Missed(NotFound::BranchPointLost))
    }

    /// Singular vectors of `[Khat dg/du; n1^T]`, which is nearly singular, by inverse iteration.
    fn borders(&self, a: &CurvePoint, end: &CurvePosition) -> Result<Borders, ContinuationFailure> {
        let first = end.unit().ok_or_else(not_simple)?;
        let factors = self.nearly_singular(&a.frame, end, &first)?;
        let mut left = (Vector::filled(end.q.len(), 1.0), [0.5]);
        for (i, value) in left.0.iter_mut().enumerate() {
            *value += 0.1 * i as f64;
        }
        let mut right = CurvePosition::zero(end.q.len());
        for _ in 0..6 {
            let (q, [p]) = factors.solve(&left.0, left.1);
            right = CurvePosition { q, p }.unit().ok_or_else(not_simple)?;
            let (q, [p]) = factors.solve_transposed(&right.q, [right.p]);
            let image = CurvePosition { q, p }.unit().ok_or_else(not_simple)?;
            left = (image.q, [image.p]);
        }
        let second = right.plus(-right.dot(&first), &first).unit().ok_or_else(not_simple)?;
        Ok(Borders { normals: [first, second], column: unit(&left.0).ok_or_else(not_simple)? })
    }

    /// `[Khat dg/du; n1^T]` near its sign change between the origin of the frame and `end`. Farther away, another
    /// direction may be softer than the one that becomes singular.
    fn nearly_singular(
        &self,
        frame: &Frame,
        end: &CurvePosition,
        first: &CurvePosition,
    ) -> Result<Bordered, ContinuationFailure> {
        let at = |fraction: f64| {
            let system = self.system(&frame.place(&end.scaled(fraction)))?;
            plane(&frame.scaled(&system), first).ok_or_else(not_simple)
        };
        let mut best = at(0.0)?;
        let sign = best.negative_determinant();
        if at(1.0).is_ok_and(|far| far.negative_determinant() != sign) {
            let mut step = 0.5;
            let mut fraction = 0.0;
            for _ in 0..NEARER {
                if let Ok(next) = at(fraction + step)
                    && next.negative_determinant() == sign
                {
                    fraction += step;
                    best = next;
                }
                step *= 0.5;
            }
        }
        Ok(best)
    }

    fn reduced(
        &self,
        frame: &Frame,
        local: &CurvePosition,
        mu: f64,
        borders: &Borders,
    ) -> Result<Reduced, ContinuationFailure> {
        let position = frame.place(local);
        let scaled = frame.scaled(&self.system(&position)?);
        let [first, second] = &borders.normals;
        let factors = Bordered::new(
            &scaled.stiffness,
            [&scaled.by_input, &borders.column],
            [&first.q, &second.q],
            [[first.p, 0.0], [second.p, 0.0]],
        )
        .ok_or_else(not_simple)?;
        let n = local.q.len();
        let off = Vector::from_fn(n, |i| -(scaled.residual[i] + mu * borders.column[i]));
        let (q, [p, change]) = factors.solve(&off, [0.0; 2]);
        let correction = CurvePosition { q, p };
        let tangents = [[1.0, 0.0], [0.0, 1.0]].map(|right| {
            let (q, [p, _]) = factors.solve(&Vector::zeros(n), right);
            CurvePosition { q, p }
        });
        let (w, slopes) = factors.solve_transposed(&Vector::zeros(n), [0.0, 1.0]);
        let weights = frame.weights(&w);
        let bend = |tangent: &CurvePosition| -> Result<CurvePosition, ContinuationFailure> {
            let curvature = self.curvature(&position, &weights, &frame.stretched(tangent))?;
            Ok(frame.stretched(&curvature))
        };
        let bent = [bend(&tangents[0])?, bend(&tangents[1])?];
        // w^T [Khat dg/du] + a1 n1 + a2 n2 = 0, so the slopes of mu are a1 and a2.
        Ok(Reduced {
            mu: mu + change,
            w,
            gradient: core::array::from_fn(|i| slopes[i] - bent[i].dot(&correction)),
            hessian: bent.each_ref().map(|bent| tangents.each_ref().map(|tangent| -bent.dot(tangent))),
            correction,
            tangents,
        })
    }

    /// Whether the arms along `v` lie where the branch along `crossed` has lost its stiffness. `None` if they leave in
    /// the direction of neither, up to the second order of the input along them.
    fn supercritical(
        &self,
        frame: &Frame,
        at: &CurvePosition,
        (borders, reduced): (&Borders, &Reduced),
        [crossed, v]: [&CurvePosition; 2],
    ) -> Result<Option<bool>, ContinuationFailure> {
        let parts = |direction| borders.normals.each_ref().map(|normal| normal.dot(direction));
        let (along, across) = (parts(crossed), parts(v));
        let linear = self.linear(&frame.place(at))?;
        // Whether stiffness falls where the input rises, as a sign.
        let loses = if symmetric_to_rounding(&linear, &self.description) {
            // With `mu = -w^T g`: the slope of `w^T Khat v` along the branch.
            let slope = -product(&reduced.hessian, along, across);
            let direction = frame.stretched(v).q;
            -slope * form(&frame.weights(&reduced.w), &linear.mass, &direction).signum() * crossed.p.signum()
        } else {
            let up = PROBE * crossed.p.signum();
            let growing = |share| self.growing(&frame.place(&at.plus(share, crossed)));
            match (growing(up), growing(-up)) {
                (Some(above), Some(below)) => above as f64 - below as f64,
                _ => return Ok(None),
            }
        };
        // Where the arm has the component `distance` along `v`, relative to the branch point.
        let input = |distance: f64| -> Option<f64> {
            let mut local = at.plus(distance, v);
            for _ in 0..ON_THE_ARM {
                let reduced = self.reduced(frame, &local, 0.0, borders).ok()?;
                let [x, y] = &reduced.tangents;
                let rate = reduced.gradient[0] * along[0] + reduced.gradient[1] * along[1];
                let amount = -reduced.mu / rate;
                local = local.plus(1.0, &reduced.correction).plus(amount * along[0], x).plus(amount * along[1], y);
            }
            local.finite().then_some(local.p - at.p)
        };
        let second = |distance: f64| Some((input(distance)? + input(-distance)?) / distance.powi(2));
        // The fourth order cancels.
        let (Some(far), Some(near)) = (second(PROBE), second(0.5 * PROBE)) else {
            return Ok(None);
        };
        let second = (4.0 * near - far) / 3.0;
        let known = second.abs() > STATIONARY && loses != 0.0;
        Ok(known.then_some(loses * second > 0.0))
    }

    /// Number of real growing modes at a place next to a branch point.
    fn growing(&self, curve_position: &CurvePosition) -> Option<usize> {
        let linear = self.linear(curve_position).ok()?;
        let modes = solve_modes(&linear, Family::General, &self.description, 0.0).ok()?;
        let behaviours = modes.modes.iter().map(|mode| mode.behaviour);
        Some(behaviours.filter(|behaviour| matches!(behaviour, Behaviour::Divergent(_))).count())
    }
}

/// `a^T H b`.
fn product(hessian: &[[f64; 2]; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    let rows = hessian.map(|row| row[0] * b[0] + row[1] * b[1]);
    a[0] * rows[0] + a[1] * rows[1]
}

fn not_simple() -> ContinuationFailure {
    ContinuationFailure::Missed(NotFound::BranchPointNotSimple)
}

/// Unit directions of the two branches: the roots of the quadratic form of the second derivatives.
fn directions(reduced: &Reduced) -> Result<[CurvePosition; 2], ContinuationFailure> {
    let [[a, b], [_, c]] = reduced.hessian;
    let discriminant = b * b - a * c;
    let size = a.abs().max(b.abs()).max(c.abs());
    if discriminant.is_nan() || discriminant <= 1e-12 * size * size {
        return Err(not_simple());
    }
    let q = -(b + discriminant.sqrt().copysign(b));
    let [x, y] = &reduced.tangents;
    let combine = |s: f64, t: f64| x.scaled(s).plus(t, y).unit().ok_or_else(not_simple);
    Ok([combine(q, a)?, combine(c, q)?])
}

/// The combination of the tangents along which the input is stationary.
fn critical([x, y]: &[CurvePosition; 2]) -> Option<CurvePosition> {
    let v = x.scaled(y.p).plus(-x.p, y);
    CurvePosition { q: v.q, p: 0.0 }.unit()
}

fn unit(x: &[f64]) -> Option<Vector> {
    CurvePosition { q: x.into(), p: 0.0 }.unit().map(|normalised| normalised.q)
}
