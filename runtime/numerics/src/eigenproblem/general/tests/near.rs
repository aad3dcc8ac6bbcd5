//! Roots found from those of a nearby pencil equal the roots found from scratch.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

use super::checks::check;
use super::pencils::{moved, near, pencil, symmetric, uniform, with_errors};
use super::*;
use crate::eigenproblem::general::prediction::predict;
use crate::eigenproblem::general::{Eigenproblem, roots_near};

fn compare(rounds: usize) {
    let mut rng = ChaCha8Rng::seed_from_u64(16);
    let mut compared = 0;
    for round in 0..rounds {
        let (n, kind) = (1 + round % 5, (round / 5 % 4) as u32);
        let share = [1e-9, 1e-4, 0.02, 0.3][round / 20 % 4];
        let there = pencil(n, &mut rng, kind);
        let here = moved(&there, &mut rng, share);
        let (Ok(known), Ok(wanted)) = (solve(&there), solve(&here)) else {
            continue;
        };
        let roots = roots_near(Eigenproblem::Quadratic(&here), &near(&known))
            .unwrap_or_else(|_| panic!("round {round}: not found"));
        check(&here, &roots).unwrap_or_else(|message| panic!("round {round}: {message}"));
        // The order of roots of equal size is decided by rounding, and a double root may be a pair or two real roots.
        let mut left = with_errors(&wanted);
        for (s, error) in with_errors(&roots) {
            let same = |other: &(Complex64, f64)| (s - other.0).norm() <= error + other.1 + 1e-12 * s.norm();
            let index = left.iter().position(same);
            left.remove(index.unwrap_or_else(|| panic!("round {round}: {s} {left:?}")));
        }
        assert!(left.is_empty(), "round {round}");
        compared += 1;
    }
    assert!(8 * compared > 7 * rounds, "{compared}");
}

#[test]
fn roots_by_those_near_by_are_those_from_nothing() {
    compare(4000);
}

#[test]
#[ignore = "takes minutes without optimisation"]
fn roots_by_those_near_by_are_those_from_nothing_in_great_number() {
    compare(200_000);
}

#[test]
fn small_changes_are_predicted_to_second_order() {
    let mut rng = ChaCha8Rng::seed_from_u64(17);
    for _ in 0..200 {
        let there = linear(
            identity(3),
            symmetric(&Matrix::from_fn(3, 3, |_, _| uniform(&mut rng)), -1.0),
            diagonal(&[10.0, 25.0, 60.0]),
        );
        let known = solve(&there).expect("a gyroscopic pencil");
        let errors = [1e-3, 1e-4].map(|share| {
            let mut rng = ChaCha8Rng::seed_from_u64(18);
            let here = moved(&there, &mut rng, share);
            let mut values = [Complex64::ZERO; 6];
            assert!(predict(Eigenproblem::Quadratic(&here), &near(&known), 1.0, &mut values));
            let wanted = all(&solve(&here).expect("a gyroscopic pencil"));
            let off = values.iter().zip(&wanted).map(|(a, b)| (a - b).norm());
            off.fold(0.0, f64::max)
        });
        assert!(errors[0] < 1e-3, "{errors:?}");
        assert!(errors[1] < 0.02 * errors[0], "{errors:?}");
    }
}

#[test]
fn what_is_far_away_or_incomplete_is_not_predicted() {
    let here = linear(identity(2), zeros(2), diagonal(&[1.0, 4.0]));
    let far = linear(identity(2), zeros(2), diagonal(&[2.0, 4.0]));
    let mut values = [Complex64::ZERO; 4];
    let mut predicted = |known: &[Root]| predict(Eigenproblem::Quadratic(&here), &near(known), 1.0, &mut values);
    let roots = solve(&here).expect("two modes");
    assert!(predicted(&roots));
    assert!(!predicted(&roots[..1]));
    assert!(!predicted(&[]));
    assert!(!predicted(&solve(&far).expect("two modes")));
    let twice = [roots[0].clone(), roots[1].clone(), roots[1].clone()];
    assert!(!predicted(&twice));
}
