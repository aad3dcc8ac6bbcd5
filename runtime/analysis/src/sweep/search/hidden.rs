//! Whether an even number of events may hide between three states.
//!
//! Each number that decides is bounded between the states. An eigenvalue that keeps apart from all others is smooth: it
//! is its cubic, but for the remainder that the middle state shows. Of two that come close neither need be smooth, but
//! `(s_1 + s_2) / 2` and `(s_1 - s_2)^2` are; so are they for an eigenvalue and its conjugate, which part on the real
//! axis.

use super::count::{Kind, Wanted};
use super::cubic::{Curve, Place};
use super::spectrum::{Root, Spectrum, rows};
use crate::Complex;

/// Places at which numbers are bounded in each of the two pieces.
const SAMPLES: usize = 8;
/// An eigenvalue farther from a threshold than so many times its distance from another is not brought there by it.
const FAR: f64 = 4.0;

/// Share of a piece, from its ends, at which its first turn is sought.
const CLOSE: f64 = 1.0 / 64.0;

/// A place at which a state tells more, and what about.
type Doubt = (f64, Kind);

/// A place where a number passes its threshold, and whether it counts behind it.
type Passing = (f64, bool);

/// A number at a place, measured from its threshold.
#[derive(Clone, Copy, Debug)]
struct Bounds {
    low: f64,
    high: f64,
    /// Whether what is not known about it is mere rounding.
    settled: bool,
}

/// A number that decides, between the states.
trait Number {
    fn bounds(&self, place: Place) -> Bounds;
    /// Where it may be extreme.
    fn turns(&self, piece: usize) -> Vec<f64>;
    /// The sign of its slope, if certain.
    fn rises(&self, place: Place) -> i8;
}

impl Wanted {
    /// A place at which a state tells more; `None` if each integer changes in one direction only between the states.
    pub(super) fn hidden(&self, states: [&Spectrum; 3]) -> Option<Doubt> {
        self.search(states).err()
    }

    fn search(&self, states: [&Spectrum; 3]) -> Result<(), Doubt> {
        let t = states.map(|state| state.t);
        let kinds = self.kinds();
        let mut stiff = false;
        for &kind in kinds.iter().filter(|kind| self.real(**kind)) {
            let lists = states.map(|state| self.roots(kind, state));
            let mut passings = Vec::new();
            for row in rows(lists, t) {
                let (number, counts) = self.single(kind, states, row);
                passings.extend(passing(&number, t, counts).map_err(|t| (t, kind))?);
            }
            opposed(&mut passings).map_or(Ok(()), |t| Err((t, kind)))?;
            stiff |= kind == Kind::Critical && states.iter().all(|x| self.count(kind, x) == 0);
        }
        let stable = stiff && self.conservative;
        let general = |kind: &Kind| match kind {
            Kind::Line(_) => states.iter().any(|state| self.meets(*kind, state)),
            // Growth is about every eigenvalue.
            Kind::Critical => !kinds.contains(&Kind::Growth),
            Kind::Growth => !stable,
        };
        let general = |kind: &Kind| !self.real(*kind) && general(kind);
        let kinds: Vec<Kind> = kinds.iter().copied().filter(general).collect();
        if kinds.is_empty() {
            return Ok(());
        }
        let all: Vec<Followed> =
            rows(states.map(|state| &state.roots[..]), t).into_iter().map(|row| Followed::new(t, row)).collect();
        let mut kinds = kinds.into_iter();
        kinds.try_for_each(|kind| self.general(kind, states, &all).map_err(|t| (t, kind)))
    }

    /// The numbers of general eigenvalues, alone or by two.
    fn general(&self, kind: Kind, states: [&Spectrum; 3], all: &[Followed]) -> Result<(), f64> {
        let t = states.map(|state| state.t);
        // Those of oscillations, and of motions without one: each a different integer.
        let mut passings: [Vec<Passing>; 2] = Default::default();
        for (i, one) in all.iter().enumerate() {
            if one.row[1].value.im < 0.0 {
                continue;
            }
            let (number, counts) = self.single(kind, states, one.row);
            // What grows counts as flutter or not by its imaginary part.
            let grows = |root: &Root| root.value.re > root.error;
            let grows = kind == Kind::Growth && one.row.iter().any(grows);
            let near = |j: &usize| {
                let other = &all[*j];
                let (second, _) = self.single(kind, states, other.row);
                let away = !grows && one.stays(&number, other) && other.stays(&second, one);
                *j != i && !away && one.meets(other)
            };
            let near: Vec<usize> = (0..all.len()).filter(near).collect();
            let real = one.row.iter().all(|root| root.value.im == 0.0);
            if near.is_empty() && (real || kind != Kind::Critical) {
                passings[usize::from(real)].extend(passing(&number, t, counts)?);
            }
            // Of three that grow and meet on the real axis no two are a pair throughout.
            let real = |root: &Root| root.value.im == 0.0;
            let parts = near.iter().map(|&j| &all[j]).chain([one]).flat_map(|x| &x.row).any(real);
            if grows && near.len() > 1 && parts {
                return Err(t[1]);
            }
            for j in near {
                let other = &all[j];
                if j < i && other.row[1].value.im >= 0.0 {
                    continue;
                }
                let [upper, lower] = [true, false].map(|upper| self.pair(kind, states, [one.row, other.row], upper));
                let line = matches!(kind, Kind::Line(_));
                match one.is_pair_with(other) && !line {
                    true => {
                        let parted = one.row.map(|root| root.value.im == 0.0);
                        let apart = |sign: f64| Apart { of: &upper.0, sign };
                        for (number, oscillates) in [(&upper, true), (&upper, false), (&lower, false)] {
                            let both = [0, 1, 2].map(|k| number.1[k] && parted[k] != oscillates);
                            let apart = apart(if oscillates { -1.0 } else { 1.0 });
                            let number = Both([&number.0, &apart]);
                            passings[usize::from(!oscillates)].extend(passing(&number, t, both)?);
                        }
                    }
                    false if kind == Kind::Critical => {}
                    false => {
                        for (number, counts) in [upper, lower] {
                            passings[0].extend(passing(&number, t, counts)?);
                        }
                    }
                }
            }
        }
        passings.iter_mut().try_for_each(|passings| opposed(passings).map_or(Ok(()), Err))
    }

    /// The number of one eigenvalue, and at which states it counts.
    fn single(&self, kind: Kind, states: [&Spectrum; 3], row: [Root; 3]) -> (Single, [bool; 3]) {
        let numbers = [0, 1, 2].map(|k| self.number(kind, states[k], &row[k]));
        let curve = Curve::new(states.map(|state| state.t), numbers.map(|x| x.0));
        let error = numbers.iter().fold(0.0, |most: f64, x| most.max(x.1));
        (Single { curve, error }, numbers.map(|(jet, error)| jet[0] > error))
    }

    /// The greater or the smaller number of two eigenvalues.
    fn pair(&self, kind: Kind, states: [&Spectrum; 3], [a, b]: [[Root; 3]; 2], upper: bool) -> (Pair, [bool; 3]) {
        let t = states.map(|state| state.t);
        let numbers = [a, b].map(|row| [0, 1, 2].map(|k| self.number(kind, states[k], &row[k])));
        let mean = [0, 1, 2].map(|k| {
            let [x, y] = [numbers[0][k].0, numbers[1][k].0];
            [0.5 * (x[0] + y[0]), 0.5 * (x[1] + y[1])]
        });
        let square = [0, 1, 2].map(|k| {
            let apart = a[k].value - b[k].value;
            (apart * apart, apart * (a[k].slope - b[k].slope) * 2.0)
        });
        let error = |k: usize| a[k].error + b[k].error;
        let of_square = |k: usize| {
            let apart = (a[k].value - b[k].value).norm();
            error(k) * (2.0 * apart + error(k))
        };
        let most = |of: &dyn Fn(usize) -> f64| (0..3).map(of).fold(0.0, f64::max);
        let pair = Pair {
            mean: Curve::new(t, mean),
            square: [
                Curve::new(t, square.map(|(x, d)| [x.re, d.re])),
                Curve::new(t, square.map(|(x, d)| [x.im, d.im])),
            ],
            alone: numbers.map(|of| Curve::new(t, of.map(|x| x.0))),
            errors: [most(&error), most(&of_square)],
            upper,
            imaginary: matches!(kind, Kind::Line(_)),
        };
        let counts = [0, 1, 2].map(|k| {
            let [x, y] = [&numbers[0][k], &numbers[1][k]].map(|(jet, error)| jet[0] > *error);
            if upper { x || y } else { x && y }
        });
        (pair, counts)
    }
}

/// An eigenvalue with the disks around it at places between the states.
struct Followed {
    row: [Root; 3],
    /// Centre and radius.
    disks: Vec<(Complex, f64)>,
}

impl Followed {
    fn new(t: [f64; 3], row: [Root; 3]) -> Self {
        let re = Curve::new(t, row.map(|root| [root.value.re, root.slope.re]));
        let im = Curve::new(t, row.map(|root| [root.value.im, root.slope.im]));
        let disk = |place: Place| {
            let [x, y] = [&re, &im].map(|curve| curve.at(place));
            let radius = x.rest + y.rest + x.rounding + y.rounding;
            (Complex::new(x.value, y.value), radius)
        };
        Self { disks: grid().map(disk).collect(), row }
    }

    /// Whether the two are a pair or real at every state, so that the square of their difference is real.
    fn is_pair_with(&self, other: &Self) -> bool {
        let mut both = self.row.iter().zip(&other.row);
        both.all(|(a, b)| a.value.im == -b.value.im && (a.value.im == 0.0 || a.value.re == b.value.re))
    }

    /// Whether the two may meet between the states.
    fn meets(&self, other: &Self) -> bool {
        let alike = |k: usize| self.row[k].is_like(&other.row[k]);
        if (0..3).all(alike) {
            return false;
        }
        let apart: Vec<Complex> = (self.disks.iter().zip(&other.disks)).map(|(a, b)| a.0 - b.0).collect();
        // Smooth is what keeps farther apart than it moves.
        apart.chunks(SAMPLES + 1).zip(self.disks.chunks(SAMPLES + 1)).zip(other.disks.chunks(SAMPLES + 1)).any(
            |((apart, a), b)| {
                let way: f64 = apart.windows(2).map(|two| (two[1] - two[0]).norm()).sum();
                let reach = a.iter().zip(b).map(|(a, b)| a.1 + b.1).fold(0.0, f64::max);
                let least = apart.iter().map(|x| x.norm()).fold(f64::INFINITY, f64::min);
                (way + FAR * reach).is_nan() || least <= way + FAR * reach
            },
        )
    }

    /// Whether its number keeps farther from the threshold than the other eigenvalue can bring it.
    fn stays(&self, number: &Single, other: &Self) -> bool {
        let mut all = grid().zip(self.disks.iter().zip(&other.disks));
        all.all(|(place, (a, b))| {
            let reach = a.1 + b.1 + (a.0 - b.0).norm();
            number.curve.at(place).value.abs() > FAR * reach
        })
    }
}

/// Places in both pieces, states included.
fn grid() -> impl Iterator<Item = Place> {
    (0..2).flat_map(|piece| (0..=SAMPLES).map(move |k| (piece, k as f64 / SAMPLES as f64)))
}

/// The number of one eigenvalue.
struct Single {
    curve: Curve,
    error: f64,
}

impl Number for Single {
    fn bounds(&self, place: Place) -> Bounds {
        let Self { curve, error } = *self;
        let found = curve.at(place);
        let reach = found.rest + found.rounding;
        Bounds {
            low: found.value - reach - error,
            high: found.value + reach + error,
            settled: found.rest <= found.rounding + error,
        }
    }

    fn turns(&self, piece: usize) -> Vec<f64> {
        self.curve.turns(piece).collect()
    }

    fn rises(&self, place: Place) -> i8 {
        self.curve.rises(place)
    }
}

/// The greater or the smaller number of two eigenvalues `(s_1 + s_2) / 2 +- sqrt((s_1 - s_2)^2) / 2`.
struct Pair {
    mean: Curve,
    /// Real and imaginary part of `(s_1 - s_2)^2`.
    square: [Curve; 2],
    /// Those of either eigenvalue by itself.
    alone: [Curve; 2],
    /// Of an eigenvalue, and of the square.
    errors: [f64; 2],
    upper: bool,
    /// Whether the number is that of imaginary parts.
    imaginary: bool,
}

impl Pair {
    /// Half of the real or imaginary part of the root of a number with this real part and size of the imaginary one.
    fn half(&self, x: f64, y: f64) -> f64 {
        let x = if self.imaginary { -x } else { x };
        let norm = x.hypot(y);
        // (|z| + x) (|z| - x) = y^2
        let twice = if x < 0.0 { y * y / (norm - x) } else { norm + x };
        0.5 * (0.5 * twice).sqrt()
    }

    /// The number at least and at most, if what is not known about the mean and the square is this.
    fn within(&self, mean: (f64, f64), [(x, dx), (y, dy)]: [(f64, f64); 2]) -> [f64; 2] {
        let dx = if self.imaginary { -dx } else { dx };
        // Either part of a root grows with |y|; the real one with x, the imaginary one against it.
        let least = self.half(x - dx, (y.abs() - dy).max(0.0));
        let most = self.half(x + dx, y.abs() + dy);
        if self.upper {
            [mean.0 - mean.1 + least, mean.0 + mean.1 + most]
        } else {
            [mean.0 - mean.1 - most, mean.0 + mean.1 - least]
        }
    }
}

impl Number for Pair {
    fn bounds(&self, place: Place) -> Bounds {
        let [error, of_square] = self.errors;
        let mean = self.mean.at(place);
        let square = self.square.each_ref().map(|curve| curve.at(place));
        let [low, high] = self.within(
            (mean.value, mean.rest + mean.rounding),
            square.map(|x| (x.value, x.rest + x.rounding + of_square)),
        );
        let rounded = self.within((mean.value, mean.rounding), square.map(|x| (x.value, x.rounding + of_square)));
        Bounds { low: low - error, high: high + error, settled: high - low <= 4.0 * (rounded[1] - rounded[0]) + error }
    }

    fn turns(&self, piece: usize) -> Vec<f64> {
        let value = |share: f64| {
            let bounds = self.bounds((piece, share));
            bounds.low + bounds.high
        };
        let mut shares: Vec<f64> = (0..=SAMPLES).map(|k| k as f64 / SAMPLES as f64).collect();
        shares.extend([CLOSE, 1.0 - CLOSE]);
        // Where the square is real, the part of its root may differ from zero on a short stretch only.
        let [first, second] = &self.alone;
        let curves = [&self.square[0], first, second].map(|curve| curve.turns(piece));
        let turns: Vec<f64> = curves.into_iter().flatten().collect();
        shares.extend(&turns);
        shares.sort_by(f64::total_cmp);
        let three = shares.windows(3).filter_map(|at| {
            let [a, b, c] = [at[0], at[1], at[2]].map(value);
            let sign = if b > a { 1.0 } else { -1.0 };
            (sign * (b - c) > 0.0).then(|| highest(|share| sign * value(share), [at[0], at[2]]))
        });
        three.chain(turns).collect()
    }

    fn rises(&self, _: Place) -> i8 {
        0
    }
}

/// Whether two eigenvalues are real (or, with the other sign, a pair): `(s_1 - s_2)^2`.
struct Apart<'a> {
    of: &'a Pair,
    sign: f64,
}

impl Number for Apart<'_> {
    fn bounds(&self, place: Place) -> Bounds {
        let (found, error) = (self.of.square[0].at(place), self.of.errors[1]);
        let reach = found.rest + found.rounding + error;
        Bounds {
            low: self.sign * found.value - reach,
            high: self.sign * found.value + reach,
            settled: found.rest <= found.rounding + error,
        }
    }

    fn turns(&self, piece: usize) -> Vec<f64> {
        self.of.square[0].turns(piece).collect()
    }

    fn rises(&self, place: Place) -> i8 {
        self.of.square[0].rises(place) * if self.sign > 0.0 { 1 } else { -1 }
    }
}

/// Whether two numbers are positive at once.
struct Both<'a>([&'a dyn Number; 2]);

impl Number for Both<'_> {
    fn bounds(&self, place: Place) -> Bounds {
        let [a, b] = self.0.map(|number| number.bounds(place));
        Bounds { low: a.low.min(b.low), high: a.high.min(b.high), settled: a.settled && b.settled }
    }

    fn turns(&self, piece: usize) -> Vec<f64> {
        self.0.map(|number| number.turns(piece)).into_iter().flatten().collect()
    }

    fn rises(&self, _: Place) -> i8 {
        0
    }
}

/// The place between two others at which a function with one maximum there is the highest.
fn highest(function: impl Fn(f64) -> f64, [mut from, mut to]: [f64; 2]) -> f64 {
    for _ in 0..60 {
        let third = (to - from) / 3.0;
        if function(from + third) > function(to - third) { to -= third } else { from += third }
    }
    0.5 * (from + to)
}

/// Where a number passes its threshold once, if it counts at some of the states only; an error is a place that tells more.
fn passing(number: &dyn Number, t: [f64; 3], counts: [bool; 3]) -> Result<Vec<Passing>, f64> {
    let mut passings: Vec<Passing> = Vec::new();
    // The last place where it is known whether the number counts, and what follows where it is not.
    let mut last = (t[0], counts[0]);
    let mut open: Vec<(f64, Bounds, i8)> = Vec::new();
    // The place farthest beyond the threshold since it was passed.
    let mut top = (t[0], 0.0);
    let mut known = |at: f64, above: bool, beyond: f64, open: &mut Vec<(f64, Bounds, i8)>| {
        if above == last.1 {
            let worst = |x: &(f64, Bounds, i8)| if above { -x.1.low } else { x.1.high };
            let worst = open.iter().max_by(|a, b| worst(a).total_cmp(&worst(b)));
            // What is within rounding everywhere, as the distance of equal eigenvalues, stays so.
            let rounding = open.len() >= SAMPLES - 1 && open.iter().all(|x| x.1.settled);
            worst.filter(|_| !rounding).map_or(Ok(()), |x| Err(x.0))?;
        } else {
            let direction = if above { 1 } else { -1 };
            let steady = |x: &(f64, Bounds, i8)| x.1.settled || x.2 == direction;
            if open.len() > 1 && !open.iter().all(steady) {
                return Err(open[open.len() / 2].0);
            }
            if !passings.is_empty() {
                return Err(top.0);
            }
            passings.push((0.5 * (last.0 + at), above));
            top = (at, 0.0);
        }
        if beyond > top.1 {
            top = (at, beyond);
        }
        open.clear();
        last = (at, above);
        Ok(())
    };
    for piece in 0..2 {
        let grid = (1..SAMPLES).map(|k| k as f64 / SAMPLES as f64);
        let mut shares: Vec<f64> = grid.chain(number.turns(piece)).collect();
        shares.sort_by(f64::total_cmp);
        for share in shares {
            let place = (piece, share);
            let at = t[piece] + share * (t[piece + 1] - t[piece]);
            let bounds = number.bounds(place);
            if bounds.low > 0.0 || bounds.high < 0.0 {
                let beyond = bounds.low.max(-bounds.high);
                known(at, bounds.low > 0.0, beyond, &mut open)?;
            } else {
                open.push((at, bounds, number.rises(place)));
            }
        }
        known(t[piece + 1], counts[piece + 1], 0.0, &mut open)?;
    }
    Ok(passings)
}

/// A place between passings in opposite directions.
fn opposed(passings: &mut [Passing]) -> Option<f64> {
    passings.sort_by(|a, b| a.0.total_cmp(&b.0));
    let two = passings.windows(2).find(|two| two[0].1 != two[1].1)?;
    Some(0.5 * (two[0].0 + two[1].0))
}
