//! Ten pencils with their eigenvalues in 34 digits (`stored/eigenvalues.py`): every error must cover the difference.

use super::checks::check;
use super::*;

struct Stored {
    name: &'static str,
    linear: Linear,
    eigenvalues: Vec<Complex64>,
}

fn stored() -> Vec<Stored> {
    let mut lines = include_str!("stored/pencils.txt").lines();
    let mut pencils = Vec::new();
    while let Some(name) = lines.next() {
        let mut numbers = || -> Vec<f64> {
            let words = lines.next().unwrap().split_whitespace();
            words.map(|word| word.parse().unwrap()).collect()
        };
        let n = numbers()[0] as usize;
        let mut square = || {
            let rows: Vec<_> = (0..n).map(|_| numbers()).collect();
            Matrix::from_fn(n, n, |i, j| rows[i][j])
        };
        let linear = linear(square(), square(), square());
        let count = numbers()[0] as usize;
        let values = (0..count).map(|_| numbers());
        let eigenvalues = values.map(|pair| Complex64::new(pair[0], pair[1])).collect();
        pencils.push(Stored { name, linear, eigenvalues });
    }
    pencils
}

/// Every root belongs to an eigenvalue of its own, within its error.
fn compare(name: &str, roots: &[Root], eigenvalues: &[Complex64]) {
    // An eigenvalue that is almost real may be found as two real ones, and the other way round.
    let mut left: Vec<_> = eigenvalues.to_vec();
    left.extend(eigenvalues.iter().filter(|s| s.im > 0.0).map(Complex64::conj));
    for s in all(roots) {
        let root = roots.iter().find(|root| root.s == s || root.s.conj() == s);
        let apart = |other: &Complex64| (s - other).norm();
        let nearest = (0..left.len()).min_by(|&a, &b| apart(&left[a]).total_cmp(&apart(&left[b])));
        let exact = left.swap_remove(nearest.unwrap());
        let (off, error) = (apart(&exact), root.unwrap().error);
        assert!(off <= error, "{name}: {s} is off by {off:e}, error {error:e}");
    }
    assert!(left.is_empty(), "{name}: {left:?} not found");
}

#[test]
fn errors_cover_the_stored_eigenvalues() {
    let pencils = stored();
    assert_eq!(pencils.len(), 10);
    for Stored { name, linear, eigenvalues } in pencils {
        let roots = solve(&linear).unwrap();
        check(&linear, &roots).unwrap_or_else(|what| panic!("{name}: {what}"));
        compare(name, &roots, &eigenvalues);
    }
}

/// The transposed pencil has the same eigenvalues, the one reversed in time the opposite ones.
#[test]
fn errors_cover_them_in_every_direction() {
    for Stored { name, linear: Linear { mass, damping, stiffness }, eigenvalues } in stored() {
        let transposed = linear(mass.clone(), damping.transpose(), stiffness.transpose());
        compare(name, &solve(&transposed).unwrap(), &eigenvalues);
        let backwards = linear(mass, damping.map(|x| -x), stiffness);
        let opposite: Vec<_> = eigenvalues.iter().map(|s| -s.conj()).collect();
        compare(name, &solve(&backwards).unwrap(), &opposite);
    }
}

/// Units of coordinates and of time that are powers of two change no bit of the answer but its scale.
#[test]
fn units_that_are_powers_of_two_round_nothing() {
    const TIME: f64 = 1.0 / 1024.0;
    for stored in stored() {
        let n = stored.linear.mass.row_count();
        let units: Vec<f64> = (0..n).map(|i| 2f64.powi((i * 7 % 11) as i32 - 5)).collect();
        let scaled =
            |matrix: &Matrix, rate: f64| Matrix::from_fn(n, n, |i, j| matrix[i][j] * units[i] * units[j] * rate);
        let Linear { mass, damping, stiffness } = &stored.linear;
        let other = linear(scaled(mass, 1.0), scaled(damping, 1.0 / TIME), scaled(stiffness, 1.0 / TIME / TIME));
        let (roots, others) = (solve(&stored.linear).unwrap(), solve(&other).unwrap());
        assert_eq!(roots.len(), others.len(), "{}", stored.name);
        for (root, other) in roots.iter().zip(&others) {
            assert_eq!(root.s / TIME, other.s, "{}", stored.name);
            assert_eq!(root.error / TIME, other.error, "{}", stored.name);
        }
    }
}

#[test]
fn the_same_bits_again_and_in_other_threads() {
    let pencils = stored();
    let once: Vec<_> = pencils.iter().map(|pencil| solve(&pencil.linear)).collect();
    std::thread::scope(|scope| {
        for _ in 0..2 {
            scope.spawn(|| {
                for (pencil, once) in pencils.iter().zip(&once) {
                    assert_eq!(solve(&pencil.linear), *once, "{}", pencil.name);
                }
            });
        }
    });
}
