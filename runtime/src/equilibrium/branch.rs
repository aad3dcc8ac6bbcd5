//! Whether equilibria of neighbouring designs lie on one branch.

use super::{OperatingPoint, Policy, SMALL_MOTION, solve};
use crate::Equilibrium;
use crate::algebra::{Lu, Matrix, Vector};
use crate::kernels::Kernels;

/// Maximum number of bisections of the path between two designs: an equilibrium this close to a branch point counts as
/// beyond it.
const HALVINGS: usize = 12;
/// A Newton step from one equilibrium to the next may miss it by this share of their distance.
const MISSED: f64 = 0.5;
/// Displacements below this, relative to the coordinate and a small motion, are rounding.
const ROUNDING: f64 = 1e-9;

/// The branch of a nominal equilibrium.
///
/// Two equilibria of neighbouring designs lie on one branch if each is in the basin of the other: `det Khat` of
/// each design has the same sign at both, and a Newton step from either leads to the other. At a pitchfork the branch
/// that ends and the one that begins fail the first test, however close they are; two valleys with a ridge between them
/// fail the second. Where the tests fail, the path between the two designs is bisected. Branches that meet where two
/// stiffnesses vanish at once cannot be told apart.
pub(crate) struct Branch<'a> {
    mechanism: &'a dyn Kernels,
    nominal: &'a Equilibrium,
}

/// A design and an equilibrium of it.
type Place<'a> = (&'a [f64], &'a [f64]);

impl<'a> Branch<'a> {
    pub(crate) fn of(mechanism: &'a dyn Kernels, nominal: &'a Equilibrium) -> Self {
        Self { mechanism, nominal }
    }

    /// Whether the equilibrium `q` of a design, as stable as the nominal one, lies on it.
    pub(crate) fn holds(&self, design: &[f64], q: &[f64]) -> bool {
        let nominal = (&self.nominal.design[..], &self.nominal.coordinates[..]);
        self.connected(nominal, (design, q), HALVINGS)
    }

    fn connected(&self, a: Place<'_>, b: Place<'_>, halvings: usize) -> bool {
        if self.leads(a, b.1) && self.leads(b, a.1) {
            return true;
        }
        if halvings == 0 {
            return false;
        }
        let design: Vector = a.0.iter().zip(b.0).map(|(a, b)| 0.5 * (a + b)).collect();
        let point = OperatingPoint::unchecked(self.mechanism, &self.nominal.inputs, &design);
        let point = point.held_like(&self.nominal.free);
        solve(&point, a.1, Policy::about(self.nominal)).is_ok_and(|middle| {
            let middle = (&design[..], &middle.state.coordinates[..]);
            self.connected(a, middle, halvings - 1) && self.connected(middle, b, halvings - 1)
        })
    }

    /// Whether a Newton step from `start` leads to the equilibrium of a design, over regular stiffness of one sign.
    fn leads(&self, (design, q): Place<'_>, start: &[f64]) -> bool {
        let inputs = &self.nominal.inputs;
        let at = |q: &[f64]| self.mechanism.residual_and_stiffness(q, inputs, design);
        let negative = |factors: &Lu| factors.negative_determinant();
        let factors = |stiffness: &Matrix| Lu::new(&self.nominal.free.held(stiffness));
        let here = factors(&at(q).1);
        let (residual, stiffness) = at(start);
        let there = factors(&stiffness);
        if here.as_ref().map(negative) != there.as_ref().map(negative) {
            return false;
        }
        let Some(factors) = there else { return true };
        let step = factors.solve(&residual);
        let (mut missed, mut apart, mut rounding) = (0.0, 0.0, 0.0);
        // Reactions have no mass; a displacement weighs what its kinetic energy does.
        for (i, (q, start)) in q.iter().zip(start).enumerate() {
            let mass = self.nominal.linear.mass[i][i];
            missed += mass * (start - step[i] - q).powi(2);
            apart += mass * (start - q).powi(2);
            rounding += mass * (ROUNDING * (q.abs() + SMALL_MOTION)).powi(2);
        }
        missed <= MISSED * MISSED * apart + rounding
    }
}
