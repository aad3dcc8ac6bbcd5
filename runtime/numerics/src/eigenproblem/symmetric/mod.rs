//! The symmetric generalised eigenproblem `K phi = lambda M phi`, with separate code for small sizes.

mod large;
mod refine;
mod residual;

use super::dense::transpose;
use super::tridiagonal;
use crate::algebra::{Matrix, Vector, for_size, largest, unless_finite};
use residual::Matrices;

/// Why the eigenproblem was not solved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum EigenproblemError {
    /// The mass matrix has no positive pivot in this row.
    SingularMass(usize),
    /// This pair was not found.
    Inaccurate { mode: usize, residual: f64 },
}

/// Eigenvalues, ascending; `shapes[r]` is the vector of eigenvalue `r` with `phi^T M phi = 1` and its largest component
/// positive.
#[derive(Debug, Default)]
pub struct Pairs {
    pub lambda: Vector,
    pub shapes: Matrix,
    pub residuals: Vector,
    /// How far each eigenvalue may be off by rounding.
    pub errors: Vector,
}

impl Pairs {
    /// Number of eigenvalues below zero.
    pub fn negative(&self) -> usize {
        self.lambda.iter().filter(|&&value| value < 0.0).count()
    }
}

/// Residual, relative to the terms in it, up to which these terms measure a pair.
const ACCEPTED: f64 = 1e-9;
/// Residual above which a pair is improved by inverse iteration.
pub const INACCURATE: f64 = 1e-13;

/// Share of the largest eigenvalue below which an eigenvalue may be no more than the effect of other modes in its
/// shape.
const SMALL: f64 = 1e-6;

/// Sizes with code of their own.
const SMALL_SIZE: usize = 8;

/// Solves `K phi = lambda M phi`, both matrices symmetric, `M` positive definite.
pub fn solve(stiffness: &Matrix, mass: &Matrix) -> Result<Pairs, EigenproblemError> {
    let mut pairs = Pairs::default();
    solve_into(stiffness, mass, &mut pairs)?;
    Ok(pairs)
}

/// Like [`solve`], overwriting existing pairs.
pub fn solve_into(stiffness: &Matrix, mass: &Matrix, pairs: &mut Pairs) -> Result<(), EigenproblemError> {
    let n = mass.row_count();
    let (k, m) = (stiffness.as_flattened(), mass.as_flattened());
    let lambda = pairs.lambda.make_room(n);
    let shapes = pairs.shapes.make_room(n, n);
    match n {
        0 => {}
        1 => one(k, m, lambda, shapes)?,
        2 => two(k, m, lambda, shapes)?,
        3..=SMALL_SIZE => for_size(
            n,
            #[inline(always)]
            |n| small(n, &k[..n * n], &m[..n * n], &mut lambda[..n], &mut shapes[..n * n]),
        )?,
        _ => {}
    }
    let (residuals, errors) = (pairs.residuals.make_room(n), pairs.errors.make_room(n));
    if n > SMALL_SIZE {
        let matrices = Matrices { n, k, m };
        return large::solve(&matrices, lambda, shapes, (residuals, errors));
    }
    for_size(
        n,
        #[inline(always)]
        |n| {
            let (k, m) = (&k[..n * n], &m[..n * n]);
            let sizes = (&mut residuals[..n], &mut errors[..n]);
            let (lambda, shapes) = (&mut lambda[..n], &mut shapes[..n * n]);
            finish(n, &Matrices { n, k, m }, lambda, shapes, sizes)
        },
    )
}

#[inline]
fn one(k: &[f64], m: &[f64], lambda: &mut [f64], vectors: &mut [f64]) -> Result<(), EigenproblemError> {
    if !(m[0] > 0.0 && m[0].is_finite()) {
        return Err(EigenproblemError::SingularMass(0));
    }
    lambda[0] = k[0] / m[0];
    vectors[0] = 1.0 / m[0].sqrt();
    Ok(())
}

/// Size two directly: explicit Cholesky reduction and one Jacobi rotation.
#[inline]
fn two(k: &[f64], m: &[f64], lambda: &mut [f64], vectors: &mut [f64]) -> Result<(), EigenproblemError> {
    let threshold = 16.0 * f64::EPSILON;
    let (k, m) = (&k[..4], &m[..4]);
    if !(m[0] > 0.0 && unless_finite(m[0]) == 0.0) {
        return Err(EigenproblemError::SingularMass(0));
    }
    // Reciprocals of the diagonal of L.
    let r0 = 1.0 / m[0].sqrt();
    let l10 = m[2] * r0;
    let pivot = m[3] - l10 * l10;
    if !(pivot > threshold * m[3].abs() && unless_finite(pivot) == 0.0) {
        return Err(EigenproblemError::SingularMass(1));
    }
    let r1 = 1.0 / pivot.sqrt();
    // A = L^-1 K L^-T
    let a00 = k[0] * r0 * r0;
    let k10 = k[2] * r0;
    let a10 = (k10 - l10 * a00) * r1;
    let a11 = (k[3] - l10 * (2.0 * k10 - l10 * a00)) * r1 * r1;
    let (cosine, tangent) = if a10 == 0.0 {
        (1.0, 0.0)
    } else {
        let ratio = (a11 - a00) / (2.0 * a10);
        let size = ratio.abs() + (1.0 + ratio * ratio).sqrt();
        let tangent = (1.0 / size).copysign(ratio);
        (1.0 / (1.0 + tangent * tangent).sqrt(), tangent)
    };
    lambda[0] = a00 - tangent * a10;
    lambda[1] = a11 + tangent * a10;
    // phi = L^-T y with y = (c, -s) and (s, c)
    let sine = tangent * cosine;
    for (r, (y0, y1)) in [(cosine, -sine), (sine, cosine)].into_iter().enumerate() {
        let x1 = y1 * r1;
        vectors[2 * r] = (y0 - l10 * x1) * r0;
        vectors[2 * r + 1] = x1;
    }
    Ok(())
}

/// Sizes from three to eight: from the tridiagonal form of `L^-1 K L^-T`, `M = L L^T`.
fn small(n: usize, k: &[f64], m: &[f64], lambda: &mut [f64], vectors: &mut [f64]) -> Result<(), EigenproblemError> {
    let lower = factor(n, m)?;
    let mut reduced = [0.0; SMALL_SIZE * SMALL_SIZE];
    let reduced = &mut reduced[..n * n];
    reduced.copy_from_slice(k);
    for _ in 0..2 {
        solve_lower(n, &lower, reduced);
        transpose(n, reduced);
    }
    symmetrise(n, reduced);
    // Q^T L^-1: its rows are the shapes.
    vectors.fill(0.0);
    vectors.iter_mut().step_by(n + 1).for_each(|x| *x = 1.0);
    solve_lower(n, &lower, vectors);
    let (mut beside, mut product) = ([0.0; SMALL_SIZE], [0.0; SMALL_SIZE]);
    let room = [lambda, &mut beside[..n], &mut product[..n]];
    tridiagonal::decompose(reduced, vectors, room).then_some(()).ok_or_else(not_found)
}

/// `L^-1 X` in place, for square `X`.
fn solve_lower(n: usize, lower: &[f64], x: &mut [f64]) {
    for i in 0..n {
        let (done, rest) = x.split_at_mut(i * n);
        let row = &mut rest[..n];
        for (done, factor) in done.chunks_exact(n).zip(&lower[i * n..]) {
            for (x, done) in row.iter_mut().zip(done) {
                *x -= factor * done;
            }
        }
        row.iter_mut().for_each(|x| *x /= lower[i * (n + 1)]);
    }
}

/// The lower triangle becomes the mean of both.
fn symmetrise(n: usize, matrix: &mut [f64]) {
    for i in 0..n {
        for j in 0..i {
            matrix[i * n + j] = 0.5 * (matrix[i * n + j] + matrix[j * n + i]);
        }
    }
}

/// Lower Cholesky factor of a mass matrix of size up to 8, row by row.
fn factor(n: usize, m: &[f64]) -> Result<[f64; 64], EigenproblemError> {
    let mut lower = [0.0; 64];
    factor_into(n, m, &mut lower)?;
    Ok(lower)
}

/// Lower Cholesky factor of a mass matrix, row by row; the part of `lower` above the diagonal is unchanged.
pub(crate) fn factor_into(n: usize, m: &[f64], lower: &mut [f64]) -> Result<(), EigenproblemError> {
    let threshold = 8.0 * n as f64 * f64::EPSILON;
    for i in 0..n {
        for j in 0..=i {
            let mut sum = m[i * n + j];
            for k in 0..j {
                sum -= lower[i * n + k] * lower[j * n + k];
            }
            if i != j {
                lower[i * n + j] = sum / lower[j * n + j];
            } else if sum > threshold * m[i * n + i].abs() && sum.is_finite() {
                lower[i * n + i] = sum.sqrt();
            } else {
                return Err(EigenproblemError::SingularMass(i));
            }
        }
    }
    Ok(())
}

/// Improves pairs by inverse iteration, and keeps them mass-orthogonal to the earlier ones near them. Leaves those
/// unchanged that it does not improve. The mass may be singular, as where unknowns include reactions.
pub fn refine(stiffness: &Matrix, mass: &Matrix, pairs: &mut Pairs, which: &[usize]) {
    let n = stiffness.row_count();
    let (k, m) = (stiffness.as_flattened(), mass.as_flattened());
    let shapes = pairs.shapes.as_flattened_mut();
    for &r in which {
        refine::refine(&Matrices { n, k, m }, &mut pairs.lambda, shapes, r);
    }
}

/// Sorts, refines where needed, measures each pair and fixes signs.
#[inline(always)]
fn finish(
    n: usize,
    matrices: &Matrices,
    lambda: &mut [f64],
    shapes: &mut [f64],
    (residuals, errors): (&mut [f64], &mut [f64]),
) -> Result<(), EigenproblemError> {
    sort(n, lambda, shapes, (residuals, errors));
    let mut refined = false;
    for r in 0..n {
        let range = r * n..(r + 1) * n;
        (residuals[r], errors[r]) = matrices.measured(n, lambda[r], &shapes[range.clone()]);
        if residuals[r] > INACCURATE {
            refine::refine(matrices, lambda, shapes, r);
            (residuals[r], errors[r]) = matrices.measured(n, lambda[r], &shapes[range.clone()]);
            refined = true;
        }
        let measured = (residuals[r], errors[r]);
        (residuals[r], errors[r]) = judged(matrices, (r, lambda), &shapes[range], measured)?;
    }
    if refined {
        sort(n, lambda, shapes, (residuals, errors));
    }
    let small = SMALL * largest(lambda);
    for r in 0..n {
        if lambda[r].abs() <= small {
            errors[r] += matrices.error_of_shape(lambda, shapes, r);
        }
    }
    for r in 0..n {
        fix_sign(&mut shapes[r * n..(r + 1) * n]);
    }
    Ok(())
}

/// The residual and the error of pair `r`. Where a matrix maps a shape to zero, the terms in the residual are rounding
/// themselves and measure nothing: the matrices do, in their own metric.
///
/// # Errors
/// If the pair is not finite.
#[inline(always)]
fn judged(
    matrices: &Matrices,
    (r, lambda): (usize, &[f64]),
    shape: &[f64],
    (residual, error): (f64, f64),
) -> Result<(f64, f64), EigenproblemError> {
    if residual <= ACCEPTED {
        return Ok((residual, error));
    }
    let distance = matrices.distance(lambda[r], shape);
    if !distance.is_finite() {
        return Err(EigenproblemError::Inaccurate { mode: r, residual });
    }
    let share = distance / largest(lambda);
    Ok((share.min(residual), error.max(distance)))
}

/// The error for a spectrum that was not found.
pub(super) fn not_found() -> EigenproblemError {
    EigenproblemError::Inaccurate { mode: 0, residual: f64::INFINITY }
}

#[inline(always)]
fn sort(n: usize, lambda: &mut [f64], shapes: &mut [f64], (residuals, errors): (&mut [f64], &mut [f64])) {
    for i in 1..n {
        let mut j = i;
        while j > 0 && lambda[j] < lambda[j - 1] {
            lambda.swap(j, j - 1);
            residuals.swap(j, j - 1);
            errors.swap(j, j - 1);
            for k in 0..n {
                shapes.swap(j * n + k, (j - 1) * n + k);
            }
            j -= 1;
        }
    }
}

/// Makes the largest component positive; a margin keeps the choice stable when two are equal up to rounding.
#[inline(always)]
pub fn fix_sign(shape: &mut [f64]) {
    let mut lead = 0;
    for i in 1..shape.len() {
        if shape[i].abs() > shape[lead].abs() * (1.0 + 1e-9) {
            lead = i;
        }
    }
    if !shape.is_empty() && shape[lead] < 0.0 {
        shape.iter_mut().for_each(|value| *value = -*value);
    }
}
