//! The distribution of a second-order model in variables that are not normal, from the model at many scrambled Sobol'
//! points. The differences between several randomisations give the error.

use eigentol_statistics::sequence::Sequence;
use eigentol_statistics::{Joint, normal};

use super::Estimate;
use crate::Error;
use crate::algebra::Vector;
use crate::second_order::Quadratic;

const RANDOMISATIONS: u64 = 8;
const POINTS: u64 = 4096;
/// Number of standard errors reported as the error.
const ERRORS: f64 = 3.0;

/// Values of a model minus its nominal value, sorted within each randomisation.
pub(in crate::second_order) struct Sampled(Vec<Vec<f64>>);

impl Sampled {
    /// Evaluates the model at points of `joint`, which was built for the same nominal values.
    pub(in crate::second_order) fn new(model: &Quadratic, joint: &Joint, about: &[f64]) -> Result<Self, Error> {
        let count = about.len();
        let (mut point, mut change) = (Vector::zeros(count), Vector::zeros(count));
        let mut all = Vec::new();
        for stream in 0..RANDOMISATIONS {
            let sequence = Sequence::sobol(count, 0, stream)?;
            let mut walk = sequence.from(0);
            let mut values = Vec::with_capacity(POINTS as usize);
            for _ in 0..POINTS {
                let Some(uniform) = walk.next_point() else {
                    break;
                };
                for (z, p) in point.iter_mut().zip(uniform) {
                    *z = normal::quantile(*p);
                }
                joint.from_normal(&point, &mut change);
                for (change, about) in change.iter_mut().zip(about) {
                    *change -= about;
                }
                values.push(model.change(&change));
            }
            values.sort_by(f64::total_cmp);
            all.push(values);
        }
        Ok(Self(all))
    }

    /// Variance, skewness and excess kurtosis about `mean`.
    pub(in crate::second_order) fn moments(&self, mean: f64) -> (f64, f64, f64) {
        let values = || self.0.iter().flatten().map(|value| value - mean);
        let count = values().count() as f64;
        let variance = values().map(|value| value * value).sum::<f64>() / count;
        if variance == 0.0 {
            return (0.0, 0.0, 0.0);
        }
        let sigma = variance.sqrt();
        let power = |order: i32| values().map(|v| (v / sigma).powi(order)).sum::<f64>() / count;
        (variance, power(3), power(4) - 3.0)
    }

    /// Probability of an interval of values, measured from the nominal value.
    pub(in crate::second_order) fn between(&self, low: f64, high: f64) -> Estimate {
        let share = |values: &Vec<f64>| {
            let below = values.partition_point(|value| *value < low);
            let within = values.partition_point(|value| *value <= high);
            (within.saturating_sub(below)) as f64 / values.len() as f64
        };
        let shares: Vec<f64> = self.0.iter().map(share).collect();
        let count = shares.len() as f64;
        let value = shares.iter().sum::<f64>() / count;
        let squares: f64 = shares.iter().map(|share| (share - value).powi(2)).sum();
        // Even randomisations that agree may all miss an event rarer than a few points.
        let resolution = ERRORS / (count * POINTS as f64);
        Estimate { value, error: (ERRORS * (squares / (count * (count - 1.0))).sqrt()).max(resolution) }
    }
}
