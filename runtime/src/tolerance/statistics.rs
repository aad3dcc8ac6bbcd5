//! Moments of a sample, gathered in pieces that merge in a fixed order.

/// Statistics of one quantity over the samples that have it, such as a mode's frequency where it oscillates.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Statistics {
    /// Number of values.
    pub count: usize,
    /// Mean, in the unit of the quantity.
    pub mean: f64,
    /// Standard deviation with divisor `count - 1`; `None` for a single value, which says nothing about it.
    pub sigma: Option<f64>,
    /// Standard error of the mean; `None` for a single value.
    pub standard_error: Option<f64>,
    /// Least value.
    pub min: f64,
    /// Greatest value.
    pub max: f64,
}

/// Running mean and sum of squared deviations (Welford 1962; merged after Chan, Golub and LeVeque 1979).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Moments {
    count: usize,
    mean: f64,
    squares: f64,
    min: f64,
    max: f64,
}

impl Moments {
    pub(crate) const EMPTY: Self = Self {
        count: 0,
        mean: 0.0,
        squares: 0.0,
        min: f64::INFINITY,
        max: f64::NEG_INFINITY,
    };

    /// Of `count` values from sums of their deviations from `about` and of the squares of these, and their least and
    /// greatest deviation.
    pub(crate) fn of_deviations(
        count: usize,
        about: f64,
        (sum, squares): (f64, f64),
        (least, most): (f64, f64),
    ) -> Self {
        if count == 0 {
            return Self::EMPTY;
        }
        let shift = sum / count as f64;
        Self {
            count,
            mean: about + shift,
            squares: (squares - sum * shift).max(0.0),
            min: about + least,
            max: about + most,
        }
    }

    pub(crate) fn add(&mut self, value: f64) {
        self.count += 1;
        let deviation = value - self.mean;
        self.mean += deviation / self.count as f64;
        self.squares += deviation * (value - self.mean);
        self.min = self.min.min(value);
        self.max = self.max.max(value);
    }

    pub(crate) fn merge(&mut self, other: &Self) {
        if other.count == 0 {
            return;
        }
        if self.count == 0 {
            *self = *other;
            return;
        }
        let count = self.count + other.count;
        let deviation = other.mean - self.mean;
        let share = other.count as f64 / count as f64;
        self.mean += deviation * share;
        self.squares += other.squares + deviation * deviation * self.count as f64 * share;
        self.count = count;
        self.min = self.min.min(other.min);
        self.max = self.max.max(other.max);
    }

    /// `None` without values.
    pub(crate) fn statistics(&self) -> Option<Statistics> {
        if self.count == 0 {
            return None;
        }
        let sigma =
            (self.count > 1).then(|| (self.squares / (self.count - 1) as f64).max(0.0).sqrt());
        Some(Statistics {
            count: self.count,
            mean: self.mean,
            sigma,
            standard_error: sigma.map(|sigma| sigma / (self.count as f64).sqrt()),
            min: self.min,
            max: self.max,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn merging_equals_adding() {
        let values = [1.0, 4.0, -2.0, 8.5, 3.0];
        let mut whole = Moments::EMPTY;
        values.iter().for_each(|&value| whole.add(value));
        let (mut left, mut right) = (Moments::EMPTY, Moments::EMPTY);
        values[..2].iter().for_each(|&value| left.add(value));
        values[2..].iter().for_each(|&value| right.add(value));
        left.merge(&right);
        let (Some(a), Some(b)) = (whole.statistics(), left.statistics()) else {
            panic!("values")
        };
        assert!((a.mean - 2.9).abs() < 1e-15 && (a.mean - b.mean).abs() < 1e-15);
        let (Some(of_a), Some(of_b)) = (a.sigma, b.sigma) else {
            panic!("several values")
        };
        assert!((of_a - of_b).abs() < 1e-14);
        let mut one = Moments::EMPTY;
        one.add(3.0);
        let alone = one.statistics();
        assert!(alone.is_some_and(|one| one.mean == 3.0 && one.sigma.is_none()));
        assert!(Moments::EMPTY.statistics().is_none());
    }
}
