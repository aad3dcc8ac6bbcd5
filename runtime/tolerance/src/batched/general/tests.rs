//! Modes in lanes compared with those of the solver for one state.

mod ill_conditioned;
#[path = "../../../../numerics/src/eigenproblem/general/tests/pencils.rs"]
mod pencils;

use num_complex::Complex64;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

use super::*;
use crate::algebra;
use crate::batched::algebra::{LARGEST, load_matrix};
use crate::eigenproblem::{Eigenproblem, roots_of};
use crate::kernels::Linear;
use crate::scalar::{Batch, Instructions, Task, WIDTH};
use pencils::{moved, near, pencil, with_errors};

/// Matrices of eight states, row by row.
struct Lanes8<'a> {
    n: usize,
    matrices: [Vec<Batch>; 3],
    reference: &'a Reference,
}

/// Eigenvalues with their errors by lane, and the flags.
type LaneEigenvalues = (Vec<Vec<(Complex64, f64)>>, [bool; WIDTH]);

impl Task for &Lanes8<'_> {
    type Output = LaneEigenvalues;

    fn run<V: Lanes>(self) -> LaneEigenvalues {
        let count = self.reference.pairs.len();
        let mut all = vec![Vec::new(); WIDTH];
        let mut flags = [false; WIDTH];
        for at in (0..WIDTH).step_by(V::WIDTH) {
            let matrices = [0, 1, 2].map(|k| load_matrix(self.n, &self.matrices[k], at));
            let pencil: Pencil<V, LARGEST> = Pencil::new(self.n, matrices, self.reference);
            let (eigenvalues, flag) = pencil.eigenvalues(self.reference, true);
            let roots = eigenvalues.as_flattened();
            let numbers = |x: V| {
                let mut batch = Batch::default();
                x.store(&mut batch, at);
                batch.0
            };
            for r in 0..count {
                let (s, error) = roots[r];
                let (re, im, error) = (numbers(s.re), numbers(s.im), numbers(error));
                for k in at..at + V::WIDTH {
                    all[k].push((Complex64::new(re[k], im[k]), error[k]));
                }
            }
            let lanes = numbers(flag);
            for k in at..at + V::WIDTH {
                flags[k] = lanes[k] == 1.0;
            }
        }
        (all, flags)
    }
}

fn batches(n: usize, of: [&algebra::Matrix; WIDTH]) -> Vec<Batch> {
    let elements = (0..n * n).map(|k| Batch::from_fn(|lane| of[lane].as_flattened()[k]));
    elements.collect()
}

/// Solves eight pencils with every set of instructions; all must give the same bits.
fn solved(reference: &Reference, here: &[Linear; WIDTH]) -> LaneEigenvalues {
    let n = here[0].mass.row_count();
    let task = Lanes8 {
        n,
        matrices: [
            batches(n, here.each_ref().map(|one| &one.mass)),
            batches(n, here.each_ref().map(|one| &one.damping)),
            batches(n, here.each_ref().map(|one| &one.stiffness)),
        ],
        reference,
    };
    let bits = |(all, flags): &LaneEigenvalues| {
        let accepted = all.iter().zip(flags).filter(|(_, flag)| **flag);
        let numbers = accepted.flat_map(|(x, _)| x.iter());
        let numbers: Vec<_> = numbers.flat_map(|(s, error)| [s.re, s.im, *error].map(f64::to_bits)).collect();
        (numbers, *flags)
    };
    let scalar = Instructions::SCALAR.run(&task);
    for set in Instructions::available() {
        assert!(bits(&set.run(&task)) == bits(&scalar), "{set:?}");
    }
    scalar
}

/// Compares random pencils; returns how many of the pencils with the smallest changes were accepted, and their total
/// number.
fn compare(rounds: usize) -> (usize, usize) {
    let mut rng = ChaCha8Rng::seed_from_u64(30);
    let (mut accepted, mut of) = (0, 0);
    for round in 0..rounds {
        let (n, kind) = (1 + round % LARGEST, (round / LARGEST % 4) as u32);
        let share = [1e-9, 1e-4, 0.02, 0.3][round / 4 / LARGEST % 4];
        let there = pencil(n, &mut rng, kind);
        let here = [(); WIDTH].map(|()| moved(&there, &mut rng, share));
        let Ok(known) = roots_of(Eigenproblem::Quadratic(&there)) else {
            continue;
        };
        let Some(reference) = Reference::new(&there, n, &near(&known)) else {
            continue;
        };
        let (lanes, flags) = solved(&reference, &here);
        for (here, (roots, flag)) in here.iter().zip(lanes.iter().zip(flags)) {
            if share < 1e-3 {
                of += 1;
                accepted += usize::from(flag);
            }
            if !flag {
                continue;
            }
            let wanted = roots_of(Eigenproblem::Quadratic(here))
                .unwrap_or_else(|_| panic!("round {round}: accepted, but not found alone"));
            let mut left = with_errors(&wanted);
            for &(s, error) in roots {
                let both = [Some(s), (s.im > 0.0).then(|| s.conj())];
                for s in both.into_iter().flatten() {
                    let same = |other: &(Complex64, f64)| (s - other.0).norm() <= error + other.1 + 1e-13 * s.norm();
                    let index = left.iter().position(same);
                    left.remove(index.unwrap_or_else(|| panic!("round {round}: {s} {left:?}")));
                }
            }
            assert!(left.is_empty(), "round {round}: {left:?}");
        }
    }
    (accepted, of)
}

#[test]
fn modes_in_lanes_are_those_alone() {
    let (accepted, of) = compare(500);
    assert!(10 * accepted > 6 * of, "{accepted} of {of}");
}

#[test]
#[ignore = "takes minutes without optimisation"]
fn modes_in_lanes_are_those_alone_in_great_number() {
    compare(40_000);
}

/// Whether a pencil is accepted from a given reference; both are diagonal.
fn accepted(there: [[f64; 2]; 2], here: [[f64; 2]; 2]) -> bool {
    let diagonal = |elements: [f64; 2]| algebra::Matrix::from_fn(2, 2, |i, j| if i == j { elements[i] } else { 0.0 });
    let pencil = |[damping, stiffness]: [[f64; 2]; 2]| Linear {
        mass: diagonal([1.0; 2]),
        damping: diagonal(damping),
        stiffness: diagonal(stiffness),
    };
    let there = pencil(there);
    let known = roots_of(Eigenproblem::Quadratic(&there)).expect("two modes");
    let reference = Reference::new(&there, 2, &near(&known)).expect("all modes");
    let here = [(); WIDTH].map(|()| pencil(here));
    let (_, flags) = solved(&reference, &here);
    assert!(flags.iter().all(|flag| *flag == flags[0]));
    flags[0]
}

#[test]
fn modes_that_meet_are_refused() {
    let damping = [0.02; 2];
    let there = [damping, [1.0, 1.1]];
    assert!(accepted(there, [damping, [1.02, 1.08]]));
    assert!(!accepted(there, [damping, [1.05, 1.05]]));
    assert!(!accepted(there, [damping, [1.05, 1.05 * (1.0 + 1e-5)]]));
}

#[test]
fn modes_that_begin_or_cease_to_oscillate_are_refused() {
    let there = [[1.96, 0.02], [1.0, 9.0]];
    assert!(accepted(there, [[1.961, 0.02], [1.0, 9.0]]));
    // Im s = 8e-5 at |s| = 1, then 4e-5, then zero.
    let barely = [[2.0 - 6.4e-9, 0.02], [1.0, 9.0]];
    assert!(accepted(barely, barely));
    assert!(!accepted(barely, [[2.0 - 1.6e-9, 0.02], [1.0, 9.0]]));
    assert!(!accepted(there, [[2.0, 0.02], [1.0, 9.0]]));
    assert!(!accepted(there, [[2.001, 0.02], [1.0, 9.0]]));
    // Two real eigenvalues move, and meet.
    let there = [[2.05, 0.02], [1.0, 9.0]];
    assert!(accepted(there, [[2.051, 0.02], [1.0, 9.0]]));
    assert!(!accepted(there, [[2.0 + 1e-10, 0.02], [1.0, 9.0]]));
    assert!(!accepted(there, [[1.99, 0.02], [1.0, 9.0]]));
}

#[test]
fn modes_far_away_are_refused() {
    let there = [[0.02; 2], [1.0, 9.0]];
    assert!(accepted(there, [[0.02; 2], [1.1, 9.0]]));
    assert!(!accepted(there, [[0.02; 2], [1.5, 9.0]]));
}
