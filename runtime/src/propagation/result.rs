//! What every method gives.

use crate::algebra::{Matrix, Vector};
use crate::response::Response;
use crate::tolerance::Counts;
use crate::{Description, Shared};

use super::Points;

/// Probabilities of the quantiles that are reported: the median, and what 1, 2 and 3 standard deviations of a normal variable leave on
/// either side.
pub const QUANTILES: [f64; 7] = [
    0.001_349_898_031_630_094_6,
    0.022_750_131_948_179_21,
    0.158_655_253_931_457_05,
    0.5,
    0.841_344_746_068_543,
    0.977_249_868_051_820_8,
    0.998_650_101_968_369_9,
];

/// A number and how far it may be off.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Estimated {
    /// The estimate.
    #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
    pub value: f64,
    /// Its error, by the method's own estimate: one standard error of a sampled value. `None` where nothing is known of it.
    #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
    pub error: Option<f64>,
}

impl Estimated {
    pub(super) fn new(value: f64, error: Option<f64>) -> Self {
        Self { value, error }
    }
}

/// The value below which a response lies with some probability.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Quantile {
    /// The probability.
    pub probability: f64,
    /// The value, in the unit of the response.
    pub value: f64,
    /// Its error, as of [`Estimated`].
    #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
    pub error: Option<f64>,
}

/// How a response is spread, over the designs that have it. Values are in its SI unit.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ResponseSpread {
    /// Value at the nominal design; `None` where it has none.
    pub nominal: Option<f64>,
    /// Mean.
    pub mean: Estimated,
    /// Standard deviation; `None` of a single value.
    pub sigma: Option<Estimated>,
    /// Third central moment over the cube of the standard deviation; `None` where nothing varies.
    pub skewness: Option<Estimated>,
    /// Quantiles for [`QUANTILES`]; empty where the method has none.
    pub quantiles: Vec<Quantile>,
    /// Share of the designs that have it, between 0 and 1.
    pub share: f64,
}

/// Where a result comes from.
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
    /// [`quadrature`](super::quadrature) on the tensor product of rules of so many nodes.
    Tensor {
        /// Nodes for each variable.
        nodes: usize,
    },
    /// [`quadrature`](super::quadrature) on a sparse grid of such a level.
    Sparse {
        /// The level.
        level: usize,
    },
}

/// How tolerances spread responses.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Propagation {
    /// How it was found.
    pub method: Method,
    /// Why it was found that way; empty where it was asked for.
    pub reason: String,
    /// What was asked for.
    pub wanted: Vec<Response>,
    /// By response; `None` for one that no design has.
    pub spreads: Vec<Option<ResponseSpread>>,
    /// Covariances of responses, SI, over the designs that have both; `None` where no two designs have.
    pub covariance: Matrix<Option<f64>>,
    /// Covariance of each response, by row, with each design variable, SI.
    pub with_design: Matrix<Option<f64>>,
    /// Designs that were evaluated.
    pub evaluations: u64,
    /// What became of them.
    pub counts: Counts,
    /// The inputs they belong to, SI.
    pub inputs: Vector,
    /// The mechanism they belong to.
    pub description: Shared<Description>,
}

impl Propagation {
    /// Correlation of two responses, between -1 and 1; `None` where either does not vary.
    #[must_use]
    pub fn correlation(&self, first: usize, second: usize) -> Option<f64> {
        let sigma = |k: usize| Some(self.spreads.get(k)?.as_ref()?.sigma?.value);
        let product = sigma(first)? * sigma(second)?;
        let found = self.covariance[first][second]? / product;
        (product > 0.0 && found.is_finite()).then(|| found.clamp(-1.0, 1.0))
    }
}
