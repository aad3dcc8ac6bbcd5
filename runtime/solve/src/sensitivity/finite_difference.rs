//! The method of the paper: central differences of the matrices at re-solved equilibria, then eqs. 20-21. A reference
//! for the exact derivatives.

use super::explicit::Rate;
use super::{Method, Sensitivities, assemble};
use crate::algebra::Matrix;
use crate::kernels::{Kernels, Linear};
use crate::{Equilibrium, Error, Modes, Policy, equilibrium::equilibrium};

/// Total derivatives of every mode by central differences.
///
/// `step` is relative to each variable (about 5e-6 is best), and absolute for a variable that is zero.
///
/// # Errors
/// [`Error::Setting`] for a step that is not positive, [`Error::OutsideDomain`] if a derivative is not finite, and the
/// errors of the re-solved equilibria.
pub fn sensitivities_by_finite_difference(
    mechanism: &dyn Kernels,
    at: &Equilibrium,
    modes: &Modes,
    step: f64,
) -> Result<Sensitivities, Error> {
    if !(step > 0.0 && step.is_finite()) {
        let reason = format!("{step} is not a positive number");
        return Err(Error::setting("finite-difference step", reason));
    }
    let solve =
        |u: &[f64], b: &[f64]| equilibrium(mechanism, u, b, &at.coordinates, Policy::Nearest).map(|state| state.linear);
    let mut by_input = Vec::with_capacity(at.inputs.len());
    for (j, &value) in at.inputs.iter().enumerate() {
        let half = half_step(value, step);
        let (mut up, mut down) = (at.inputs.clone(), at.inputs.clone());
        up[j] += half;
        down[j] -= half;
        let (above, below) = (solve(&up, &at.design)?, solve(&down, &at.design)?);
        by_input.push(difference(&above, &below, up[j] - down[j]));
    }
    let mut by_design = Vec::with_capacity(at.design.len());
    for (j, &value) in at.design.iter().enumerate() {
        let half = half_step(value, step);
        let (mut up, mut down) = (at.design.clone(), at.design.clone());
        up[j] += half;
        down[j] -= half;
        let (above, below) = (solve(&at.inputs, &up)?, solve(&at.inputs, &down)?);
        by_design.push(difference(&above, &below, up[j] - down[j]));
    }
    assemble(at, modes, Method::FiniteDifference, |sensitivity, mode| {
        let slopes = Rate::of(at, modes.family, mode, None).slopes(by_input.iter(), by_design.iter());
        sensitivity.set(mode, modes.family, &slopes);
    })
}

fn half_step(value: f64, step: f64) -> f64 {
    if value == 0.0 { step } else { step * value.abs() }
}

fn difference(above: &Linear, below: &Linear, width: f64) -> Linear {
    let quotient = |a: &Matrix, b: &Matrix| {
        let n = a.row_count();
        Matrix::from_fn(n, n, |i, j| (a[i][j] - b[i][j]) / width)
    };
    Linear {
        mass: quotient(&above.mass, &below.mass),
        damping: quotient(&above.damping, &below.damping),
        stiffness: quotient(&above.stiffness, &below.stiffness),
    }
}
