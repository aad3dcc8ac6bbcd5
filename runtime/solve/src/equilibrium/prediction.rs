//! Predicts where an equilibrium moves along an input, from the last states of the path.
//!
//! A block of eight values reaches far beyond the last state, where a parabola is off by more than one Newton step mends: of a
//! smooth path, terms of third and fourth degree save a step. A rough one shows it by terms that do not shrink.

use core::mem::replace;

use crate::algebra::{Vector, dot, greater, largest, unless_finite};

/// Share of the distance by which a prediction may miss.
pub const MISSED: f64 = 0.25;
/// Largest difference between coordinates that count as unchanged.
pub const STILL: f64 = 1e-9;
/// Last steps beyond which a parabola through them is no prediction.
const FAR: f64 = 8.0;

/// Most states that a prediction takes.
const MOST: usize = 5;
/// Share of the term before it that a term of third or fourth degree may reach: beyond, the states do not tell it.
const SHRINKS: f64 = 0.5;

/// The last states of the path, at most five: the polynomial through them in Newton's form,
/// `t0 + (u - u0) (t1 + (u - u1) (t2 + ..))`.
#[derive(Clone, Debug, Default)]
#[doc(hidden)]
pub struct Path {
    /// Values of the input, the latest first.
    values: [f64; MOST],
    /// For each coordinate the divided differences, the first of which is the latest state.
    terms: Vec<[f64; MOST]>,
    count: usize,
}

impl Path {
    /// Moves on to the state at another value of the input.
    #[doc(hidden)]
    pub fn go(&mut self, value: f64, q: impl ExactSizeIterator<Item = f64>) {
        self.terms.resize(q.len(), [0.0; MOST]);
        let mut per_step = [0.0; MOST];
        for (per_step, other) in per_step.iter_mut().zip(&self.values[..self.count]) {
            *per_step = 1.0 / (value - other);
        }
        for (terms, q) in self.terms.iter_mut().zip(q) {
            let mut new = q;
            for (term, per_step) in terms.iter_mut().zip(per_step) {
                let old = replace(term, new);
                new = (new - old) * per_step;
            }
        }
        self.values.copy_within(..MOST - 1, 1);
        self.values[0] = value;
        self.count = (self.count + 1).min(MOST);
    }

    /// Whether it has the three states that show how a path bends.
    #[doc(hidden)]
    #[inline]
    pub fn bends(&self) -> bool {
        self.count > 2
    }

    /// The values of the input, the latest first.
    #[doc(hidden)]
    #[inline]
    pub fn values(&self) -> &[f64] {
        &self.values[..self.count]
    }

    /// What coordinate `i` was a number of states ago.
    #[doc(hidden)]
    #[inline]
    pub fn state(&self, ago: usize, i: usize) -> f64 {
        let reach = self.reach(self.values[ago]);
        dot(&self.terms[i][..=ago], &reach[..=ago])
    }

    /// Whether a value of the input is too far beyond the last states for them to tell the state there.
    #[doc(hidden)]
    pub fn is_far(&self, value: f64) -> bool {
        let [u0, u1, ..] = self.values;
        self.count > 1 && (value - u0).abs() > FAR * (u0 - u1).abs()
    }

    /// `1, u - u0, (u - u0) (u - u1), ..` at a value of the input.
    #[doc(hidden)]
    #[inline]
    pub fn reach(&self, value: f64) -> [f64; MOST] {
        let mut reach = [1.0; MOST];
        for k in 1..MOST {
            reach[k] = reach[k - 1] * (value - self.values[k - 1]);
        }
        reach
    }

    /// The terms of coordinate `i`: a parabola, or a straight line through two states, and terms of higher degree as long as
    /// they shrink over this reach; zeros beyond.
    #[doc(hidden)]
    #[inline]
    pub fn terms(&self, i: usize, reach: &[f64; MOST]) -> [f64; MOST] {
        let mut terms = self.terms[i];
        let mut most = f64::INFINITY;
        for k in 2..MOST {
            let size = (terms[k] * reach[k]).abs();
            (terms[k], most) = if size < most { (terms[k], SHRINKS * size) } else { (0.0, 0.0) };
        }
        terms
    }

    /// Extrapolates the state to a value of the input. `None` if there are fewer than two states, if the value is
    /// [far](Self::is_far), or if values of the input repeat.
    #[doc(hidden)]
    pub fn at(&self, value: f64) -> Option<Vector> {
        if self.count < 2 || self.is_far(value) {
            return None;
        }
        let reach = self.reach(value);
        let mut rest = 0.0;
        let predicted = Vector::from_fn(self.terms.len(), |i| {
            let q = dot(&self.terms(i, &reach), &reach);
            rest += unless_finite(q);
            q
        });
        (rest == 0.0).then_some(predicted)
    }
}

/// Whether the state found from a prediction is the predicted one: much closer to the prediction than to the last
/// state, and within half a turn of it, since angles bring the same place back.
pub fn confirmed(values: &[f64], predicted: &[f64], last: &[f64]) -> bool {
    let distance = |from: &[f64]| values.iter().zip(from).fold(0.0, |most, (a, b)| greater(most, (a - b).abs()));
    let still = STILL * greater(1.0, largest(values));
    let moved = distance(last);
    distance(predicted) <= MISSED * moved + still && moved <= core::f64::consts::PI
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parabolas_are_continued_exactly_whatever_the_steps() {
        let state = |u: f64| [1.0 + 2.0 * u - 0.5 * u * u, 3.0 - u];
        let mut path = Path::default();
        assert!(path.at(1.0).is_none());
        for u in [0.0, 0.25, 1.0] {
            path.go(u, state(u).into_iter());
        }
        for u in [1.5, -1.0, 7.0] {
            let Some(predicted) = path.at(u) else { panic!("three states") };
            for (predicted, exact) in predicted.iter().zip(state(u)) {
                assert!((predicted - exact).abs() < 1e-13 * (1.0 + u * u), "{u}");
            }
        }
    }

    #[test]
    fn higher_terms_count_as_long_as_they_shrink() {
        let ends = |state: fn(f64) -> f64, to: f64| {
            let mut path = Path::default();
            for u in [0.0, 0.1, 0.2, 0.3, 0.4] {
                path.go(u, [state(u)].into_iter());
            }
            path.at(to).map_or(f64::NAN, |predicted| predicted[0])
        };
        let quartic = |u: f64| 1.0 + u + u * u + 0.5 * u.powi(3) + 0.25 * u.powi(4);
        assert!((ends(quartic, 0.6) - quartic(0.6)).abs() < 1e-13);
        // An older state beside the parabola, magnified by the distance, would lead away from it.
        let rough = |u: f64| u * u + if u == 0.1 { 0.01 } else { 0.0 };
        assert!((ends(rough, 1.1) - 1.1 * 1.1).abs() < 1e-12);
    }

    #[test]
    fn the_last_states_come_latest_first() {
        let mut path = Path::default();
        for k in 0..9 {
            let value = f64::from(k);
            path.go(value, [-value].into_iter());
            assert_eq!(path.bends(), k > 1);
            let expected: Vec<f64> = (0..=k).rev().take(MOST).map(f64::from).collect();
            assert_eq!(path.values(), expected);
            assert!((0..expected.len()).all(|ago| path.state(ago, 0) == -expected[ago]));
            // Two states give a straight line.
            if k == 1 {
                assert_eq!(path.at(3.0), Some(Vector::from([-3.0])));
            }
        }
    }

    #[test]
    fn repeated_values_predict_nothing() {
        let mut path = Path::default();
        path.go(1.0, [0.5].into_iter());
        path.go(1.0, [0.5].into_iter());
        assert_eq!(path.at(2.0), None);
    }

    #[test]
    fn a_state_on_another_branch_is_not_what_was_meant() {
        assert!(confirmed(&[1.01], &[1.0], &[0.9]));
        assert!(!confirmed(&[-1.0], &[1.0], &[0.9]));
        assert!(!confirmed(&[0.9], &[1.0], &[0.9]));
        assert!(confirmed(&[0.0], &[0.0], &[0.0]));
        assert!(!confirmed(&[99.0], &[100.0], &[0.9]));
    }
}
