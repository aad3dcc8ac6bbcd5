//! Spread to second order: what the curvature of a frequency adds to its first-order spread, and whether first order
//! holds.

use super::curvature::{ModeCurvature, mode_curvatures};
use super::nonlinearity::Nonlinearity;
use super::quadratic::{ModelMoments, Quadratic};
use crate::algebra::Vector;
use crate::kernels::CurvatureKernels;
use crate::modes::Family;
use crate::sensitivity::{Quantity, sensitivities};
use crate::tolerance::Doubt;
use crate::tolerance::{Tolerances, first_order};
use crate::{Description, Equilibrium, Error, Modes, Shared, Watch};

/// A quantity of a mode to second order.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SecondOrderSpread {
    /// Value, gradient and Hessian with respect to the design variables.
    pub model: Shared<Quadratic>,
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
    /// For each mode, the doubts that distances raise ([`FirstOrder::doubts`](crate::tolerance::FirstOrder::doubts)): a
    /// series does not converge beyond a critical state, and describes no mode that mixes with another.
    pub doubts: Vec<Vec<Doubt>>,
    /// Number of standard deviations that a tolerance represents.
    pub sigma_level: f64,
    /// Whether any variable has a tolerance.
    pub varies: bool,
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
    of_each(mechanism, (at, modes), blocks(mechanism, (at, modes), tolerances).flatten().collect(), tolerances)
}

/// Like [`second_order`], but `watch` can stop it.
pub fn second_order_watched(
    mechanism: &dyn CurvatureKernels,
    (at, modes): (&Equilibrium, &Modes),
    tolerances: &Tolerances,
    watch: Watch<'_>,
) -> Result<SecondOrder, Error> {
    let mut all = Vec::new();
    for block in blocks(mechanism, (at, modes), tolerances) {
        all.extend(block);
        if watch.stopped() {
            return Err(Error::Stopped);
        }
    }
    Ok(of_each(mechanism, (at, modes), all, tolerances))
}

/// Modes whose curvature is computed together, sharing the motion of the state.
const TOGETHER: usize = 32;

/// The spreads of all modes, block by block.
fn blocks<'a>(
    mechanism: &'a dyn CurvatureKernels,
    (at, modes): (&'a Equilibrium, &'a Modes),
    tolerances: &'a Tolerances,
) -> impl Iterator<Item = Vec<Result<ModeSecondOrder, Error>>> + 'a {
    let count = modes.modes.len();
    let starts = (0..count).step_by(TOGETHER);
    let mut undamped = None;
    starts.map(move |start| {
        let block = start..count.min(start + TOGETHER);
        let mode_curvatures = mode_curvatures(mechanism, at, modes, block).into_iter();
        mode_curvatures.map(|item| mode_second_order(&item?, modes, tolerances, &mut undamped)).collect()
    })
}

fn of_each(
    mechanism: &dyn CurvatureKernels,
    (at, modes): (&Equilibrium, &Modes),
    all: Vec<Result<ModeSecondOrder, Error>>,
    tolerances: &Tolerances,
) -> SecondOrder {
    let first = sensitivities(mechanism, at, modes).and_then(|slopes| first_order(modes, &slopes, tolerances));
    // Without derivatives there is no second order either, and each mode says why.
    let doubts = |mode| first.as_ref().map_or_else(|_| Vec::new(), |first| first.doubts(mode));
    SecondOrder {
        doubts: (0..all.len()).map(doubts).collect(),
        modes: all,
        sigma_level: tolerances.sigma_level(),
        varies: tolerances.vary(),
        inputs: at.inputs.clone(),
        description: at.description.clone(),
    }
}

/// The quantities of one mode to second order; `undamped` keeps what all undamped modes share.
fn mode_second_order(
    curvature: &ModeCurvature,
    modes: &Modes,
    tolerances: &Tolerances,
    undamped: &mut Option<SecondOrderSpread>,
) -> Result<ModeSecondOrder, Error> {
    let mode = curvature.mode;
    let lambda = modes.modes[mode].lambda;
    let spread = |quantity| {
        let second_order = second_order_spread(curvature, quantity, tolerances).transpose();
        second_order.unwrap_or(Err(Error::NotOscillating { mode, lambda }))
    };
    let frequency = spread(Quantity::Frequency)?;
    if modes.family == Family::General {
        return Ok(ModeSecondOrder {
            frequency,
            natural_frequency: spread(Quantity::NaturalFrequency)?,
            damping_ratio: spread(Quantity::DampingRatio)?,
        });
    }
    // Without damping, the two frequencies are one, and all damping ratios are zero.
    let damping_ratio = match undamped {
        Some(known) => known.clone(),
        None => undamped.insert(spread(Quantity::DampingRatio)?).clone(),
    };
    Ok(ModeSecondOrder { natural_frequency: frequency.clone(), frequency, damping_ratio })
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
    let moments = model.moments(tolerances)?;
    Ok(Some(SecondOrderSpread { nonlinearity: moments.nonlinearity(), moments, model: model.into() }))
}
