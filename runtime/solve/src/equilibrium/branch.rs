//! Whether equilibria of neighbouring designs lie on one branch.
//!
//! # Another branch is a test of Newton's method, not of a distance
//!
//! A stable design belongs to the nominal branch if the straight way back to the nominal design keeps the stiffness
//! regular and the state where Newton's method expects it (`equilibrium/branch.rs`), by halving where it does not at
//! once. Samples, the summary and the judge count by this one test.

use super::{OperatingPoint, Policy, SMALL_MOTION, solve};
use crate::algebra::{Lu, Matrix, Vector};
use crate::kernels::Kernels;
use crate::{Equilibrium, Stability};

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
/// stiffnesses vanish at once cannot be told apart. At a branch point the nominal equilibrium has no basin, so the test at
/// the other one decides.
#[doc(hidden)]
pub struct Branch<'a> {
    mechanism: &'a dyn Kernels,
    nominal: &'a Equilibrium,
}

/// A design and an equilibrium of it.
#[derive(Clone, Copy)]
struct DesignEquilibrium<'a> {
    design: &'a [f64],
    q: &'a [f64],
    /// Whether its stiffness is regular.
    regular: bool,
}

impl<'a> Branch<'a> {
    #[doc(hidden)]
    pub fn of(mechanism: &'a dyn Kernels, nominal: &'a Equilibrium) -> Self {
        Self { mechanism, nominal }
    }

    /// Whether the equilibrium `q` of a design, as stable as the nominal one, lies on it.
    #[doc(hidden)]
    pub fn holds(&self, design: &[f64], q: &[f64]) -> bool {
        let free = self.nominal.free.count();
        let nominal = DesignEquilibrium {
            design: &self.nominal.design,
            q: &self.nominal.coordinates,
            regular: !matches!(self.nominal.stability, Stability::Neutral { zero } if zero > free),
        };
        let regular = true;
        self.connected(nominal, DesignEquilibrium { design, q, regular }, HALVINGS)
    }

    fn connected(&self, a: DesignEquilibrium<'_>, b: DesignEquilibrium<'_>, halvings: usize) -> bool {
        if self.leads(a, b.q) && self.leads(b, a.q) {
            return true;
        }
        if halvings == 0 {
            return false;
        }
        let design: Vector = a.design.iter().zip(b.design).map(|(a, b)| 0.5 * (a + b)).collect();
        let point = OperatingPoint::unchecked(self.mechanism, &self.nominal.inputs, &design);
        let point = point.held_like(&self.nominal.free);
        solve(&point, a.q, Policy::about(self.nominal)).is_ok_and(|middle| {
            let middle = DesignEquilibrium { design: &design, q: &middle.state.coordinates, regular: true };
            self.connected(a, middle, halvings - 1) && self.connected(middle, b, halvings - 1)
        })
    }

    /// Whether a Newton step from `start` leads to the equilibrium of a design, over regular stiffness of one sign; or the
    /// equilibrium has no basin.
    fn leads(&self, DesignEquilibrium { design, q, regular }: DesignEquilibrium<'_>, start: &[f64]) -> bool {
        if !regular {
            return true;
        }
        let inputs = &self.nominal.inputs;
        let at = |q: &[f64]| self.mechanism.residual_and_stiffness(q, inputs, design);
        let negative = |factors: &Lu| factors.negative_determinant();
        let factors = |stiffness: &Matrix| Lu::new(&self.nominal.free.held(stiffness));
        let here = factors(&at(q).1);
        let (mut residual, stiffness) = at(start);
        let free = &self.nominal.free;
        let point = OperatingPoint::unchecked(self.mechanism, inputs, design).held_like(free);
        free.lead(&mut residual, start, &point.held);
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
