//! Moments of a second-order model in variables that are not normal, from the model at many scrambled Sobol' points.

use eigentol_statistics::sequence::Sequence;
use eigentol_statistics::{Joint, normal};

use crate::Error;
use crate::algebra::Vector;
use crate::second_order::Quadratic;

const RANDOMISATIONS: u64 = 8;
const POINTS: u64 = 4096;

/// Variance, skewness and excess kurtosis about `mean` of a model minus its nominal value, at points of `joint`, which was
/// built for the same nominal values.
pub(super) fn sampled_moments(
    model: &Quadratic,
    (joint, about): (&Joint, &[f64]),
    mean: f64,
) -> Result<(f64, f64, f64), Error> {
    let count = about.len();
    let (mut point, mut change) = (Vector::zeros(count), Vector::zeros(count));
    let mut values = Vec::with_capacity((RANDOMISATIONS * POINTS) as usize);
    for stream in 0..RANDOMISATIONS {
        let sequence = Sequence::sobol(count, 0, stream)?;
        let mut walk = sequence.from(0);
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
            values.push(model.change(&change) - mean);
        }
    }
    let count = values.len() as f64;
    let variance = values.iter().map(|value| value * value).sum::<f64>() / count;
    if variance == 0.0 {
        return Ok((0.0, 0.0, 0.0));
    }
    let sigma = variance.sqrt();
    let power = |order: i32| values.iter().map(|v| (v / sigma).powi(order)).sum::<f64>() / count;
    Ok((variance, power(3), power(4) - 3.0))
}
