//! Derivatives of all modes by all variables through the adjoint: `dlambda/db = da/db - (dg/db)^T w`, `Khat^T w = da/dq`.

use super::{Method, Sensitivities, assemble, mode_gradient};
use crate::array::{Lu, transpose};
use crate::{Equilibrium, Error, Mechanism, Modes};

/// Total derivatives of every mode by every input and design variable.
///
/// # Errors
/// [`Error::CriticalState`] when `Khat` is singular, [`Error::OutsideDomain`] when a derivative is not finite.
pub fn sensitivities<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    mechanism: &M,
    at: &Equilibrium<N, U, P>,
    modes: &Modes<N>,
) -> Result<Sensitivities<N, U, P>, Error>
where
    M: Mechanism<N, U, P, O>,
{
    let factors = Lu::new(&transpose(&at.linear.stiffness)).ok_or(Error::CriticalState)?;
    let mut lambda = [([0.0; U], [0.0; P]); N];
    for (r, (by_input, by_design)) in lambda.iter_mut().enumerate() {
        let direct = mode_gradient(mechanism, at, modes, r);
        let adjoint = factors.solve(&direct.coordinates);
        let shift = mechanism.residual_gradient(&at.coordinates, &at.inputs, &at.design, &adjoint);
        *by_input = core::array::from_fn(|j| direct.inputs[j] - shift.inputs[j]);
        *by_design = core::array::from_fn(|j| direct.design[j] - shift.design[j]);
    }
    assemble(at, modes, Method::Adjoint, |r| lambda[r])
}
