//! Total derivatives of an equilibrium, its modes and the outputs with respect to inputs and design variables,
//! including the shift of the equilibrium (eqs. 19-21 completed).

mod adjoint;
mod answer;
#[doc(hidden)]
pub mod derivatives;
mod explicit;
mod finite_difference;
mod free_directions;
mod gradients;
mod mode;
mod outputs;
mod pencil;
mod quantity;
mod redundancy;
mod shift;

#[doc(hidden)]
pub use adjoint::Adjoint;
#[doc(hidden)]
pub use adjoint::normaliser;
pub use adjoint::sensitivities;
#[doc(hidden)]
pub use explicit::Rate;
pub use explicit::{sensitivities_explicit, sensitivities_with_frozen_equilibrium};
pub use finite_difference::sensitivities_by_finite_difference;
#[doc(hidden)]
pub use free_directions::{amplitude_depends, depends};
#[doc(hidden)]
pub use gradients::Source;
#[doc(hidden)]
pub use mode::root_rate;
pub use mode::{ModeSensitivity, Slopes};
pub use outputs::{OutputSensitivities, output_sensitivities};
#[doc(hidden)]
pub use pencil::{BilinearForm, ComplexGradient, Direction, form_gradient, form_gradients_along, subtract};
pub use quantity::Quantity;
#[doc(hidden)]
pub use quantity::{eigenvalue_curvature, eigenvalue_slope};
pub use shift::{EquilibriumShift, equilibrium_shift};
#[doc(hidden)]
pub use shift::{directions, outside_domain};

use crate::algebra::Vector;
use crate::arguments::check_count;
use crate::kernels::Kernels;
use crate::modes::{CLUSTER_GAP, Family, merged, near_another};
use crate::{Behaviour, Description, Equilibrium, Error, Mode, Modes, Shared};

/// How derivatives were computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Method {
    /// Adjoint: all variables at once.
    Adjoint,
    /// Explicit partial derivatives and the shift of the equilibrium.
    Explicit,
    /// Equilibrium held fixed: wrong wherever it moves; for comparison only.
    FrozenEquilibrium,
    /// Central differences of the matrices at re-solved equilibria.
    FiniteDifference,
}

crate::worded! {
    Method {
        Self::Adjoint => "exact (adjoint)",
        Self::Explicit => "exact (explicit partials)",
        Self::FrozenEquilibrium => "equilibrium frozen: NOT the true derivatives",
        Self::FiniteDifference => "central differences",
    }
}

/// Total derivatives of all modes at one equilibrium, in the order of the modes.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Sensitivities {
    /// One entry for each mode.
    pub modes: Vec<ModeSensitivity>,
    /// How they were computed.
    pub method: Method,
    /// The family of the modes.
    pub family: Family,
    /// The inputs they belong to, SI.
    pub inputs: Vector,
    /// The mechanism they belong to.
    pub description: Shared<Description>,
}

impl Sensitivities {
    /// Empty derivatives for these modes, to be overwritten.
    #[inline]
    #[doc(hidden)]
    pub fn blank(at: &Equilibrium, modes: &Modes, method: Method) -> Self {
        Self {
            modes: modes.modes.iter().map(|_| ModeSensitivity::blank()).collect(),
            method,
            family: modes.family,
            inputs: at.inputs.clone(),
            description: modes.description.clone(),
        }
    }
}

/// Calls `set` for every mode that has not merged with another, and refuses derivatives that are not finite.
fn assemble(
    at: &Equilibrium,
    modes: &Modes,
    method: Method,
    mut set: impl FnMut(&mut ModeSensitivity, &Mode),
) -> Result<Sensitivities, Error> {
    let mut sensitivities = Sensitivities::blank(at, modes, method);
    assemble_into(at, modes, &mut sensitivities, |sensitivity, (_, mode)| set(sensitivity, mode))?;
    Ok(sensitivities)
}

/// Like [`assemble`], overwriting derivatives of the same mechanism, family and method.
fn assemble_into(
    at: &Equilibrium,
    modes: &Modes,
    sensitivities: &mut Sensitivities,
    mut set: impl FnMut(&mut ModeSensitivity, (usize, &Mode)),
) -> Result<(), Error> {
    check_modes(at, modes)?;
    sensitivities.inputs.set(&at.inputs, |value| *value);
    sensitivities.modes.resize_with(modes.modes.len(), ModeSensitivity::blank);
    let mut finite = true;
    for (position, (sensitivity, mode)) in sensitivities.modes.iter_mut().zip(&modes.modes).enumerate() {
        if matches!(mode.behaviour, Behaviour::Free) {
            sensitivity.set_free(at.inputs.len(), at.design.len());
        } else if merged(modes, position) {
            sensitivity.set_merged(mode, at.inputs.len(), at.design.len());
        } else {
            set(sensitivity, (position, mode));
            sensitivity.clustered |= near_another(modes, position, CLUSTER_GAP);
        }
        finite &= sensitivity.finite();
    }
    if finite { Ok(()) } else { Err(shift::outside_domain(at)) }
}

/// Refuses a state of another mechanism.
pub fn check_state(mechanism: &dyn Kernels, at: &Equilibrium) -> Result<(), Error> {
    let sizes = mechanism.sizes();
    check_count("coordinates", &at.coordinates, sizes.coordinates)?;
    check_count("inputs", &at.inputs, sizes.inputs)?;
    check_count("design variables", &at.design, sizes.design)
}

/// Refuses modes of another mechanism.
pub fn check_modes(at: &Equilibrium, modes: &Modes) -> Result<(), Error> {
    let expected = at.coordinates.len();
    let mut lengths = modes.modes.iter().map(|mode| mode.shape.len());
    match lengths.find(|&length| length != expected) {
        None => Ok(()),
        Some(length) => Err(Error::WrongLength { kind: "components of a shape", found: length, expected }),
    }
}
