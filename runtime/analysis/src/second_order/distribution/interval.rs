//! Probability of an interval, by the method that suits the terms.

use super::terms::Terms;
use super::{Estimate, contour, davies, normal_cdf, single};

/// Error above which a second method is tried.
const ACCEPTED: f64 = 1e-11;

impl Terms {
    /// `P(from < X < to)`, in closed form where one exists.
    pub(in crate::second_order) fn between(&self, from: f64, to: f64) -> Estimate {
        if from >= to {
            return Estimate { value: 0.0, error: 0.0 };
        }
        match self.squares[..] {
            [] => self.straight(from, to),
            [square] if self.normal == 0.0 => single::between(square, from, to),
            _ => self.inverted(from, to),
        }
    }

    /// The normal distribution, when there are no squares.
    fn straight(&self, from: f64, to: f64) -> Estimate {
        let (from, to) = (from / self.normal, to / self.normal);
        Estimate {
            value: normal_cdf::between(from, to).clamp(0.0, 1.0),
            error: normal_cdf::end_error(from, 0.0) + normal_cdf::end_error(to, 0.0),
        }
    }

    /// The trapezoidal rule where it is short, with its proven bound; otherwise the tilted ray. If neither is good, the
    /// better of the two.
    fn inverted(&self, from: f64, to: f64) -> Estimate {
        let rule = davies::Rule::new(self);
        if rule.is_short() {
            return rule.between(self, from, to);
        }
        let ray = contour::between(self, from, to);
        match ray {
            Some(estimate) if estimate.error < ACCEPTED => estimate,
            _ => {
                let long = rule.between(self, from, to);
                ray.filter(|ray| ray.error < long.error).unwrap_or(long)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::terms::Square;
    use super::*;

    /// With standard deviation 1 and five or more variables of either sign both inversions apply, and they share no
    /// formula but the terms.
    #[test]
    fn both_inversions_agree() {
        for (normal, count, c, nu) in
            [(0.0, 5, 0.8, 0.7), (0.3, 4, 0.5, -1.2), (0.05, 6, 0.1, 1.0), (1.0, 3, 0.4, 0.05), (0.0, 9, 0.0, 1.0)]
        {
            let squares = (0..count)
                .map(|j| Square { c: c * (1.0 + f64::from(j)).sin(), nu: nu * (2.0 + 1.7 * f64::from(j)).cos() });
            let mut terms = Terms { unit: 1.0, normal, squares: squares.collect() };
            let parts = terms.squares.iter();
            let variance: f64 = parts.map(|t| t.c * t.c + 0.5 * t.nu * t.nu).sum();
            let sigma = (variance + normal * normal).sqrt();
            terms.normal /= sigma;
            for square in &mut terms.squares {
                square.c /= sigma;
                square.nu /= sigma;
            }
            let rule = davies::Rule::new(&terms);
            let mut compared = 0;
            for k in -12..=12 {
                let y = 0.5 * f64::from(k);
                let axis = rule.between(&terms, y, f64::INFINITY);
                let Some(ray) = contour::between(&terms, y, f64::INFINITY) else { panic!("a ray at {y}") };
                let apart = (axis.value - ray.value).abs();
                assert!(apart <= axis.error + ray.error, "{y}: {axis:?} {ray:?}");
                compared += usize::from(axis.error + ray.error < 1e-9);
            }
            assert_eq!(compared, 25);
        }
    }
}
