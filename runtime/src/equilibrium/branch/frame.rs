//! Points `(q, u_k)` of a branch, and the units in which steps along it are measured.

use crate::array::{Square, all_finite, dot, largest};

/// A point `(q, u_k)`, a displacement or a direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Place<const N: usize> {
    pub(crate) q: [f64; N],
    pub(crate) p: f64,
}

impl<const N: usize> Place<N> {
    pub(crate) const ZERO: Self = Self {
        q: [0.0; N],
        p: 0.0,
    };

    /// `self + factor * other`.
    pub(crate) fn plus(&self, factor: f64, other: &Self) -> Self {
        Self {
            q: core::array::from_fn(|i| self.q[i] + factor * other.q[i]),
            p: self.p + factor * other.p,
        }
    }

    pub(crate) fn scaled(&self, factor: f64) -> Self {
        Self {
            q: self.q.map(|value| value * factor),
            p: self.p * factor,
        }
    }

    pub(crate) fn dot(&self, other: &Self) -> f64 {
        dot(&self.q, &other.q) + self.p * other.p
    }

    pub(crate) fn norm(&self) -> f64 {
        self.dot(self).sqrt()
    }

    /// The unit vector of this direction; `None` when it has none.
    pub(crate) fn unit(&self) -> Option<Self> {
        let norm = self.norm();
        let unit = self.scaled(1.0 / norm);
        (norm > 0.0 && unit.finite()).then_some(unit)
    }

    pub(crate) fn finite(&self) -> bool {
        all_finite(&self.q) && self.p.is_finite()
    }

    fn per(&self, units: &Self) -> Self {
        Self {
            q: core::array::from_fn(|i| self.q[i] / units.q[i]),
            p: self.p / units.p,
        }
    }

    fn by(&self, units: &Self) -> Self {
        Self {
            q: core::array::from_fn(|i| self.q[i] * units.q[i]),
            p: self.p * units.p,
        }
    }
}

/// Residual, `Khat` and `dg/du_k` at one place.
#[derive(Clone, Copy, Debug)]
pub(crate) struct System<const N: usize> {
    pub(crate) residual: [f64; N],
    pub(crate) stiffness: Square<N>,
    pub(crate) by_input: [f64; N],
}

/// Local coordinates about an origin: every unknown and every equation of order one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frame<const N: usize> {
    pub(crate) origin: Place<N>,
    units: Place<N>,
    rows: [f64; N],
}

impl<const N: usize> Frame<N> {
    /// The first `motions` unknowns are coordinates and speeds, the others reactions.
    pub(crate) fn new(
        origin: Place<N>,
        size: f64,
        range: f64,
        system: &System<N>,
        motions: usize,
    ) -> Self {
        let units = units(&origin, size, range, system, motions);
        let rows = core::array::from_fn(|i| {
            let row: [f64; N] = core::array::from_fn(|j| system.stiffness[i][j] * units.q[j]);
            let most = largest(&row).max((system.by_input[i] * range).abs());
            if most > 0.0 { most } else { 1.0 }
        });
        Self {
            origin,
            units,
            rows,
        }
    }

    /// Length of a direction in SI units.
    pub(crate) fn length(&self, direction: &Place<N>) -> f64 {
        direction.per(&self.units).norm()
    }

    pub(crate) fn at(&self, origin: Place<N>) -> Self {
        Self { origin, ..*self }
    }

    pub(crate) fn place(&self, local: &Place<N>) -> Place<N> {
        self.origin.plus(1.0, &local.by(&self.units))
    }

    pub(crate) fn local(&self, place: &Place<N>) -> Place<N> {
        self.direction(&place.plus(-1.0, &self.origin))
    }

    /// A direction in local coordinates.
    pub(crate) fn direction(&self, direction: &Place<N>) -> Place<N> {
        direction.per(&self.units)
    }

    /// A local direction in SI units; a gradient in SI units by local coordinates.
    pub(crate) fn stretched(&self, local: &Place<N>) -> Place<N> {
        local.by(&self.units)
    }

    /// Weights of the scaled equations as weights of the equations.
    pub(crate) fn weights(&self, scaled: &[f64; N]) -> [f64; N] {
        core::array::from_fn(|i| scaled[i] / self.rows[i])
    }

    pub(crate) fn scaled(&self, system: &System<N>) -> System<N> {
        System {
            residual: self.weights(&system.residual),
            stiffness: core::array::from_fn(|i| {
                core::array::from_fn(|j| system.stiffness[i][j] * self.units.q[j] / self.rows[i])
            }),
            by_input: core::array::from_fn(|i| system.by_input[i] * self.units.p / self.rows[i]),
        }
    }
}

/// Units of unknowns and input. A reaction is measured by the work that it does on a unit of the coordinates it holds, with
/// the work of the other forces on units of all as the unit: it weighs as much as what it balances.
fn units<const N: usize>(
    place: &Place<N>,
    size: f64,
    range: f64,
    system: &System<N>,
    motions: usize,
) -> Place<N> {
    let mut units = Place {
        q: place.q.map(|value| size + value.abs()),
        p: range,
    };
    if motions >= N {
        return units;
    }
    let mut work = 0.0;
    for i in 0..motions {
        let row = &system.stiffness[i][..motions];
        let force = row.iter().zip(&units.q).map(|(k, q)| (k * q).abs());
        work += (force.sum::<f64>() + (system.by_input[i] * range).abs()) * units.q[i];
    }
    for j in motions..N {
        let held = (0..motions).map(|i| (system.stiffness[i][j] * units.q[i]).abs());
        let force = work / held.fold(0.0, f64::max);
        if force.is_finite() {
            units.q[j] = units.q[j].max(force);
        }
    }
    units
}
