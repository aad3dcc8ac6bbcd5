//! Roots of a function of one variable between two values of opposite sign: Newton's method where a slope is known and
//! the step stays inside, secants otherwise, bisection where both are slow.

/// A bracket `[low, high]` with the values of the function at both ends.
#[derive(Clone, Copy, Debug)]
#[doc(hidden)]
pub struct Bracket {
    #[doc(hidden)]
    pub low: f64,
    #[doc(hidden)]
    pub high: f64,
    #[doc(hidden)]
    pub at_low: f64,
    #[doc(hidden)]
    pub at_high: f64,
}

/// Shrinks the bracket to rounding and returns its best point.
///
/// `function` returns its value and, if known, its slope; `None` if it is not defined: the point then counts as lying
/// on the side of `high`.
pub fn refine(mut bracket: Bracket, mut function: impl FnMut(f64) -> Option<(f64, Option<f64>)>) -> f64 {
    let (mut weight_low, mut weight_high) = (1.0, 1.0);
    let mut last_side = 0;
    let mut newton = None;
    for round in 0..200 {
        let width = bracket.high - bracket.low;
        let scale = bracket.low.abs().max(bracket.high.abs());
        if width.abs() <= 2.0 * f64::EPSILON * scale || bracket.at_low == 0.0 {
            break;
        }
        let (a, b) = (bracket.at_low * weight_low, bracket.at_high * weight_high);
        let secant = bracket.low + width * a / (a - b);
        let middle = bracket.low + 0.5 * width;
        let inside = |trial: &f64| trial.is_finite() && (trial - bracket.low) * (trial - bracket.high) < 0.0;
        let slow = round % 16 == 15 || (round % 4 == 3 && newton.is_none());
        let trial =
            if slow { middle } else { newton.take().filter(inside).or(Some(secant).filter(inside)).unwrap_or(middle) };
        if trial == bracket.low || trial == bracket.high {
            break;
        }
        match function(trial) {
            Some((0.0, _)) => return trial,
            Some((value, slope)) if (value > 0.0) == (bracket.at_low > 0.0) => {
                newton = slope.map(|slope| trial - value / slope);
                bracket.low = trial;
                bracket.at_low = value;
                weight_low = 1.0;
                weight_high = if last_side == 1 { 0.5 * weight_high } else { 1.0 };
                last_side = 1;
            }
            other => {
                newton = other.and_then(|(value, slope)| Some(trial - value / slope?));
                bracket.high = trial;
                bracket.at_high = other.map_or(-bracket.at_low, |(value, _)| value);
                weight_high = 1.0;
                weight_low = if last_side == -1 { 0.5 * weight_low } else { 1.0 };
                last_side = -1;
            }
        }
        // The Newton step is below rounding: closing the other side of the bracket gains nothing.
        if let Some(next) = newton
            && (next - trial).abs() <= f64::EPSILON * scale
        {
            return trial;
        }
    }
    if bracket.at_high.abs() < bracket.at_low.abs() { bracket.high } else { bracket.low }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cubic(x: f64) -> f64 {
        x * x * x - 2.0
    }

    const UP: Bracket = Bracket { low: 0.0, high: 3.0, at_low: -2.0, at_high: 25.0 };

    #[test]
    fn finds_roots_of_both_slopes_and_edges_of_domains() {
        let down = Bracket { low: 3.0, high: 0.0, at_low: 25.0, at_high: -2.0 };
        for bracket in [UP, down] {
            let root = refine(bracket, |x| Some((cubic(x), None)));
            assert!((root - 2f64.cbrt()).abs() < 1e-15);
        }
        let bracket = Bracket { low: 0.0, high: 2.0, at_low: 1.0, at_high: -1.0 };
        let edge = refine(bracket, |x| (x <= 1.0).then(|| ((1.0 - x).sqrt(), None)));
        assert!((edge - 1.0).abs() < 1e-14);
    }

    #[test]
    fn slopes_save_evaluations_and_wrong_ones_do_no_harm() {
        let count = |slope: fn(f64) -> f64| {
            let mut count = 0;
            let root = refine(UP, |x| {
                count += 1;
                Some((cubic(x), Some(slope(x))))
            });
            assert!((root - 2f64.cbrt()).abs() < 1e-14, "{root}");
            count
        };
        let evaluations = count(|x| 3.0 * x * x);
        assert!(evaluations <= 9, "{evaluations}");
        count(|_| -1.0);
        count(|_| f64::NAN);
        count(|_| 0.0);
    }
}
