//! Total derivatives: how an equilibrium, its modes and the outputs move with inputs and design variables, the shift of
//! the equilibrium included (eqs. 19-21 completed).

mod adjoint;
mod events;
mod explicit;
mod finite_difference;
mod outputs;
mod shift;

pub use adjoint::sensitivities;
pub use events::{critical_sensitivity, crossing_sensitivity};
pub use explicit::{sensitivities_explicit, sensitivities_with_frozen_equilibrium};
pub use finite_difference::sensitivities_by_finite_difference;
pub use outputs::{OutputSensitivities, output_sensitivities};
pub use shift::{EquilibriumShift, equilibrium_shift};

use crate::array::all_finite;
use crate::modes::clusters;
use crate::{Description, Equilibrium, Error, Mechanism, Modes};

/// How derivatives were found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// Adjoint: all variables at once.
    Adjoint,
    /// Explicit partial derivatives and the shift of the equilibrium.
    Explicit,
    /// The equilibrium held still: wrong wherever it moves; for comparison only.
    FrozenEquilibrium,
    /// Central differences of the matrices at re-solved equilibria.
    FiniteDifference,
}

/// Total derivatives of one mode.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ModeSensitivity<const U: usize, const P: usize> {
    /// `dlambda/du`, 1/s^2 by SI unit of the input.
    pub lambda_by_input: [f64; U],
    /// `dlambda/db`, 1/s^2 by SI unit of the design variable.
    pub lambda_by_design: [f64; P],
    /// `domega/du`, rad/s by SI unit (eq. 21); `None` for a mode that does not oscillate.
    pub omega_by_input: Option<[f64; U]>,
    /// `domega/db`, rad/s by SI unit (eq. 21); `None` for a mode that does not oscillate.
    pub omega_by_design: Option<[f64; P]>,
    /// The mode is one of several with nearly equal eigenvalues: these numbers belong to the computed basis of the
    /// cluster, a single-mode derivative does not exist.
    pub clustered: bool,
}

impl<const U: usize, const P: usize> ModeSensitivity<U, P> {
    fn finite(&self) -> bool {
        let omega_by_input = self.omega_by_input.as_ref();
        let omega_by_design = self.omega_by_design.as_ref();
        all_finite(&self.lambda_by_input)
            && all_finite(&self.lambda_by_design)
            && omega_by_input.is_none_or(all_finite)
            && omega_by_design.is_none_or(all_finite)
    }
}

/// Total derivatives of all modes at one equilibrium, in the order of the modes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sensitivities<const N: usize, const U: usize, const P: usize> {
    /// One entry for each mode.
    pub modes: [ModeSensitivity<U, P>; N],
    /// How they were found.
    pub method: Method,
    /// The mechanism they belong to.
    pub description: &'static Description,
}

/// Eigenvalues closer than this, relative to the larger, form a cluster.
const CLUSTER_GAP: f64 = 1e-6;

/// Puts the derivatives of `lambda` together with those of the frequencies; refuses what is not finite.
fn assemble<const N: usize, const U: usize, const P: usize>(
    at: &Equilibrium<N, U, P>,
    modes: &Modes<N>,
    method: Method,
    lambda: impl Fn(usize) -> ([f64; U], [f64; P]),
) -> Result<Sensitivities<N, U, P>, Error> {
    let clustered = clusters(modes, CLUSTER_GAP);
    let sensitivities: [ModeSensitivity<U, P>; N] = core::array::from_fn(|r| {
        let (by_input, by_design) = lambda(r);
        let omega = modes.modes[r].frequency();
        ModeSensitivity {
            lambda_by_input: by_input,
            lambda_by_design: by_design,
            omega_by_input: omega.map(|omega| by_input.map(|rate| rate / (2.0 * omega))),
            omega_by_design: omega.map(|omega| by_design.map(|rate| rate / (2.0 * omega))),
            clustered: clustered[r],
        }
    });
    if !sensitivities.iter().all(ModeSensitivity::finite) {
        return Err(shift::outside_domain(at));
    }
    Ok(Sensitivities {
        modes: sensitivities,
        method,
        description: modes.description,
    })
}

/// The gradient of `phi^T (Khat - lambda Mhat) phi` for one mode.
fn mode_gradient<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    mechanism: &M,
    at: &Equilibrium<N, U, P>,
    modes: &Modes<N>,
    r: usize,
) -> crate::Gradient<f64, N, U, P>
where
    M: Mechanism<N, U, P, O>,
{
    let mode = &modes.modes[r];
    mechanism.mode_gradient(
        &at.coordinates,
        &at.inputs,
        &at.design,
        &mode.shape,
        mode.lambda,
    )
}
