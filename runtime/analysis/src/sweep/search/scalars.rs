//! The numbers whose zeros are events, and where they vanish between three states of a step.
//!
//! | event | number |
//! | --- | --- |
//! | an undamped frequency meets a line `L` | `lambda - L^2` |
//! | a damped frequency meets a line `L` | `Im s - L` |
//! | an oscillation starts or stops growing | `Re s`; the sum of a pair that is real at some states |
//! | flutter turns into divergence | `(s_1 - s_2)^2` of a growing pair |
//! | two oscillations without damping merge | `(s_1 - s_2)^2`, negative while both keep their amplitude |
//! | stiffness vanishes | `lambda` of a symmetric `Khat`; otherwise a real `s`, or the product of a pair |

use super::cubic::{Finding, Jet, Passage, Triple, Zero, cubic};
use super::spectrum::{Chain, Chains, Root, Spectrum, Two, between, sum_and_product};
use crate::Complex;
use crate::sweep::condition::Line;

/// What to look for, and what is known about the eigenvalues.
#[derive(Clone, Debug)]
pub(super) struct Wanted {
    pub(super) lines: Vec<Line>,
    /// Oscillations that start or stop growing.
    pub(super) growth: bool,
    /// Vanishing stiffness.
    pub(super) critical: bool,
    /// The eigenvalues of the modes are `lambda`.
    pub(super) undamped: bool,
    /// `Khat` is symmetric, and has eigenvalues `lambda` of its own.
    pub(super) symmetric: bool,
    /// Nothing feeds or takes energy: positive stiffness excludes growth.
    pub(super) conservative: bool,
}

/// An event of a kind that needs no further search.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// A frequency meets the line at this position.
    Line(usize),
    Growth,
    /// Two oscillations begin or cease to be equal.
    Merging,
    /// A growing pair becomes real, or complex again.
    Turning,
    Critical,
}

/// An event between three states.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Candidate {
    pub(super) kind: Kind,
    pub(super) zero: Zero,
    /// About the eigenvalue, or the two, at the event.
    pub(super) near: [Complex; 2],
}

/// What can be said about the stretch between three states.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Stretch {
    /// All its events.
    Events(Vec<Candidate>),
    /// A state at this place tells more.
    Divide(f64, Kind),
}

/// Samples in each piece at which two neighbouring eigenvalues are compared.
const SAMPLES: usize = 8;

impl Wanted {
    /// The events between three states; the last state is part of the stretch only if it `closes` the search.
    pub(super) fn events(&self, states: [&Spectrum; 3], closes: bool) -> Stretch {
        let search = Search {
            wanted: self,
            states,
            roots: moving(states.map(|state| &state.roots[..])),
            t: states.map(|state| state.t),
            closes,
            events: Vec::new(),
        };
        search.all()
    }
}

struct Search<'a> {
    wanted: &'a Wanted,
    states: [&'a Spectrum; 3],
    roots: [Vec<Root>; 3],
    t: [f64; 3],
    closes: bool,
    events: Vec<Candidate>,
}

/// The eigenvalues of three states without those that are zero at all of them, because nothing ever resists a motion.
fn moving(states: [&[Root]; 3]) -> [Vec<Root>; 3] {
    let neutral = states.map(|roots| roots.iter().filter(|root| root.neutral).count());
    let always = neutral[0].min(neutral[1]).min(neutral[2]);
    states.map(|roots| {
        let mut left = always;
        let moves = |root: &&Root| {
            let dropped = root.neutral && left > 0;
            left -= usize::from(dropped);
            !dropped
        };
        roots.iter().filter(moves).copied().collect()
    })
}

/// The place of the next state, and what needs it.
type Needs = (f64, Kind);

impl Search<'_> {
    fn all(mut self) -> Stretch {
        match self.look() {
            Ok(()) => Stretch::Events(self.events),
            Err((t, kind)) => Stretch::Divide(t, kind),
        }
    }

    fn look(&mut self) -> Result<(), Needs> {
        let wanted = self.wanted;
        let roots = self.roots.each_ref().map(|roots| &roots[..]);
        let unknown = match (wanted.growth, wanted.lines.is_empty()) {
            (true, _) => Kind::Growth,
            (false, false) => Kind::Line(0),
            (false, true) => Kind::Critical,
        };
        let chains = Chains::new(roots, self.t).ok_or((self.t[1], unknown))?;
        if wanted.undamped {
            for &chain in &chains.real {
                if wanted.critical {
                    self.plain(Kind::Critical, chain)?;
                }
                self.square_lines(chain)?;
            }
            return Ok(());
        }
        let mut stiff = false;
        if wanted.critical && wanted.symmetric {
            stiff = self.stiffness()?;
        }
        for &chain in &chains.pairs {
            self.lines(chain)?;
        }
        if wanted.critical && !wanted.symmetric {
            for &chain in &chains.real {
                self.plain(Kind::Critical, chain)?;
            }
            for &[i, j, k] in &chains.pairs {
                self.both(Kind::Critical, [i, j, k].map(Two::Pair))?;
            }
            for &changing in &chains.changing {
                self.both(Kind::Critical, changing)?;
            }
        }
        if wanted.growth && !(stiff && wanted.conservative) {
            self.growth(&chains)?;
        }
        Ok(())
    }

    /// The zeros of a number, as events of a kind.
    fn zeros(
        &mut self,
        kind: Kind,
        jets: [Jet; 3],
        size: f64,
        near: impl Fn(f64) -> [Complex; 2],
    ) -> Result<(), Needs> {
        let triple = Triple {
            t: self.t,
            jets,
            size,
        };
        match triple.zeros(self.closes) {
            Finding::Divide(t) => Err((t, kind)),
            Finding::Zeros(zeros) => {
                self.events.extend(zeros.into_iter().map(|zero| Candidate {
                    kind,
                    near: near(zero.at),
                    zero,
                }));
                Ok(())
            }
        }
    }

    fn roots(&self, chain: Chain) -> [Root; 3] {
        [0, 1, 2].map(|k| self.roots[k][chain[k]])
    }

    /// The eigenvalue of a chain at any place.
    fn value(&self, chain: Chain) -> impl Fn(f64) -> Complex + use<> {
        let (roots, t) = (self.roots(chain), self.t);
        move |at| {
            let states = [0, 1, 2].map(|k| core::slice::from_ref(&roots[k]));
            between(states, [0; 3], t, at)
        }
    }

    /// The zeros of the real part of an eigenvalue.
    fn plain(&mut self, kind: Kind, chain: Chain) -> Result<(), Needs> {
        let roots = self.roots(chain);
        let jets = roots.map(|root| Jet {
            value: root.value.re,
            slope: root.slope.re,
            error: root.error,
        });
        let value = self.value(chain);
        self.zeros(kind, jets, largest(&roots), |t| [value(t); 2])
    }

    /// Where an undamped frequency meets a line.
    fn square_lines(&mut self, chain: Chain) -> Result<(), Needs> {
        for k in 0..self.wanted.lines.len() {
            let Line { ratio, offset } = self.wanted.lines[k];
            let jets = [0, 1, 2].map(|i| {
                let (root, [u, du]) = (self.roots(chain)[i], self.states[i].input);
                let line = ratio * u + offset;
                Jet {
                    value: root.value.re - line * line,
                    slope: root.slope.re - 2.0 * line * ratio * du,
                    error: root.error + 4.0 * f64::EPSILON * line * line,
                }
            });
            let size = largest(&self.roots(chain));
            let value = self.value(chain);
            self.zeros(Kind::Line(k), jets, size, |t| [value(t); 2])?;
        }
        Ok(())
    }

    /// Where a damped frequency meets a line.
    fn lines(&mut self, chain: Chain) -> Result<(), Needs> {
        for k in 0..self.wanted.lines.len() {
            let Line { ratio, offset } = self.wanted.lines[k];
            let jets = [0, 1, 2].map(|i| {
                let (root, [u, du]) = (self.roots(chain)[i], self.states[i].input);
                let line = ratio * u + offset;
                Jet {
                    value: root.value.im - line,
                    slope: root.slope.im - ratio * du,
                    error: root.error + 4.0 * f64::EPSILON * line.abs(),
                }
            });
            let size = largest(&self.roots(chain));
            let value = self.value(chain);
            self.zeros(Kind::Line(k), jets, size, |t| [value(t); 2])?;
        }
        Ok(())
    }

    /// The zeros of the stiffness; returns whether it is positive throughout.
    fn stiffness(&mut self) -> Result<bool, Needs> {
        let lists = moving(self.states.map(|state| &state.stiffness[..]));
        let lists = lists.each_ref().map(|list| &list[..]);
        let chains = Chains::new(lists, self.t).ok_or((self.t[1], Kind::Critical))?;
        let before = self.events.len();
        let mut positive = true;
        for &chain in &chains.real {
            let roots = [0, 1, 2].map(|k| lists[k][chain[k]]);
            let jets = roots.map(|root| Jet {
                value: root.value.re,
                slope: root.slope.re,
                error: root.error,
            });
            positive &= jets.iter().all(|jet| jet.value > jet.error);
            let t = self.t;
            let value = |at| between(lists, chain, t, at);
            self.zeros(Kind::Critical, jets, largest(&roots), |t| [value(t); 2])?;
        }
        Ok(positive && self.events.len() == before)
    }

    /// The zeros of the sum, the product or the squared difference of two eigenvalues.
    fn both(&mut self, kind: Kind, two: [Two; 3]) -> Result<(), Needs> {
        let jets = [0, 1, 2].map(|k| {
            let [sum, product] = sum_and_product(&self.roots[k], two[k]);
            let error = self.error(k, two[k]);
            let size = sum[0].abs() + error;
            match kind {
                Kind::Critical => Jet {
                    value: product[0],
                    slope: product[1],
                    error: error * size,
                },
                Kind::Turning => squared_difference(sum, product, error),
                _ => Jet {
                    value: sum[0],
                    slope: sum[1],
                    error: 2.0 * error,
                },
            }
        });
        let size = (0..3).fold(0.0_f64, |most, k| {
            let [sum, product] = sum_and_product(&self.roots[k], two[k]);
            most.max(match kind {
                Kind::Critical | Kind::Turning => product[0].abs(),
                _ => sum[0].abs().max(product[0].abs().sqrt()),
            })
        });
        let (ends, t) = (
            [0, 1, 2].map(|k| sum_and_product(&self.roots[k], two[k])),
            self.t,
        );
        self.zeros(kind, jets, size, |at| {
            let piece = usize::from(at > t[1]);
            let h = t[piece + 1] - t[piece];
            let (from, to) = (ends[piece], ends[piece + 1]);
            let share = (at - t[piece]) / h;
            let [sum, product] = [0, 1].map(|k| cubic(from[k], to[k], h, share)[0]);
            let root = Complex::from(0.25 * sum * sum - product).sqrt();
            [0.5 * sum + root, 0.5 * sum - root]
        })
    }

    fn error(&self, k: usize, two: Two) -> f64 {
        let roots = &self.roots[k];
        match two {
            Two::Pair(i) => roots[i].error,
            Two::Real(i, j) => roots[i].error.max(roots[j].error),
        }
    }

    /// Where oscillations start or stop growing.
    fn growth(&mut self, chains: &Chains) -> Result<(), Needs> {
        let pairs = &chains.pairs;
        let roots: Vec<[Root; 3]> = pairs.iter().map(|&chain| self.roots(chain)).collect();
        let keeps = |root: &Root| root.value.re.abs() <= root.error;
        let constant: Vec<bool> = roots.iter().map(|root| root.iter().all(keeps)).collect();
        let twins = |i: usize, j: usize| twins(&roots[i], &roots[j]);
        let mut partners: Vec<Option<usize>> = vec![None; pairs.len()];
        for i in 0..pairs.len() {
            for j in i + 1..pairs.len() {
                // Of equal oscillations each merges with one of those that their like merge with.
                let taken = |i: usize, j: usize| partners[i].is_some_and(|k| twins(j, k));
                if self.approach(&roots[i], &roots[j])
                    && mirrored(&roots[i], &roots[j])
                    && !(twins(i, j) || taken(i, j) || taken(j, i))
                    && self.merging(pairs[i], pairs[j])?
                {
                    (partners[i], partners[j]) = (Some(j), Some(i));
                }
            }
        }
        let merges: Vec<bool> = partners.iter().map(Option::is_some).collect();
        for (i, &chain) in pairs.iter().enumerate() {
            if !constant[i] && !merges[i] {
                self.sum(chain.map(Two::Pair))?;
            }
        }
        for &changing in &chains.changing {
            self.sum(changing)?;
            self.turning(changing)?;
        }
        for i in 0..pairs.len() {
            for j in i + 1..pairs.len() {
                let alone = |r: usize| !constant[r] && !merges[r];
                if alone(i) && alone(j) && self.approach(&roots[i], &roots[j]) {
                    self.close(&roots[i], &roots[j])?;
                }
            }
        }
        Ok(())
    }

    /// Where the sum of two eigenvalues vanishes while they are complex.
    fn sum(&mut self, changing: [Two; 3]) -> Result<(), Needs> {
        let known = self.events.len();
        self.both(Kind::Growth, changing)?;
        let candidates = self.events.split_off(known);
        let complex = |event: &Candidate| event.near[0].im != 0.0;
        self.events.extend(candidates.into_iter().filter(complex));
        Ok(())
    }

    /// Where a growing pair becomes real, or complex again.
    fn turning(&mut self, changing: [Two; 3]) -> Result<(), Needs> {
        let sums = [0, 1, 2].map(|k| sum_and_product(&self.roots[k], changing[k])[0]);
        let grows = |k: usize| sums[k][0] > self.error(k, changing[k]);
        match (0..3).any(grows) {
            true => {
                let known = self.events.len();
                self.both(Kind::Turning, changing)?;
                let candidates = self.events.split_off(known);
                let growing = |event: &Candidate| event.near[0].re > 0.0;
                self.events.extend(candidates.into_iter().filter(growing));
                Ok(())
            }
            false => Ok(()),
        }
    }

    /// Where two oscillations that all but keep their amplitude merge, or part again; returns whether they grow anywhere.
    fn merging(&mut self, a: Chain, b: Chain) -> Result<bool, Needs> {
        let (first, second) = (self.roots(a), self.roots(b));
        let jets = [0, 1, 2].map(|k| difference(&first[k], &second[k]));
        let size = (0..3).fold(0.0, |most: f64, k| most.max(jets[k].value.abs()));
        let grows = jets.iter().any(|jet| jet.value > jet.error);
        let (x, y) = (self.value(a), self.value(b));
        let known = self.events.len();
        self.zeros(Kind::Merging, jets, size, |t| [x(t), y(t)])?;
        // Frequencies that are equal for a moment cross.
        let new = self.events.split_off(known);
        let merges = |event: &Candidate| event.zero.passage != Passage::Touches;
        self.events.extend(new.into_iter().filter(merges));
        Ok(grows || self.events.len() > known)
    }

    /// Whether two eigenvalues may meet between the states: their imaginary parts change order, or come closer to each
    /// other than they move.
    fn approach(&self, a: &[Root; 3], b: &[Root; 3]) -> bool {
        let apart = |k: usize| a[k].value.im - b[k].value.im;
        let least = (0..3).fold(f64::INFINITY, |least, k| apart(k).abs().min(least));
        let changes = (0..3).any(|k| (apart(k) > 0.0) != (apart(0) > 0.0));
        let h = self.t[2] - self.t[0];
        let speed = |k: usize| (a[k].slope - b[k].slope).norm() * h;
        let most = (0..3).fold(0.0, |most: f64, k| most.max(speed(k)));
        changes || least <= 2.0 * most || most.is_nan()
    }

    /// Makes sure that two damped oscillations, whose eigenvalues may come close to each other, do not grow meanwhile.
    ///
    /// The sum and the squared difference of their eigenvalues are smooth where they meet.
    fn close(&self, first: &[Root; 3], second: &[Root; 3]) -> Result<(), Needs> {
        if first.iter().chain(second).any(|root| root.value.re >= 0.0) {
            return Ok(());
        }
        let ends = [0, 1, 2].map(|k| {
            let (x, y) = (&first[k], &second[k]);
            let apart = x.value - y.value;
            let square = [apart * apart, apart * (x.slope - y.slope) * 2.0];
            ([x.value + y.value, x.slope + y.slope], square)
        });
        let missed = |of: &dyn Fn(usize) -> [Complex; 2]| -> f64 {
            let h = self.t[2] - self.t[0];
            let share = (self.t[1] - self.t[0]) / h;
            let [value, slope] = cubic(of(0), of(2), h, share);
            let [middle, rate] = of(1);
            let bump = share * (1.0 - share);
            let value = (value - middle).norm() / (16.0 * bump * bump);
            0.5 * value.max(0.25 * (slope - rate).norm() * h)
        };
        let rests = [missed(&|k| ends[k].0), missed(&|k| ends[k].1)];
        if !(rests[0] + rests[1]).is_finite() {
            return Err((self.t[1], Kind::Growth));
        }
        let mut worst = (0.0, self.t[1]);
        for piece in 0..2 {
            let h = self.t[piece + 1] - self.t[piece];
            let at = |share: f64| {
                let [sum, _] = cubic(ends[piece].0, ends[piece + 1].0, h, share);
                let [square, _] = cubic(ends[piece].1, ends[piece + 1].1, h, share);
                (sum, square)
            };
            let mut look = |share: f64| {
                let (sum, square) = at(share);
                let bump = 16.0 * (share * (1.0 - share)).powi(2);
                let (of_sum, of_square) = (rests[0] * bump, rests[1] * bump);
                let of_root = of_square.sqrt().min(of_square / square.norm().sqrt());
                let growth = 0.5 * (sum.re + square.sqrt().re.abs() + of_sum + of_root);
                if growth > worst.0 {
                    worst = (growth, self.t[piece] + share * h);
                }
            };
            let distance = |share: f64| -at(share).1.re;
            let shares = (1..SAMPLES).map(|k| k as f64 / SAMPLES as f64);
            let nearest = shares
                .clone()
                .min_by(|a, b| distance(*a).total_cmp(&distance(*b)));
            shares.for_each(&mut look);
            if let Some(nearest) = nearest {
                look(lowest(distance, nearest, 1.0 / SAMPLES as f64));
            }
        }
        match worst.0 > 0.0 {
            true => Err((worst.1, Kind::Growth)),
            false => Ok(()),
        }
    }
}

/// The place, no farther than `reach` from `centre`, at which a function with one minimum there is the lowest.
fn lowest(function: impl Fn(f64) -> f64, centre: f64, reach: f64) -> f64 {
    let (mut from, mut to) = (centre - reach, centre + reach);
    for _ in 0..60 {
        let third = (to - from) / 3.0;
        match function(from + third) < function(to - third) {
            true => to -= third,
            false => from += third,
        }
    }
    0.5 * (from + to)
}

/// Whether two oscillations are one motion in two directions: alike at a state at which they keep their amplitude.
fn twins(a: &[Root; 3], b: &[Root; 3]) -> bool {
    let keeps = |root: &Root| root.value.re.abs() <= root.error;
    let mut states = a.iter().zip(b);
    states.any(|(a, b)| a.is_like(b) && keeps(a) && keeps(b))
}

/// Share of the squared distance of two eigenvalues below which the squares of their real parts do not matter.
const SLIGHT: f64 = 1e-11;

/// Whether two eigenvalues are mirror images of each other at the imaginary axis, or each of itself, at all states.
fn mirrored(a: &[Root; 3], b: &[Root; 3]) -> bool {
    let apart = |k: usize| (a[k].value - b[k].value).norm();
    let most = apart(0).max(apart(1)).max(apart(2));
    let slight = SLIGHT.sqrt() * most;
    let keeps = |root: &Root| root.value.re.abs() <= root.error.max(slight);
    (0..3).all(|k| {
        let error = (a[k].error + b[k].error).max(slight);
        let mirror = (a[k].value + b[k].value.conj()).norm() <= error;
        mirror || keeps(&a[k]) && keeps(&b[k])
    })
}

/// `Re (s_1 - s_2)^2 - (Re s_1 + Re s_2)^2` of eigenvalues that are [`mirrored`]: negative while neither grows.
pub(super) fn difference(a: &Root, b: &Root) -> Jet {
    let (apart, sum) = (a.value - b.value, a.value.re + b.value.re);
    let error = a.error + b.error;
    let change = (apart * (a.slope - b.slope)).re - sum * (a.slope.re + b.slope.re);
    Jet {
        value: (apart * apart).re - sum * sum,
        slope: if change.is_finite() {
            2.0 * change
        } else {
            0.0
        },
        error: of_square(apart.norm(), error),
    }
}

/// The error of the square of a distance, and of what its slope adds to the cubic through it.
fn of_square(distance: f64, error: f64) -> f64 {
    error * (4.0 * distance + error)
}

/// `(s_1 - s_2)^2` of two eigenvalues that are real or conjugate, from their sum and product.
pub(super) fn squared_difference(sum: [f64; 2], product: [f64; 2], error: f64) -> Jet {
    let value = sum[0] * sum[0] - 4.0 * product[0];
    Jet {
        value,
        slope: 2.0 * sum[0] * sum[1] - 4.0 * product[1],
        error: of_square(value.abs().sqrt(), error),
    }
}

fn largest(roots: &[Root]) -> f64 {
    let sizes = roots.iter().map(|root| root.value.norm());
    sizes.fold(0.0, f64::max)
}
