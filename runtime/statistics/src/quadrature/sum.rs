//! Accurate sums of many terms of either sign.

/// A sum with compensation of its rounding errors (Neumaier, Z. Angew. Math. Mech. 54, 1974): the error does not grow
/// with the number of terms. Needed for the weights of sparse grids in many dimensions.
///
/// ```
/// use eigentol_statistics::quadrature::CompensatedSum;
///
/// let mut sum = CompensatedSum::default();
/// [1.0, 1e100, 1.0, -1e100].map(|term| sum.add(term));
/// assert_eq!(sum.value(), 2.0);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CompensatedSum {
    sum: f64,
    lost: f64,
}

impl CompensatedSum {
    /// Adds a term.
    pub fn add(&mut self, term: f64) {
        let sum = self.sum + term;
        self.lost += if self.sum.abs() >= term.abs() { (self.sum - sum) + term } else { (term - sum) + self.sum };
        self.sum = sum;
    }

    /// The sum so far.
    pub fn value(&self) -> f64 {
        self.sum + self.lost
    }
}
