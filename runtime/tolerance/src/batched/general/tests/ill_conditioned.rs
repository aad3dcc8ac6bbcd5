//! Modes whose eigenvalues are sensitive to rounding: those of random pencils in skew coordinates.

use super::pencils::uniform;
use super::*;
use crate::algebra::Matrix;
use crate::modes::{Family, Mode, Modes, match_modes, solve_modes};
use crate::{DampingKind, Description, Shared};

static ANY: Shared<Description> = Shared::Static(&Description {
    name: Shared::Static("Any"),
    coordinates: Shared::Static(&[]),
    inputs: Shared::Static(&[]),
    design: Shared::Static(&[]),
    excitations: Shared::Static(&[]),
    outputs: Shared::Static(&[]),
    symmetric_stiffness: false,
    free_directions: 0,
    held: Shared::Static(&[]),
    length: 1.0,
    frequency: eigentol_contract::Unit::si("rad/s"),
    resolved_modes: None,
    correlations: Shared::Static(&[]),
    rings: Shared::Static(&[]),
    spans: Shared::Static(&[]),
    harmonics: Shared::Static(&[]),
    damping: DampingKind::General,
    kernels: Shared::Static(&[]),
});

fn product(a: &Matrix, b: &Matrix) -> Matrix {
    let n = a.row_count();
    Matrix::from_fn(n, n, |i, j| (0..n).map(|k| a[i][k] * b[k][j]).sum())
}

/// Coordinates with a condition number of up to about `10^5`.
fn skew(n: usize, rng: &mut ChaCha8Rng) -> Matrix {
    let spread = 2.5 * (1.0 + uniform(rng)) / (n.max(2) - 1) as f64;
    let left = Matrix::from_fn(n, n, |_, _| uniform(rng));
    let right = Matrix::from_fn(n, n, |k, _| uniform(rng) * 10_f64.powf(-spread * k as f64));
    product(&left, &right)
}

/// The same motions in coordinates `x = T y`.
fn in_coordinates(pencil: &Linear, t: &Matrix) -> Linear {
    let n = t.row_count();
    let transposed = Matrix::from_fn(n, n, |i, j| t[j][i]);
    let seen = |matrix: &Matrix| product(&transposed, &product(matrix, t));
    let mass = seen(&pencil.mass);
    Linear {
        mass: Matrix::from_fn(n, n, |i, j| 0.5 * (mass[i][j] + mass[j][i])),
        damping: seen(&pencil.damping),
        stiffness: seen(&pencil.stiffness),
    }
}

fn modes(linear: &Linear) -> Option<Modes> {
    solve_modes(linear, Family::General, &ANY, 0.0).ok()
}

/// Compares random pencils mode by mode; returns how many were accepted although their eigenvalues may be off by more
/// than `1e-9`.
fn compare(rounds: usize) -> usize {
    let mut rng = ChaCha8Rng::seed_from_u64(31);
    let mut inaccurate = 0;
    for round in 0..rounds {
        let (n, kind) = (1 + round % LARGEST, (round / LARGEST % 4) as u32);
        let share = [1e-9, 1e-4, 0.02, 0.3][round / 4 / LARGEST % 4];
        let there = pencil(n, &mut rng, kind);
        let here = [(); WIDTH].map(|()| moved(&there, &mut rng, share));
        let t = skew(n, &mut rng);
        let there = in_coordinates(&there, &t);
        let here = here.each_ref().map(|one| in_coordinates(one, &t));
        let Some(known) = modes(&there) else { continue };
        let nearby: Vec<_> = known.modes.iter().map(Mode::near).collect();
        let Some(reference) = Reference::new(&there, n, &nearby) else {
            continue;
        };
        let (lanes, flags) = solved(&reference, &here);
        for (here, (roots, flag)) in here.iter().zip(lanes.iter().zip(flags)) {
            if !flag {
                continue;
            }
            let wanted = modes(here).unwrap_or_else(|| panic!("round {round}: accepted, but not found alone"));
            assert_eq!(roots.len(), wanted.modes.len(), "round {round}");
            let places = match_modes(&known, &wanted, here);
            for (&(s, error), index) in roots.iter().zip(places) {
                let mode = &wanted.modes[index.expect("as many modes")];
                let off = (s - mode.s).norm();
                assert!(
                    off <= error + mode.error + 1e-13 * s.norm(),
                    "round {round}: {s} {} {error:e} {:e}",
                    mode.s,
                    mode.error
                );
            }
            let far = |&(s, error): &(Complex64, f64)| error > 1e-9 * s.norm();
            inaccurate += usize::from(roots.iter().any(far));
        }
    }
    inaccurate
}

#[test]
fn modes_in_lanes_are_those_alone() {
    let inaccurate = compare(200);
    assert!(inaccurate > 100, "{inaccurate}");
}

#[test]
#[ignore = "takes minutes without optimisation"]
fn modes_in_lanes_are_those_alone_in_great_number() {
    let inaccurate = compare(40_000);
    assert!(inaccurate > 50_000, "{inaccurate}");
}
