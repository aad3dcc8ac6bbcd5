//! Comparisons, and total derivatives of matrices along a moving equilibrium.

use eigentol::kernels::{DirectionalKernels, Kernels, Linear};
use eigentol::sensitivity::EquilibriumShift;
use eigentol::{Equilibrium, Matrix, Modes, Vector};

/// Relative error within which derivatives and frequencies must match.
pub(crate) const TIGHT: f64 = 1e-9;

/// Requires the error of each number, relative to the larger of the expected value and `scale`, not to exceed 1e-9.
#[track_caller]
pub(crate) fn assert_close(values: &[f64], expected: &[f64], scale: f64, what: &str) {
    assert_eq!(values.len(), expected.len(), "{what}");
    for (one, other) in values.iter().zip(expected) {
        assert!((one - other).abs() <= TIGHT * other.abs().max(scale), "{what}: {values:?}, not {expected:?}");
    }
}

/// Checks the coordinates of an equilibrium: 1e-9 relative, or 1e-12 absolute where zero.
#[track_caller]
pub(crate) fn assert_equilibrium(values: &[f64], expected: &[f64], what: &str) {
    assert_close(values, expected, 1e-3, what);
}

pub(crate) fn flat(matrix: &Matrix) -> Vec<f64> {
    matrix.as_flattened().to_vec()
}

/// Frequencies of modes that all oscillate.
pub(crate) fn frequencies(modes: &Modes) -> Vec<f64> {
    let frequencies = modes.frequencies().into_iter();
    frequencies.map(|omega| omega.expect("it oscillates")).collect()
}

/// The variable of differentiation.
#[derive(Clone, Copy, Debug)]
pub(crate) enum By {
    Input(usize),
    Design(usize),
}

fn unit(n: usize, k: usize) -> Vector {
    Vector::from_fn(n, |i| f64::from(u8::from(i == k)))
}

/// `dq*/db`.
pub(crate) fn moved(shift: &EquilibriumShift, by: By) -> Vector {
    match by {
        By::Input(k) => shift.by_input.column(k),
        By::Design(k) => shift.by_design.column(k),
    }
}

/// `dM/db`, `dC/db`, `dK/db`, the explicit part plus the part through the equilibrium: from explicit partials, and in
/// one direction.
pub(crate) fn total_linear(machine: &dyn DirectionalKernels, at: &Equilibrium, dq: &[f64], by: By) -> [Linear; 2] {
    let (q, u, b) = (&at.coordinates, &at.inputs, &at.design);
    let kernels: &dyn Kernels = machine;
    let partials = kernels.linear_partials(q, u, b);
    let mut sum = match by {
        By::Input(k) => partials.by_input[k].clone(),
        By::Design(k) => partials.by_design[k].clone(),
    };
    for (part, rate) in partials.by_coordinate.iter().zip(dq) {
        for (total, part) in
            [(&mut sum.mass, &part.mass), (&mut sum.damping, &part.damping), (&mut sum.stiffness, &part.stiffness)]
        {
            let total = total.as_flattened_mut().iter_mut();
            for (total, part) in total.zip(part.as_flattened()) {
                *total += rate * part;
            }
        }
    }
    let (du, db) = match by {
        By::Input(k) => (unit(u.len(), k), Vector::zeros(b.len())),
        By::Design(k) => (Vector::zeros(u.len()), unit(b.len(), k)),
    };
    [sum, machine.linear_along(q, u, b, [dq, &du, &db])]
}
