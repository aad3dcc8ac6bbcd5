//! The symmetric problem `P^T (K_c - lambda M) P y = 0`: gives undamped modes and the number of directions of negative
//! stiffness.
#![allow(clippy::needless_range_loop, reason = "index loops read as the formulas they are")]

use super::quadratic::tangent_trouble;
use super::{measure, projected};
use crate::Description;
use crate::algebra::{Matrix, Vector, largest, largest_element, times};
use crate::constraints::{Structure, Tangent};
use crate::eigenproblem::{EigenproblemError, Pairs, symmetric};
use crate::kernels::Linear;
use crate::modes::deflation;

/// Eigenpairs of a symmetric `Khat` and `Mhat` along the directions that the constraints of `description` leave free.
///
/// There are as many pairs as free directions; their vectors include the reactions.
///
/// # Errors
/// Fails as inaccurate for a mechanism with speeds or constraints on velocities, which has no such pairs.
pub fn free_pairs(linear: &Linear, description: &Description) -> Result<Pairs, EigenproblemError> {
    let mut pairs = Pairs::default();
    free_pairs_into(linear, (Structure::of(description), description.free_directions), &mut pairs)?;
    Ok(pairs)
}

/// Like [`free_pairs`], overwriting existing pairs.
#[inline(always)]
pub(crate) fn free_pairs_into(
    linear: &Linear,
    (structure, free): (Structure, usize),
    pairs: &mut Pairs,
) -> Result<(), EigenproblemError> {
    if structure.open() {
        return deflation::pairs(&linear.stiffness, &linear.mass, free, pairs);
    }
    if !structure.holonomic() {
        return Err(EigenproblemError::Inaccurate { mode: 0, residual: f64::INFINITY });
    }
    let tangent = Tangent::new(linear, structure);
    *pairs = reduced_pairs(linear, &tangent, free)?;
    Ok(())
}

fn reduced_pairs(linear: &Linear, tangent: &Tangent, free: usize) -> Result<Pairs, EigenproblemError> {
    let mut mass = projected(&linear.mass, tangent);
    let mut stiffness = projected(&linear.stiffness, tangent);
    symmetrise(&mut mass);
    symmetrise(&mut stiffness);
    let mut pairs = Pairs::default();
    deflation::pairs(&stiffness, &mass, free, &mut pairs).map_err(|trouble| tangent_trouble(trouble, tangent))?;
    let reduced = pairs.shapes;
    pairs.shapes = Matrix::zeros(tangent.freedom, tangent.structure.size());
    for (r, y) in reduced.iter().enumerate() {
        let mut x = tangent.lift(y);
        symmetric::fix_sign(&mut x[..tangent.structure.motions()]);
        let lambda = &mut pairs.lambda[r];
        if r < free && *lambda == 0.0 {
            let shape = with_reactions(linear, tangent, 0.0, &x);
            pairs.shapes[r].copy_from_slice(&shape);
            continue;
        }
        // The quotient does not depend on the reactions: constraint forces cancel in it.
        let complete = with_reactions(linear, tangent, *lambda, &x);
        let (numerator, rounding) = deflation::quotient(linear, *lambda, &complete);
        *lambda += numerator;
        pairs.errors[r] = pairs.errors[r].max(rounding);
        let shape = with_reactions(linear, tangent, *lambda, &x);
        pairs.residuals[r] = residual(linear, tangent, *lambda, &shape);
        pairs.shapes[r].copy_from_slice(&shape);
    }
    refine(linear, tangent, &mut pairs);
    Ok(pairs)
}

/// Improves those pairs with the complete matrices that the projection onto the free directions left inaccurate: stiff
/// members leave their rounding in the projected matrices.
fn refine(linear: &Linear, tangent: &Tangent, pairs: &mut Pairs) {
    let accurate = |residual: f64| residual <= ACCEPTED;
    let all = 0..tangent.freedom;
    let inaccurate: Vec<usize> = all.filter(|&r| !accurate(pairs.residuals[r])).collect();
    symmetric::refine(&linear.stiffness, &linear.mass, pairs, &inaccurate);
    for mode in inaccurate {
        let (lambda, shape) = (pairs.lambda[mode], &pairs.shapes[mode]);
        let (off, rounding) = deflation::quotient(linear, lambda, shape);
        pairs.residuals[mode] = residual(linear, tangent, lambda, shape);
        let error = rounding + 2.0 * off.abs();
        pairs.errors[mode] = if accurate(pairs.residuals[mode]) { error } else { error.max(pairs.errors[mode]) };
    }
}

/// Residual, relative to the terms in it, above which a pair is refined.
const ACCEPTED: f64 = 1e-9;

fn symmetrise(matrix: &mut Matrix) {
    for i in 0..matrix.row_count() {
        for j in 0..i {
            let mean = 0.5 * (matrix[i][j] + matrix[j][i]);
            (matrix[i][j], matrix[j][i]) = (mean, mean);
        }
    }
}

fn with_reactions(linear: &Linear, tangent: &Tangent, lambda: f64, x: &[f64]) -> Vector {
    let (k, m) = (times(&linear.stiffness, x), times(&linear.mass, x));
    let force = Vector::from_fn(x.len(), |i| lambda * m[i] - k[i]);
    let reactions = tangent.multipliers(&force);
    let motions = tangent.structure.motions();
    Vector::from_fn(x.len(), |i| if i < motions { x[i] } else { reactions[i] })
}

/// Largest component of `(K - lambda M) phi` relative to the sums of absolute terms, over the equations of motion and
/// the constraints.
fn residual(linear: &Linear, tangent: &Tangent, lambda: f64, phi: &[f64]) -> f64 {
    let motions = tangent.structure.motions();
    let (mut most, mut terms) = (0.0_f64, 0.0_f64);
    let mut violation = 0.0_f64;
    let greatest = largest(&phi[..motions]);
    let n = phi.len();
    for i in 0..n {
        let (mut sum, mut size, mut row) = (0.0, 0.0, 0.0_f64);
        for j in 0..n {
            let (k, m) = (linear.stiffness[i][j], lambda * linear.mass[i][j]);
            sum += (k - m) * phi[j];
            size += (k.abs() + m.abs()) * phi[j].abs();
            row = row.max(k.abs());
        }
        if !f64::is_finite(sum) {
            return f64::INFINITY;
        }
        if i < motions {
            most = most.max(f64::abs(sum));
            terms = terms.max(size);
        } else if sum != 0.0 {
            violation = violation.max(f64::abs(sum) / (row * greatest));
        }
    }
    let mut motion = if most == 0.0 { 0.0 } else { most / terms };
    if motion > ACCEPTED {
        // A shape that `K` maps to zero contains nothing but rounding, so its terms are no measure.
        let matrices = largest_element(&linear.stiffness) + lambda.abs() * largest_element(&linear.mass);
        if most <= measure::ROUNDING * n as f64 * matrices * largest(phi) {
            motion = measure::ROUNDING;
        }
    }
    motion.max(violation)
}
