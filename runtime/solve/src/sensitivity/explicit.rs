//! Derivatives of all modes from explicit partial derivatives of the matrices: the method of eqs. 19-21, used to check
//! the adjoint, and the variant that ignores the shift of the equilibrium.

use core::borrow::Borrow;

use super::adjoint::normaliser;
use super::shift::equilibrium_shift;
use super::{Method, Sensitivities, Slopes, assemble, check_state};
use crate::algebra::{dot_complex, form};
use crate::kernels::{Kernels, Linear, PartialMatrices};
use crate::modes::{Family, pencil_times};
use crate::shafts::{ShaftsAlong, refuse};
use crate::{Complex, Equilibrium, Error, Mode, Modes};

/// Total derivatives of every mode from explicit partials and the shift (eqs. 19-21 completed).
///
/// # Errors
/// [`Error::CriticalState`] if `Khat` is singular, [`Error::OutsideDomain`] if a derivative is not finite, [`Error::NotWithShafts`].
pub fn sensitivities_explicit(
    mechanism: &dyn Kernels,
    at: &Equilibrium,
    modes: &Modes,
) -> Result<Sensitivities, Error> {
    refuse(&mechanism.description(), "derivatives of the matrices")?;
    let shift = equilibrium_shift(mechanism, at)?;
    let partials = partials_at(mechanism, at);
    assemble(at, modes, Method::Explicit, |sensitivity, mode| {
        let rate = Rate::of(at, modes.family, mode, None);
        let mut slopes = rate.slopes(partials.matrices(partials.by_input()), partials.matrices(partials.by_design()));
        let by_coordinate = partials.matrices(partials.by_coordinate());
        for (i, change) in by_coordinate.enumerate() {
            let moved = rate.along(&change);
            for (total, by) in slopes.by_input.iter_mut().zip(&shift.by_input[i]) {
                *total += moved * by;
            }
            for (total, by) in slopes.by_design.iter_mut().zip(&shift.by_design[i]) {
                *total += moved * by;
            }
        }
        sensitivity.set(mode, modes.family, &slopes);
    })
}

/// Derivatives with the equilibrium held fixed, for comparison only.
///
/// **Not** the derivatives of the frequencies wherever the equilibrium moves: for the rotating pendulum above its
/// critical speed they are -1/2 of the true ones.
///
/// # Errors
/// [`Error::OutsideDomain`] if a derivative is not finite, [`Error::NotWithShafts`].
pub fn sensitivities_with_frozen_equilibrium(
    mechanism: &dyn Kernels,
    at: &Equilibrium,
    modes: &Modes,
) -> Result<Sensitivities, Error> {
    check_state(mechanism, at)?;
    refuse(&mechanism.description(), "derivatives of the matrices")?;
    let partials = partials_at(mechanism, at);
    assemble(at, modes, Method::FrozenEquilibrium, |sensitivity, mode| {
        let rate = Rate::of(at, modes.family, mode, None);
        let slopes = rate.slopes(partials.matrices(partials.by_input()), partials.matrices(partials.by_design()));
        sensitivity.set(mode, modes.family, &slopes);
    })
}

fn partials_at(mechanism: &dyn Kernels, at: &Equilibrium) -> PartialMatrices {
    let mut partials = PartialMatrices::zeros(mechanism.sizes());
    mechanism.linear_partials_into(&at.coordinates, &at.inputs, &at.design, &mut partials);
    partials
}

/// How the eigenvalue of a mode changes with its matrices: `lambda` for an undamped mode, `s` for a general one.
#[doc(hidden)]
pub struct Rate<'a> {
    family: Family,
    mode: &'a Mode,
    scale: Complex,
}

impl<'a> Rate<'a> {
    #[doc(hidden)]
    pub fn of(at: &Equilibrium, family: Family, mode: &'a Mode, shafts: Option<&ShaftsAlong<'_>>) -> Self {
        let of_shafts = shafts.map_or(Complex::ZERO, |own| own.form(&own.slope, mode.left(), &mode.shape));
        Self { family, mode, scale: normaliser(at, None, mode) + of_shafts }
    }

    /// Derivative of the eigenvalue by a variable, as far as it is in the numbers of shafts.
    #[doc(hidden)]
    pub fn of_shafts(&self, shafts: &ShaftsAlong<'_>, variable: usize) -> Complex {
        -shafts.form(&shafts.by[variable][0], self.mode.left(), &self.mode.shape) / self.scale
    }

    /// Derivatives from the changes of the matrices with each variable.
    pub(crate) fn slopes<L: Borrow<Linear>>(
        &self,
        by_input: impl Iterator<Item = L>,
        by_design: impl Iterator<Item = L>,
    ) -> Slopes<Complex> {
        let slope = |change: L| self.along(change.borrow());
        Slopes { by_input: by_input.map(slope).collect(), by_design: by_design.map(slope).collect() }
    }

    /// Derivative along a change of the matrices: `phi^T (dK - lambda dM) phi` (eq. 20), and its counterpart for
    /// general modes.
    #[doc(hidden)]
    pub fn along(&self, change: &Linear) -> Complex {
        let mode = self.mode;
        match self.family {
            Family::Undamped => {
                let phi = &mode.real_shape();
                let stiffness = form(phi, &change.stiffness, phi);
                (stiffness - mode.lambda * form(phi, &change.mass, phi)).into()
            }
            Family::General => {
                let change = pencil_times(change, mode.place(), &mode.shape);
                -dot_complex(mode.left(), &change) / self.scale
            }
        }
    }
}
