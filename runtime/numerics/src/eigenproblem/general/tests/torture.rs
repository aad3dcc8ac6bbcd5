//! Large numbers of degenerate, defective and badly scaled pencils.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

use super::checks::{check, check_product, check_sum};
use super::known::{check_known, known};
use super::pencils::{below, integers, mass, symmetric, uniform};
use super::*;

fn graded(n: usize, rng: &mut ChaCha8Rng, spread: f64) -> Matrix {
    Matrix::from_fn(n, n, |_, _| uniform(rng) * 10.0_f64.powf(spread * uniform(rng)))
}

fn companion(n: usize, rng: &mut ChaCha8Rng) -> Matrix {
    let last = Vector::from_fn(n, |_| below(rng, 5) as f64 - 2.0);
    Matrix::from_fn(n, n, |i, j| {
        if i == 0 {
            last[j]
        } else if i == j + 1 {
            1.0
        } else {
            0.0
        }
    })
}

/// Exact determinant of a matrix of small integers (Bareiss).
pub(super) fn determinant(matrix: &Matrix) -> f64 {
    let n = matrix.row_count();
    let mut a = matrix.map(|x| x as i128);
    let (mut sign, mut before) = (1, 1);
    for k in 0..n {
        let Some(pivot) = (k..n).find(|&i| a[i][k] != 0) else {
            return 0.0;
        };
        if pivot != k {
            a.swap(pivot, k);
            sign = -sign;
        }
        for i in k + 1..n {
            for j in k + 1..n {
                a[i][j] = (a[i][j] * a[k][k] - a[i][k] * a[k][j]) / before;
            }
        }
        before = a[k][k];
    }
    (sign * before) as f64
}

/// A pencil of integers with `M = I` has an exact sum and an exact product.
fn check_integers(damping: Matrix, stiffness: Matrix) -> Result<(), String> {
    let pencil = linear(identity(damping.row_count()), damping, stiffness);
    let describe = |what: String| format!("{what}\n{pencil:?}");
    let roots = solve(&pencil).map_err(|trouble| describe(format!("{trouble:?}")))?;
    check(&pencil, &roots).map_err(describe)?;
    let (damping, stiffness) = (&pencil.damping, &pencil.stiffness);
    let trace = (0..damping.row_count()).map(|i| damping[i][i]).sum();
    check_sum(&roots, trace).map_err(describe)?;
    check_product(&roots, determinant(stiffness)).map_err(describe)
}

fn check_any(pencil: &Linear) -> Result<(), String> {
    let describe = |what: String| format!("{what}\n{pencil:?}");
    let roots = solve(pencil).map_err(|trouble| describe(format!("{trouble:?}")))?;
    check(pencil, &roots).map_err(describe)
}

/// One pencil of each kind.
fn one(n: usize, rng: &mut ChaCha8Rng, kind: u32) -> Result<(), String> {
    match kind {
        0 => check_known(&known(n, rng, true)),
        1 => check_known(&known(n, rng, false)),
        2 => {
            let most = 1 + below(rng, 3);
            check_integers(integers(n, rng, most), integers(n, rng, most))
        }
        3 => check_integers(zeros(n), companion(n, rng)),
        4 => check_integers(companion(n, rng), zeros(n)),
        5 => check_integers(companion(n, rng), companion(n, rng)),
        6 => {
            // Gyroscopic: marginal or unstable, symmetric about both axes.
            let gyroscopic = symmetric(&integers(n, rng, 2), -1.0);
            check_integers(gyroscopic, symmetric(&integers(n, rng, 2), 1.0))
        }
        7 => {
            let mut damping = integers(n, rng, 1);
            let mut stiffness = integers(n, rng, 1);
            for i in 0..n {
                if below(rng, 2) == 0 {
                    damping[i].fill(0.0);
                }
                if below(rng, 2) == 0 {
                    stiffness[i].fill(0.0);
                }
            }
            check_integers(damping, stiffness)
        }
        8 => check_any(&linear(mass(n, rng, 6.0), graded(n, rng, 6.0), graded(n, rng, 12.0))),
        9 => {
            let units = Vector::from_fn(n, |_| 10.0_f64.powf(6.0 * uniform(rng)));
            let scaled = |matrix: &Matrix| Matrix::from_fn(n, n, |i, j| matrix[i][j] * units[i] * units[j]);
            let damping = scaled(&integers(n, rng, 2));
            check_any(&linear(mass(n, rng, 0.0), damping, scaled(&symmetric(&integers(n, rng, 2), 1.0))))
        }
        10 => {
            // Almost defective.
            let mut near = known(n, rng, true).linear;
            let size = 10.0_f64.powf(-8.0 + 8.0 * uniform(rng));
            for matrix in [&mut near.damping, &mut near.stiffness] {
                for x in matrix.as_flattened_mut() {
                    *x += size * uniform(rng);
                }
            }
            check_any(&near)
        }
        _ => {
            // Overdamped by up to 1e12.
            let size = 10.0_f64.powf(12.0 * uniform(rng));
            let damping = symmetric(&Matrix::from_fn(n, n, |_, _| size * uniform(rng)), 1.0);
            check_any(&linear(mass(n, rng, 0.0), damping, graded(n, rng, 3.0)))
        }
    }
}

/// Pencils of these sizes, in turn.
fn torture(count: u64, sizes: core::ops::RangeInclusive<u64>) {
    let different = sizes.end() - sizes.start() + 1;
    let mut failures = Vec::new();
    for case in 0..count {
        let mut rng = ChaCha8Rng::seed_from_u64(case);
        let kind = (case % 12) as u32;
        let n = sizes.start() + case / 12 % different;
        let outcome = one(n as usize, &mut rng, kind);
        if let Err(what) = outcome {
            failures.push(format!("case {case}, kind {kind}: {what}"));
        }
    }
    let few = &failures[..failures.len().min(3)];
    assert!(few.is_empty(), "{} of {count}: {few:#?}", failures.len());
}

#[test]
fn hard_pencils_in_number() {
    torture(6_000, 1..=8);
}

/// Those whose pairs come from one Hessenberg form.
#[test]
fn hard_pencils_that_are_not_small() {
    torture(300, 9..=16);
}

/// Takes ten seconds with optimisation: `cargo test --release -p eigentol -- --ignored hard_pencils`.
#[test]
#[ignore = "takes minutes without optimisation"]
fn hard_pencils_in_great_number() {
    torture(100_000, 1..=8);
}
