//! Ranks of the values between which a quantile of their distribution lies.

use crate::Error;

/// Weights below this fraction of the largest are omitted.
const NEGLIGIBLE: f64 = 1e-40;

/// Ranks, from 0, and the probability that the quantile lies between the values with these ranks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Ranks {
    pub(super) lower: u64,
    pub(super) upper: u64,
    pub(super) coverage: f64,
}

/// The ranks of two values that enclose the `p`-quantile with at least the given confidence; `None` if there are too
/// few values.
///
/// The number `B` of values below the `p`-quantile is binomial. The quantile is above the value of rank `k` (from 0) if
/// `B > k` and below it if `B <= k`; each of the two fails with probability at most half of `1 - confidence`
/// (David and Nagaraja, Order Statistics, 3rd edition, section 7.1).
pub(super) fn ranks(count: u64, p: f64, confidence: f64) -> Result<Option<Ranks>, Error> {
    check_inside("p", p)?;
    check_inside("confidence", confidence)?;
    if count == 0 {
        return Ok(None);
    }
    let (first, weights) = weights(count, p);
    let total: f64 = weights.iter().sum();
    let most = 0.5 * (1.0 - confidence) * total;
    // How many weights may be omitted, and their sum.
    let leave = |weights: &mut dyn Iterator<Item = &f64>| {
        let (mut left, mut sum) = (0, 0.0);
        for weight in weights {
            if sum + weight > most {
                break;
            }
            (left, sum) = (left + 1, sum + weight);
        }
        (left, sum)
    };
    let (low, low_sum) = leave(&mut weights.iter());
    let (high, high_sum) = leave(&mut weights.iter().rev());
    // `B <= lower` and `B >= upper + 1` are omitted.
    let lower = (first + low).checked_sub(1);
    let upper = first + weights.len() as u64 - 1 - high;
    Ok(lower.filter(|_| upper < count).map(|lower| Ranks {
        lower,
        upper,
        coverage: 1.0 - (low_sum + high_sum) / total,
    }))
}

/// Binomial probabilities up to a common factor, from the first that is not negligible to the last; computed from their
/// ratios, from the most probable outwards.
fn weights(count: u64, p: f64) -> (u64, Vec<f64>) {
    let odds = p / (1.0 - p);
    let most_probable = (((count as f64 + 1.0) * p) as u64).min(count);
    let ratio = |k: u64| (count - k) as f64 / (k + 1) as f64 * odds;
    let mut down = vec![1.0];
    let mut k = most_probable;
    while let Some(&weight) = down.last().filter(|weight| k > 0 && **weight > NEGLIGIBLE) {
        k -= 1;
        down.push(weight / ratio(k));
    }
    let first = k;
    down.reverse();
    let mut weights = down;
    k = most_probable;
    while let Some(&weight) = weights.last().filter(|weight| k < count && **weight > NEGLIGIBLE) {
        weights.push(weight * ratio(k));
        k += 1;
    }
    (first, weights)
}

fn check_inside(setting: &'static str, value: f64) -> Result<(), Error> {
    if 0.0 < value && value < 1.0 {
        return Ok(());
    }
    let reason = format!("{value} is not strictly between 0 and 1");
    Err(Error::setting(setting, reason))
}
