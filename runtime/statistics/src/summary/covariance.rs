//! Reported statistics of a pair of quantities.

use super::Comoments;

/// Two quantities over the samples that have both.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Covariance {
    /// Number of samples that have both.
    pub count: u64,
    /// Means over these samples, each in the unit of its quantity.
    pub means: [f64; 2],
    /// Standard deviations over these samples, with divisor `count - 1`; `None` for a single sample.
    pub sigmas: Option<[f64; 2]>,
    /// Covariance with divisor `count - 1`, in the product of both units; `None` for a single sample.
    pub covariance: Option<f64>,
    /// Pearson correlation, between -1 and 1; `None` if either does not vary.
    pub correlation: Option<f64>,
}

impl Covariance {
    /// Computes the statistics of a pair of quantities; `None` if no sample has both.
    #[must_use]
    pub fn of(comoments: &Comoments) -> Option<Self> {
        let Comoments { count, means, squares, product } = *comoments;
        let finite = |value: f64| value.is_finite().then_some(value);
        let divisor = (count > 1).then(|| (count - 1) as f64);
        let [x, y] = squares.map(f64::sqrt);
        let sigmas = divisor
            .map(|divisor| [x, y].map(|root| root / divisor.sqrt()))
            .filter(|sigmas| sigmas.iter().all(|sigma| sigma.is_finite()));
        (count > 0).then(|| Self {
            count,
            means: means.map(|mean| mean.high),
            sigmas,
            covariance: divisor.and_then(|divisor| finite(product / divisor)),
            correlation: finite(product / x / y).map(|value| value.clamp(-1.0, 1.0)),
        })
    }
}
