//! The paper's own way: central differences of the matrices at re-solved equilibria, then eqs. 20-21. A reference
//! for the exact derivatives.

use super::explicit::rate_of;
use super::{Method, Sensitivities, Slopes, assemble};
use crate::array::Square;
use crate::{Equilibrium, Error, Linear, Mechanism, Modes, Policy, equilibrium::equilibrium};

/// Total derivatives of every mode by central differences; `step` is relative to each variable (5e-6 is about best),
/// absolute for a variable that is zero.
///
/// # Errors
/// [`Error::Setting`] for a step that is not positive, [`Error::OutsideDomain`] when a derivative is not finite; otherwise those of the re-solved equilibria.
pub fn sensitivities_by_finite_difference<
    M,
    const N: usize,
    const U: usize,
    const P: usize,
    const O: usize,
>(
    mechanism: &M,
    at: &Equilibrium<N, U, P>,
    modes: &Modes<N>,
    step: f64,
) -> Result<Sensitivities<N, U, P>, Error>
where
    M: Mechanism<N, U, P, O>,
{
    if !(step > 0.0 && step.is_finite()) {
        let reason = format!("{step} is not a positive number");
        return Err(Error::Setting {
            setting: "finite-difference step",
            reason,
        });
    }
    let solve = |u: &[f64; U], b: &[f64; P]| {
        equilibrium(mechanism, u, b, &at.coordinates, Policy::Nearest).map(|state| state.linear)
    };
    let mut by_input = Vec::with_capacity(U);
    for j in 0..U {
        let half = half_step(at.inputs[j], step);
        let (mut up, mut down) = (at.inputs, at.inputs);
        up[j] += half;
        down[j] -= half;
        let (above, below) = (solve(&up, &at.design)?, solve(&down, &at.design)?);
        by_input.push(difference(&above, &below, up[j] - down[j]));
    }
    let mut by_design = Vec::with_capacity(P);
    for j in 0..P {
        let half = half_step(at.design[j], step);
        let (mut up, mut down) = (at.design, at.design);
        up[j] += half;
        down[j] -= half;
        let (above, below) = (solve(&at.inputs, &up)?, solve(&at.inputs, &down)?);
        by_design.push(difference(&above, &below, up[j] - down[j]));
    }
    assemble(at, modes, Method::FiniteDifference, |mode| {
        let rate = rate_of(at, modes.family, mode);
        Slopes {
            by_input: core::array::from_fn(|j| rate(&by_input[j])),
            by_design: core::array::from_fn(|j| rate(&by_design[j])),
        }
    })
}

fn half_step(value: f64, step: f64) -> f64 {
    if value == 0.0 {
        step
    } else {
        step * value.abs()
    }
}

fn difference<const N: usize>(
    above: &Linear<f64, N>,
    below: &Linear<f64, N>,
    width: f64,
) -> Linear<f64, N> {
    let quotient = |a: &Square<N>, b: &Square<N>| {
        core::array::from_fn(|i| core::array::from_fn(|j| (a[i][j] - b[i][j]) / width))
    };
    Linear {
        mass: quotient(&above.mass, &below.mass),
        damping: quotient(&above.damping, &below.damping),
        stiffness: quotient(&above.stiffness, &below.stiffness),
    }
}
