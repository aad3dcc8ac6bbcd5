//! Pencils as machines have them: bodies on springs and dampers, with arms, units and ranks of all sizes. None is refused.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

use super::pencils::{below, uniform};
use super::*;
use crate::eigenproblem::general::{Growing, growing};
use crate::eigenproblem::symmetric;

/// `rows` random directions of `n` coordinates, some through a point at a distance: `sum k r^T r`.
fn elements(n: usize, rows: usize, arm: f64, decades: f64, rng: &mut ChaCha8Rng) -> Matrix {
    let mut sum = zeros(n);
    for _ in 0..rows {
        let size = 10.0_f64.powf(decades * uniform(rng));
        let direction = Vector::from_fn(n, |i| {
            let lever = if i % 2 == 1 { arm } else { 1.0 };
            lever * f64::from(below(rng, 5) as i32 - 2) * 0.5
        });
        for i in 0..n {
            for j in 0..n {
                sum[i][j] += size * direction[i] * direction[j];
            }
        }
    }
    sum
}

/// A random machine: masses, dampers and springs over `decades`, arms of any length, gyroscopic and follower parts.
pub(super) fn machine(rng: &mut ChaCha8Rng) -> Linear {
    let n = match below(rng, 8) {
        0 => 9 + below(rng, 16) as usize,
        _ => 1 + below(rng, 8) as usize,
    };
    let arm = 10.0_f64.powf(2.0 * uniform(rng));
    let decades = [0.5, 2.0, 6.0][below(rng, 3) as usize];
    let mut mass = elements(n, n + 1, arm, 1.0, rng);
    for i in 0..n {
        let lever = if i % 2 == 1 { arm } else { 1.0 };
        mass[i][i] += lever * lever * 10.0_f64.powf(uniform(rng) - 1.0);
    }
    let damped = below(rng, n as u32 + 2) as usize;
    let held = below(rng, n as u32 + 2) as usize;
    let mut damping = elements(n, damped, arm, decades, rng);
    let mut stiffness = elements(n, held, arm, decades, rng);
    if below(rng, 3) == 0 {
        let spin = 10.0_f64.powf(decades * uniform(rng));
        for i in 1..n {
            let lever = if i % 2 == 1 { arm } else { 1.0 };
            damping[i][i - 1] += spin * lever;
            damping[i - 1][i] -= spin * lever;
        }
    }
    if below(rng, 4) == 0 && n > 1 {
        stiffness[0][n - 1] += 10.0_f64.powf(decades * uniform(rng));
    }
    // Jordan blocks, and equal machines side by side.
    if below(rng, 6) == 0 && n > 1 {
        let half = n / 2;
        for matrix in [&mut mass, &mut damping, &mut stiffness] {
            *matrix = Matrix::from_fn(n, n, |i, j| match i / half == j / half {
                true => matrix[i % half][j % half],
                false => 0.0,
            });
        }
        if below(rng, 2) == 0 {
            stiffness[0][half] += 10.0_f64.powf(decades * uniform(rng));
        }
    }
    // Units of coordinates and of time.
    let units = Vector::from_fn(n, |_| 2.0_f64.powi(below(rng, 41) as i32 - 20));
    let rate = 2.0_f64.powi(below(rng, 21) as i32 - 10);
    let unit = |matrix: &Matrix, power: f64| Matrix::from_fn(n, n, |i, j| matrix[i][j] * units[i] * units[j] * power);
    linear(unit(&mass, 1.0), unit(&damping, rate), unit(&stiffness, rate * rate))
}

/// Counts machines that are refused; writes some to a file for `machines.py`, which knows their eigenvalues to 34 digits.
fn count(machines: u64, mut written: Option<&mut String>) -> usize {
    let mut refused = 0;
    for seed in 0..machines {
        let pencil = machine(&mut ChaCha8Rng::seed_from_u64(seed));
        let n = pencil.mass.row_count();
        let even = |matrix: &Matrix| Matrix::from_fn(n, n, |i, j| 0.5 * (matrix[i][j] + matrix[j][i]));
        for matrix in [&pencil.damping, &pencil.stiffness] {
            refused += usize::from(symmetric::solve(&even(matrix), &pencil.mass).is_err());
        }
        let Ok(roots) = solve(&pencil) else {
            refused += 1;
            continue;
        };
        assert_eq!(all(&roots).len(), 2 * n, "{seed}");
        for root in &roots {
            assert!(root.s.is_finite() && root.s.im >= 0.0 && !root.error.is_nan(), "{seed}");
        }
        if let Some(text) = &mut written
            && n < 7
        {
            let matrices = [&pencil.mass, &pencil.damping, &pencil.stiffness];
            let elements = matrices.into_iter().flat_map(|matrix| matrix.as_flattened());
            let numbers = roots.iter().flat_map(|root| [&root.s.re, &root.s.im, &root.error]);
            let all: Vec<String> = elements.chain(numbers).map(f64::to_string).collect();
            text.push_str(&format!("{seed} {n} {}\n", all.join(" ")));
        }
    }
    refused
}

#[test]
fn no_machine_is_refused() {
    assert_eq!(count(2_000, None), 0);
}

/// Counts machines whose growing eigenvalues are counted without vectors, which must agree with those of all roots.
fn counted(machines: u64) -> usize {
    let counted = (0..machines).filter(|&seed| {
        let pencil = machine(&mut ChaCha8Rng::seed_from_u64(seed));
        let Some(found) = growing(&pencil) else { return false };
        let mut expected = Growing::default();
        for root in solve(&pencil).unwrap() {
            // Who asks for the modes is told the same.
            assert!(root.s.re.abs() > root.error, "{seed}: {root:?}");
            match root.s.im == 0.0 {
                _ if root.s.re < 0.0 => {}
                true => expected.real += 1,
                false => expected.pairs += 1,
            }
        }
        assert_eq!(found, expected, "{seed}");
        true
    });
    counted.count()
}

#[test]
fn what_grows_is_counted_without_vectors() {
    assert!(counted(2_000) > 300);
}

/// The same for many more; `MACHINES=file` writes them.
#[test]
#[ignore = "a minute"]
fn no_machine_of_many_is_refused() {
    let mut text = String::new();
    assert_eq!(count(100_000, Some(&mut text)), 0);
    if let Ok(file) = std::env::var("MACHINES") {
        std::fs::write(file, text).unwrap();
    }
}
