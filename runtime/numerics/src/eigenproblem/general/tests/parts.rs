//! Tests of the parts of the solver.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

use super::pencils::below;
use super::*;
use crate::eigenproblem::general::lu::Lu;
use crate::eigenproblem::general::measure::Pair;
use crate::eigenproblem::general::pencil::Pencil;
use crate::eigenproblem::general::{aberth, accuracy, hessenberg, schur};

/// Companion matrices of polynomials with small integer coefficients, on which an unbounded QR iteration without
/// exceptional shifts hangs.
#[test]
fn qr_converges_on_small_integer_companions() {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    for case in 0..20_000 {
        let n = 2 + case % 7;
        let mut matrix = vec![0.0; n * n];
        for j in 0..n {
            matrix[j] = below(&mut rng, 5) as f64 - 2.0;
        }
        for i in 1..n {
            matrix[i * n + i - 1] = 1.0;
        }
        let coefficients = matrix[..n].to_vec();
        let mut values = vec![Complex64::ZERO; n];
        let mut work = vec![0.0; n];
        hessenberg::balance(n, &mut matrix, &mut work);
        let mut reflections = vec![0.0; n * n];
        hessenberg::reduce(n, &mut matrix, &mut reflections, &mut work);
        let steps = schur::eigenvalues(n, &mut matrix, &mut values);
        assert!(steps.is_some(), "{coefficients:?}");
        let sum: Complex64 = values.iter().sum();
        assert!((sum - coefficients[0]).norm() < 1e-12, "{coefficients:?}");
    }
}

/// Permutations have their eigenvalues on the unit circle: ordinary shifts do not move them.
#[test]
fn qr_converges_on_cyclic_permutations() {
    for n in 2..17 {
        let mut matrix = vec![0.0; n * n];
        matrix[n - 1] = 1.0;
        for i in 1..n {
            matrix[i * n + i - 1] = 1.0;
        }
        let mut values = vec![Complex64::ZERO; n];
        assert!(schur::eigenvalues(n, &mut matrix, &mut values).is_some());
        for value in values {
            assert!((value.powu(n as u32) - 1.0).norm() < 1e-12);
        }
    }
}

/// Balancing is a similarity by powers of two.
#[test]
fn balancing_keeps_the_matrix_similar() {
    let original = [1.0, 1e9, -3.0, 1e-9, 2.0, 4e-7, 5.0, 1e8, 3.0];
    let mut matrix = original;
    let mut scales = [0.0; 3];
    hessenberg::balance(3, &mut matrix, &mut scales);
    for i in 0..3 {
        for j in 0..3 {
            assert_eq!(matrix[3 * i + j], original[3 * i + j] * scales[j] / scales[i]);
        }
    }
    assert!(matrix.iter().all(|x| x.abs() < 100.0), "{matrix:?}");
}

/// The second method, started from a circle, finds the same values as the first.
#[test]
fn both_methods_agree() {
    let mass = [1.0, 0.0, 0.0, 1.0];
    let damping = [0.3, -2.0, 1.7, 0.1];
    let stiffness = [0.9, 0.2, -0.4, 0.5];
    let pencil = Pencil {
        degree: super::super::pencil::Degree::Two,
        n: 2,
        mass: &mass,
        damping: &damping,
        stiffness: &stiffness,
        transposed: [&mass, &[0.3, 1.7, -2.0, 0.1], &[0.9, -0.4, 0.2, 0.5]],
        largest: [1.0, 2.0, 0.9],
    };
    let mut values: [Complex64; 4] = core::array::from_fn(|i| Complex64::from_polar(1.0, 0.4 + 1.57 * i as f64));
    let mut open = [true; 4];
    let mut q = [Complex64::ZERO; 4];
    let (mut order, mut work) = ([0; 4], [Complex64::ZERO; 8]);
    aberth::improve(&pencil, &mut values, &mut open, &mut q, &mut order, &mut work);
    aberth::symmetrise(&mut values, &mut [true; 4]);
    let linear = linear(identity(2), [[0.3, -2.0], [1.7, 0.1]], [[0.9, 0.2], [-0.4, 0.5]]);
    let roots = all(&solve(&linear).unwrap());
    for root in roots {
        let nearest = values.iter().map(|value| (value - root).norm());
        assert!(nearest.fold(f64::INFINITY, f64::min) < 1e-14);
    }
}

/// Rank, null vectors from both sides, and solutions.
#[test]
fn complete_pivoting_reveals_the_rank() {
    let c = |re, im| Complex64::new(re, im);
    // Rank one: the product of a column and a row.
    let (column, row) = ([c(1.0, 2.0), c(-0.5, 0.1), c(3.0, 0.0)], [c(0.2, 1.0), c(2.0, 0.0), c(1.0, -1.0)]);
    let mut matrix: [Complex64; 9] = core::array::from_fn(|k| column[k / 3] * row[k % 3]);
    let original = matrix;
    let mut order = [0; 6];
    let lu = Lu::new(3, &mut matrix, &mut order);
    assert_eq!(lu.nullity(1e-14), 2);
    for k in 0..2 {
        let (mut right, mut left) = ([Complex64::ZERO; 3], [Complex64::ZERO; 3]);
        lu.null_right(2, k, &mut right);
        lu.null_left(2, k, &mut left);
        for i in 0..3 {
            let across: Complex64 = (0..3).map(|j| original[3 * i + j] * right[j]).sum();
            let down: Complex64 = (0..3).map(|j| left[j] * original[3 * j + i]).sum();
            assert!(across.norm() < 1e-14 && down.norm() < 1e-14);
        }
        assert!(right.iter().chain(&left).any(|x| x.norm() >= 1.0));
    }
    let mut regular: [Complex64; 9] = core::array::from_fn(|k| original[k] + if k % 4 == 0 { 1.0 } else { 0.0 });
    let original = regular;
    let lu = Lu::new(3, &mut regular, &mut order);
    let b = [c(1.0, 0.0), c(0.0, -2.0), c(0.5, 0.5)];
    let (mut x, mut y, mut work) = ([Complex64::ZERO; 3], [Complex64::ZERO; 3], [Complex64::ZERO; 3]);
    lu.solve(&b, &mut x, &mut work);
    lu.solve_transposed(&b, &mut y, &mut work);
    for i in 0..3 {
        let across: Complex64 = (0..3).map(|j| original[3 * i + j] * x[j]).sum();
        let down: Complex64 = (0..3).map(|j| original[3 * j + i] * y[j]).sum();
        assert!((across - b[i]).norm() < 1e-13 && (down - b[i]).norm() < 1e-13);
    }
}

/// An eigenvalue that stands in the place of another is told by the sum: no error is smaller than what is missing.
#[test]
fn the_sum_tells_what_is_missing() {
    let pairs =
        [1.0, 1.0, -4.0].map(|re| Pair { s: Complex64::new(re, 0.5), conjugate: re < 0.0, error: 1e-12, ..Pair::NONE });
    assert_eq!(accuracy::missing(&pairs, -6.0 + 1e-8), 0.0);
    assert_eq!(accuracy::missing(&pairs, -5.0), 1.0);
    assert_eq!(accuracy::missing(&pairs, -6.5), 0.5);
}
