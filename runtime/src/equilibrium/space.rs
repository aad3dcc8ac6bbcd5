//! Where solvers look: among all values of all unknowns, or among the positions that meet the constraints.
//!
//! Positions that meet `Phi(q) = 0` near a base `q_0` are written over its tangent directions `P`: `q(y) = q_0 + P y + n(y)`,
//! `n` in the span of the normals at the base, which is orthogonal to `P` in the metric of masses. For a potential `V`
//! with gradient `g` and multipliers `mu` that balance it along those normals, `n_k . (g + H^T mu) = 0`,
//!
//! - the derivative of `V` by `y` is `P^T (g + H^T mu)`;
//! - the second one along `y` is `t^T K_c(mu) t`, `t = P y + dn` tangent at `q(y)`, `K_c = d(g + H^T mu)/dq`.
//!
//! (Differentiate `Phi(q(y)) = 0` twice; `n''` is a combination of normals, on which `g` is `-mu . H n'' = mu . Phi_qq t t`.)
//! The first holds without a potential too. Nothing else of the solvers differs from those of an open mechanism.

use super::convergence::{TOLERANCE, relative_gap};
use super::problem::{Failure, Problem};
use super::weights::weights;
use crate::Mechanism;
use crate::array::{Lu, Square, add_scaled, all_finite_square, dot, times, transpose};
use crate::constraints::Tangent;

/// A state with what a step from it needs.
pub(super) struct Base<const N: usize, S> {
    pub(super) q: [f64; N],
    pub(super) residual: [f64; N],
    pub(super) stiffness: Square<N>,
    pub(super) space: S,
}

/// A state at the end of a step.
pub(super) struct Trial<const N: usize> {
    pub(super) q: [f64; N],
    /// Its product with the step is the slope of the potential along the step.
    pub(super) residual: [f64; N],
    pub(super) stiffness: Square<N>,
    /// Direction of the way at its end: its form with the stiffness is the curvature of the potential along the way.
    pub(super) direction: [f64; N],
}

/// The positions in the neighbourhood of a base.
pub(super) trait Space<const N: usize>: Sized {
    /// The base at a state that meets the constraints.
    fn base<M, const U: usize, const P: usize, const O: usize>(
        problem: &Problem<'_, M, N, U, P, O>,
        q: &[f64; N],
    ) -> Result<Base<N, Self>, Failure<N>>
    where
        M: Mechanism<N, U, P, O>;

    /// The base at the end of a step.
    fn arrive<M, const U: usize, const P: usize, const O: usize>(
        problem: &Problem<'_, M, N, U, P, O>,
        trial: Trial<N>,
    ) -> Result<Base<N, Self>, Failure<N>>
    where
        M: Mechanism<N, U, P, O>;

    /// Slopes of the potential by free direction.
    fn slopes(&self, residual: &[f64; N]) -> [f64; N];

    /// Stiffness over free directions; unused rows are diagonal and positive.
    fn stiffness(&self, stiffness: &Square<N>) -> Square<N>;

    /// Masses over free directions; unused rows are diagonal and positive.
    fn mass(&self, mass: &Square<N>) -> Square<N>;

    /// Weights that make the squares of the slopes comparable.
    fn weights<M, const U: usize, const P: usize, const O: usize>(
        problem: &Problem<'_, M, N, U, P, O>,
        q: &[f64; N],
    ) -> Result<[f64; N], Failure<N>>
    where
        M: Mechanism<N, U, P, O>;

    /// Displacement of all unknowns for a displacement along free directions.
    fn lift(&self, y: &[f64; N]) -> [f64; N];

    /// The state at a share `length` of `step`; `None` where there is none.
    fn trial<M, const U: usize, const P: usize, const O: usize>(
        &self,
        problem: &Problem<'_, M, N, U, P, O>,
        q: &[f64; N],
        step: &[f64; N],
        length: f64,
    ) -> Option<Trial<N>>
    where
        M: Mechanism<N, U, P, O>;
}

/// All unknowns, constraints equations like the others.
pub(super) struct Whole;

impl<const N: usize> Space<N> for Whole {
    fn base<M, const U: usize, const P: usize, const O: usize>(
        problem: &Problem<'_, M, N, U, P, O>,
        q: &[f64; N],
    ) -> Result<Base<N, Self>, Failure<N>>
    where
        M: Mechanism<N, U, P, O>,
    {
        let (residual, stiffness) = problem.evaluate_start(q)?;
        Ok(Base {
            q: *q,
            residual,
            stiffness,
            space: Self,
        })
    }

    fn arrive<M, const U: usize, const P: usize, const O: usize>(
        _: &Problem<'_, M, N, U, P, O>,
        trial: Trial<N>,
    ) -> Result<Base<N, Self>, Failure<N>>
    where
        M: Mechanism<N, U, P, O>,
    {
        Ok(Base {
            q: trial.q,
            residual: trial.residual,
            stiffness: trial.stiffness,
            space: Self,
        })
    }

    fn slopes(&self, residual: &[f64; N]) -> [f64; N] {
        *residual
    }

    fn stiffness(&self, stiffness: &Square<N>) -> Square<N> {
        *stiffness
    }

    fn mass(&self, mass: &Square<N>) -> Square<N> {
        *mass
    }

    fn weights<M, const U: usize, const P: usize, const O: usize>(
        problem: &Problem<'_, M, N, U, P, O>,
        q: &[f64; N],
    ) -> Result<[f64; N], Failure<N>>
    where
        M: Mechanism<N, U, P, O>,
    {
        weights(problem, q)
    }

    fn lift(&self, y: &[f64; N]) -> [f64; N] {
        *y
    }

    fn trial<M, const U: usize, const P: usize, const O: usize>(
        &self,
        problem: &Problem<'_, M, N, U, P, O>,
        q: &[f64; N],
        step: &[f64; N],
        length: f64,
    ) -> Option<Trial<N>>
    where
        M: Mechanism<N, U, P, O>,
    {
        let q = add_scaled(q, length, step);
        let (residual, stiffness) = problem.evaluate(&q)?;
        Some(Trial {
            q,
            residual,
            stiffness,
            direction: *step,
        })
    }
}

/// With constraints on positions.
pub(super) struct Constrained<const N: usize> {
    tangent: Tangent<N>,
}

/// Most Newton steps back onto the constraints.
const MAX_RETURNS: usize = 12;
/// A step back must leave less than this share of the gaps, or rounding.
const CONTRACTION: f64 = 0.5;

impl<const N: usize> Constrained<N> {
    /// The place among the unknowns of independent constraint `i`.
    fn row(&self, i: usize) -> usize {
        self.tangent.structure.motions() + self.tangent.positions.order[i]
    }

    /// `a_ik = h_i . n_k` of the independent constraints at a state and the normals at the base, unit beyond.
    fn crossed(&self, stiffness: &Square<N>) -> Square<N> {
        let rank = self.tangent.normal.rank;
        core::array::from_fn(|i| {
            core::array::from_fn(|k| match (i < rank, k < rank) {
                (true, true) => dot(&stiffness[self.row(i)], &self.tangent.normal.normal(k)),
                _ if i == k => 1.0,
                _ => 0.0,
            })
        })
    }

    /// Values by independent constraint.
    fn independent(&self, values: &[f64; N]) -> [f64; N] {
        let rank = self.tangent.normal.rank;
        core::array::from_fn(|i| if i < rank { values[self.row(i)] } else { 0.0 })
    }

    /// `sum_k c_k n_k` over the normals at the base.
    fn along_normals(&self, c: &[f64; N]) -> [f64; N] {
        (0..self.tangent.normal.rank).fold([0.0; N], |sum, k| {
            add_scaled(&sum, c[k], &self.tangent.normal.normal(k))
        })
    }

    /// Displacement along the normals at the base that brings `from` back onto the constraints; not longer than `reach` in
    /// the metric. Also the residual and the stiffness there.
    fn back<M, const U: usize, const P: usize, const O: usize>(
        &self,
        problem: &Problem<'_, M, N, U, P, O>,
        from: &[f64; N],
        reach: f64,
    ) -> Option<([f64; N], [f64; N], Square<N>)>
    where
        M: Mechanism<N, U, P, O>,
    {
        let mut c = [0.0; N];
        let mut last = f64::INFINITY;
        for _ in 0..MAX_RETURNS {
            let q = add_scaled(from, 1.0, &self.along_normals(&c));
            let (residual, stiffness) = problem.evaluate(&q)?;
            let gap = greatest_gap(problem, &q, &residual, &stiffness);
            if gap >= CONTRACTION * last && gap <= TOLERANCE {
                return Some((q, residual, stiffness));
            }
            if gap.is_nan() || gap > 2.0 * last {
                return None;
            }
            last = gap;
            let lu = Lu::new(&self.crossed(&stiffness))?;
            c = add_scaled(&c, -1.0, &lu.solve(&self.independent(&residual)));
            if dot(&c, &c).sqrt() > reach {
                return None;
            }
        }
        None
    }
}

/// Greatest gap of the constraints on positions, relative to what small motions open.
pub(super) fn greatest_gap<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    _: &Problem<'_, M, N, U, P, O>,
    q: &[f64; N],
    residual: &[f64; N],
    stiffness: &Square<N>,
) -> f64
where
    M: Mechanism<N, U, P, O>,
{
    let structure = Problem::<M, N, U, P, O>::STRUCTURE;
    structure.position_rows().fold(0.0, |most: f64, row| {
        let motions = &q[..structure.coordinates];
        most.max(relative_gap(residual[row], motions, &stiffness[row]))
    })
}

impl<const N: usize> Space<N> for Constrained<N> {
    fn base<M, const U: usize, const P: usize, const O: usize>(
        problem: &Problem<'_, M, N, U, P, O>,
        q: &[f64; N],
    ) -> Result<Base<N, Self>, Failure<N>>
    where
        M: Mechanism<N, U, P, O>,
    {
        let (residual, _) = problem.evaluate_start(q)?;
        let linear = problem.linear(q)?;
        let tangent = Tangent::new(&linear, Problem::<M, N, U, P, O>::STRUCTURE);
        let mut q = *q;
        let space = Self { tangent };
        let change = tangent.normal.multipliers(&residual);
        for i in 0..tangent.normal.rank {
            q[space.row(i)] -= change[i];
        }
        let (residual, stiffness) = problem.evaluate_start(&q)?;
        Ok(Base {
            q,
            residual,
            stiffness,
            space,
        })
    }

    fn arrive<M, const U: usize, const P: usize, const O: usize>(
        problem: &Problem<'_, M, N, U, P, O>,
        trial: Trial<N>,
    ) -> Result<Base<N, Self>, Failure<N>>
    where
        M: Mechanism<N, U, P, O>,
    {
        Self::base(problem, &trial.q)
    }

    fn slopes(&self, residual: &[f64; N]) -> [f64; N] {
        self.tangent.project(residual)
    }

    fn stiffness(&self, stiffness: &Square<N>) -> Square<N> {
        self.tangent.reduce_stiffness(stiffness)
    }

    fn mass(&self, mass: &Square<N>) -> Square<N> {
        self.tangent.reduce_mass(mass)
    }

    /// The basis is orthonormal in the metric of masses.
    fn weights<M, const U: usize, const P: usize, const O: usize>(
        _: &Problem<'_, M, N, U, P, O>,
        _: &[f64; N],
    ) -> Result<[f64; N], Failure<N>>
    where
        M: Mechanism<N, U, P, O>,
    {
        Ok([1.0; N])
    }

    fn lift(&self, y: &[f64; N]) -> [f64; N] {
        self.tangent.lift(y)
    }

    fn trial<M, const U: usize, const P: usize, const O: usize>(
        &self,
        problem: &Problem<'_, M, N, U, P, O>,
        q: &[f64; N],
        step: &[f64; N],
        length: f64,
    ) -> Option<Trial<N>>
    where
        M: Mechanism<N, U, P, O>,
    {
        let scaled = self.tangent.normal.scaled(step);
        let reach = length * dot(&scaled, &scaled).sqrt();
        let from = add_scaled(q, length, step);
        let (mut q, residual, stiffness) = self.back(problem, &from, reach)?;
        let crossed = self.crossed(&stiffness);
        // Multipliers that balance the forces along the normals at the base.
        let rank = self.tangent.normal.rank;
        let forces = core::array::from_fn(|k| {
            if k < rank {
                dot(&self.tangent.normal.normal(k), &residual)
            } else {
                0.0
            }
        });
        let change = Lu::new(&transpose(&crossed))?.solve(&forces);
        for i in 0..rank {
            q[self.row(i)] -= change[i];
        }
        let (residual, stiffness) = problem.evaluate(&q)?;
        let off = self.independent(&times(&stiffness, step));
        let bend = Lu::new(&crossed)?.solve(&off);
        let direction = add_scaled(step, -1.0, &self.along_normals(&bend));
        all_finite_square(&stiffness).then_some(Trial {
            q,
            residual,
            stiffness,
            direction,
        })
    }
}
