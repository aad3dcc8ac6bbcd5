//! The path of conservative gyroscopic pencils beside the general one.

use super::families::{random_conservative, rotors};
use super::pencils::with_errors;
use super::*;
use crate::eigenproblem::general::gyroscopic::oscillations;
use crate::eigenproblem::general::scaled_pencil::{Eigenproblem, scaled};

/// The roots of the special path, whatever the size.
fn conservative(pencil: &Linear) -> Option<Vec<Root>> {
    let n = pencil.mass.row_count();
    let mut store = vec![0.0; 6 * n * n + 2 * n];
    let scaled = scaled(Eigenproblem::Quadratic(pencil), &mut &mut store[..]).unwrap();
    let oscillations = oscillations(&scaled.pencil)?;
    let root = |oscillation: crate::eigenproblem::general::gyroscopic::Oscillation| {
        oscillation.root(scaled.rate, scaled.right)
    };
    Some(oscillations.into_iter().map(root).collect())
}

fn compare(rounds: u64) {
    for round in 0..rounds {
        let n = 1 + (round % 8) as usize;
        let pencil = match round % 3 {
            // Pairs of equal frequencies.
            0 if n.is_multiple_of(2) => rotors(n, 0.0, round as f64 / rounds as f64),
            _ => random_conservative(n, round),
        };
        let special = conservative(&pencil).unwrap_or_else(|| panic!("round {round}"));
        checks::check(&pencil, &special).unwrap_or_else(|what| panic!("round {round}: {what}"));
        let general = with_errors(&solve(&pencil).unwrap());
        for (s, error) in with_errors(&special) {
            let nearest = general.iter().map(|(other, x)| (s - other).norm() - x);
            let off = nearest.fold(f64::INFINITY, f64::min);
            assert!(off <= error, "round {round}: {s} off by {off:e}, error {error:e}");
        }
        // Vectors of equal frequencies are orthogonal in the energy, which keeps derivatives of clusters right.
        for (a, one) in special.iter().enumerate() {
            for other in &special[..a] {
                let energy = checks::cross(&pencil, one, one).norm();
                let mixed = checks::cross(&pencil, one, other).norm();
                assert!(mixed < 1e-10 * energy, "round {round}: {mixed:e}");
            }
        }
    }
}

#[test]
fn both_paths_agree_within_their_errors() {
    compare(1_000);
}

/// `cargo test --release -p eigentol -- --ignored both_paths`
#[test]
#[ignore = "takes a minute without optimisation"]
fn both_paths_agree_within_their_errors_in_great_number() {
    compare(100_000);
}

/// `omega (omega +- p) = k`: a mass on equal springs in a turning frame.
#[test]
fn bounds_cover_a_closed_form() {
    for (spin, k) in [(1e-3, 7.0), (3.0, 2.0), (1e6, 1.0)] {
        let pencil = linear(identity(2), [[0.0, -spin], [spin, 0.0]], diagonal(&[k, k]));
        let roots = conservative(&pencil).unwrap();
        let fast = 0.5 * (spin + (spin * spin + 4.0 * k).sqrt());
        for (root, exact) in roots.iter().zip([k / fast, fast]) {
            let off = (root.s.im - exact).abs();
            assert!(off <= root.error + 2.0 * f64::EPSILON * exact, "{root:?} {exact}");
            assert!(root.error < 1e-14 * exact.max(1e-3 * fast), "{root:?}");
        }
    }
}

#[test]
fn only_conservative_pencils_are_taken() {
    let wrong = [
        linear(identity(2), [[0.0, -1.0], [1.0, 1e-9]], identity(2)),
        linear(identity(2), [[0.0, -1.0], [1.0, 0.0]], [[1.0, 0.1], [0.2, 1.0]]),
        linear(identity(2), [[0.0, -1.0], [1.0, 0.0]], diagonal(&[1.0, 0.0])),
        linear(identity(2), [[0.0, -1.0], [1.0, 0.0]], diagonal(&[1.0, -1.0])),
    ];
    for pencil in wrong {
        assert!(conservative(&pencil).is_none());
    }
}
