//! A mean in double-double precision: if values are large and close together, their mean is needed more accurately than
//! to its last digit, or merging loses their spread.

/// The sum `high + low`, where `high` is the nearest number to it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Mean {
    #[cfg_attr(feature = "serde", serde(with = "super::bits::one"))]
    pub(super) high: f64,
    #[cfg_attr(feature = "serde", serde(with = "super::bits::one"))]
    pub(super) low: f64,
}

impl Mean {
    /// `value + step`.
    pub(super) fn new(value: f64, step: f64) -> Self {
        Self::sum(value, step)
    }

    /// Exact sum (Knuth 1969, two-sum).
    fn sum(a: f64, b: f64) -> Self {
        let high = a + b;
        let part = high - a;
        let low = (a - (high - part)) + (b - part);
        Self { high, low }
    }

    pub(super) fn minus(self, other: Self) -> f64 {
        (self.high - other.high) + (self.low - other.low)
    }

    pub(super) fn moved(self, step: f64) -> Self {
        let sum = Self::sum(self.high, step);
        Self::sum(sum.high, sum.low + self.low)
    }
}
