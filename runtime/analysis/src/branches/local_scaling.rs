//! Points `(q, u_k)` of a branch, and the units in which steps along it are measured.

use crate::algebra::{Matrix, Vector, add_scaled, all_finite, dot, greater};

/// A point `(q, u_k)`, a displacement or a direction.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct CurvePosition {
    pub(crate) q: Vector,
    pub(crate) p: f64,
}

impl CurvePosition {
    pub(crate) fn zero(n: usize) -> Self {
        Self { q: Vector::zeros(n), p: 0.0 }
    }

    /// `self + factor * other`.
    pub(crate) fn plus(&self, factor: f64, other: &Self) -> Self {
        Self { q: add_scaled(&self.q, factor, &other.q), p: self.p + factor * other.p }
    }

    pub(crate) fn scaled(&self, factor: f64) -> Self {
        Self { q: self.q.map(|value| value * factor), p: self.p * factor }
    }

    pub(crate) fn dot(&self, other: &Self) -> f64 {
        dot(&self.q, &other.q) + self.p * other.p
    }

    pub(crate) fn norm(&self) -> f64 {
        self.dot(self).sqrt()
    }

    /// The unit vector in this direction; `None` for a zero vector.
    pub(crate) fn unit(&self) -> Option<Self> {
        let norm = self.norm();
        let unit = self.scaled(1.0 / norm);
        (norm > 0.0 && unit.finite()).then_some(unit)
    }

    pub(crate) fn finite(&self) -> bool {
        all_finite(&self.q) && self.p.is_finite()
    }

    fn per(&self, units: &Self) -> Self {
        Self { q: Vector::from_fn(self.q.len(), |i| self.q[i] / units.q[i]), p: self.p / units.p }
    }

    fn by(&self, units: &Self) -> Self {
        Self { q: Vector::from_fn(self.q.len(), |i| self.q[i] * units.q[i]), p: self.p * units.p }
    }
}

/// Residual, `Khat` and `dg/du_k` at a point.
#[derive(Clone, Debug)]
pub(crate) struct System {
    pub(crate) residual: Vector,
    pub(crate) stiffness: Matrix,
    pub(crate) by_input: Vector,
}

/// Local coordinates about an origin, in which all unknowns and equations are of order one.
#[derive(Clone, Debug)]
pub(crate) struct Frame {
    pub(crate) origin: CurvePosition,
    units: CurvePosition,
    rows: Vector,
}

impl Frame {
    /// The first `motions` unknowns are coordinates and speeds; the rest are reactions.
    pub(crate) fn new(origin: CurvePosition, large: &[f64], range: f64, system: &System, motions: usize) -> Self {
        let units = units(&origin, large, range, system, motions);
        let rows = Vector::from_fn(units.q.len(), |i| {
            let row = system.stiffness[i].iter().zip(&units.q);
            let most = row.fold(0.0, |most, (k, q)| greater(most, (k * q).abs()));
            let most = most.max((system.by_input[i] * range).abs());
            if most > 0.0 { most } else { 1.0 }
        });
        Self { origin, units, rows }
    }

    /// Length of a direction in SI units.
    pub(crate) fn length(&self, direction: &CurvePosition) -> f64 {
        direction.per(&self.units).norm()
    }

    pub(crate) fn at(&self, origin: CurvePosition) -> Self {
        Self { origin, ..self.clone() }
    }

    pub(crate) fn place(&self, local: &CurvePosition) -> CurvePosition {
        self.origin.plus(1.0, &local.by(&self.units))
    }

    pub(crate) fn local(&self, curve_position: &CurvePosition) -> CurvePosition {
        self.direction(&curve_position.plus(-1.0, &self.origin))
    }

    /// Converts a direction to local coordinates.
    pub(crate) fn direction(&self, direction: &CurvePosition) -> CurvePosition {
        direction.per(&self.units)
    }

    /// Converts a local direction to SI units, or an SI gradient to local coordinates.
    pub(crate) fn stretched(&self, local: &CurvePosition) -> CurvePosition {
        local.by(&self.units)
    }

    /// Converts weights of the scaled equations to weights of the original ones.
    pub(crate) fn weights(&self, scaled: &[f64]) -> Vector {
        Vector::from_fn(scaled.len(), |i| scaled[i] / self.rows[i])
    }

    pub(crate) fn scaled(&self, system: &System) -> System {
        let n = self.rows.len();
        System {
            residual: self.weights(&system.residual),
            stiffness: Matrix::from_fn(n, n, |i, j| system.stiffness[i][j] * self.units.q[j] / self.rows[i]),
            by_input: Vector::from_fn(n, |i| system.by_input[i] * self.units.p / self.rows[i]),
        }
    }
}

/// Units of the unknowns and the input. A reaction is measured by the work it does on a unit of the coordinates it
/// holds, relative to the work of the other forces on all units: it weighs as much as the forces it balances.
fn units(curve_position: &CurvePosition, large: &[f64], range: f64, system: &System, motions: usize) -> CurvePosition {
    let mut units = CurvePosition {
        q: Vector::from_fn(curve_position.q.len(), |i| large[i] + curve_position.q[i].abs()),
        p: range,
    };
    let n = units.q.len();
    if motions >= n {
        return units;
    }
    let mut work = 0.0;
    for i in 0..motions {
        let row = &system.stiffness[i][..motions];
        let force = row.iter().zip(&units.q).map(|(k, q)| (k * q).abs());
        work += (force.sum::<f64>() + (system.by_input[i] * range).abs()) * units.q[i];
    }
    for j in motions..n {
        let force = work / (0..motions).map(|i| (system.stiffness[i][j] * units.q[i]).abs()).fold(0.0, f64::max);
        if force.is_finite() {
            units.q[j] = units.q[j].max(force);
        }
    }
    units
}
