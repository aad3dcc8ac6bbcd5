//! Derivatives of all modes from the explicit partial matrices: the second way, which checks the adjoint, and the way
//! that forgets the shift of the equilibrium.

use super::shift::equilibrium_shift;
use super::{Method, Sensitivities, assemble};
use crate::array::form;
use crate::{Equilibrium, Error, Linear, LinearPartials, Mechanism, Mode, Modes};

/// Total derivatives of every mode, from explicit partials and the shift (eqs. 19-21 completed).
///
/// # Errors
/// [`Error::CriticalState`] when `Khat` is singular, [`Error::OutsideDomain`] when a derivative is not finite.
pub fn sensitivities_explicit<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    mechanism: &M,
    at: &Equilibrium<N, U, P>,
    modes: &Modes<N>,
) -> Result<Sensitivities<N, U, P>, Error>
where
    M: Mechanism<N, U, P, O>,
{
    let shift = equilibrium_shift(mechanism, at)?;
    let partials = mechanism.linear_partials(&at.coordinates, &at.inputs, &at.design);
    assemble(at, modes, Method::Explicit, |r| {
        let mode = &modes.modes[r];
        let by_coordinate = partials
            .by_coordinate
            .each_ref()
            .map(|matrix| slope(mode, matrix));
        let (mut by_input, mut by_design) = direct(mode, &partials);
        for (i, &rate) in by_coordinate.iter().enumerate() {
            for (total, moved) in by_input.iter_mut().zip(&shift.by_input[i]) {
                *total += rate * moved;
            }
            for (total, moved) in by_design.iter_mut().zip(&shift.by_design[i]) {
                *total += rate * moved;
            }
        }
        (by_input, by_design)
    })
}

/// Derivatives with the equilibrium held still. **Not** the derivatives of the frequencies wherever the equilibrium
/// moves: for the rotating pendulum above its critical speed they are -1/2 of the true ones. For comparison only.
///
/// # Errors
/// [`Error::OutsideDomain`] when a derivative is not finite.
pub fn sensitivities_with_frozen_equilibrium<
    M,
    const N: usize,
    const U: usize,
    const P: usize,
    const O: usize,
>(
    mechanism: &M,
    at: &Equilibrium<N, U, P>,
    modes: &Modes<N>,
) -> Result<Sensitivities<N, U, P>, Error>
where
    M: Mechanism<N, U, P, O>,
{
    let partials = mechanism.linear_partials(&at.coordinates, &at.inputs, &at.design);
    assemble(at, modes, Method::FrozenEquilibrium, |r| {
        direct(&modes.modes[r], &partials)
    })
}

fn direct<const N: usize, const U: usize, const P: usize>(
    mode: &Mode<N>,
    partials: &LinearPartials<f64, N, U, P>,
) -> ([f64; U], [f64; P]) {
    (
        partials
            .by_input
            .each_ref()
            .map(|matrix| slope(mode, matrix)),
        partials
            .by_design
            .each_ref()
            .map(|matrix| slope(mode, matrix)),
    )
}

/// `phi^T (dK - lambda dM) phi` (eq. 20).
pub(super) fn slope<const N: usize>(mode: &Mode<N>, change: &Linear<f64, N>) -> f64 {
    let phi = &mode.shape;
    form(phi, &change.stiffness, phi) - mode.lambda * form(phi, &change.mass, phi)
}
