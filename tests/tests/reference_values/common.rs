//! Comparisons, and totals of matrices along a moving equilibrium.

use eigentol::sensitivity::EquilibriumShift;
use eigentol::{Equilibrium, Linear, Mechanism};

/// Relative error to which derivatives and frequencies must match.
pub(crate) const TIGHT: f64 = 1e-9;

/// The error of each number relative to the larger of the expected value and `scale`, which must not exceed 1e-9.
#[track_caller]
pub(crate) fn assert_close(found: &[f64], expected: &[f64], scale: f64, what: &str) {
    assert_eq!(found.len(), expected.len(), "{what}");
    for (one, other) in found.iter().zip(expected) {
        assert!(
            (one - other).abs() <= TIGHT * other.abs().max(scale),
            "{what}: {found:?}, not {expected:?}"
        );
    }
}

/// Coordinates of an equilibrium: relative 1e-9, or absolute 1e-12 where zero.
#[track_caller]
pub(crate) fn assert_equilibrium(found: &[f64], expected: &[f64], what: &str) {
    assert_close(found, expected, 1e-3, what);
}

pub(crate) fn flat<const R: usize, const C: usize>(matrix: &[[f64; C]; R]) -> Vec<f64> {
    matrix.iter().flatten().copied().collect()
}

/// What a derivative is taken by.
#[derive(Clone, Copy, Debug)]
pub(crate) enum By {
    Input(usize),
    Design(usize),
}

fn unit<const K: usize>(k: usize) -> [f64; K] {
    std::array::from_fn(|i| f64::from(u8::from(i == k)))
}

/// `dq*/db`.
pub(crate) fn moved<const N: usize, const U: usize, const P: usize>(
    shift: &EquilibriumShift<N, U, P>,
    by: By,
) -> [f64; N] {
    std::array::from_fn(|i| match by {
        By::Input(k) => shift.by_input[i][k],
        By::Design(k) => shift.by_design[i][k],
    })
}

/// `dM/db`, `dC/db`, `dK/db`, explicit and through the equilibrium: from explicit partials, and in one direction.
pub(crate) fn total_linear<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    machine: &M,
    at: &Equilibrium<N, U, P>,
    dq: &[f64; N],
    by: By,
) -> [Linear<f64, N>; 2]
where
    M: Mechanism<N, U, P, O>,
{
    let (q, u, b) = (&at.coordinates, &at.inputs, &at.design);
    let partials = machine.linear_partials(q, u, b);
    let mut sum = match by {
        By::Input(k) => partials.by_input[k],
        By::Design(k) => partials.by_design[k],
    };
    for (part, rate) in partials.by_coordinate.iter().zip(dq) {
        for (total, part) in [
            (&mut sum.mass, &part.mass),
            (&mut sum.damping, &part.damping),
            (&mut sum.stiffness, &part.stiffness),
        ] {
            for (total, part) in total.iter_mut().flatten().zip(part.iter().flatten()) {
                *total += rate * part;
            }
        }
    }
    let (du, db) = match by {
        By::Input(k) => (unit(k), [0.0; P]),
        By::Design(k) => ([0.0; U], unit(k)),
    };
    [sum, machine.linear_along(q, u, b, dq, &du, &db)]
}
