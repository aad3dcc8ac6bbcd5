//! How probable it is that a quantity of a mode lies in a forbidden band: a frequency within 10 % of the running speed, a
//! growth above zero.

use super::{Margin, Tolerances, margin};
use crate::sensitivity::{Quantity, mode_curvature};
use crate::{Description, Equilibrium, Error, Input, Mechanism, Modes};

/// A band of values to keep clear of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Band {
    /// Between two values, SI; either may be infinite.
    Between {
        /// Low end, SI.
        low: f64,
        /// High end, SI.
        high: f64,
    },
    /// Within a fraction of a multiple of an input: from `(1 - fraction) order u` to `(1 + fraction) order u`.
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
    pub fn around(input: Input, fraction: f64) -> Self {
        Self::Around {
            input,
            order: 1.0,
            fraction,
        }
    }

    /// Ends of the band, rad/s, low end first.
    fn ends(self, inputs: &[f64]) -> Option<(f64, f64)> {
        Some(match self {
            Self::Between { low, high } => (low, high),
            Self::Around {
                input,
                order,
                fraction,
            } => {
                let centre = (order * inputs.get(input.0)?).abs();
                (centre * (1.0 - fraction), centre * (1.0 + fraction))
            }
        })
    }

    /// Refuses a band about something infinite; what is between two values is checked where it is used.
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

    /// How the ends move with an input.
    fn slopes(self, inputs: &[f64], input: usize) -> (f64, f64) {
        match self {
            Self::Around {
                input: own,
                order,
                fraction,
            } if own.0 == input => {
                let rate = order * (order * inputs[input]).signum();
                (rate * (1.0 - fraction), rate * (1.0 + fraction))
            }
            _ => (0.0, 0.0),
        }
    }
}

/// The margin of a quantity of a mode against a forbidden band.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ModeMargin<const U: usize, const P: usize> {
    /// Position of the mode, from 0.
    pub mode: usize,
    /// What is looked at.
    pub quantity: Quantity,
    /// What it keeps clear of.
    pub band: Band,
    /// Probabilities, distance, derivatives by design variables and half-widths; SI.
    pub margin: Margin<P>,
    /// Total derivatives of the first-order probability by each input, by SI unit: the quantity, its standard deviation
    /// and a band around the input all move. `None` where [`Margin::derivatives`] is.
    pub by_input: Option<[f64; U]>,
    /// The mechanism it belongs to.
    pub description: &'static Description,
}

/// Probability that a quantity of mode number `mode` lies in a forbidden band, to first order and corrected, with its
/// sensitivities. [`Quantity::Growth`] between zero and infinity is the probability that the mode is unstable.
///
/// # Errors
/// [`Error::NotOscillating`] for a mode without that quantity, [`Error::ClusteredMode`], [`Error::CriticalState`], [`Error::OutsideDomain`],
/// [`Error::NoSuchMode`], [`Error::UnknownHandle`], [`Error::Setting`] for a band without sense.
pub fn mode_margin<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    mechanism: &M,
    at: &Equilibrium<N, U, P>,
    modes: &Modes<N>,
    (mode, quantity): (usize, Quantity),
    tolerances: &Tolerances<P>,
    band: Band,
) -> Result<ModeMargin<U, P>, Error>
where
    M: Mechanism<N, U, P, O>,
{
    let description = at.description;
    let Some(ends) = band.ends(&at.inputs) else {
        let Band::Around { input, .. } = band else {
            unreachable!("a fixed band has ends")
        };
        return Err(Error::UnknownHandle {
            kind: "input",
            index: input.0,
            mechanism: description.name,
            count: U,
        });
    };
    band.check(ends)?;
    let curvature = mode_curvature(mechanism, at, modes, mode)?;
    let lambda = modes.modes[mode].lambda;
    let silent = Error::NotOscillating { mode, lambda };
    let model = curvature.quadratic(quantity).ok_or(silent.clone())?;
    let first = curvature.first.of(quantity).ok_or(silent.clone())?;
    let mixed = curvature.of(quantity).ok_or(silent)?.by_input_and_design;
    let margin = margin(&model, tolerances, ends)?;
    let by_input = margin.derivatives.map(|derivatives| {
        core::array::from_fn(|k| {
            let sigma = tolerances.covariance(&first.by_design, &mixed[k]) / margin.sigma;
            let (low, high) = band.slopes(&at.inputs, k);
            derivatives.along(first.by_input[k], sigma, low, high)
        })
    });
    Ok(ModeMargin {
        mode,
        quantity,
        band,
        margin,
        by_input,
        description,
    })
}
