//! Search spaces of the solvers: all values of all unknowns, or the positions that meet the constraints.
//!
//! Near a base `q_0`, positions that meet `Phi(q) = 0` are parametrised by its tangent directions `P`:
//! `q(y) = q_0 + P y + n(y)`, with `n` in the span of the normals at the base, which is orthogonal to `P` in the mass
//! metric. For a potential `V` with gradient `g`, and multipliers `mu` that balance it along those normals,
//! `n_k . (g + H^T mu) = 0`,
//!
//! - the first derivative of `V` with respect to `y` is `P^T (g + H^T mu)`;
//! - the second derivative along `y` is `t^T K_c(mu) t`, `t = P y + dn` tangent at `q(y)`, `K_c = d(g + H^T mu)/dq`.
//!
//! (Differentiate `Phi(q(y)) = 0` twice; `n''` is a combination of normals, on which `g` is
//! `-mu . H n'' = mu . Phi_qq t t`.) The first formula holds without a potential too. Otherwise the solvers do the same
//! as for an open mechanism.

use core::mem::swap;
use std::borrow::Cow;

use super::convergence::{TOLERANCE, largest_of, relative_gaps};
use super::operating_point::{Failure, OperatingPoint};
use super::scaling::weights;
use crate::algebra::{Lu, Matrix, Vector, add_scaled, add_to, all_finite_matrix, dot, times};
use crate::constraints::Tangent;

/// A state with the data needed for a step from it.
pub(super) struct Base<S> {
    pub(super) q: Vector,
    pub(super) residual: Vector,
    pub(super) stiffness: Matrix,
    pub(super) space: S,
}

/// A state at the end of a step.
pub(super) struct Trial {
    pub(super) q: Vector,
    /// Its product with the step is the slope of the potential along the step.
    pub(super) residual: Vector,
    pub(super) stiffness: Matrix,
    /// Direction of the path at its end: its quadratic form with the stiffness is the curvature of the potential along
    /// the path.
    pub(super) direction: Vector,
}

impl Trial {
    /// A trial to be overwritten.
    pub(super) fn blank(n: usize) -> Self {
        Self {
            q: Vector::zeros(n),
            residual: Vector::zeros(n),
            stiffness: Matrix::zeros(n, n),
            direction: Vector::zeros(n),
        }
    }
}

/// The positions in the neighbourhood of a base.
pub(super) trait SearchSpace: Sized {
    /// The base at a state that meets the constraints.
    fn base(point: &OperatingPoint<'_>, q: &[f64]) -> Result<Base<Self>, Failure>;

    /// Moves the base to the end of a step, whose contents are unspecified afterwards.
    fn arrive(point: &OperatingPoint<'_>, trial: &mut Trial, base: &mut Base<Self>) -> Result<(), Failure>;

    /// Slopes of the potential along the free directions.
    fn slopes<'a>(&self, residual: &'a Vector) -> Cow<'a, Vector>;

    /// A matrix of stiffnesses or masses along the free directions.
    fn reduced<'a>(&self, matrix: &'a Matrix) -> Cow<'a, Matrix>;

    /// Weights that make the squares of the slopes comparable.
    fn weights(point: &OperatingPoint<'_>, q: &[f64]) -> Result<Vector, Failure>;

    /// Displacement of all unknowns caused by a displacement along the free directions.
    fn lift(&self, y: Vector) -> Vector;

    /// Writes the state at a share of a step; false if there is none.
    fn trial(&self, point: &OperatingPoint<'_>, q: &[f64], step_and_share: (&[f64], f64), trial: &mut Trial) -> bool;
}

/// All unknowns, with constraints treated as ordinary equations.
pub(super) struct Unconstrained;

impl SearchSpace for Unconstrained {
    fn base(point: &OperatingPoint<'_>, q: &[f64]) -> Result<Base<Self>, Failure> {
        let (residual, stiffness) = point.evaluate_start(q)?;
        Ok(Base { q: q.into(), residual, stiffness, space: Self })
    }

    fn arrive(_: &OperatingPoint<'_>, trial: &mut Trial, base: &mut Base<Self>) -> Result<(), Failure> {
        swap(&mut base.q, &mut trial.q);
        swap(&mut base.residual, &mut trial.residual);
        swap(&mut base.stiffness, &mut trial.stiffness);
        Ok(())
    }

    fn slopes<'a>(&self, residual: &'a Vector) -> Cow<'a, Vector> {
        Cow::Borrowed(residual)
    }

    fn reduced<'a>(&self, matrix: &'a Matrix) -> Cow<'a, Matrix> {
        Cow::Borrowed(matrix)
    }

    fn weights(point: &OperatingPoint<'_>, q: &[f64]) -> Result<Vector, Failure> {
        weights(point, q)
    }

    fn lift(&self, y: Vector) -> Vector {
        y
    }

    fn trial(&self, point: &OperatingPoint<'_>, q: &[f64], (step, length): (&[f64], f64), trial: &mut Trial) -> bool {
        let n = q.len();
        let (coordinates, direction, step) = (&mut trial.q[..n], &mut trial.direction[..n], &step[..n]);
        for i in 0..n {
            coordinates[i] = q[i] + length * step[i];
            direction[i] = step[i];
        }
        point.evaluate_into(&trial.q, &mut trial.residual, &mut trial.stiffness)
    }
}

/// The positions that meet the constraints.
pub(super) struct ConstraintManifold {
    tangent: Tangent,
    /// `n_k`.
    normals: Vec<Vector>,
}

/// Maximum number of Newton steps back onto the constraints.
const MAX_RETURNS: usize = 12;
/// Each step back must reduce the gaps below this share, or to rounding.
const CONTRACTION: f64 = 0.5;

impl ConstraintManifold {
    /// The position of independent constraint `i` among the unknowns.
    fn row(&self, i: usize) -> usize {
        self.tangent.structure.motions() + self.tangent.positions.order[i]
    }

    /// `a_ik = h_i . n_k` of the independent constraints at a state with the normals at the base.
    fn crossed(&self, stiffness: &Matrix) -> Matrix {
        let rank = self.normals.len();
        Matrix::from_fn(rank, rank, |i, k| dot(&stiffness[self.row(i)], &self.normals[k]))
    }

    /// Selects the values of the independent constraints.
    fn independent(&self, values: &[f64]) -> Vector {
        Vector::from_fn(self.normals.len(), |i| values[self.row(i)])
    }

    /// `sum_k c_k n_k` over the normals at the base.
    fn along_normals(&self, c: &[f64]) -> Vector {
        let mut sum = Vector::zeros(self.tangent.structure.size());
        for (c, normal) in c.iter().zip(&self.normals) {
            add_to(&mut sum, *c, normal);
        }
        sum
    }

    /// Displacement along the normals at the base that brings `from` back onto the constraints, no longer than `reach`
    /// in the mass metric; also returns the residual and the stiffness there.
    fn back(&self, point: &OperatingPoint<'_>, from: &[f64], reach: f64) -> Option<(Vector, Vector, Matrix)> {
        let mut c = Vector::zeros(self.normals.len());
        let mut last = f64::INFINITY;
        for _ in 0..MAX_RETURNS {
            let q = add_scaled(from, 1.0, &self.along_normals(&c));
            let (residual, stiffness) = point.evaluate_plain(&q)?;
            let gap = greatest_gap(point, &q, &residual, &stiffness);
            if gap >= CONTRACTION * last && gap <= TOLERANCE {
                return Some((q, residual, stiffness));
            }
            if gap.is_nan() || gap > 2.0 * last {
                return None;
            }
            last = gap;
            let lu = Lu::new(&self.crossed(&stiffness))?;
            add_to(&mut c, -1.0, &lu.solve(&self.independent(&residual)));
            if dot(&c, &c).sqrt() > reach {
                return None;
            }
        }
        None
    }

    /// The state at a share `length` of `step`.
    fn along(&self, point: &OperatingPoint<'_>, q: &[f64], (step, length): (&[f64], f64)) -> Option<Trial> {
        let scaled = self.tangent.normal.scaled(step);
        let reach = length * dot(&scaled, &scaled).sqrt();
        let from = add_scaled(q, length, step);
        let (mut q, residual, stiffness) = self.back(point, &from, reach)?;
        let crossed = self.crossed(&stiffness);
        // Multipliers that balance the forces along the normals at the base.
        let forces: Vector = self.normals.iter().map(|normal| dot(normal, &residual)).collect();
        let change = Lu::new(&crossed.transpose())?.solve(&forces);
        for (i, change) in change.iter().enumerate() {
            q[self.row(i)] -= change;
        }
        let (residual, stiffness) = point.evaluate_plain(&q)?;
        let off = self.independent(&times(&stiffness, step));
        let bend = Lu::new(&crossed)?.solve(&off);
        let direction = add_scaled(step, -1.0, &self.along_normals(&bend));
        all_finite_matrix(&stiffness).then_some(Trial { q, residual, stiffness, direction })
    }
}

/// Largest gap of the constraints on positions, relative to what small motions open.
pub(super) fn greatest_gap(point: &OperatingPoint<'_>, q: &[f64], residual: &[f64], stiffness: &Matrix) -> f64 {
    largest_of(&relative_gaps(point, q, residual, stiffness))
}

impl SearchSpace for ConstraintManifold {
    fn base(point: &OperatingPoint<'_>, q: &[f64]) -> Result<Base<Self>, Failure> {
        let (residual, _) = point.evaluate_start(q)?;
        let linear = point.linear(q)?;
        let tangent = Tangent::new(&linear, point.structure);
        let normals = (0..tangent.normal.rank).map(|k| tangent.normal.normal(k));
        let space = Self { normals: normals.collect(), tangent };
        let mut q = Vector::from(q);
        let change = space.tangent.normal.multipliers(&residual);
        for (i, change) in change.iter().enumerate() {
            q[space.row(i)] -= change;
        }
        let (residual, stiffness) = point.evaluate_start(&q)?;
        Ok(Base { q, residual, stiffness, space })
    }

    fn arrive(point: &OperatingPoint<'_>, trial: &mut Trial, base: &mut Base<Self>) -> Result<(), Failure> {
        *base = Self::base(point, &trial.q)?;
        Ok(())
    }

    fn slopes<'a>(&self, residual: &'a Vector) -> Cow<'a, Vector> {
        Cow::Owned(self.tangent.project(residual))
    }

    fn reduced<'a>(&self, matrix: &'a Matrix) -> Cow<'a, Matrix> {
        Cow::Owned(self.tangent.reduce(matrix))
    }

    /// All ones: the basis is orthonormal in the mass metric.
    fn weights(_: &OperatingPoint<'_>, q: &[f64]) -> Result<Vector, Failure> {
        Ok(Vector::filled(q.len(), 1.0))
    }

    fn lift(&self, y: Vector) -> Vector {
        self.tangent.lift(&y)
    }

    fn trial(&self, point: &OperatingPoint<'_>, q: &[f64], (step, length): (&[f64], f64), trial: &mut Trial) -> bool {
        let candidate = self.along(point, q, (step, length));
        let exists = candidate.is_some();
        if let Some(candidate) = candidate {
            *trial = candidate;
        }
        exists
    }
}
