//! Probability that a quantity of a mode lies in a forbidden band: a frequency within 10 % of the running speed, a
//! growth rate above zero.

use super::curvature::mode_curvature;
use super::margin::{Margin, margin};
use super::quadratic::Quadratic;
use crate::algebra::{Vector, add_scaled};
use crate::arguments::check_input;
use crate::clusters::groups;
use crate::judge::{Event, Judgement, Lines};
use crate::kernels::{CurvatureKernels, Kernels};
use crate::limits::Deviations;
use crate::response::{Realisation, Response, Responses};
use crate::sensitivity::Quantity;
use crate::tolerance::Tolerances;
use crate::{Description, Equilibrium, Error, Input, Modes, Shared};

/// A band of values to avoid.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Band {
    /// Between two values, SI; either may be infinite.
    Between {
        /// Low end, SI.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
        low: f64,
        /// High end, SI.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
        high: f64,
    },
    /// Within a fraction of a multiple of an input: from `(1 - fraction) order u` to `(1 + fraction) order u`. If the
    /// input deviates ([`DeviatingInputs`](crate::kernels::DeviatingInputs)), the band moves with it.
    Around {
        /// The input `u`, rad/s in SI.
        input: Input,
        /// Engine order.
        order: f64,
        /// Half-width of the band as a fraction of its centre.
        fraction: f64,
    },
}

impl Band {
    /// Within `fraction` of the value of an input.
    #[must_use]
    pub fn around(input: Input, fraction: f64) -> Self {
        Self::Around {
            input,
            order: 1.0,
            fraction,
        }
    }

    /// Ends of the band, rad/s, low end first.
    fn ends(self, mechanism: &dyn Kernels, at: &Equilibrium) -> Result<(f64, f64), Error> {
        match self {
            Self::Between { low, high } => Ok((low, high)),
            Self::Around {
                input,
                order,
                fraction,
            } => {
                check_input(input, &at.description)?;
                let centre = (order * actual(mechanism, at, input.index())).abs();
                Ok((centre * (1.0 - fraction), centre * (1.0 + fraction)))
            }
        }
    }

    /// Refuses an invalid band around an input; the ends of a [`Band::Between`] are checked where they are used.
    fn check(self, (low, high): (f64, f64)) -> Result<(), Error> {
        let Self::Around {
            order, fraction, ..
        } = self
        else {
            return Ok(());
        };
        let reason = if !(fraction > 0.0 && fraction.is_finite()) {
            format!("its fraction {fraction} must be positive")
        } else if !order.is_finite() {
            format!("its order {order} must be finite")
        } else if !(low.is_finite() && high.is_finite()) {
            format!("order {order} and fraction {fraction} take it beyond the range of a double")
        } else {
            return Ok(());
        };
        Err(Error::Setting {
            setting: "band",
            reason,
        })
    }

    /// Nominal over actual centre of the band in a design.
    fn shrinks(self, mechanism: &dyn Kernels, at: &Equilibrium, design: &[f64]) -> f64 {
        match self {
            Self::Around { input, .. } => {
                let nominal = actual(mechanism, at, input.index());
                let moved = mechanism.deviation(input.index(), design)
                    - mechanism.deviation(input.index(), &at.design);
                nominal / (nominal + moved)
            }
            Self::Between { .. } => 1.0,
        }
    }

    fn is_around(self, input: usize) -> bool {
        matches!(self, Self::Around { input: own, .. } if own.index() == input)
    }

    /// Derivatives of the ends with respect to an input.
    fn slopes(self, mechanism: &dyn Kernels, at: &Equilibrium, input: usize) -> (f64, f64) {
        match self {
            Self::Around {
                input: own,
                order,
                fraction,
            } if own.index() == input => {
                let rate = order * (order * actual(mechanism, at, input)).signum();
                (rate * (1.0 - fraction), rate * (1.0 + fraction))
            }
            _ => (0.0, 0.0),
        }
    }
}

/// The actual value of an input, its deviation included.
fn actual(mechanism: &dyn Kernels, at: &Equilibrium, input: usize) -> f64 {
    at.inputs[input] + mechanism.deviation(input, &at.design)
}

/// Relative derivatives of the reciprocal of the band's centre with respect to each design variable. For a deviation
/// `d` of the input the reciprocal is `u / (u + d)`, with `u` the present value of the input.
fn reciprocal_slopes(mechanism: &dyn Kernels, at: &Equilibrium, band: Band) -> Vector {
    let slope = |design: usize| match mechanism.input_of_deviation(design) {
        Some(input) if band.is_around(input) => -actual(mechanism, at, input).recip(),
        _ => 0.0,
    };
    Vector::from_fn(at.design.len(), slope)
}

/// The model of `f r`, where the reciprocal `r` has nominal value one and the given slopes. A quantity `f` lies in a
/// band about `u + d` exactly where `f u / (u + d)` lies in the band about `u`.
fn relative(model: &Quadratic, reciprocal: &[f64]) -> Quadratic {
    let (f, s, r) = (model.value, &model.slopes, reciprocal);
    let mut curvature = model.curvature.clone();
    for (i, row) in curvature.iter_mut().enumerate() {
        for (j, value) in row.iter_mut().enumerate() {
            *value += s[i] * r[j] + s[j] * r[i] + 2.0 * f * r[i] * r[j];
        }
    }
    Quadratic {
        value: f,
        slopes: add_scaled(s, f, r),
        curvature,
    }
}

/// The margin of a mode's quantity against a forbidden band.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ModeMargin {
    /// Position of the mode, from 0.
    pub mode: usize,
    /// The quantity.
    pub quantity: Quantity,
    /// The band to avoid.
    pub band: Band,
    /// Probabilities, distance, and derivatives with respect to design variables and half-widths; SI. If the band
    /// deviates, they refer to the quantity times the ratio of the band's nominal centre to its actual centre.
    pub margin: Margin,
    /// Total derivatives of the first-order probability with respect to each input, per SI unit: the quantity, its
    /// standard deviation and a band around the input all move. `None` where [`Margin::derivatives`] is.
    pub by_input: Option<Vector>,
    /// The probability by designs solved anew, which judges the other two.
    pub judgement: Judgement,
    /// The other modes that tolerances mix with this one ([`clusters`](crate::clusters::clusters)). If there are any, no
    /// series of this mode alone describes it, and neither model can be relied on.
    pub mixed_with: Vec<usize>,
    /// The inputs of the operating point, SI.
    pub inputs: Vector,
    /// The mechanism it belongs to.
    pub description: Shared<Description>,
}

impl ModeMargin {
    /// Whether designs solved anew confirm the second-order probability
    /// ([`Judged::confirms`](crate::judge::Judged::confirms)).
    #[must_use]
    pub fn verified(&self) -> bool {
        self.judgement.confirms(self.margin.corrected.value)
    }
}

/// Probability that a quantity of mode number `mode` lies in a forbidden band, to first and second order, with its
/// sensitivities, judged by designs solved anew. Designs without the quantity do not lie in the band.
///
/// With [`Quantity::Growth`] between zero and infinity it is the probability that the mode is unstable.
///
/// # Errors
/// [`Error::NotOscillating`] for a mode without that quantity, [`Error::ClusteredMode`], [`Error::CriticalState`],
/// [`Error::OutsideDomain`], [`Error::NoSuchMode`], [`Error::UnknownHandle`], [`Error::WrongLength`],
/// [`Error::Setting`] for an invalid band.
pub fn mode_margin(
    mechanism: &dyn CurvatureKernels,
    at: &Equilibrium,
    modes: &Modes,
    (mode, quantity): (usize, Quantity),
    tolerances: &Tolerances,
    band: Band,
) -> Result<ModeMargin, Error> {
    let ends = band.ends(mechanism, at)?;
    band.check(ends)?;
    let curvature = mode_curvature(mechanism, at, modes, mode)?;
    let lambda = modes.modes[mode].lambda;
    let silent = Error::NotOscillating { mode, lambda };
    let model = curvature.quadratic(quantity).ok_or(silent.clone())?;
    let reciprocal = reciprocal_slopes(mechanism, at, band);
    let model = relative(&model, &reciprocal);
    let first = curvature.first.of(quantity).ok_or(silent.clone())?;
    let mixed = curvature.of(quantity).ok_or(silent)?.by_input_and_design;
    let mut margin = margin(&model, tolerances, ends)?;
    let by_input = margin.derivatives.as_ref().map(|derivatives| {
        Vector::from_fn(at.inputs.len(), |k| {
            let (low, high) = band.slopes(mechanism, at, k);
            // The derivative of the reciprocal `u / (u + d)` with respect to `d` is `r = -1/u`, and the derivative of
            // `r` with respect to `u` is `r^2`.
            let bend = if band.is_around(k) { model.value } else { 0.0 };
            let slopes = Vector::from_fn(reciprocal.len(), |j| {
                mixed[k][j] + reciprocal[j] * (first.by_input[k] + bend * reciprocal[j])
            });
            let sigma = tolerances.covariance(&model.slopes, &slopes) / margin.sigma;
            derivatives.along(first.by_input[k], sigma, low, high)
        })
    });
    let groups = groups(mechanism, at, modes, tolerances)?;
    let own = groups.into_iter().find(|own| own.contains(&mode));
    let mut mixed_with = own.unwrap_or_default();
    mixed_with.retain(|other| *other != mode);
    let judgement = {
        let response = Response::Mode { mode, quantity };
        let responses = Responses::new(mechanism, at, modes, vec![response])?;
        let deviations = Deviations::new(tolerances, &at.design)?;
        let (low, high) = ends;
        let distance = |design: &[f64], found: &Realisation| {
            let value = found.values.first().copied().flatten()?;
            let value = value * band.shrinks(mechanism, at, design);
            Some((low - value).max(value - high))
        };
        let lines = Lines::along(&deviations, &model.slopes, margin.distance);
        Event::new(&responses, &deviations, &distance).judge(&lines)?
    };
    if let Some(judged) = judgement.judged() {
        let error = judged.error_of(margin.corrected.value);
        margin.corrected = margin.corrected.with_model_error(error);
    }
    Ok(ModeMargin {
        mode,
        judgement,
        mixed_with,
        quantity,
        band,
        margin,
        by_input,
        inputs: at.inputs.clone(),
        description: at.description.clone(),
    })
}
