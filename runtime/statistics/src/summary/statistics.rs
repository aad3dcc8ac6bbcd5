//! Reported statistics of a single quantity.

use super::{Estimate, Interval, Moments, Sketch};
use crate::Error;

/// Statistics of one quantity over the samples that have it.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Statistics {
    /// Number of values.
    pub count: u64,
    /// Mean, in the unit of the quantity.
    pub mean: f64,
    /// Standard error of the mean; `None` for a single value.
    pub standard_error: Option<f64>,
    /// Standard deviation with divisor `count - 1`; `None` for a single value.
    pub sigma: Option<f64>,
    /// Standard error of `sigma`, from the fourth moment, for any distribution: the variance of `sigma^2` is
    /// `(m4 - (n - 3) / (n - 1) sigma^4) / n` (Rao, Linear Statistical Inference, 2nd edition, section 6h). `None` for
    /// a single value and if all values are equal.
    pub sigma_error: Option<f64>,
    /// Skewness, unbiased for normal values: `G1` of Joanes and Gill (1998); `None` for fewer than three values and if
    /// all values are equal.
    pub skewness: Option<f64>,
    /// Standard error of `skewness` for normal values (Cramér 1946, section 29.3); a much larger skewness indicates
    /// another distribution.
    pub skewness_error: Option<f64>,
    /// Excess kurtosis over the 3 of a normal distribution, unbiased for normal values: `G2` of Joanes and Gill (1998);
    /// `None` for fewer than four values and if all values are equal.
    pub excess_kurtosis: Option<f64>,
    /// Standard error of `excess_kurtosis` for normal values.
    pub kurtosis_error: Option<f64>,
    /// Smallest value.
    pub min: f64,
    /// Largest value.
    pub max: f64,
    sketch: Option<Sketch>,
}

impl Statistics {
    /// Computes statistics from moments, and from a sketch of the same values for quantiles.
    ///
    /// `None` if there are no values; a statistic too large to compute is also `None`.
    #[must_use]
    pub fn of(moments: &Moments, sketch: Option<Sketch>) -> Option<Self> {
        let mean = moments.mean().filter(|mean| mean.is_finite())?;
        let n = moments.count as f64;
        let given = |count: u64, value: f64| (moments.count >= count && value.is_finite()).then_some(value);
        let Moments { second, third, fourth, .. } = *moments;
        let sigma = given(2, (second / (n - 1.0)).sqrt());
        let skewness = third / second / second.sqrt() * n.sqrt();
        let kurtosis = n * (fourth / second / second) - 3.0;
        // (m4 / sigma^4 - (n - 3) / (n - 1)) / n is the variance of sigma^2, divided by sigma^4.
        let share = (n - 1.0) / n;
        let variance = given(2, ((kurtosis + 3.0) * share * share - (n - 3.0) / (n - 1.0)) / n);
        let skewness_error = (6.0 * n * (n - 1.0) / ((n - 2.0) * (n + 1.0) * (n + 3.0))).sqrt();
        let kurtosis_error = 2.0 * skewness_error * ((n * n - 1.0) / ((n - 3.0) * (n + 5.0))).sqrt();
        let skewness = given(3, skewness * (n * (n - 1.0)).sqrt() / (n - 2.0));
        let excess_kurtosis = given(4, (n - 1.0) / ((n - 2.0) * (n - 3.0)) * ((n + 1.0) * kurtosis + 6.0));
        Some(Self {
            count: moments.count,
            mean,
            standard_error: sigma.map(|sigma| sigma / n.sqrt()),
            sigma,
            sigma_error: sigma.zip(variance).map(|(sigma, variance)| 0.5 * sigma * variance.max(0.0).sqrt()),
            skewness,
            skewness_error: skewness.map(|_| skewness_error),
            excess_kurtosis,
            kurtosis_error: excess_kurtosis.map(|_| kurtosis_error),
            min: moments.min,
            max: moments.max,
            sketch,
        })
    }

    /// Statistics of a value shared by `count` samples; `None` if there are no samples.
    #[must_use]
    pub fn of_equal(value: f64, count: u64) -> Option<Self> {
        let mut sketch = Sketch::new(value, 1.0).ok()?;
        let moments = Moments::of_equal(value, count);
        sketch.add_equal(&moments);
        Self::of(&moments, Some(sketch))
    }

    /// The distribution, if the plan includes it.
    #[must_use]
    pub fn sketch(&self) -> Option<&Sketch> {
        self.sketch.as_ref()
    }

    /// The quantile for the fraction `p`, between 0 and 1; see [`Sketch::quantile`].
    ///
    /// # Errors
    ///
    /// If `p` is not between 0 and 1, or if the plan has no sketch of this quantity.
    pub fn quantile(&self, p: f64) -> Result<Estimate, Error> {
        self.distribution()?.quantile(p)
    }

    /// A confidence interval for the quantile of the underlying distribution; see [`Sketch::quantile_interval`].
    ///
    /// # Errors
    ///
    /// If `p` or `confidence` is not strictly between 0 and 1, or if the plan has no sketch of this quantity.
    pub fn quantile_interval(&self, p: f64, confidence: f64) -> Result<Option<Interval>, Error> {
        self.distribution()?.quantile_interval(p, confidence)
    }

    fn distribution(&self) -> Result<&Sketch, Error> {
        self.sketch.as_ref().ok_or_else(|| {
            Error::setting("quantile", "the plan has no sketch of this quantity; ask for it with `Plan::sketch`")
        })
    }
}
