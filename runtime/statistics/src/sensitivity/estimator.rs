//! Estimators of first-order and total indices from the values of the Saltelli design.

/// How to estimate the indices of an input from the values `a` of the rows of `A`, `b` of `B`, and `c` of `A` with that
/// input taken from `B`.
///
/// `V` is the variance of all `a` and `b`, `m` their mean.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Estimator {
    /// First order `mean((b - m) (c - a)) / V` (Saltelli et al. 2010, table 2 b), total `mean((a - c)^2) / 2 V` (table
    /// 2 f). Accurate for small first-order indices.
    Saltelli,
    /// First order `1 - mean((b - c)^2) / 2 V` (Jansen 1999), total as in `Saltelli`. Accurate for large first-order
    /// indices.
    #[default]
    Jansen,
    /// Correlation coefficients: first order is that of `b` and `c`, total is one minus that of `a` and `c` (Martinez
    /// 2011; Baudin et al., SAMO 2016).
    Martinez,
}

/// Sums of the values of an input over rows.
#[derive(Clone, Copy, Default)]
pub(super) struct Sums {
    n: f64,
    a: f64,
    b: f64,
    c: f64,
    aa: f64,
    bb: f64,
    cc: f64,
    ab: f64,
    ac: f64,
    bc: f64,
}

impl Sums {
    /// Adds a row `times` times.
    pub(super) fn add(&mut self, times: f64, [a, b, c]: [f64; 3]) {
        self.n += times;
        self.a += times * a;
        self.b += times * b;
        self.c += times * c;
        self.aa += times * a * a;
        self.bb += times * b * b;
        self.cc += times * c * c;
        self.ab += times * a * b;
        self.ac += times * a * c;
        self.bc += times * b * c;
    }

    /// Mean and variance of all `a` and `b`.
    pub(super) fn moments(&self) -> (f64, f64) {
        let mean = (self.a + self.b) / (2.0 * self.n);
        (mean, (self.aa + self.bb) / (2.0 * self.n) - mean * mean)
    }

    /// First-order and total index. `None` if a variance vanishes.
    pub(super) fn indices(&self, estimator: Estimator) -> Option<[f64; 2]> {
        let (mean, variance) = self.moments();
        let positive = varies(variance, (self.aa + self.bb) / self.n).then_some(variance)?;
        let share = |sum: f64| sum / (self.n * positive);
        let half_square = |xx: f64, xc: f64| share(0.5 * (xx + self.cc) - xc);
        Some(match estimator {
            Estimator::Saltelli => [share(self.bc - self.ab - mean * (self.c - self.a)), half_square(self.aa, self.ac)],
            Estimator::Jansen => [1.0 - half_square(self.bb, self.bc), half_square(self.aa, self.ac)],
            Estimator::Martinez => {
                [self.correlation([self.b, self.bb, self.bc])?, 1.0 - self.correlation([self.a, self.aa, self.ac])?]
            }
        })
    }

    /// Correlation of `c` with another value, given the sums of that value, its square and its product with `c`.
    fn correlation(&self, [x, xx, xc]: [f64; 3]) -> Option<f64> {
        let n = self.n;
        let spread = |x: f64, xx: f64| {
            let variance = xx / n - (x / n).powi(2);
            varies(variance, xx / n).then(|| variance.sqrt())
        };
        let covariance = xc / n - x / n * self.c / n;
        Some(covariance / (spread(x, xx)? * spread(self.c, self.cc)?))
    }
}

/// Whether a variance exceeds the rounding error of the mean square from which it was computed as a difference.
fn varies(variance: f64, square: f64) -> bool {
    variance > 1e-13 * square
}
