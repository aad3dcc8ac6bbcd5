//! Sizes that are not small: products are those of whole matrices, and inaccurate shapes are corrected by all others.

use super::refine::refine;
use super::residual::{Matrices, Rest, second_order};
use super::{EigenproblemError, INACCURATE, SMALL, fix_sign, judged, not_found, sort, symmetrise};
use crate::algebra::largest;
use crate::eigenproblem::dense::{self, add, dot, dot_sizes};
use crate::eigenproblem::tridiagonal;

/// Corrections of an inaccurate shape.
const CORRECTIONS: usize = 6;
/// Share of another shape beyond which the two may be any in their plane.
const MIXED: f64 = 0.1;

/// Fills in all pairs, ascending; shape `r` is row `r`.
pub(crate) fn solve(
    matrices: &Matrices,
    lambda: &mut [f64],
    shapes: &mut [f64],
    (residuals, errors): (&mut [f64], &mut [f64]),
) -> Result<(), EigenproblemError> {
    let n = matrices.n;
    decompose(matrices, lambda, shapes)?;
    measure(matrices, lambda, shapes, (residuals, errors));
    let mut moved = false;
    for r in 0..n {
        if residuals[r] > INACCURATE {
            moved = true;
            correct(matrices, lambda, shapes, (r, residuals[r]));
            let residual_of = |shapes: &[f64], value| Residual::new(matrices, value, &shapes[r * n..]);
            let mut residual = residual_of(shapes, lambda[r]);
            if residual.rest.relative() > INACCURATE {
                refine(matrices, lambda, shapes, r);
                residual = residual_of(shapes, lambda[r]);
            }
            (residuals[r], errors[r]) = (residual.rest.relative(), residual.rest.error(n));
        }
        let shape = &shapes[r * n..(r + 1) * n];
        (residuals[r], errors[r]) = judged(matrices, (r, lambda), shape, (residuals[r], errors[r]))?;
    }
    if moved {
        sort(n, lambda, shapes, (residuals, errors));
    }
    let small = SMALL * largest(lambda);
    for r in (0..n).filter(|&r| lambda[r].abs() <= small) {
        let residual = Residual::new(matrices, lambda[r], &shapes[r * n..]);
        let parts = shapes.chunks_exact(n).map(|shape| dot(shape, &residual.values));
        errors[r] += second_order(lambda, r, parts);
    }
    shapes.chunks_exact_mut(n).for_each(fix_sign);
    Ok(())
}

/// Pairs as they come from `L^-1 K L^-T`, `M = L L^T`, sorted.
fn decompose(matrices: &Matrices, lambda: &mut [f64], shapes: &mut [f64]) -> Result<(), EigenproblemError> {
    let n = matrices.n;
    let mut lower = vec![0.0; n * n];
    dense::cholesky(n, matrices.m, &mut lower).map_err(EigenproblemError::SingularMass)?;
    let mut reduced = matrices.k.to_vec();
    for _ in 0..2 {
        dense::solve_lower(n, &lower, n, &mut reduced);
        dense::transpose(n, &mut reduced);
    }
    symmetrise(n, &mut reduced);
    // Q^T L^-1: its rows are the shapes.
    let mut rows = vec![0.0; n * n];
    rows.iter_mut().step_by(n + 1).for_each(|x| *x = 1.0);
    dense::solve_lower(n, &lower, n, &mut rows);
    let (mut values, mut beside, mut product) = (vec![0.0; n], vec![0.0; n], vec![0.0; n]);
    let room = [&mut values[..], &mut beside, &mut product];
    if !tridiagonal::decompose(&mut reduced, &mut rows, room) {
        return Err(not_found());
    }
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by(|&a, &b| values[a].total_cmp(&values[b]));
    for (r, shape) in order.iter().zip(shapes.chunks_exact_mut(n)) {
        shape.copy_from_slice(&rows[r * n..(r + 1) * n]);
    }
    for (r, lambda) in order.iter().zip(lambda) {
        *lambda = values[*r];
    }
    Ok(())
}

/// All residuals, and the errors of the eigenvalues.
fn measure(matrices: &Matrices, lambda: &[f64], shapes: &[f64], (residuals, errors): (&mut [f64], &mut [f64])) {
    let n = matrices.n;
    let sizes = |x: &[f64]| -> Vec<f64> { x.iter().map(|x| x.abs()).collect() };
    // The matrices are symmetric: row `r` of the product belongs to shape `r`.
    let times = |shapes: &[f64], matrix: &[f64]| {
        let mut product = vec![0.0; n * n];
        dense::multiply(n, n, shapes, matrix, &mut product);
        product
    };
    let absolute = sizes(shapes);
    let [k, m] = [matrices.k, matrices.m].map(|matrix| times(shapes, matrix));
    let terms = [matrices.k, matrices.m].map(|matrix| times(&absolute, &sizes(matrix)));
    for (r, &lambda) in lambda.iter().enumerate() {
        let mut rest = Rest::default();
        for i in r * n..(r + 1) * n {
            let terms = terms[0][i] + lambda.abs() * terms[1][i];
            rest.add(shapes[i], k[i] - lambda * m[i], terms);
        }
        (residuals[r], errors[r]) = (rest.relative(), rest.error(n));
    }
}

/// `K phi - lambda M phi` for one pair.
struct Residual {
    values: Vec<f64>,
    rest: Rest,
}

impl Residual {
    /// For the shape at the beginning of `phi`.
    fn new(matrices: &Matrices, lambda: f64, phi: &[f64]) -> Self {
        let n = matrices.n;
        let phi = &phi[..n];
        let (mut values, mut rest) = (Vec::with_capacity(n), Rest::default());
        let rows = matrices.k.chunks_exact(n).zip(matrices.m.chunks_exact(n));
        for ((k, m), &x) in rows.zip(phi) {
            let value = dot(k, phi) - lambda * dot(m, phi);
            let terms = dot_sizes(k, phi) + lambda.abs() * dot_sizes(m, phi);
            rest.add(x, value, terms);
            values.push(value);
        }
        Self { values, rest }
    }
}

/// Removes from shape `r` the parts of all others that its residual shows, as long as that helps.
fn correct(matrices: &Matrices, lambda: &mut [f64], shapes: &mut [f64], (r, mut residual): (usize, f64)) {
    let n = matrices.n;
    for _ in 0..CORRECTIONS {
        let old = Residual::new(matrices, lambda[r], &shapes[r * n..]);
        let mut shape = shapes[r * n..(r + 1) * n].to_vec();
        for (s, other) in shapes.chunks_exact(n).enumerate() {
            let part = dot(other, &old.values) / (lambda[r] - lambda[s]);
            if s != r && part.abs() <= MIXED {
                add(part, other, &mut shape);
            }
        }
        let form =
            |matrix: &[f64], x: &[f64]| matrix.chunks_exact(n).zip(x).map(|(row, x)| x * dot(row, &shape)).sum::<f64>();
        let size = form(matrices.m, &shape);
        let value = form(matrices.k, &shape) / size;
        shape.iter_mut().for_each(|x| *x /= size.sqrt());
        let reached = Residual::new(matrices, value, &shape).rest.relative();
        if reached.is_nan() || reached >= residual {
            break;
        }
        residual = reached;
        lambda[r] = value;
        shapes[r * n..(r + 1) * n].copy_from_slice(&shape);
        if reached <= INACCURATE {
            break;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{INACCURATE, solve};
    use crate::algebra::Matrix;

    /// A chain of masses, fixed at both ends.
    fn chain(masses: &[f64], springs: &[f64]) -> [Matrix; 2] {
        let n = masses.len();
        let stiffness = Matrix::from_fn(n, n, |i, j| match i.abs_diff(j) {
            0 => springs[i] + springs[i + 1],
            1 => -springs[i.max(j)],
            _ => 0.0,
        });
        let mass = Matrix::from_fn(n, n, |i, j| if i == j { masses[i] } else { 0.0 });
        [stiffness, mass]
    }

    /// `lambda = 4 sin^2(pi r / (2 (n + 1)))`.
    #[test]
    fn errors_cover_the_uniform_chain() {
        for n in [9, 16, 33, 64] {
            let [stiffness, mass] = chain(&vec![1.0; n], &vec![1.0; n + 1]);
            let pairs = solve(&stiffness, &mass).unwrap();
            for (r, (lambda, error)) in pairs.lambda.iter().zip(&pairs.errors).enumerate() {
                let angle = core::f64::consts::PI * (r + 1) as f64 / (2.0 * (n + 1) as f64);
                let exact = 4.0 * angle.sin().powi(2);
                assert!((lambda - exact).abs() <= *error, "{n} {r}");
                assert!(*error < 1e-14 * n as f64, "{n} {r}: {error:e}");
                assert!(pairs.residuals[r] < INACCURATE);
            }
        }
    }

    /// Masses that are as good as none leave the slow modes as they are to twelve digits.
    #[test]
    fn slow_modes_do_not_carry_the_rounding_of_fast_ones() {
        for n in [15, 47] {
            let masses: Vec<f64> = (0..n).map(|i| if i % 2 == 1 { 1e-13 } else { 1.0 }).collect();
            let [stiffness, mass] = chain(&masses, &vec![2.0; n + 1]);
            let pairs = solve(&stiffness, &mass).unwrap();
            // Without them, two springs in series are one of half the stiffness, but those at the ends.
            let count = n.div_ceil(2);
            let mut springs = vec![1.0; count + 1];
            (springs[0], springs[count]) = (2.0, 2.0);
            let [stiffness, mass] = chain(&vec![1.0; count], &springs);
            let exact = solve(&stiffness, &mass).unwrap();
            for r in 0..count {
                let (computed, exact) = (pairs.lambda[r], exact.lambda[r]);
                assert!((computed / exact - 1.0).abs() < 1e-11, "{n} {r}: {computed} {exact}");
                assert!(pairs.residuals[r] < INACCURATE && pairs.errors[r] < 1e-11);
            }
        }
    }

    /// Equal eigenvalues with any orthogonal shapes.
    #[test]
    fn equal_eigenvalues_keep_their_shapes_apart() {
        const N: usize = 12;
        let stiffness = Matrix::from_fn(N, N, |i, j| if i == j { 3.0 } else { 1.0 });
        let mass = Matrix::from_fn(N, N, |i, j| if i == j { 1.0 } else { 0.0 });
        let pairs = solve(&stiffness, &mass).unwrap();
        for r in 0..N {
            let exact = if r + 1 == N { 14.0 } else { 2.0 };
            assert!((pairs.lambda[r] - exact).abs() < 1e-13);
            for s in 0..N {
                let product: f64 = (0..N).map(|i| pairs.shapes[r][i] * pairs.shapes[s][i]).sum();
                assert!((product - if r == s { 1.0 } else { 0.0 }).abs() < 1e-13);
            }
        }
    }
}
