//! Polynomials truncated at a given degree.

/// Coefficients of `1, x, ..., x^degree`.
#[derive(Clone, Debug)]
pub(super) struct Truncated(Vec<f64>);

impl Truncated {
    pub(super) fn new(mut coefficients: Vec<f64>, degree: usize) -> Self {
        coefficients.resize(degree + 1, 0.0);
        Self(coefficients)
    }

    pub(super) fn times(&self, other: &Self) -> Self {
        let coefficient = |k: usize| {
            let factors = self.0[..=k].iter().zip(other.0[..=k].iter().rev());
            factors.map(|(a, b)| a * b).sum()
        };
        Self((0..self.0.len()).map(coefficient).collect())
    }

    pub(super) fn power(&self, mut exponent: usize) -> Self {
        let mut result = Self::new(vec![1.0], self.0.len() - 1);
        let mut square = self.clone();
        while exponent > 0 {
            if exponent % 2 == 1 {
                result = result.times(&square);
            }
            square = square.times(&square);
            exponent /= 2;
        }
        result
    }

    /// The polynomial divided by `1 - x`.
    pub(super) fn summed(mut self) -> Self {
        let mut sum = 0.0;
        for coefficient in &mut self.0 {
            sum += *coefficient;
            *coefficient = sum;
        }
        self
    }

    /// The coefficients of `x^k` and of the next lower power.
    pub(super) fn pair(&self, k: usize) -> (f64, f64) {
        (self.0[k], if k == 0 { 0.0 } else { self.0[k - 1] })
    }
}
