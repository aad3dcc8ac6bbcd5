//! Random pencils and what tests compare of their roots, shared with the tests of the solver in lanes.

use eigentol_numerics::algebra::{Matrix, Vector};
use eigentol_numerics::eigenproblem::{ApproximatePair, Root};
use eigentol_numerics::linear::Linear;
use num_complex::Complex64;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::Rng;

pub(crate) fn linear(mass: impl Into<Matrix>, damping: impl Into<Matrix>, stiffness: impl Into<Matrix>) -> Linear {
    Linear { mass: mass.into(), damping: damping.into(), stiffness: stiffness.into() }
}

pub(crate) fn zeros(n: usize) -> Matrix {
    Matrix::zeros(n, n)
}

pub(crate) fn identity(n: usize) -> Matrix {
    diagonal(&vec![1.0; n])
}

pub(crate) fn diagonal(elements: &[f64]) -> Matrix {
    let n = elements.len();
    Matrix::from_fn(n, n, |i, j| if i == j { elements[i] } else { 0.0 })
}

/// Uniform in -1 .. 1.
pub(crate) fn uniform(rng: &mut ChaCha8Rng) -> f64 {
    (rng.next_u64() >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}

pub(crate) fn below(rng: &mut ChaCha8Rng, bound: u32) -> u32 {
    rng.next_u32() % bound
}

pub(crate) fn integers(n: usize, rng: &mut ChaCha8Rng, most: u32) -> Matrix {
    Matrix::from_fn(n, n, |_, _| below(rng, 2 * most + 1) as f64 - most as f64)
}

pub(crate) fn symmetric(matrix: &Matrix, sign: f64) -> Matrix {
    let n = matrix.row_count();
    Matrix::from_fn(n, n, |i, j| matrix[i][j] + sign * matrix[j][i])
}

/// Well conditioned, with coordinates then scaled by up to `10^spread` either way.
pub(crate) fn mass(n: usize, rng: &mut ChaCha8Rng, spread: f64) -> Matrix {
    let units = Vector::from_fn(n, |_| 10.0_f64.powf(spread * uniform(rng)));
    let coupling = Matrix::from_fn(n, n, |_, _| 0.4 * uniform(rng) / n as f64);
    Matrix::from_fn(n, n, |i, j| {
        let element = coupling[i][j] + coupling[j][i];
        let one = if i == j { 1.0 } else { 0.0 };
        (element + one) * units[i] * units[j]
    })
}

/// Gyroscopic, damped and circulatory pencils, with eigenvalues that meet or vanish.
pub(crate) fn pencil(n: usize, rng: &mut ChaCha8Rng, kind: u32) -> Linear {
    let any = Matrix::from_fn(n, n, |_, _| uniform(rng));
    let stiffness = symmetric(&any, 1.0);
    match kind {
        0 => linear(identity(n), symmetric(&any, -1.0), stiffness),
        1 => linear(mass(n, rng, 0.5), any, stiffness),
        2 => linear(identity(n), integers(n, rng, 1), integers(n, rng, 1)),
        _ => linear(mass(n, rng, 0.0), zeros(n), stiffness),
    }
}

/// The pencil with every element changed by up to this share, keeping symmetric parts and signs.
pub(crate) fn moved(pencil: &Linear, rng: &mut ChaCha8Rng, share: f64) -> Linear {
    let n = pencil.mass.row_count();
    let factors = Matrix::from_fn(n, n, |_, _| 0.5 * share * uniform(rng));
    let factor = |i: usize, j: usize| 1.0 + factors[i][j] + factors[j][i];
    let change = |matrix: &Matrix| Matrix::from_fn(n, n, |i, j| matrix[i][j] * factor(i, j));
    linear(change(&pencil.mass), change(&pencil.damping), change(&pencil.stiffness))
}

pub(crate) fn near(roots: &[Root]) -> Vec<ApproximatePair<'_>> {
    fn near(root: &Root) -> ApproximatePair<'_> {
        ApproximatePair { s: root.s, right: &root.right, left: &root.left }
    }
    roots.iter().map(near).collect()
}

/// All roots with their errors, including conjugates.
pub(crate) fn with_errors(roots: &[Root]) -> Vec<(Complex64, f64)> {
    let both = |root: &Root| {
        let conjugate = (root.s.im > 0.0).then(|| root.s.conj());
        let values = [Some(root.s), conjugate].into_iter().flatten();
        values.map(|s| (s, root.error)).collect::<Vec<_>>()
    };
    roots.iter().flat_map(both).collect()
}
