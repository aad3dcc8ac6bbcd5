//! The length of a sum of vectors in the plane with known lengths and independent, uniformly distributed directions: the
//! vibration due to unbalances of which only the amounts are known.

use crate::Error;

/// Terms of the series.
const TERMS: usize = 4000;

/// The distribution of `|sum_k a_k e^{i phi_k}|` with independent `phi_k`, each uniform over the turn.
///
/// With one vector the length is certain, with two the probability is an arc cosine. With more it is a series over the
/// zeros `j` of `J_0` on the disk of radius `R = sum a_k` (W. R. Bennett, *Distribution of the sum of randomly phased
/// components*, Quarterly of Applied Mathematics 5, 1948):
///
/// `P(length <= r) = (2 r / R) sum_m  J_1(j_m r / R) / (j_m J_1(j_m)^2)  prod_k J_0(a_k j_m / R)`.
///
/// ```
/// use eigentol_statistics::random_phases::RandomPhases;
///
/// let sum = RandomPhases::new(&[3.0, 4.0])?;
/// assert_eq!((sum.greatest(), sum.root_mean_square()), (7.0, 5.0));
/// assert!((sum.probability_below(5.0) - 0.5).abs() < 1e-12);
/// # Ok::<(), eigentol_statistics::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct RandomPhases {
    /// Lengths above zero, longest first.
    lengths: Vec<f64>,
    /// For each term of the series: `j_m`, and its factor.
    terms: Vec<[f64; 2]>,
}

impl RandomPhases {
    /// The sum of vectors of these lengths.
    ///
    /// # Errors
    /// [`Error::Setting`] for a length that is negative or not finite.
    pub fn new(lengths: &[f64]) -> Result<Self, Error> {
        if let Some(wrong) = lengths.iter().find(|length| !(**length >= 0.0 && length.is_finite())) {
            return Err(Error::setting("lengths", format!("{wrong} is no length")));
        }
        let mut lengths: Vec<f64> = lengths.iter().copied().filter(|length| *length > 0.0).collect();
        lengths.sort_by(|a, b| b.total_cmp(a));
        let all: f64 = lengths.iter().sum();
        let mut terms = Vec::new();
        if lengths.len() > 2 {
            for m in 1..=TERMS {
                let j = zero_of_j0(m);
                let product: f64 = lengths.iter().map(|length| libm::j0(length * j / all)).product();
                terms.push([j, product / (j * libm::j1(j).powi(2))]);
            }
        }
        Ok(Self { lengths, terms })
    }

    /// The greatest possible length: all in one direction.
    #[must_use]
    pub fn greatest(&self) -> f64 {
        self.lengths.iter().sum()
    }

    /// The least possible length.
    #[must_use]
    pub fn least(&self) -> f64 {
        let longest = self.lengths.first().copied().unwrap_or_default();
        (2.0 * longest - self.greatest()).max(0.0)
    }

    /// Root of the mean square of the length.
    #[must_use]
    pub fn root_mean_square(&self) -> f64 {
        self.lengths.iter().map(|length| length * length).sum::<f64>().sqrt()
    }

    /// Probability that the sum is not longer than `length`; the series of three or more vectors to about 1e-6.
    #[must_use]
    pub fn probability_below(&self, length: f64) -> f64 {
        let all = self.greatest();
        if length >= all {
            return 1.0;
        }
        if length < self.least() || length <= 0.0 {
            return 0.0;
        }
        if let [a, b] = self.lengths[..] {
            let cosine = (a * a + b * b - length * length) / (2.0 * a * b);
            return cosine.clamp(-1.0, 1.0).acos() / std::f64::consts::PI;
        }
        let x = length / all;
        let sum: f64 = self.terms.iter().map(|[j, factor]| factor * libm::j1(j * x)).sum();
        (2.0 * x * sum).clamp(0.0, 1.0)
    }

    /// The length that is not exceeded with a probability.
    ///
    /// # Errors
    /// [`Error::Setting`] unless the probability lies between zero and one.
    pub fn quantile(&self, probability: f64) -> Result<f64, Error> {
        if !(0.0..=1.0).contains(&probability) {
            return Err(Error::setting("probability", format!("{probability} is no probability")));
        }
        let (mut low, mut high) = (self.least(), self.greatest());
        if probability == 1.0 {
            return Ok(high);
        }
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (low + high);
            if self.probability_below(middle) < probability { low = middle } else { high = middle }
        }
        Ok(0.5 * (low + high))
    }
}

/// Halvings of the range of lengths for a quantile.
const BISECTIONS: usize = 50;

/// The `m`-th zero of `J_0`: McMahon's expansion, then two steps of Newton's method with `J_0' = -J_1`.
fn zero_of_j0(m: usize) -> f64 {
    let b = (m as f64 - 0.25) * std::f64::consts::PI;
    let mut j = b + 1.0 / (8.0 * b) - 31.0 / (384.0 * b.powi(3));
    for _ in 0..2 {
        j += libm::j0(j) / libm::j1(j);
    }
    j
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::RandomNumbers;

    #[test]
    fn the_series_continues_the_closed_form() -> Result<(), Error> {
        // A third vector of almost no length.
        let two = RandomPhases::new(&[1.0, 0.7])?;
        let three = RandomPhases::new(&[1.0, 0.7, 1e-9])?;
        for r in [0.35, 0.5, 1.0, 1.3, 1.6] {
            let (a, b) = (two.probability_below(r), three.probability_below(r));
            assert!((a - b).abs() < 2e-3, "{r}: {a} {b}");
        }
        Ok(())
    }

    /// Equal vectors: Kluyver's random walk of three steps ends within one step with probability 1/4, of n steps with
    /// 1/(n + 1).
    #[test]
    fn walks_of_equal_steps_end_near_their_start_as_kluyver_found() -> Result<(), Error> {
        for n in 3..12 {
            let walk = RandomPhases::new(&vec![1.0; n])?;
            let error = walk.probability_below(1.0) - 1.0 / (n as f64 + 1.0);
            assert!(error.abs() < 2e-5, "{n}: {error}");
        }
        Ok(())
    }

    #[test]
    fn samples_have_this_distribution() -> Result<(), Error> {
        let lengths = [2.0, 1.0, 0.4, 0.3];
        let sum = RandomPhases::new(&lengths)?;
        let mut random = RandomNumbers::starting_at(7, 0, 0);
        let number = 200_000;
        let mut below = 0;
        let limit = sum.quantile(0.9)?;
        for _ in 0..number {
            let (mut x, mut y) = (0.0, 0.0);
            for length in lengths {
                let (sine, cosine) = (std::f64::consts::TAU * random.probability()).sin_cos();
                (x, y) = (x + length * cosine, y + length * sine);
            }
            below += u32::from(f64::hypot(x, y) <= limit);
        }
        let share = f64::from(below) / f64::from(number);
        // Four standard errors.
        assert!((share - 0.9).abs() < 0.0027, "{share}");
        Ok(())
    }

    #[test]
    fn certain_and_empty_sums() -> Result<(), Error> {
        let one = RandomPhases::new(&[3.0, 0.0])?;
        assert_eq!((one.least(), one.greatest()), (3.0, 3.0));
        assert_eq!((one.probability_below(2.9), one.probability_below(3.0)), (0.0, 1.0));
        assert_eq!(one.quantile(0.5)?, 3.0);
        let none = RandomPhases::new(&[])?;
        assert_eq!((none.greatest(), none.probability_below(0.0)), (0.0, 1.0));
        assert!(RandomPhases::new(&[f64::NAN]).is_err() && one.quantile(1.5).is_err());
        Ok(())
    }
}
