//! Results common to all methods.

use crate::algebra::{Matrix, Vector};
use crate::judge::Doubt;
use crate::response::Response;
use crate::tolerance::{Counts, Points};
use crate::{Description, Shared};

/// Probabilities of the reported quantiles: the median, and those of a normal variable at 1, 2 and 3 standard
/// deviations on either side.
pub const QUANTILES: [f64; 7] = [
    0.001_349_898_031_630_094_6,
    0.022_750_131_948_179_21,
    0.158_655_253_931_457_05,
    0.5,
    0.841_344_746_068_543,
    0.977_249_868_051_820_8,
    0.998_650_101_968_369_9,
];

/// An estimate and its error.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Estimated {
    /// The estimate.
    #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
    pub value: f64,
    /// Its error according to the method: one standard error for a sampled value. `None` if nothing is known about it.
    /// A standard error from few randomisations is itself uncertain: with 8 of them, 95 % of the values lie within 2.4
    /// of it.
    #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
    pub error: Option<f64>,
}

impl Estimated {
    pub(super) fn new(value: f64, error: Option<f64>) -> Self {
        Self { value, error }
    }
}

/// The value below which a response lies with a given probability.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Quantile {
    /// The probability.
    pub probability: f64,
    /// The value, in the unit of the response.
    pub value: f64,
    /// Its error, as in [`Estimated`].
    #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
    pub error: Option<f64>,
}

/// The spread of a response over the designs that have it. Values are in its SI unit.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ResponseSpread {
    /// Value at the nominal design; `None` if it has none there.
    pub nominal: Option<f64>,
    /// Mean.
    pub mean: Estimated,
    /// Standard deviation; `None` for a single value.
    pub sigma: Option<Estimated>,
    /// Third central moment over the cube of the standard deviation; `None` if nothing varies.
    pub skewness: Option<Estimated>,
    /// Quantiles for [`QUANTILES`]; empty if the method gives none.
    pub quantiles: Vec<Quantile>,
    /// Fraction of the designs that have the response, between 0 and 1.
    pub share: f64,
}

impl ResponseSpread {
    /// The same, with nothing known about the errors.
    pub(super) fn without_errors(mut self) -> Self {
        self.mean.error = None;
        for one in [&mut self.sigma, &mut self.skewness].into_iter().flatten() {
            one.error = None;
        }
        for quantile in &mut self.quantiles {
            quantile.error = None;
        }
        self
    }
}

/// The method behind a result.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Method {
    /// [`first_order`](super::first_order).
    FirstOrder,
    /// [`second_order`](super::second_order).
    SecondOrder,
    /// [`sampled`](super::sampled).
    Sampled(Points),
    /// [`vibrations`](super::vibrations).
    Resolvent(Points),
}

eigentol_solve::worded! {
    Method {
        Self::FirstOrder => "first order",
        Self::SecondOrder => "second order",
        Self::Sampled(Points::Random) => "random samples",
        Self::Sampled(Points::LatinHypercube) => "Latin hypercube samples",
        Self::Sampled(Points::Sobol) => "samples at scrambled Sobol' points",
        Self::Resolvent(_) => "samples of the resolvent near the nominal design",
    }
}

/// The spread of responses due to tolerances.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Propagation {
    /// The method used.
    pub method: Method,
    /// The reason for this method; empty if it was requested explicitly.
    pub reason: String,
    /// The responses requested.
    pub wanted: Vec<Response>,
    /// One per response; `None` if no design has it, or if the derivatives that the method needs do not exist.
    pub spreads: Vec<Option<ResponseSpread>>,
    /// For each response the doubts that distances raise about the model. Samples need no model and have none.
    /// Where there are doubts, nothing is known about the errors.
    pub doubts: Vec<Vec<Doubt>>,
    /// Covariances of responses, SI, over the designs that have both; `None` if no two designs do.
    pub covariance: Matrix<Option<f64>>,
    /// Covariance of each response, by row, with each design variable, SI.
    pub with_design: Matrix<Option<f64>>,
    /// Number of designs evaluated.
    pub evaluations: u64,
    /// Outcomes of the designs.
    pub counts: Counts,
    /// The inputs of the operating point, SI.
    pub inputs: Vector,
    /// The mechanism they belong to.
    pub description: Shared<Description>,
}

impl Propagation {
    /// The same, in doubt: without the errors of the spreads that are.
    pub(super) fn doubted(mut self, doubts: Vec<Vec<Doubt>>) -> Self {
        for (spread, doubts) in self.spreads.iter_mut().zip(&doubts) {
            if !doubts.is_empty() {
                *spread = spread.take().map(ResponseSpread::without_errors);
            }
        }
        Self { doubts, ..self }
    }

    /// Correlation of two responses, between -1 and 1; `None` if either does not vary.
    #[must_use]
    pub fn correlation(&self, first: usize, second: usize) -> Option<f64> {
        let sigma = |k: usize| Some(self.spreads.get(k)?.as_ref()?.sigma?.value);
        let product = sigma(first)? * sigma(second)?;
        let coefficient = self.covariance[first][second]? / product;
        (product > 0.0 && coefficient.is_finite()).then(|| coefficient.clamp(-1.0, 1.0))
    }
}
