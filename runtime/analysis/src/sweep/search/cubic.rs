//! A smooth number between three states at which it and its slope are known.
//!
//! Between two states it is the cubic with their values and slopes, but for a remainder
//! `f''''/24 (t - a)^2 (t - b)^2`. How large that is, the state in the middle shows: by what the cubic through the other
//! two misses it.

use core::ops::{Add, Mul, Sub};

/// The value and the slope, at `share` of the distance `h`, of the cubic with these values and slopes at both ends.
pub(super) fn cubic<T>(first: [T; 2], last: [T; 2], h: f64, share: f64) -> [T; 2]
where
    T: Copy + Add<Output = T> + Sub<Output = T> + Mul<f64, Output = T>,
{
    let (x, y) = (share, 1.0 - share);
    let rise = last[0] - first[0];
    let (left, right) = (first[1] * h - rise, rise - last[1] * h);
    let value = first[0] * y + last[0] * x + (left * y + right * x) * (x * y);
    let slope = rise + left * (y * (y - 2.0 * x)) + right * (x * (2.0 * y - x));
    [value, slope * (1.0 / h)]
}

/// How much larger the remainder of a piece may be than that of the whole, divided by 16 for its half length.
const SAFETY: f64 = 8.0;
/// Rounding of a cubic as a share of the terms that it adds up.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// A place between three states: which of the two pieces, and the share of it.
pub(super) type Place = (usize, f64);

/// Values and slopes at three states.
#[derive(Clone, Copy, Debug)]
pub(super) struct Curve {
    t: [f64; 3],
    jets: [[f64; 2]; 3],
    rests: [f64; 2],
    rounding: f64,
}

/// A number at a place: what the cubic says, by how much that may be wrong, and what of it is rounding.
#[derive(Clone, Copy, Debug)]
pub(super) struct Estimate {
    pub(super) value: f64,
    pub(super) rest: f64,
    pub(super) rounding: f64,
}

impl Curve {
    /// A slope that is not known, as where eigenvalues merge, counts as zero; the remainder shows it.
    pub(super) fn new(t: [f64; 3], jets: [[f64; 2]; 3]) -> Self {
        let jets = jets.map(|[value, slope]| if slope.is_finite() { [value, slope] } else { [value, 0.0] });
        let h = t[2] - t[0];
        let share = (t[1] - t[0]) / h;
        let [value, slope] = cubic(jets[0], jets[2], h, share);
        let bump = share * (1.0 - share);
        let missed = (value - jets[1][0]).abs() / (16.0 * bump * bump);
        let whole = missed.max(0.25 * (slope - jets[1][1]).abs() * h);
        let size = |[value, slope]: &[f64; 2]| value.abs() + h * slope.abs();
        Self {
            t,
            rests: [share, 1.0 - share].map(|share| SAFETY * whole * share.powi(4)),
            rounding: ROUNDING * jets.iter().map(size).fold(0.0, f64::max),
            jets,
        }
    }

    #[cfg(test)]
    fn time(&self, (piece, share): Place) -> f64 {
        self.t[piece] + share * (self.t[piece + 1] - self.t[piece])
    }

    pub(super) fn at(&self, (piece, share): Place) -> Estimate {
        let h = self.t[piece + 1] - self.t[piece];
        let [value, _] = cubic(self.jets[piece], self.jets[piece + 1], h, share);
        let bump = share * (1.0 - share);
        let rounding = self.rounding;
        Estimate { value, rest: 16.0 * self.rests[piece] * bump * bump, rounding }
    }

    /// The sign of the slope: 1 or -1 where it is certain, else 0.
    pub(super) fn rises(&self, (piece, share): Place) -> i8 {
        let h = self.t[piece + 1] - self.t[piece];
        let [_, slope] = cubic(self.jets[piece], self.jets[piece + 1], h, share);
        let doubt = 32.0 * self.rests[piece] * share * (1.0 - share) / h;
        i8::from(slope > doubt) - i8::from(slope < -doubt)
    }

    /// Where the cubic of a piece turns, as shares of it.
    pub(super) fn turns(&self, piece: usize) -> impl Iterator<Item = f64> + use<> {
        let h = self.t[piece + 1] - self.t[piece];
        let (from, to) = (self.jets[piece], self.jets[piece + 1]);
        let (a, b) = (from[1] * h, to[1] * h);
        let rise = to[0] - from[0];
        // a + 2 c x + 3 d x^2
        let (c, d) = (3.0 * rise - 2.0 * a - b, a + b - 2.0 * rise);
        let sum = -(c + (c * c - 3.0 * a * d).sqrt().copysign(c));
        [sum / (3.0 * d), a / sum].into_iter().filter(|share| *share > 0.0 && *share < 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `amount (t - r_1) (t - r_2) ..` and its slope.
    fn product(roots: &[f64], amount: f64, t: f64) -> [f64; 2] {
        let mut jet = [amount, 0.0];
        for root in roots {
            jet = [jet[0] * (t - root), jet[1] * (t - root) + jet[0]];
        }
        jet
    }

    #[test]
    fn the_cubic_is_exact_for_cubics() {
        let f = |t: f64| product(&[0.3, -1.0, 2.5], 1.7, t);
        for t in [1.0, 1.25, 1.9, 2.0] {
            let interpolated = cubic(f(1.0), f(2.0), 1.0, t - 1.0);
            for (actual, expected) in interpolated.into_iter().zip(f(t)) {
                assert!((actual - expected).abs() < 1e-13);
            }
        }
    }

    /// The remainder covers what smooth functions do beside their cubics, and is rounding for a cubic.
    #[test]
    fn the_remainder_covers_what_the_cubic_misses() {
        let f = |t: f64| [(3.0 * t).sin(), 3.0 * (3.0 * t).cos()];
        let t = [0.2, 0.45, 0.7];
        let curve = Curve::new(t, t.map(f));
        for k in 0..40 {
            let place = (k % 2, f64::from(u8::try_from(k).unwrap()) / 40.0);
            let (found, expected) = (curve.at(place), f(curve.time(place))[0]);
            let off = (found.value - expected).abs();
            assert!(off <= found.rest + found.rounding, "{off} {found:?}");
            assert!(found.rest < 1e-2);
        }
        let curve = Curve::new(t, t.map(|t| product(&[0.3, -1.0, 2.5], 1.7, t)));
        assert!(curve.at((0, 0.5)).rest < 1e-13);
        let turns: Vec<f64> = curve.turns(0).collect();
        assert!(turns.is_empty(), "{turns:?}");
    }
}
