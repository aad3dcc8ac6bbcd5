//! The symmetric problem `P^T (K_c - lambda M) P y = 0`: undamped modes, and what counts negative stiffness.
#![allow(
    clippy::needless_range_loop,
    reason = "index loops read as the formulas they are"
)]

use super::quadratic::tangent_trouble;
use super::{measure, projected};
use crate::array::{dot, largest_element, times};
use crate::constraints::{Structure, Tangent};
use crate::modes::symmetric::{self, Trouble};
use crate::rounding::of_form;
use crate::{Description, Linear};

/// Eigenpairs of a symmetric `Khat` and `Mhat` along the directions that constraints leave free, ascending.
pub(crate) struct FreePairs<const N: usize> {
    count: usize,
    lambda: [f64; N],
    shapes: [[f64; N]; N],
    residuals: [f64; N],
    errors: [f64; N],
}

impl<const N: usize> FreePairs<N> {
    /// The eigenvalues, ascending: as many as there are free directions.
    pub(crate) fn lambda(&self) -> &[f64] {
        &self.lambda[..self.count]
    }

    /// Their vectors, reactions included: `phi^T Mhat phi = 1`, the largest component of a coordinate positive.
    pub(crate) fn shapes(&self) -> &[[f64; N]] {
        &self.shapes[..self.count]
    }

    /// Relative residuals on the bordered pencil.
    pub(crate) fn residuals(&self) -> &[f64] {
        &self.residuals[..self.count]
    }

    /// How far each eigenvalue may be off by rounding.
    pub(crate) fn errors(&self) -> &[f64] {
        &self.errors[..self.count]
    }

    /// Number of eigenvalues below zero.
    pub(crate) fn negative(&self) -> usize {
        self.lambda().iter().filter(|&&value| value < 0.0).count()
    }
}

/// The pairs of the mechanism that `description` describes.
///
/// # Errors
/// Of one with speeds or constraints on velocities there are none to be found in this way: none is accurate.
pub(crate) fn free_pairs<const N: usize>(
    linear: &Linear<f64, N>,
    description: &Description,
) -> Result<FreePairs<N>, Trouble> {
    let structure = Structure::of(description);
    if structure.open() {
        let pairs = symmetric::solve(&linear.stiffness, &linear.mass)?;
        return Ok(FreePairs {
            count: N,
            lambda: pairs.lambda,
            shapes: pairs.shapes,
            residuals: pairs.residuals,
            errors: pairs.errors,
        });
    }
    if !structure.holonomic() {
        return Err(Trouble::Inaccurate {
            mode: 0,
            residual: f64::INFINITY,
        });
    }
    reduced_pairs(linear, &Tangent::new(linear, structure))
}

#[cold]
fn reduced_pairs<const N: usize>(
    linear: &Linear<f64, N>,
    tangent: &Tangent<N>,
) -> Result<FreePairs<N>, Trouble> {
    let f = tangent.freedom;
    let mut store = [[[0.0; N]; N]; 3];
    let [mass, stiffness, reduced] = store.each_mut().map(|matrix| {
        let all = matrix.as_flattened_mut();
        &mut all[..f * f]
    });
    projected(&linear.mass, tangent, mass);
    projected(&linear.stiffness, tangent, stiffness);
    symmetrise(f, mass);
    symmetrise(f, stiffness);
    let mut pairs = FreePairs {
        count: f,
        lambda: [0.0; N],
        shapes: [[0.0; N]; N],
        residuals: [0.0; N],
        errors: [0.0; N],
    };
    symmetric::solve_on(
        f,
        (stiffness, mass),
        &mut pairs.lambda[..f],
        reduced,
        (&mut pairs.residuals[..f], &mut pairs.errors[..f]),
    )
    .map_err(|trouble| tangent_trouble(trouble, tangent))?;
    for r in 0..f {
        let mut y = [0.0; N];
        y[..f].copy_from_slice(&reduced[r * f..(r + 1) * f]);
        let mut x = tangent.lift(&y);
        symmetric::fix_sign(&mut x[..tangent.structure.motions()]);
        let lambda = &mut pairs.lambda[r];
        // Reactions do not matter to the quotient, and forces of constraints cancel in it.
        let complete = with_reactions(linear, tangent, *lambda, &x);
        let (numerator, rounding) = quotient(linear, *lambda, &complete);
        *lambda += numerator;
        pairs.errors[r] = pairs.errors[r].max(rounding);
        pairs.shapes[r] = with_reactions(linear, tangent, *lambda, &x);
        pairs.residuals[r] = residual(linear, tangent, *lambda, &pairs.shapes[r]);
        let residual = pairs.residuals[r];
        if residual.is_nan() || residual > ACCEPTED {
            return Err(Trouble::Inaccurate { mode: r, residual });
        }
    }
    Ok(pairs)
}

/// Accepted residual of a pair relative to the terms in it.
const ACCEPTED: f64 = 1e-9;

fn symmetrise(n: usize, matrix: &mut [f64]) {
    for i in 0..n {
        for j in 0..i {
            let mean = 0.5 * (matrix[i * n + j] + matrix[j * n + i]);
            (matrix[i * n + j], matrix[j * n + i]) = (mean, mean);
        }
    }
}

fn with_reactions<const N: usize>(
    linear: &Linear<f64, N>,
    tangent: &Tangent<N>,
    lambda: f64,
    x: &[f64; N],
) -> [f64; N] {
    let (k, m) = (times(&linear.stiffness, x), times(&linear.mass, x));
    let force = core::array::from_fn(|i| lambda * m[i] - k[i]);
    let reactions = tangent.multipliers(&force);
    let motions = tangent.structure.motions();
    core::array::from_fn(|i| if i < motions { x[i] } else { reactions[i] })
}

/// `phi^T (K - lambda M) phi` and a bound on its rounding, per `phi^T M phi = 1`.
fn quotient<const N: usize>(linear: &Linear<f64, N>, lambda: f64, phi: &[f64; N]) -> (f64, f64) {
    let (k, m) = (times(&linear.stiffness, phi), times(&linear.mass, phi));
    let size = dot(phi, &m);
    let numerator = dot(phi, &k) - lambda * size;
    let rounding = of_form(&linear.stiffness, phi) + lambda.abs() * of_form(&linear.mass, phi);
    (numerator / size, rounding / size)
}

/// Greatest component of `(K - lambda M) phi` relative to the sums of absolute terms: of the equations of motion, and of
/// the constraints.
fn residual<const N: usize>(
    linear: &Linear<f64, N>,
    tangent: &Tangent<N>,
    lambda: f64,
    phi: &[f64; N],
) -> f64 {
    let motions = tangent.structure.motions();
    let (mut most, mut terms) = (0.0_f64, 0.0_f64);
    let mut violation = 0.0_f64;
    let greatest = symmetric::largest(&phi[..motions]);
    for i in 0..N {
        let (mut sum, mut size, mut row) = (0.0, 0.0, 0.0_f64);
        for j in 0..N {
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
        // A shape that `K` takes to zero has nothing but rounding in it; its terms are no measure.
        let matrices =
            largest_element(&linear.stiffness) + lambda.abs() * largest_element(&linear.mass);
        if most <= measure::ROUNDING * N as f64 * matrices * symmetric::largest(phi) {
            motion = measure::ROUNDING;
        }
    }
    motion.max(violation)
}
