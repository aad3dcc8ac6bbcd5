//! Spread to second order: what the curvature of a frequency adds to its first-order spread, and whether first order
//! holds.

use super::curvature::{ModeCurvature, mode_curvature};
use super::nonlinearity::Nonlinearity;
use super::quadratic::{ModelMoments, Quadratic};
use crate::algebra::Vector;
use crate::kernels::CurvatureKernels;
use crate::sensitivity::Quantity;
use crate::tolerance::Tolerances;
use crate::{Description, Equilibrium, Error, Modes, Shared, Watch};

/// A quantity of a mode to second order.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SecondOrderSpread {
    /// Value, gradient and Hessian with respect to the design variables.
    pub model: Quadratic,
    /// Mean, standard deviation, skewness and kurtosis of that model.
    pub moments: ModelMoments,
    /// The contributions of curvature to mean and standard deviation, relative to the first-order standard deviation.
    pub nonlinearity: Nonlinearity,
}

/// A mode to second order.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ModeSecondOrder {
    /// Frequency `Im s`, rad/s.
    pub frequency: SecondOrderSpread,
    /// Natural frequency `|s|`, rad/s.
    pub natural_frequency: SecondOrderSpread,
    /// Damping ratio.
    pub damping_ratio: SecondOrderSpread,
}

/// All modes to second order.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SecondOrder {
    /// One result per mode, in order; an error for a mode that does not oscillate or has no derivatives of its own.
    pub modes: Vec<Result<ModeSecondOrder, Error>>,
    /// Number of standard deviations that a tolerance represents.
    pub sigma_level: f64,
    /// The inputs of the operating point, SI.
    pub inputs: Vector,
    /// The mechanism they belong to.
    pub description: Shared<Description>,
}

impl ModeCurvature {
    /// The second-order model of a quantity in the design variables; `None` if the mode has no such quantity.
    #[must_use]
    pub fn quadratic(&self, quantity: Quantity) -> Option<Quadratic> {
        Some(Quadratic {
            value: quantity.value(self.s),
            slopes: self.first.of(quantity)?.by_design,
            curvature: self.of(quantity)?.by_design,
        })
    }
}

/// Second-order spread of every mode: exact mean and variance of the second-order model of each quantity under normally
/// distributed design variables.
pub fn second_order(
    mechanism: &dyn CurvatureKernels,
    at: &Equilibrium,
    modes: &Modes,
    tolerances: &Tolerances,
) -> SecondOrder {
    let one = |mode: usize| mode_second_order(mechanism, at, modes, mode, tolerances);
    of_each((0..modes.modes.len()).map(one).collect(), at, tolerances)
}

/// Like [`second_order`], but `watch` can stop it.
pub(crate) fn second_order_watched(
    mechanism: &dyn CurvatureKernels,
    (at, modes): (&Equilibrium, &Modes),
    tolerances: &Tolerances,
    watch: Watch<'_>,
) -> Result<SecondOrder, Error> {
    let one = |mode: usize| match watch.stopped() {
        true => Err(Error::Stopped),
        false => Ok(mode_second_order(mechanism, at, modes, mode, tolerances)),
    };
    let all = (0..modes.modes.len()).map(one).collect::<Result<_, _>>()?;
    Ok(of_each(all, at, tolerances))
}

fn of_each(
    modes: Vec<Result<ModeSecondOrder, Error>>,
    at: &Equilibrium,
    tolerances: &Tolerances,
) -> SecondOrder {
    SecondOrder {
        modes,
        sigma_level: tolerances.sigma_level(),
        inputs: at.inputs.clone(),
        description: at.description.clone(),
    }
}

fn mode_second_order(
    mechanism: &dyn CurvatureKernels,
    at: &Equilibrium,
    modes: &Modes,
    mode: usize,
    tolerances: &Tolerances,
) -> Result<ModeSecondOrder, Error> {
    let curvature = mode_curvature(mechanism, at, modes, mode)?;
    let lambda = modes.modes[mode].lambda;
    let spread = |quantity| {
        let found = second_order_spread(&curvature, quantity, tolerances).transpose();
        found.unwrap_or(Err(Error::NotOscillating { mode, lambda }))
    };
    Ok(ModeSecondOrder {
        frequency: spread(Quantity::Frequency)?,
        natural_frequency: spread(Quantity::NaturalFrequency)?,
        damping_ratio: spread(Quantity::DampingRatio)?,
    })
}

/// The spread of one quantity; `None` if the mode has no such quantity.
fn second_order_spread(
    curvature: &ModeCurvature,
    quantity: Quantity,
    tolerances: &Tolerances,
) -> Result<Option<SecondOrderSpread>, Error> {
    let Some(model) = curvature.quadratic(quantity) else {
        return Ok(None);
    };
    Ok(Some(SecondOrderSpread {
        moments: model.moments(tolerances)?,
        nonlinearity: model.nonlinearity(tolerances)?,
        model,
    }))
}
