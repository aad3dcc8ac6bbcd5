//! The kinds of requirements.

use crate::arguments::check_input;
use crate::kernels::Kernels;
use crate::response::{Response, Responses};
use crate::tolerance::Outcome;
use crate::{Equilibrium, Error, Input};

/// A requirement on a design. Numbers are in the SI unit of the response.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Requirement {
    /// A response lies in a band, ends included; either end may be infinite.
    Within {
        /// The response.
        response: Response,
        /// Low end.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
        low: f64,
        /// High end.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
        high: f64,
    },
    /// A response lies outside a forbidden band or on one of its ends; either end may be infinite.
    Outside {
        /// The response.
        response: Response,
        /// Low end.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
        low: f64,
        /// High end.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
        high: f64,
    },
    /// A response stays away from a multiple of an input, such as a frequency from an engine order: outside the band from
    /// `(1 - fraction) order u` to `(1 + fraction) order u` or on one of its ends. If the input deviates
    /// ([`DeviatingInputs`](crate::kernels::DeviatingInputs)), the band moves with it.
    Away {
        /// The response.
        response: Response,
        /// The input `u`, rad/s in SI for a frequency.
        input: Input,
        /// The multiple; its sign does not matter.
        order: f64,
        /// Half-width of the band as a fraction of its centre.
        fraction: f64,
    },
    /// The equilibrium is stable: the design has [`Outcome::Stable`].
    ///
    /// Stability is not a number, so it has a probability but no design point. For a design point, require a critical
    /// value of an input beyond the operating point ([`Response::Critical`]).
    Stable,
}

impl Requirement {
    /// Requires a response to be at least `low`.
    #[must_use]
    pub fn at_least(response: Response, low: f64) -> Self {
        let high = f64::INFINITY;
        Self::Within { response, low, high }
    }

    /// Requires a response to be at most `high`.
    #[must_use]
    pub fn at_most(response: Response, high: f64) -> Self {
        let low = f64::NEG_INFINITY;
        Self::Within { response, low, high }
    }

    /// Requires a response to stay away from the value of an input by a fraction of it.
    #[must_use]
    pub fn away(response: Response, input: Input, fraction: f64) -> Self {
        Self::Away { response, input, order: 1.0, fraction }
    }

    /// The response it constrains, if any.
    #[must_use]
    pub fn response(&self) -> Option<Response> {
        match self {
            Self::Within { response, .. } | Self::Outside { response, .. } | Self::Away { response, .. } => {
                Some(*response)
            }
            Self::Stable => None,
        }
    }

    /// Distance of a design from failing it, negative in failure; infinite where only the side is known, as for a design
    /// without a stable equilibrium, which fails every requirement on its state. `None` if the response needed to tell
    /// is missing.
    pub(super) fn distance(
        &self,
        responses: &Responses<'_>,
        design: &[f64],
        outcome: Outcome,
        value: Option<f64>,
    ) -> Option<f64> {
        let Some(response) = self.response() else {
            let stable = outcome == Outcome::Stable;
            return Some(if stable { 1.0 } else { -1.0 } * f64::INFINITY);
        };
        let lost = response.of_state() && outcome.lost();
        let inputs = &responses.nominal().inputs;
        let of = |limit: Self| {
            let band = limit.band(responses.mechanism(), inputs, design);
            let distance = value.map(|value| beyond(band, value));
            if lost {
                Some(distance.filter(|distance| *distance <= 0.0).unwrap_or(f64::NEG_INFINITY))
            } else {
                distance
            }
        };
        let mut limits = self.limits().into_iter();
        limits.try_fold(f64::INFINITY, |least, limit| Some(least.min(of(limit)?)))
    }

    /// What it is made of: requirements that fail in a single band of values.
    pub(crate) fn limits(&self) -> Vec<Self> {
        let (response, low, high) = match *self {
            Self::Stable => return Vec::new(),
            Self::Within { response, low, high } => (response, low, high),
            Self::Outside { response, low, high } if low.is_infinite() || high.is_infinite() => (response, high, low),
            Self::Outside { .. } | Self::Away { .. } => return vec![*self],
        };
        let low = low.is_finite().then(|| Self::at_least(response, low));
        let high = high.is_finite().then(|| Self::at_most(response, high));
        low.into_iter().chain(high).collect()
    }

    /// The ends of the values that fail, SI, for one of [`limits`](Self::limits) in a design.
    pub(crate) fn band(&self, mechanism: &dyn Kernels, inputs: &[f64], design: &[f64]) -> (f64, f64) {
        match *self {
            Self::Within { low, .. } if low.is_finite() => (f64::NEG_INFINITY, low),
            Self::Within { high, .. } => (high, f64::INFINITY),
            Self::Outside { low, high, .. } => (low, high),
            Self::Away { input, order, fraction, .. } => {
                let actual = actual(mechanism, input.index(), inputs, design);
                let centre = (order * actual).abs();
                (centre * (1.0 - fraction), centre * (1.0 + fraction))
            }
            Self::Stable => (f64::INFINITY, f64::NEG_INFINITY),
        }
    }

    /// Derivatives of these ends with respect to the value of an input.
    pub(crate) fn band_slopes(
        &self,
        mechanism: &dyn Kernels,
        inputs: &[f64],
        design: &[f64],
        input: usize,
    ) -> (f64, f64) {
        match *self {
            Self::Away { order, fraction, .. } if self.moves_with(input) => {
                let rate = order * (order * actual(mechanism, input, inputs, design)).signum();
                (rate * (1.0 - fraction), rate * (1.0 + fraction))
            }
            _ => (0.0, 0.0),
        }
    }

    /// Whether its band moves with an input.
    pub(crate) fn moves_with(&self, input: usize) -> bool {
        matches!(self, Self::Away { input: own, .. } if own.index() == input)
    }

    pub(super) fn check(&self, mechanism: &dyn Kernels, at: &Equilibrium) -> Result<(), Error> {
        let refuse = |reason: String| Err(Error::setting("requirement", reason));
        match *self {
            Self::Stable => Ok(()),
            Self::Within { low, high, .. } | Self::Outside { low, high, .. } => {
                if low.is_nan() || high.is_nan() || low >= high {
                    return refuse(format!("the band from {low} to {high} is empty"));
                }
                let limits = self.limits();
                if limits.is_empty() {
                    return refuse("a band without a finite end asks for nothing".to_owned());
                }
                let band = |this: &Self| this.band(mechanism, &at.inputs, &at.design);
                let all = |(low, high): (f64, f64)| low <= 0.0 && high == f64::INFINITY;
                match self.response().filter(|x| x.never_negative()) {
                    Some(response) if limits.iter().map(band).any(all) => refuse(format!(
                        "the upper limit of `{}`, which is never below zero, must be positive",
                        response.name(&at.description)
                    )),
                    _ => Ok(()),
                }
            }
            Self::Away { input, order, fraction, .. } => {
                check_input(input, &at.description)?;
                let (low, high) = self.band(mechanism, &at.inputs, &at.design);
                if !(fraction > 0.0 && fraction.is_finite()) {
                    return refuse(format!("its fraction {fraction} must be positive"));
                }
                if !order.is_finite() {
                    return refuse(format!("its order {order} must be finite"));
                }
                if !(low.is_finite() && high.is_finite()) {
                    return refuse(format!(
                        "order {order} and fraction {fraction} take it beyond the range of a double"
                    ));
                }
                Ok(())
            }
        }
    }
}

/// The actual value of an input, its deviation included.
pub(crate) fn actual(mechanism: &dyn Kernels, input: usize, inputs: &[f64], design: &[f64]) -> f64 {
    inputs[input] + mechanism.deviation(input, design)
}

/// Distance of a value from a band, negative inside.
pub(crate) fn beyond((low, high): (f64, f64), value: f64) -> f64 {
    (low - value).max(value - high)
}
