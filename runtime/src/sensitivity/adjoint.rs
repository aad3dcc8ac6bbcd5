//! Derivatives of all modes by all variables through the adjoint. For undamped modes
//! `dlambda/db = da/db - (dg/db)^T w`, `a = phi^T (Khat - lambda Mhat) phi`; for general ones the same with
//! `a = psi^T (s^2 Mhat + s Chat + Khat) phi`, divided by `-psi^T (2 s Mhat + Chat) phi`. In both `Khat^T w = da/dq`.

use super::pencil::{Form, form_gradient, residual_gradient};
use super::{Method, Sensitivities, Slopes, assemble, redundancy};
use crate::array::{Lu, dot_complex, transpose};
use crate::modes::Family;
use crate::pencil::pencil_slope_times;
use crate::{Complex, Equilibrium, Error, Mechanism, Mode, Modes};

/// Total derivatives of every mode by every input and design variable.
///
/// # Errors
/// [`Error::CriticalState`] when `Khat` is singular, [`Error::ClosesHereOnly`] where redundant constraints contradict each
/// other as soon as a variable changes, [`Error::OutsideDomain`] when a derivative is not finite.
pub fn sensitivities<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    mechanism: &M,
    at: &Equilibrium<N, U, P>,
    modes: &Modes<N>,
) -> Result<Sensitivities<N, U, P>, Error>
where
    M: Mechanism<N, U, P, O>,
{
    redundancy::check(mechanism, at)?;
    let factors = Lu::new(&transpose(&at.linear.stiffness)).ok_or(Error::CriticalState)?;
    assemble(at, modes, Method::Adjoint, |mode| match modes.family {
        Family::Undamped => undamped(mechanism, at, &factors, mode),
        Family::General => general(mechanism, at, &factors, mode),
    })
}

fn undamped<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    mechanism: &M,
    at: &Equilibrium<N, U, P>,
    factors: &Lu<f64, N>,
    mode: &Mode<N>,
) -> Slopes<Complex, U, P>
where
    M: Mechanism<N, U, P, O>,
{
    let (q, u, b) = (&at.coordinates, &at.inputs, &at.design);
    let direct = mechanism.mode_gradient(q, u, b, &mode.real_shape(), mode.lambda);
    let adjoint = factors.solve(&direct.coordinates);
    let shift = mechanism.residual_gradient(q, u, b, &adjoint);
    Slopes {
        by_input: core::array::from_fn(|j| (direct.inputs[j] - shift.inputs[j]).into()),
        by_design: core::array::from_fn(|j| (direct.design[j] - shift.design[j]).into()),
    }
}

fn general<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    mechanism: &M,
    at: &Equilibrium<N, U, P>,
    factors: &Lu<f64, N>,
    mode: &Mode<N>,
) -> Slopes<Complex, U, P>
where
    M: Mechanism<N, U, P, O>,
{
    let direct = form_gradient(mechanism, at, &Form::of(&mode.left, mode.s, &mode.shape));
    let adjoint = factors.solve_complex(&direct.coordinates);
    let shift = residual_gradient(mechanism, at, &adjoint);
    let scale = -normaliser(at, mode);
    Slopes {
        by_input: core::array::from_fn(|j| (direct.inputs[j] - shift.inputs[j]) / scale),
        by_design: core::array::from_fn(|j| (direct.design[j] - shift.design[j]) / scale),
    }
}

/// `psi^T (2 s Mhat + Chat) phi`; zero where the eigenvalue has merged with another.
pub(super) fn normaliser<const N: usize, const U: usize, const P: usize>(
    at: &Equilibrium<N, U, P>,
    mode: &Mode<N>,
) -> Complex {
    dot_complex(
        &mode.left,
        &pencil_slope_times(&at.linear, mode.s, &mode.shape),
    )
}
