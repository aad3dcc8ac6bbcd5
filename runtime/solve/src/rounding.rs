//! Decides what is zero up to rounding. Stability, modes, tolerances and reports all decide here whether a number is
//! negative, zero or positive, given its possible error.
//!
//! # What is zero is decided once
//!
//! The error of an undamped `lambda` is what rounding of each element changes in the quotient of its shape, and what
//! other modes leave in that, so a soft mode next to a stiffness 1e15 times larger is as accurate as it would be alone.
//! Where a stiffness nearly vanishes, its elements may be remainders of greater terms: there the derivatives of
//! `lambda` by all data, including the shift of the equilibrium, give the effect of rounding in the data, which the
//! equilibrium keeps (`Equilibrium::rounding`) for all later steps. Pivots show at no cost when this is unnecessary.

use crate::algebra::{Lu, Matrix, dot};
use crate::kernels::{Kernels, Linear};

pub use eigentol_numerics::rounding::{Sign, of_elements, of_form, sign};

/// Relative rounding of an input, a design variable or a coordinate, including the rounding of operations in which it
/// takes part.
const OF_DATA: f64 = 8.0 * f64::EPSILON;

/// A state and its remaining residual.
#[doc(hidden)]
pub struct CheckedState<'a> {
    pub coordinates: &'a [f64],
    pub inputs: &'a [f64],
    pub design: &'a [f64],
    pub residual: &'a [f64],
}

/// Change of an eigenvalue `lambda` of `Khat phi = lambda Mhat phi`, `phi^T Mhat phi = 1`, due to rounding of the data,
/// including the shift of the equilibrium, whose place is held along free directions in `stiffness`.
///
/// An element of `Khat` may be a small difference of large terms, as when weight and centrifugal forces cancel at a
/// critical speed. Its own size then says nothing about its error, but its derivatives do.
#[cold]
#[inline(never)]
pub(crate) fn of_data(
    mechanism: &dyn Kernels,
    at: &CheckedState<'_>,
    stiffness: &Matrix,
    (lambda, phi): (f64, &[f64]),
) -> f64 {
    let (q, u, b) = (at.coordinates, at.inputs, at.design);
    let mut slopes = mechanism.mode_gradient(q, u, b, phi, lambda);
    let mut rest = 0.0;
    let direct = terms(&slopes.coordinates, q);
    if let Some(factors) = Lu::new(&stiffness.transpose()) {
        let adjoint = factors.solve(&slopes.coordinates);
        let shift = mechanism.residual_gradient(q, u, b, &adjoint);
        for (slope, shift) in slopes.inputs.iter_mut().zip(shift.inputs) {
            *slope -= shift;
        }
        for (slope, shift) in slopes.design.iter_mut().zip(shift.design) {
            *slope -= shift;
        }
        rest = dot(&adjoint, at.residual).abs();
    }
    OF_DATA * (direct + terms(&slopes.inputs, u) + terms(&slopes.design, b)) + rest
}

/// Sum of the absolute values of the products.
fn terms(slopes: &[f64], values: &[f64]) -> f64 {
    slopes.iter().zip(values).fold(0.0, |sum, (slope, value)| sum + (slope * value).abs())
}

/// Whether `Khat` is so clearly positive definite that rounding does not matter.
///
/// This is judged by its pivots `D` in `L D L^T` against its own diagonal and that of `Mhat`: no pivot may be a small
/// remainder of its element, and no stiffness so small that its element could be the difference of larger terms.
#[inline(always)]
pub(crate) fn clear(pivots: &[f64], linear: &Linear) -> bool {
    let n = pivots.len();
    let stiffness = &linear.stiffness.as_flattened()[..n * n];
    let mass = &linear.mass.as_flattened()[..n * n];
    let mut clear = true;
    for i in 0..n {
        let (stiffness, mass) = (stiffness[i * n + i], mass[i * n + i]);
        clear &= pivots[i] > CANCELLED * stiffness && pivots[i] > SLOW * mass;
    }
    clear
}

/// Share of its element below which a pivot may be pure rounding.
const CANCELLED: f64 = 1e-6;
/// Smallest eigenvalue, 1/s^2, that needs no closer check: the rounding of terms up to 1e12 1/s^2 stays below it.
/// Ordinary states are thus spared the derivatives that the check needs.
pub const SLOW: f64 = 1e-3;
