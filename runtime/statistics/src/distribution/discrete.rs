//! A discrete variable.

use crate::{Error, normal};

#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Discrete {
    /// In increasing order.
    values: Vec<f64>,
    /// Probability of each.
    weights: Vec<f64>,
    /// The standard normal `z` at which the value changes to the next one.
    #[cfg_attr(feature = "serde", serde(with = "crate::serial::exact"))]
    steps: Vec<f64>,
}

impl Discrete {
    pub(super) fn new(values: &[(f64, f64)]) -> Result<Self, Error> {
        let wrong = |reason: String| Err(Error::setting("discrete distribution", reason));
        if let Some((value, _)) = values.iter().find(|(value, _)| !value.is_finite()) {
            return wrong(format!("value {value} must be finite"));
        }
        if let Some((_, weight)) = (values.iter()).find(|(_, w)| !(0.0..=f64::MAX).contains(w)) {
            return wrong(format!("weight {weight} must be zero or positive and finite"));
        }
        let mut sorted: Vec<(f64, f64)> = values.iter().filter(|(_, w)| *w > 0.0).copied().collect();
        sorted.sort_by(|a, b| a.0.total_cmp(&b.0));
        let greatest = sorted.iter().fold(0.0, |most: f64, (_, w)| most.max(*w));
        if sorted.is_empty() {
            return wrong("it needs at least one value with a positive weight".to_owned());
        }
        let sum: f64 = sorted.iter().map(|(_, w)| w / greatest).sum();
        let weights: Vec<f64> = sorted.iter().map(|(_, w)| w / greatest / sum).collect();
        Ok(Self { values: sorted.iter().map(|(value, _)| *value).collect(), steps: steps(&weights), weights })
    }

    pub(super) fn support(&self) -> (f64, f64) {
        (self.values[0], self.values[self.values.len() - 1])
    }

    pub(super) fn moments(&self) -> (f64, f64) {
        // About one of the values, so that a common offset costs no digits.
        let about = self.values[self.values.len() / 2];
        let shift = self.sum(|value| value - about);
        (about + shift, self.sum(|value| (value - about - shift).powi(2)).sqrt())
    }

    pub(super) fn sum(&self, of: impl Fn(f64) -> f64) -> f64 {
        self.values.iter().zip(&self.weights).map(|(value, weight)| weight * of(*value)).sum()
    }

    pub(super) fn quantile(&self, z: f64) -> f64 {
        self.values[self.steps.partition_point(|step| *step < z)]
    }

    /// The positions and heights of its steps.
    pub(super) fn jumps(&self) -> impl Iterator<Item = (f64, f64)> {
        let sizes = self.values.windows(2).map(|pair| pair[1] - pair[0]);
        self.steps.iter().copied().zip(sizes)
    }
}

/// The normal quantiles of the cumulative weights, each summed from the nearer end.
fn steps(weights: &[f64]) -> Vec<f64> {
    let running = |weights: &mut dyn Iterator<Item = &f64>| -> Vec<f64> {
        weights
            .scan(0.0, |sum, weight| {
                *sum += weight;
                Some(*sum)
            })
            .collect()
    };
    let below = running(&mut weights.iter());
    let mut above = running(&mut weights.iter().rev());
    above.reverse();
    below
        .iter()
        .zip(above.iter().skip(1))
        .map(
            |(below, above)| {
                if below < above { normal::quantile(below.min(0.5)) } else { -normal::quantile(above.min(0.5)) }
            },
        )
        .collect()
}
