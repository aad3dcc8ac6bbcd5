//! Where a number vanishes between three neighbouring states at which it and its slope are known.
//!
//! Between two states a smooth function is the cubic with their values and slopes, but for a remainder
//! `f''''/24 (t - a)^2 (t - b)^2`. The state in the middle shows how large the remainder is. A sign of the cubic counts
//! where the remainder cannot change it; since the remainder vanishes with its slope at both ends, a state at a minimum
//! shows the sign of everything around it.

use core::ops::{Add, Mul, Sub};

/// A number at one state: its value, its slope along the step, and the error up to which the value counts as zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Jet {
    pub(super) value: f64,
    pub(super) slope: f64,
    pub(super) error: f64,
}

impl Jet {
    fn vanishes(&self) -> bool {
        self.value.abs() <= self.error
    }
}

/// Where a number vanishes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Zero {
    /// Two places on either side of it.
    pub(super) between: [f64; 2],
    /// Its place on the cubic.
    pub(super) at: f64,
    pub(super) passage: Passage,
}

/// How a number passes zero along a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Passage {
    Rises,
    Falls,
    /// It touches zero and turns back.
    Touches,
}

/// What can be said about a number between three states.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Finding {
    /// It vanishes exactly here, if at all; a zero at the last state is left to the next three.
    Zeros(Vec<Zero>),
    /// A state at this place tells more.
    Divide(f64),
}

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

/// Samples in each of the two pieces.
const SAMPLES: usize = 8;
/// Share of the size of a number below which its changes count as none where it vanishes at every state.
const STILL: f64 = 1e-6;
/// Rounding of a cubic as a share of the terms that it adds up.
const ROUNDING: f64 = 4.0 * f64::EPSILON;
/// How much larger the remainder of a piece may be than that of the whole, divided by 16 for its half length.
const SAFETY: f64 = 8.0;

/// Three states along a step and the number there; `size` is what the number is compared with.
pub(super) struct Triple {
    pub(super) t: [f64; 3],
    pub(super) jets: [Jet; 3],
    pub(super) size: f64,
}

/// A place with the cubic there.
#[derive(Clone, Copy, Debug)]
struct Sample {
    t: f64,
    value: f64,
    /// The error up to which the value counts as zero.
    error: f64,
    /// 1 or -1 where it is certain, else 0.
    sign: i8,
    /// The sign of the slope, in the same way.
    rising: i8,
}

fn certain(value: f64, doubt: f64) -> i8 {
    if value > doubt {
        1
    } else if value < -doubt {
        -1
    } else {
        0
    }
}

impl Triple {
    /// Where the number vanishes in `[t_0, t_2)`, or in `[t_0, t_2]` if the last state `closes` the search.
    pub(super) fn zeros(&self, closes: bool) -> Finding {
        let [first, middle, last] = self.t;
        let still = |jet: &Jet| {
            jet.vanishes() && jet.slope.abs() * (last - first) <= STILL * self.size + jet.error
        };
        if self.jets.iter().all(still) {
            return Finding::Zeros(Vec::new());
        }
        let samples = self.samples();
        let definite: Vec<usize> = (0..samples.len())
            .filter(|&k| samples[k].sign != 0)
            .collect();
        let (Some(&begin), Some(&end)) = (definite.first(), definite.last()) else {
            return Finding::Divide(middle);
        };
        let mut zeros = Vec::new();
        if begin > 0 {
            match self.at_end(&samples[..=begin], 0) {
                Some(passage) => zeros.push(Zero {
                    between: [first, first],
                    at: first,
                    passage,
                }),
                None => return Finding::Divide(self.turning(first, samples[begin].t)),
            }
        }
        for pair in definite.windows(2) {
            let run = &samples[pair[0]..=pair[1]];
            let (a, b) = (run[0], run[run.len() - 1]);
            if a.sign == b.sign {
                if run.len() > 2 {
                    return Finding::Divide(self.turning(a.t, b.t));
                }
                continue;
            }
            let at = self.root(a, b);
            let steady = |sample: &Sample| sample.rising == b.sign;
            if !run[1..run.len() - 1].iter().all(steady) || !steady(&self.sample_at(at)) {
                return Finding::Divide(self.turning(a.t, b.t));
            }
            zeros.push(Zero {
                between: [a.t, b.t],
                at,
                passage: match b.sign {
                    1 => Passage::Rises,
                    _ => Passage::Falls,
                },
            });
        }
        if end + 1 < samples.len() {
            let mut run = samples[end..].to_vec();
            run.reverse();
            match self.at_end(&run, 2) {
                Some(passage) if closes => zeros.push(Zero {
                    between: [last, last],
                    at: last,
                    passage,
                }),
                Some(_) => {}
                None => return Finding::Divide(self.turning(samples[end].t, last)),
            }
        }
        self.widen(&mut zeros);
        Finding::Zeros(zeros)
    }

    /// Moves the places around each zero apart, to the nearest state or half of the way to the next zero.
    fn widen(&self, zeros: &mut [Zero]) {
        let places: Vec<f64> = zeros.iter().map(|zero| zero.at).collect();
        for (k, zero) in zeros.iter_mut().enumerate() {
            if zero.between[0] == zero.between[1] {
                continue;
            }
            let before = self.t.iter().rev().find(|t| **t < zero.between[0]);
            let after = self.t.iter().find(|t| **t > zero.between[1]);
            let mut between = [before, after].map(|t| t.copied());
            if let Some(last) = k.checked_sub(1).map(|k| places[k]) {
                between[0] = between[0].map(|t| t.max(0.5 * (last + zero.at)));
            }
            if let Some(next) = places.get(k + 1) {
                between[1] = between[1].map(|t| t.min(0.5 * (next + zero.at)));
            }
            zero.between[0] = between[0].unwrap_or(zero.between[0]);
            zero.between[1] = between[1].unwrap_or(zero.between[1]);
        }
    }

    /// How the number vanishes at the first state of a run that ends where its sign is certain; `None` if it may vanish
    /// again within the run.
    fn at_end(&self, run: &[Sample], which: usize) -> Option<Passage> {
        let (from, to) = (run[0], run[run.len() - 1]);
        let jet = self.jets[which];
        let direction = if which == 0 { 1 } else { -1 };
        // A parabola whose vertex is no farther from zero than the error.
        let distance = to.t - from.t;
        let bend = 2.0 * (to.value - jet.value - jet.slope * distance) / (distance * distance);
        let depth = jet.slope * jet.slope / (2.0 * bend.abs());
        let inner = &run[1..run.len() - 1];
        let near = inner.len() <= 1 || inner.iter().all(|x| x.value.abs() <= 2.0 * x.error);
        if certain(bend, 0.0) == to.sign && near && depth <= jet.error {
            return Some(Passage::Touches);
        }
        let passage = to.sign * direction;
        let steady = run.iter().all(|sample| sample.rising == passage);
        steady.then_some(match passage {
            1 => Passage::Rises,
            _ => Passage::Falls,
        })
    }

    /// The cubic at places in both pieces, among them those where it turns.
    fn samples(&self) -> Vec<Sample> {
        let rests = self.rests();
        let mut samples = Vec::with_capacity(2 * SAMPLES + 5);
        for (piece, rest) in rests.into_iter().enumerate() {
            let mut shares: Vec<f64> = (0..SAMPLES).map(|k| k as f64 / SAMPLES as f64).collect();
            shares.extend(self.turns(piece));
            shares.sort_by(f64::total_cmp);
            shares.dedup();
            samples.extend(shares.iter().map(|&share| self.sample(piece, share, rest)));
        }
        samples.push(self.sample(1, 1.0, 0.0));
        samples
    }

    /// The cubic of a piece, whose remainder is at most `rest`.
    fn sample(&self, piece: usize, share: f64, rest: f64) -> Sample {
        let (t, h) = (self.t[piece], self.t[piece + 1] - self.t[piece]);
        let (from, to) = (self.jets[piece], self.jets[piece + 1]);
        let [value, slope] = cubic([from.value, from.slope], [to.value, to.slope], h, share);
        let (bump, linear) = (share * (1.0 - share), |of: fn(&Jet) -> f64| {
            of(&from) * (1.0 - share) + of(&to) * share
        });
        let terms = from.value.abs() + to.value.abs() + h * linear(|jet| jet.slope.abs());
        let rounding = ROUNDING * (linear(|jet| jet.value.abs()) + bump * terms);
        let error = linear(|jet| jet.error) + rounding;
        Sample {
            t: t + share * h,
            value,
            error,
            sign: certain(value, 16.0 * rest * bump * bump + error),
            rising: certain(slope, 32.0 * rest * bump / h),
        }
    }

    /// The largest remainder of the cubic of either piece, from what the middle state shows of that of the whole.
    fn rests(&self) -> [f64; 2] {
        let [a, m, b] = self.jets;
        let [first, middle, last] = self.t;
        let h = last - first;
        let share = (middle - first) / h;
        let [value, slope] = cubic([a.value, a.slope], [b.value, b.slope], h, share);
        let bump = share * (1.0 - share);
        let missed = (value - m.value).abs() / (16.0 * bump * bump);
        let whole = missed.max(0.25 * (slope - m.slope).abs() * h);
        [share, 1.0 - share].map(|share| SAFETY * whole * share.powi(4))
    }

    /// Where the cubic of a piece turns, as shares of it.
    fn turns(&self, piece: usize) -> impl Iterator<Item = f64> + use<> {
        let h = self.t[piece + 1] - self.t[piece];
        let (from, to) = (self.jets[piece], self.jets[piece + 1]);
        let (a, b) = (from.slope * h, to.slope * h);
        let rise = to.value - from.value;
        // a + 2 c x + 3 d x^2
        let (c, d) = (3.0 * rise - 2.0 * a - b, a + b - 2.0 * rise);
        let root = (c * c - 3.0 * a * d).sqrt();
        let sum = -(c + root.copysign(c));
        let inside = |share: &f64| *share > 0.0 && *share < 1.0;
        [sum / (3.0 * d), a / sum].into_iter().filter(inside)
    }

    /// The place between two others where the number turns; their middle if it does not.
    fn turning(&self, from: f64, to: f64) -> f64 {
        let turns = |piece: usize| {
            let (start, h) = (self.t[piece], self.t[piece + 1] - self.t[piece]);
            self.turns(piece).map(move |share| start + share * h)
        };
        let inside = |t: &f64| *t > from && *t < to;
        let mut all = turns(0).chain(turns(1)).filter(inside);
        all.next().unwrap_or(0.5 * (from + to))
    }

    /// The place between two samples at which the cubic vanishes.
    fn root(&self, a: Sample, b: Sample) -> f64 {
        let (mut from, mut to) = (a.t, b.t);
        for _ in 0..60 {
            let middle = 0.5 * (from + to);
            match (self.sample_at(middle).value > 0.0) == (b.sign > 0) {
                true => to = middle,
                false => from = middle,
            }
        }
        0.5 * (from + to)
    }

    fn sample_at(&self, t: f64) -> Sample {
        let piece = usize::from(t > self.t[1]);
        let h = self.t[piece + 1] - self.t[piece];
        self.sample(piece, (t - self.t[piece]) / h, self.rests()[piece])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn jets(t: [f64; 3], f: impl Fn(f64) -> [f64; 2], error: f64) -> Triple {
        let jets = t.map(|t| {
            let [value, slope] = f(t);
            Jet {
                value,
                slope,
                error,
            }
        });
        Triple { t, jets, size: 1.0 }
    }

    /// All zeros of a function on `[0, 1]`, found by division, and the number of states.
    fn all(f: impl Fn(f64) -> [f64; 2], error: f64) -> (Vec<(f64, Passage)>, usize) {
        let (mut all_zeros, mut states) = (Vec::new(), 1);
        let mut open = vec![(0.0, 1.0)];
        while let Some((from, to)) = open.pop() {
            states += 2;
            assert!(states < 300, "{all_zeros:?} {from} {to}");
            let triple = jets([from, 0.5 * (from + to), to], &f, error);
            match triple.zeros(to == 1.0) {
                Finding::Zeros(zeros) => {
                    all_zeros.extend(zeros.iter().map(|zero| (zero.at, zero.passage)));
                }
                Finding::Divide(t) => {
                    assert!(t > from && t < to, "{from} {t} {to}");
                    open.extend([(t, to), (from, t)]);
                }
            }
        }
        (all_zeros, states)
    }

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

    #[test]
    fn every_zero_of_a_polynomial_is_found_once() {
        let cases: [&[f64]; 9] = [
            &[0.4],
            &[0.4, 0.400_01],
            &[0.5, 0.5 + 1e-6, 0.9],
            &[0.0, 1.0],
            &[0.25, 0.5, 0.75],
            &[-0.001, 0.5, 1.001],
            &[0.1, 0.11, 0.12, 0.7, 0.71, 0.72],
            &[],
            &[0.5, 0.25, 0.2501],
        ];
        for roots in cases {
            for amount in [1.0_f64, -1e6, 1e-6] {
                let (zeros, states) = all(|t| product(roots, amount, t), 1e-15 * amount.abs());
                let mut expected = roots.to_vec();
                expected.retain(|root| (0.0..=1.0).contains(root));
                expected.sort_by(f64::total_cmp);
                assert_eq!(zeros.len(), expected.len(), "{roots:?}: {zeros:?}");
                for (zero, expected) in zeros.iter().zip(&expected) {
                    assert!((zero.0 - expected).abs() < 1e-3, "{zero:?}");
                    assert!(zero.1 != Passage::Touches);
                }
                assert!(states < 12 * (roots.len() + 1), "{roots:?} {states}");
            }
        }
    }

    #[test]
    fn a_number_that_touches_zero_is_told_from_one_that_crosses_or_stays_away() {
        for root in [0.3, 0.5, 0.123_456] {
            for (depth, expected) in [(0.0, Some(Passage::Touches)), (1e-9, None)] {
                let f = |t: f64| {
                    let [value, slope] = product(&[root, root], 1.0, t);
                    [value * (1.0 + t) + depth, slope * (1.0 + t) + value]
                };
                let (zeros, states) = all(f, 1e-14);
                let passages: Vec<_> = zeros.iter().map(|zero| zero.1).collect();
                assert_eq!(passages, Vec::from_iter(expected), "{root} {depth}");
                assert!(states < 60, "{states}");
            }
            let f = |t: f64| {
                let [value, slope] = product(&[root, root], 1.0, t);
                [value - 1e-10, slope]
            };
            let (zeros, _) = all(f, 1e-14);
            assert_eq!(zeros.len(), 2, "{zeros:?}");
        }
    }

    #[test]
    fn a_number_that_is_zero_throughout_has_no_zeros() {
        let (zeros, states) = all(|t| [1e-16 * (9.0 * t).sin(), 1e-15], 1e-15);
        assert!(zeros.is_empty() && states == 3);
    }

    /// Away from zero nothing needs to be resolved.
    #[test]
    fn what_happens_far_from_zero_costs_nothing() {
        let f = |t: f64| [10.0 + (40.0 * t).sin(), 40.0 * (40.0 * t).cos()];
        let (zeros, states) = all(f, 1e-15);
        assert!(zeros.is_empty() && states <= 31, "{states}");
    }
}
