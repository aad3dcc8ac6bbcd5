//! Degenerate, defective and badly scaled pencils in great number.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

use super::checks::{check, check_product, check_sum};
use super::known::{below, check_known, known};
use super::*;

type Matrix<const N: usize> = [[f64; N]; N];

fn fill<const N: usize>(mut element: impl FnMut(usize, usize) -> f64) -> Matrix<N> {
    let mut matrix = [[0.0; N]; N];
    for i in 0..N {
        for j in 0..N {
            matrix[i][j] = element(i, j);
        }
    }
    matrix
}

/// Uniform in -1 .. 1.
fn uniform(rng: &mut ChaCha8Rng) -> f64 {
    (rng.next_u64() >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}

fn integers<const N: usize>(rng: &mut ChaCha8Rng, most: u32) -> Matrix<N> {
    fill(|_, _| below(rng, 2 * most + 1) as f64 - most as f64)
}

fn symmetric<const N: usize>(matrix: Matrix<N>, sign: f64) -> Matrix<N> {
    fill(|i, j| matrix[i][j] + sign * matrix[j][i])
}

fn graded<const N: usize>(rng: &mut ChaCha8Rng, spread: f64) -> Matrix<N> {
    fill(|_, _| uniform(rng) * 10.0_f64.powf(spread * uniform(rng)))
}

/// Well conditioned, after scaling the coordinates by up to `10^spread` either way.
fn mass<const N: usize>(rng: &mut ChaCha8Rng, spread: f64) -> Matrix<N> {
    let units: [f64; N] = core::array::from_fn(|_| 10.0_f64.powf(spread * uniform(rng)));
    let coupling: Matrix<N> = fill(|_, _| 0.4 * uniform(rng) / N as f64);
    fill(|i, j| {
        let element = coupling[i][j] + coupling[j][i];
        let one = if i == j { 1.0 } else { 0.0 };
        (element + one) * units[i] * units[j]
    })
}

fn companion<const N: usize>(rng: &mut ChaCha8Rng) -> Matrix<N> {
    let last: [f64; N] = core::array::from_fn(|_| below(rng, 5) as f64 - 2.0);
    fill(|i, j| {
        if i == 0 {
            last[j]
        } else if i == j + 1 {
            1.0
        } else {
            0.0
        }
    })
}

/// Determinant of a matrix of small integers, exactly (Bareiss).
pub(super) fn determinant<const N: usize>(matrix: &Matrix<N>) -> f64 {
    let mut a = matrix.map(|row| row.map(|x| x as i128));
    let (mut sign, mut before) = (1, 1);
    for k in 0..N {
        let Some(pivot) = (k..N).find(|&i| a[i][k] != 0) else {
            return 0.0;
        };
        if pivot != k {
            a.swap(pivot, k);
            sign = -sign;
        }
        for i in k + 1..N {
            for j in k + 1..N {
                a[i][j] = (a[i][j] * a[k][k] - a[i][k] * a[k][j]) / before;
            }
        }
        before = a[k][k];
    }
    (sign * before) as f64
}

/// A pencil of integers with `M = I` has an exact sum and an exact product.
fn check_integers<const N: usize>(damping: Matrix<N>, stiffness: Matrix<N>) -> Result<(), String> {
    let pencil = linear(identity(), damping, stiffness);
    let describe = |what: String| format!("{what}\n{pencil:?}");
    let roots = solve(&pencil).map_err(|trouble| describe(format!("{trouble:?}")))?;
    check(&pencil, &roots).map_err(describe)?;
    let trace = (0..N).map(|i| damping[i][i]).sum();
    check_sum(&roots, trace).map_err(describe)?;
    check_product(&roots, determinant(&stiffness)).map_err(describe)
}

fn check_any<const N: usize>(pencil: &Linear<f64, N>) -> Result<(), String> {
    let describe = |what: String| format!("{what}\n{pencil:?}");
    let roots = solve(pencil).map_err(|trouble| describe(format!("{trouble:?}")))?;
    check(pencil, &roots).map_err(describe)
}

/// One pencil of each kind.
fn one<const N: usize>(rng: &mut ChaCha8Rng, kind: u32) -> Result<(), String> {
    match kind {
        0 => check_known(&known::<N>(rng, true)),
        1 => check_known(&known::<N>(rng, false)),
        2 => {
            let most = 1 + below(rng, 3);
            check_integers::<N>(integers(rng, most), integers(rng, most))
        }
        3 => check_integers::<N>([[0.0; N]; N], companion(rng)),
        4 => check_integers::<N>(companion(rng), [[0.0; N]; N]),
        5 => check_integers::<N>(companion(rng), companion(rng)),
        6 => {
            // Gyroscopic: marginal or unstable, symmetric about both axes.
            let gyroscopic = symmetric(integers(rng, 2), -1.0);
            check_integers::<N>(gyroscopic, symmetric(integers(rng, 2), 1.0))
        }
        7 => {
            let mut damping = integers(rng, 1);
            let mut stiffness = integers(rng, 1);
            for i in 0..N {
                if below(rng, 2) == 0 {
                    damping[i] = [0.0; N];
                }
                if below(rng, 2) == 0 {
                    stiffness[i] = [0.0; N];
                }
            }
            check_integers::<N>(damping, stiffness)
        }
        8 => check_any::<N>(&linear(mass(rng, 6.0), graded(rng, 6.0), graded(rng, 12.0))),
        9 => {
            let units: [f64; N] = core::array::from_fn(|_| 10.0_f64.powf(6.0 * uniform(rng)));
            let scaled = |matrix: Matrix<N>| fill(|i, j| matrix[i][j] * units[i] * units[j]);
            let damping = scaled(integers(rng, 2));
            check_any::<N>(&linear(
                mass(rng, 0.0),
                damping,
                scaled(symmetric(integers(rng, 2), 1.0)),
            ))
        }
        10 => {
            // Almost defective.
            let mut near = known::<N>(rng, true).linear;
            let size = 10.0_f64.powf(-8.0 + 8.0 * uniform(rng));
            for row in near.damping.iter_mut().chain(&mut near.stiffness) {
                row.iter_mut().for_each(|x| *x += size * uniform(rng));
            }
            check_any(&near)
        }
        _ => {
            // Overdamped by up to 1e12.
            let size = 10.0_f64.powf(12.0 * uniform(rng));
            let damping = symmetric(fill(|_, _| size * uniform(rng)), 1.0);
            check_any::<N>(&linear(mass(rng, 0.0), damping, graded(rng, 3.0)))
        }
    }
}

fn torture(count: u64) {
    let mut failures = Vec::new();
    for case in 0..count {
        let mut rng = ChaCha8Rng::seed_from_u64(case);
        let kind = (case % 12) as u32;
        let outcome = match (case / 12) % 8 {
            0 => one::<1>(&mut rng, kind),
            1 => one::<2>(&mut rng, kind),
            2 => one::<3>(&mut rng, kind),
            3 => one::<4>(&mut rng, kind),
            4 => one::<5>(&mut rng, kind),
            5 => one::<6>(&mut rng, kind),
            6 => one::<7>(&mut rng, kind),
            _ => one::<8>(&mut rng, kind),
        };
        if let Err(what) = outcome {
            failures.push(format!("case {case}, kind {kind}: {what}"));
        }
    }
    let few = &failures[..failures.len().min(3)];
    assert!(few.is_empty(), "{} of {count}: {few:#?}", failures.len());
}

#[test]
fn hard_pencils_in_number() {
    torture(6_000);
}

/// Ten seconds with optimisation: `cargo test --release -p eigentol -- --ignored hard_pencils`.
#[test]
#[ignore = "takes minutes without optimisation"]
fn hard_pencils_in_great_number() {
    torture(100_000);
}
