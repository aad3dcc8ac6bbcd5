//! Closed forms and reference values.

use super::checks::{check, cross};
use super::*;
use crate::eigenproblem::symmetric;

fn close(roots: &[Complex64], expected: &[Complex64], tolerance: f64) {
    assert_eq!(roots.len(), expected.len(), "{roots:?}");
    for (root, expected) in roots.iter().zip(expected) {
        assert!((root - expected).norm() <= tolerance * (1.0 + expected.norm()), "{root} in place of {expected}");
    }
}

fn solved(linear: &Linear) -> Vec<Root> {
    let roots = solve(linear).unwrap();
    check(linear, &roots).unwrap();
    roots
}

fn values(roots: &[Root]) -> Vec<Complex64> {
    roots.iter().map(|root| root.s).collect()
}

/// Reference values of case P3 in 80-digit arithmetic: a point mass on two sliders on a plate that spins at 4 rad/s.
#[test]
fn mass_on_spinning_plate() {
    let mass = [[0.5, 0.0], [0.0, 0.5]];
    let stiffness = [[32.0, 0.0], [0.0, 52.0]];
    let undamped = solved(&linear(mass, [[0.0, -4.0], [4.0, 0.0]], stiffness));
    let expected = [Complex64::new(0.0, 5.791190506937825), Complex64::new(0.0, 14.087658162815892)];
    close(&values(&undamped), &expected, 1e-15);
    let damped = solved(&linear(mass, [[0.3, -4.0], [4.0, 0.2]], stiffness));
    let expected = [
        Complex64::new(-0.16509762046087628, 5.7885059301340895),
        Complex64::new(-0.3349023795391237, 14.084481386437531),
    ];
    close(&values(&damped), &expected, 1e-15);
    for root in undamped.iter().chain(&damped) {
        assert!(root.error < 1e-13 && root.condition < 10.0);
    }
}

/// `m s^2 + c s + k = 0`.
#[test]
fn one_coordinate() {
    let one = |m, c, k| values(&solved(&linear([[m]], [[c]], [[k]])));
    let real = |x| Complex64::new(x, 0.0);
    close(&one(1.0, 0.0, 4.0), &[Complex64::new(0.0, 2.0)], 1e-16);
    close(&one(2.0, 4.0, 10.0), &[Complex64::new(-1.0, 2.0)], 1e-16);
    close(&one(1.0, 5.0, 4.0), &[real(-1.0), real(-4.0)], 1e-15);
    close(&one(1.0, 0.0, -9.0), &[real(-3.0), real(3.0)], 1e-16);
    close(&one(1.0, 3.0, 0.0), &[real(0.0), real(-3.0)], 1e-16);
    // Overdamped by 1e18: the small root is -k/c to working accuracy.
    let heavy = one(1.0, 1e9, 1.0);
    assert!((heavy[0].re + 1e-9).abs() < 1e-24 && (heavy[1].re + 1e9).abs() < 1e-6);
}

/// Four roots of size 2, of three coordinates that nothing couples.
#[test]
fn roots_of_one_size_are_in_order_of_their_parts() {
    let diagonal = |d: [f64; 3]| Matrix::from_fn(3, 3, |i, j| if i == j { d[i] } else { 0.0 });
    let mass = diagonal([1.0; 3]);
    let stiffness = diagonal([4.0, 4.0, -4.0]);
    let roots = solved(&linear(mass, diagonal([0.8, 2.4, 0.0]), stiffness));
    let expected = [
        Complex64::new(-2.0, 0.0),
        Complex64::new(2.0, 0.0),
        Complex64::new(-1.2, 1.6),
        Complex64::new(-0.4, 3.84_f64.sqrt()),
    ];
    close(&values(&roots), &expected, 1e-14);
}

/// With `C = a M + b K` each mode keeps its shape and has `s^2 + (a + b lambda) s + lambda = 0`.
#[test]
fn proportional_damping() {
    let mass = Matrix::from([[2.0, 0.5, 0.0], [0.5, 1.0, 0.1], [0.0, 0.1, 3.0]]);
    let stiffness = Matrix::from([[50.0, -20.0, 0.0], [-20.0, 60.0, -7.0], [0.0, -7.0, 900.0]]);
    let (a, b) = (0.3, 0.2);
    let damping = Matrix::from_fn(3, 3, |i, j| a * mass[i][j] + b * stiffness[i][j]);
    let pairs = symmetric::solve(&stiffness, &mass).unwrap();
    let mut expected = Vec::new();
    for lambda in pairs.lambda {
        let half = 0.5 * (a + b * lambda);
        let square = lambda - half * half;
        if square > 0.0 {
            expected.push(Complex64::new(-half, square.sqrt()));
        } else {
            let larger = half + (-square).sqrt();
            expected.push(Complex64::new(-lambda / larger, 0.0));
            expected.push(Complex64::new(-larger, 0.0));
        }
    }
    expected.sort_by(|x, y| x.norm().total_cmp(&y.norm()));
    close(&values(&solved(&linear(mass, damping, stiffness))), &expected, 1e-13);
}

/// Undamped symmetric pencils against the symmetric solver: `s = i sqrt(lambda)`, real shapes, left vectors equal to
/// right ones.
#[test]
fn undamped_modes_of_the_symmetric_solver() {
    let mass = Matrix::from([[3.0, 0.2, 0.1, 0.0], [0.2, 2.0, 0.3, 0.1], [0.1, 0.3, 4.0, 0.5], [0.0, 0.1, 0.5, 1.0]]);
    let stiffness =
        Matrix::from([[9.0, -2.0, 1.0, 0.5], [-2.0, -6.0, 0.3, 1.0], [1.0, 0.3, 90.0, -4.0], [0.5, 1.0, -4.0, 20.0]]);
    let pairs = symmetric::solve(&stiffness, &mass).unwrap();
    let roots = solved(&linear(mass, zeros(4), stiffness));
    for root in &roots {
        let lambda = -(root.s * root.s).re;
        let mode = (0..4)
            .min_by(|&a, &b| {
                let distance = |r: usize| (pairs.lambda[r] - lambda).abs();
                distance(a).total_cmp(&distance(b))
            })
            .unwrap();
        assert!((pairs.lambda[mode] - lambda).abs() < 1e-12 * lambda.abs());
        for i in 0..4 {
            let shape = pairs.shapes[mode][i];
            assert!((root.right[i] - shape).norm() < 1e-12, "{root:?}");
            assert!((root.left[i] - shape).norm() < 1e-12, "{root:?}");
        }
    }
    // Three modes that oscillate and one that diverges, which has two real roots.
    assert_eq!(roots.len(), 5);
}

/// Circulatory forces: `lambda = 2 +- i`, `s = +- sqrt(-lambda)`, and one mode grows.
#[test]
fn flutter() {
    let roots = solved(&linear(identity(2), zeros(2), [[2.0, 1.0], [-1.0, 2.0]]));
    let grows = Complex64::new(-2.0, 1.0).sqrt();
    let decays = -grows.conj();
    close(&values(&roots), &[decays, grows], 1e-15);
    // At the stability limit, `lambda = 3` occurs twice with one vector.
    let roots = solved(&linear(identity(2), zeros(2), [[2.0, 1.0], [-1.0, 4.0]]));
    for root in &roots {
        assert!((root.s - Complex64::new(0.0, 3.0_f64.sqrt())).norm() <= root.error);
        assert!(root.error < 1e-6 && root.condition > 1e6);
    }
}

/// A free mechanism: `s = 0` twice, with one vector, next to `i sqrt(k / m1 + k / m2)`.
#[test]
fn rigid_body_mode() {
    let k = 7.1;
    let roots = solved(&linear(diagonal(&[1.0, 1.3]), zeros(2), [[k, -k], [-k, k]]));
    let [first, second, elastic] = &roots[..] else { panic!("{roots:?}") };
    for root in [first, second] {
        assert!(root.s.norm() <= root.error && root.s.im == 0.0);
        assert!(root.error < 1e-6 && root.condition == f64::INFINITY);
        assert!((root.right[0] - root.right[1]).norm() < 1e-12);
    }
    assert!((elastic.s - Complex64::new(0.0, (k + k / 1.3).sqrt())).norm() < 1e-14);
}

/// Two equal oscillators, coupled only by the choice of coordinates: independent vectors, biorthogonal.
#[test]
fn semisimple_double_roots() {
    let mass = [[1.0, 0.2], [0.2, 1.3]];
    for damping in [0.1, 10.0] {
        let scaled = |factor: f64| mass.map(|row| row.map(|x| factor * x));
        let pencil = linear(mass, scaled(damping), scaled(7.0));
        let roots = solved(&pencil);
        for pair in roots.chunks(2) {
            let [a, b] = pair else { panic!("{roots:?}") };
            assert!((a.s - b.s).norm() < 1e-14 && a.condition < 10.0 && b.condition < 10.0);
            assert_eq!(super::checks::rank(&pencil, &[&a.right, &b.right]), 2);
            assert_eq!(super::checks::rank(&pencil, &[&a.left, &b.left]), 2);
            assert!(cross(&pencil, a, b).norm() < 1e-13 && cross(&pencil, b, a).norm() < 1e-13);
        }
    }
}

/// Eigenvalues over twelve orders of magnitude. Exact roots of `det Q` in rational arithmetic: with
/// `K = [[1, 1e-12], [1e-12, 2e-24]]` the small frequency is 1e-12 to a relative accuracy of 1e-24.
#[test]
fn small_eigenvalues_beside_great_ones() {
    let stiffness = [[1.0, 1e-12], [1e-12, 2e-24]];
    let roots = solved(&linear(identity(2), zeros(2), stiffness));
    let expected = [Complex64::new(0.0, 1e-12), Complex64::new(0.0, 1.0)];
    for (root, expected) in roots.iter().zip(expected) {
        assert!((root.s - expected).norm() <= 1e-14 * expected.norm());
        assert!(root.error < 1e-13 * expected.norm());
    }
    // A soft spring in series with a stiff one, in coordinates that mix them; lambda_1 = k1 k2 / (k1 + 2 k2) to a
    // relative 1e-12.
    let (soft, stiff) = (1.0, 1e12);
    let stiffness = [[soft + stiff, -stiff], [-stiff, stiff]];
    let roots = solved(&linear(identity(2), zeros(2), stiffness));
    let slow = &roots[0];
    let expected = Complex64::new(0.0, 0.5_f64.sqrt());
    assert!((slow.s - expected).norm() <= slow.error + 1e-12);
    assert!(slow.error < 1e-2, "{slow:?}");
}

/// Coordinates in other units (`D M D` and so on) have the same eigenvalues.
#[test]
fn units_of_coordinates_do_not_matter() {
    let pencil = linear([[2.0, 0.3], [0.3, 1.0]], [[0.1, -3.0], [2.5, 0.4]], [[30.0, 4.0], [-5.0, 20.0]]);
    let scaled = |matrix: &Matrix| {
        let units = [1e-9, 1e7];
        Matrix::from_fn(2, 2, |i, j| matrix[i][j] * units[i] * units[j])
    };
    let other = linear(scaled(&pencil.mass), scaled(&pencil.damping), scaled(&pencil.stiffness));
    close(&values(&solved(&pencil)), &values(&solved(&other)), 1e-14);
}
