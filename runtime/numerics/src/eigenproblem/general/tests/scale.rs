//! Pencils that are not small: which path they take, and what work that is.

use super::checks::check;
use super::families::*;
use super::*;
use crate::eigenproblem::general::census::{self, Census};
use crate::eigenproblem::general::linearisation::Linearisation;
use crate::eigenproblem::general::scaled_pencil::{Eigenproblem, scaled};
use crate::eigenproblem::general::{hessenberg, schur};

fn solved(pencil: &Linear) -> (Vec<Root>, Census) {
    census::take();
    let roots = solve(pencil).unwrap();
    (roots, census::take())
}

/// Steps of QR on the linearisation, not sorted.
fn qr_steps(pencil: &Linear) -> Option<usize> {
    let n = pencil.mass.row_count();
    let mut store = vec![0.0; 6 * n * n + 2 * n];
    let scaled = scaled(Eigenproblem::Quadratic(pencil), &mut &mut store[..]).unwrap();
    let mut store = vec![0.0; 3 * n * n + 2 * n];
    let (mut companion, mut reflections) = (vec![0.0; 4 * n * n], vec![0.0; 4 * n * n]);
    Linearisation::new(&scaled.pencil, &mut companion, &mut store).unwrap();
    hessenberg::reduce(2 * n, &mut companion, &mut reflections, &mut vec![0.0; 2 * n]);
    let mut values = vec![Complex64::ZERO; 2 * n];
    schur::eigenvalues(2 * n, &mut companion, &mut values)
}

/// Machines whose linearisation has a diagonal that is exactly zero.
fn uniform(n: usize) -> [(&'static str, Linear); 4] {
    [
        ("spinning chain", spinning_chain(n, 0.3 / (n as f64).sqrt())),
        ("rotors", rotors(n, 0.3, 1.5)),
        ("rotors apart", rotors(n, 0.0, 1.5)),
        ("skew of ones", skew_of_ones(n)),
    ]
}

#[test]
fn qr_converges_on_uniform_machines() {
    for n in [4, 8, 16, 32, 64, 128] {
        for (name, pencil) in uniform(n) {
            let steps = qr_steps(&pencil).unwrap_or_else(|| panic!("{name} {n}"));
            assert!(steps <= 8 * n, "{name} {n}: {steps}");
        }
    }
}

#[test]
fn conservative_machines_need_no_factors() {
    let only = Census { conservative: 1, ..Census::default() };
    for n in [10, 16, 32, 64] {
        let shaft = ("shaft", undamped_shaft(n / 4));
        let machines = uniform(n).into_iter().chain((n % 4 == 0).then_some(shaft));
        for (name, pencil) in machines {
            let (roots, census) = solved(&pencil);
            assert_eq!(census, only, "{name} {n}");
            assert_eq!(roots.len(), n, "{name}");
            check(&pencil, &roots).unwrap_or_else(|what| panic!("{name} {n}: {what}"));
        }
    }
    // An element that is not exactly skew, a stiffness that is not positive, a damper.
    let pencil = spinning_chain(12, 0.1);
    let mut others = [pencil.clone(), pencil.clone(), pencil];
    others[0].damping[3][2] *= 1.0 + 1e-15;
    others[1].stiffness[4][4] = -1.0;
    others[2].damping[5][5] = 1e-3;
    for other in others {
        let (_, census) = solved(&other);
        assert_eq!((census.conservative, census.general), (0, 1));
    }
}

/// Machines of every other kind.
fn general(n: usize) -> [(&'static str, Linear); 7] {
    let mut damped_chain = spinning_chain(n, 0.3 / (n as f64).sqrt());
    for i in 0..n {
        damped_chain.damping[i][i] += 0.01 * damped_chain.mass[i][i];
    }
    [
        ("damped spinning chain", damped_chain),
        ("shaft in oil", shaft_in_oil(n / 4)),
        ("Beck's column", beck(n, 10.0)),
        ("damped", random_damped(n, 5)),
        ("nearly massless", nearly_massless(n)),
        ("stiff", stiff(n)),
        ("overdamped", overdamped(n)),
    ]
}

/// One Hessenberg form serves nearly all pairs.
#[test]
fn few_pairs_need_factors_of_their_own() {
    for n in [16, 32, 64] {
        for (name, pencil) in general(n) {
            let (roots, census) = solved(&pencil);
            check(&pencil, &roots).unwrap_or_else(|what| panic!("{name} {n}: {what}"));
            assert_eq!((census.general, census.second), (1, 0), "{name} {n}");
            assert!(census.steps <= 8 * n, "{name} {n}: {census:?}");
            let share = match name {
                "nearly massless" | "stiff" | "overdamped" => n / 2,
                _ => n / 16,
            };
            assert!(census.factors <= share, "{name} {n}: {census:?}");
        }
    }
}

/// Two equal eigenvalues each: independent vectors, without factors; with one vector each, factors for every cluster.
#[test]
fn clusters_cost_no_more_than_a_factor_each() {
    for n in [16, 32, 64] {
        let pencil = round_at_rest(n);
        let (roots, census) = solved(&pencil);
        check(&pencil, &roots).unwrap();
        assert_eq!((census.factors, census.second), (0, 0), "{n}");
        for pair in roots.chunks(2) {
            assert!((pair[0].s - pair[1].s).norm() <= pair[0].error + pair[1].error);
            let vectors = [&pair[0].right[..], &pair[1].right];
            assert_eq!(checks::rank(&pencil, &vectors), 2);
        }
        let pencil = critically_damped(n);
        let (roots, census) = solved(&pencil);
        check(&pencil, &roots).unwrap();
        assert!(census.factors <= 4 * n && census.second == 0, "{census:?}");
    }
}

/// Chains of eigenvectors, rigid modes, no stiffness at all: the answer covers the truth, and the work is bounded.
#[test]
fn degenerate_pencils_are_answered_in_bounded_time() {
    for n in [16, 40] {
        let (roots, census) = solved(&jordan(n, 2.0));
        for root in &roots {
            let off = (root.s - Complex64::new(0.0, 2f64.sqrt())).norm();
            assert!(off <= root.error, "{n}: {root:?}");
        }
        assert!(census.factors <= if n == 16 { 6000 } else { 6 * n }, "{census:?}");
        let mut free = chain_of_masses(&vec![1.0; n], &vec![1.0; n], 0.0);
        free.stiffness[0][0] = 1.0;
        let (roots, _) = solved(&free);
        check(&free, &roots).unwrap();
        let still = roots.iter().filter(|root| root.s.norm() <= root.error);
        assert_eq!(still.count(), 2, "{n}");
        let none = linear(identity(n), random_conservative(n, 1).damping, zeros(n));
        let (roots, _) = solved(&none);
        check(&none, &roots).unwrap();
        let still = roots.iter().filter(|root| root.s.norm() <= root.error);
        assert_eq!(still.count(), n, "{n}");
    }
}
