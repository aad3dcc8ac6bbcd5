//! Roots of a function of one variable between two values of opposite sign, by bisection made faster with secants.

/// A bracket `[low, high]` with the values of the function at its ends.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bracket {
    pub(super) low: f64,
    pub(super) high: f64,
    pub(super) at_low: f64,
    pub(super) at_high: f64,
}

/// Shrinks the bracket to rounding and returns its best point (Illinois method, bisection where that is slow).
///
/// `function` returns `None` where it is not defined; such a point counts as lying on the side of `high`.
pub(super) fn refine(mut bracket: Bracket, mut function: impl FnMut(f64) -> Option<f64>) -> f64 {
    let (mut weight_low, mut weight_high) = (1.0, 1.0);
    let mut last_side = 0;
    for round in 0..200 {
        let width = bracket.high - bracket.low;
        let scale = bracket.low.abs().max(bracket.high.abs());
        if width.abs() <= 2.0 * f64::EPSILON * scale || bracket.at_low == 0.0 {
            break;
        }
        let (a, b) = (bracket.at_low * weight_low, bracket.at_high * weight_high);
        let secant = bracket.low + width * a / (a - b);
        let middle = bracket.low + 0.5 * width;
        let inside = secant.is_finite() && (secant - bracket.low) * (secant - bracket.high) < 0.0;
        let trial = if inside && round % 4 != 3 {
            secant
        } else {
            middle
        };
        if trial == bracket.low || trial == bracket.high {
            break;
        }
        match function(trial) {
            Some(0.0) => return trial,
            Some(value) if (value > 0.0) == (bracket.at_low > 0.0) => {
                bracket.low = trial;
                bracket.at_low = value;
                weight_low = 1.0;
                weight_high = if last_side == 1 {
                    0.5 * weight_high
                } else {
                    1.0
                };
                last_side = 1;
            }
            value => {
                bracket.high = trial;
                bracket.at_high = value.unwrap_or(-bracket.at_low);
                weight_high = 1.0;
                weight_low = if last_side == -1 {
                    0.5 * weight_low
                } else {
                    1.0
                };
                last_side = -1;
            }
        }
    }
    if bracket.at_high.abs() < bracket.at_low.abs() {
        bracket.high
    } else {
        bracket.low
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_roots_of_both_slopes_and_edges_of_domains() {
        let cubic = |x: f64| x * x * x - 2.0;
        let bracket = Bracket {
            low: 0.0,
            high: 3.0,
            at_low: -2.0,
            at_high: 25.0,
        };
        assert!((refine(bracket, |x| Some(cubic(x))) - 2f64.cbrt()).abs() < 1e-15);
        let bracket = Bracket {
            low: 3.0,
            high: 0.0,
            at_low: 25.0,
            at_high: -2.0,
        };
        assert!((refine(bracket, |x| Some(cubic(x))) - 2f64.cbrt()).abs() < 1e-15);
        let bracket = Bracket {
            low: 0.0,
            high: 2.0,
            at_low: 1.0,
            at_high: -1.0,
        };
        let edge = refine(bracket, |x| (x <= 1.0).then(|| (1.0 - x).sqrt()));
        assert!((edge - 1.0).abs() < 1e-14);
    }
}
