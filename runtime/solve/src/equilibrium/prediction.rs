//! Predicts where an equilibrium moves along an input, from the last states of the path.

use crate::algebra::{Vector, all_finite, greater, largest};

/// Share of the distance by which a prediction may miss.
pub const MISSED: f64 = 0.25;
/// Largest difference between coordinates that count as unchanged.
pub const STILL: f64 = 1e-9;
/// Last steps beyond which a parabola through them is no prediction.
const FAR: f64 = 8.0;

/// A value of the input and the state there.
pub type Passed<'a> = (f64, &'a [f64]);

/// The last states of the path, at most three.
#[derive(Clone, Debug, Default)]
#[doc(hidden)]
pub struct Path {
    /// In a ring.
    states: [(f64, Vector); 3],
    /// Position of the latest.
    latest: usize,
    count: usize,
}

impl Path {
    /// Moves on to the state at another value of the input.
    #[doc(hidden)]
    pub fn go(&mut self, value: f64, q: impl ExactSizeIterator<Item = f64>) {
        self.latest = (self.latest + 1) % 3;
        let (last, state) = &mut self.states[self.latest];
        *last = value;
        state.assign(q);
        self.count = (self.count + 1).min(3);
    }

    /// The last three states, the latest first; `None` if there are fewer.
    #[doc(hidden)]
    pub fn last_three(&self) -> Option<[Passed<'_>; 3]> {
        (self.count == 3).then(|| self.latest_first())
    }

    fn latest_first(&self) -> [Passed<'_>; 3] {
        [0, 2, 1].map(|ahead| {
            let (value, state) = &self.states[(self.latest + ahead) % 3];
            (*value, &state[..])
        })
    }

    /// Whether a value of the input is too far beyond the last states for them to tell the state there.
    #[doc(hidden)]
    pub fn is_far(&self, value: f64) -> bool {
        let [(u0, _), (u1, _), _] = self.latest_first();
        self.count > 1 && (value - u0).abs() > FAR * (u0 - u1).abs()
    }

    /// Extrapolates the state to a value of the input, by a parabola or straight line through the last states. `None`
    /// if there are fewer than two states, if the value is [far](Self::is_far), or if values of the input repeat.
    #[doc(hidden)]
    pub fn at(&self, value: f64) -> Option<Vector> {
        let [(u0, q0), (u1, q1), (u2, q2)] = self.latest_first();
        if self.count < 2 || self.is_far(value) {
            return None;
        }
        let (first, second) = ((value - u0) / (u0 - u1), (value - u1) / (u0 - u2));
        let curved = self.count == 3 && second.is_finite();
        let q2 = if curved { q2 } else { q1 };
        let bend = if curved { first * second } else { 0.0 };
        let ratio = if curved { (u0 - u1) / (u1 - u2) } else { 0.0 };
        let predicted = Vector::from_fn(q0.len(), |i| {
            let slope = q0[i] - q1[i];
            q0[i] + first * slope + bend * (slope - ratio * (q1[i] - q2[i]))
        });
        all_finite(&predicted).then_some(predicted)
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
    fn the_last_three_states_come_latest_first() {
        let mut path = Path::default();
        for k in 0..7 {
            let value = f64::from(k);
            path.go(value, [-value].into_iter());
            let last = path.last_three();
            if k < 2 {
                assert_eq!(last, None);
            } else {
                let passed = [0.0, 1.0, 2.0].map(|ago| value - ago);
                let states = passed.map(|value| [-value]);
                assert_eq!(last, Some([0, 1, 2].map(|i| (passed[i], &states[i][..]))));
            }
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
