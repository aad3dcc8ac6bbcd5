//! Derivatives of all modes from explicit partial derivatives of the matrices: the way of eqs. 19-21, which checks the
//! adjoint, and the way that forgets the shift of the equilibrium.

use super::adjoint::normaliser;
use super::shift::equilibrium_shift;
use super::{Method, Sensitivities, Slopes, assemble};
use crate::array::{dot_complex, form};
use crate::modes::Family;
use crate::pencil::pencil_times;
use crate::{Complex, Equilibrium, Error, Linear, LinearPartials, Mechanism, Mode, Modes};

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
    with_partials(mechanism, at, |partials| {
        assemble(at, modes, Method::Explicit, |mode| {
            let rate = rate_of(at, modes.family, mode);
            let mut slopes = direct(partials, &rate);
            for (i, change) in partials.by_coordinate.iter().enumerate() {
                let moved = rate(change);
                for (total, by) in slopes.by_input.iter_mut().zip(&shift.by_input[i]) {
                    *total += moved * by;
                }
                for (total, by) in slopes.by_design.iter_mut().zip(&shift.by_design[i]) {
                    *total += moved * by;
                }
            }
            slopes
        })
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
    with_partials(mechanism, at, |partials| {
        assemble(at, modes, Method::FrozenEquilibrium, |mode| {
            direct(partials, rate_of(at, modes.family, mode))
        })
    })
}

/// Explicit partials of the matrices by every coordinate, input and design variable.
struct Partials<'a, const N: usize> {
    by_coordinate: &'a [Linear<f64, N>],
    by_input: &'a [Linear<f64, N>],
    by_design: &'a [Linear<f64, N>],
}

/// Explicit partials of at most this size, bytes, are passed by value; larger ones would fill the stack.
const ON_STACK: usize = 1 << 16;

fn with_partials<M, R, const N: usize, const U: usize, const P: usize, const O: usize>(
    mechanism: &M,
    at: &Equilibrium<N, U, P>,
    ask: impl FnOnce(&Partials<'_, N>) -> R,
) -> R
where
    M: Mechanism<N, U, P, O>,
{
    if const { size_of::<LinearPartials<f64, N, U, P>>() <= ON_STACK } {
        with_partials_on_stack(mechanism, at, ask)
    } else {
        with_partials_by_direction(mechanism, at, ask)
    }
}

#[inline(never)]
fn with_partials_on_stack<M, R, const N: usize, const U: usize, const P: usize, const O: usize>(
    mechanism: &M,
    at: &Equilibrium<N, U, P>,
    ask: impl FnOnce(&Partials<'_, N>) -> R,
) -> R
where
    M: Mechanism<N, U, P, O>,
{
    let partials = mechanism.linear_partials(&at.coordinates, &at.inputs, &at.design);
    ask(&Partials {
        by_coordinate: &partials.by_coordinate,
        by_input: &partials.by_input,
        by_design: &partials.by_design,
    })
}

#[inline(never)]
fn with_partials_by_direction<
    M,
    R,
    const N: usize,
    const U: usize,
    const P: usize,
    const O: usize,
>(
    mechanism: &M,
    at: &Equilibrium<N, U, P>,
    ask: impl FnOnce(&Partials<'_, N>) -> R,
) -> R
where
    M: Mechanism<N, U, P, O>,
{
    let (q, u, b) = (&at.coordinates, &at.inputs, &at.design);
    let mut all = Vec::with_capacity(N + U + P);
    for k in 0..N + U + P {
        let (dq, du, db) = (unit(k, 0), unit(k, N), unit(k, N + U));
        all.push(mechanism.linear_along(q, u, b, &dq, &du, &db));
    }
    let (by_coordinate, rest) = all.split_at(N);
    let (by_input, by_design) = rest.split_at(U);
    ask(&Partials {
        by_coordinate,
        by_input,
        by_design,
    })
}

/// The unit vector of place `k`, counted from `first`; zero where it has no such place.
fn unit<const K: usize>(k: usize, first: usize) -> [f64; K] {
    core::array::from_fn(|i| if first + i == k { 1.0 } else { 0.0 })
}

fn direct<const N: usize, const U: usize, const P: usize>(
    partials: &Partials<'_, N>,
    rate: impl Fn(&Linear<f64, N>) -> Complex,
) -> Slopes<Complex, U, P> {
    Slopes {
        by_input: core::array::from_fn(|k| rate(&partials.by_input[k])),
        by_design: core::array::from_fn(|k| rate(&partials.by_design[k])),
    }
}

/// How the eigenvalue of a mode moves with its matrices: of an undamped mode `lambda`, of a general one `s`.
pub(super) fn rate_of<'a, const N: usize, const U: usize, const P: usize>(
    at: &Equilibrium<N, U, P>,
    family: Family,
    mode: &'a Mode<N>,
) -> impl Fn(&Linear<f64, N>) -> Complex + use<'a, N, U, P> {
    let scale = normaliser(at, mode);
    move |change| match family {
        Family::Undamped => slope(mode, change).into(),
        Family::General => {
            -dot_complex(&mode.left, &pencil_times(change, mode.s, &mode.shape)) / scale
        }
    }
}

/// `phi^T (dK - lambda dM) phi` (eq. 20).
fn slope<const N: usize>(mode: &Mode<N>, change: &Linear<f64, N>) -> f64 {
    let phi = &mode.real_shape();
    form(phi, &change.stiffness, phi) - mode.lambda * form(phi, &change.mass, phi)
}
