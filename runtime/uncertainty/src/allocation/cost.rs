//! The cost of a tolerance.

use core::fmt;

/// Cost of a half-width as a function of its size, in any currency.
///
/// ```
/// use eigentol::allocation::Cost;
///
/// let turned = Cost::reciprocal(1.0, 2e-6, 2.0);
/// let (cost, slope) = turned.of(1e-3);
/// assert!((cost - 3.0).abs() < 1e-12 && (slope + 4e3).abs() < 1e-9);
/// ```
pub struct Cost<'a>(Law<'a>);

enum Law<'a> {
    Reciprocal { fixed: f64, factor: f64, power: f64 },
    Function(Box<dyn Fn(f64) -> (f64, f64) + 'a>),
}

impl<'a> Cost<'a> {
    /// `fixed + factor / T^power` of a half-width `T` in SI units: finite numbers, `factor` and `power` positive.
    #[must_use]
    pub fn reciprocal(fixed: f64, factor: f64, power: f64) -> Self {
        Self(Law::Reciprocal { fixed, factor, power })
    }

    /// Any smooth function of a half-width in SI units, with its derivative.
    #[must_use]
    pub fn function(function: impl Fn(f64) -> (f64, f64) + 'a) -> Self {
        Self(Law::Function(Box::new(function)))
    }

    /// What is wrong with the numbers of a [`Cost::reciprocal`]: a cost must not fall where a tolerance gets tighter.
    pub(super) fn mistake(&self) -> Option<String> {
        let Law::Reciprocal { fixed, factor, power } = self.0 else {
            return None;
        };
        let positive = |value: f64| value > 0.0 && value.is_finite();
        if !fixed.is_finite() {
            Some(format!("the fixed cost {fixed} is not finite"))
        } else if !positive(factor) {
            Some(format!("the factor of a cost must be positive and finite, not {factor}"))
        } else if !positive(power) {
            Some(format!("the power of a cost must be positive and finite, not {power}"))
        } else {
            None
        }
    }

    /// The cost of a half-width, SI, and its derivative.
    #[must_use]
    pub fn of(&self, half_width: f64) -> (f64, f64) {
        match &self.0 {
            Law::Function(function) => function(half_width),
            Law::Reciprocal { fixed, factor, power } => {
                let variable = factor / half_width.powf(*power);
                (fixed + variable, -power * variable / half_width)
            }
        }
    }
}

impl fmt::Debug for Cost<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.0 {
            Law::Function(_) => write!(f, "Cost(function)"),
            Law::Reciprocal { fixed, factor, power } => write!(f, "Cost({fixed} + {factor} / T^{power})"),
        }
    }
}
