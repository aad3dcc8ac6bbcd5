//! Divides a range until the poles say that nothing can hide between two states.
//!
//! As a function of the input, the squared amplitude has no finer features than the distance from `i w` to the nearest
//! pole `s_j`, measured by how fast the two move relative to each other. A stretch along which they move by a small part
//! of that distance is as good as a cubic; where the cubic through both ends turns twice, it is
//! divided all the same. A pole that the excitation does not reach, or the output does not see, has no residue and makes
//! no peak. Few states suffice: the stretches shrink geometrically towards a resonance and no farther than
//! its width.

use super::state::{Along, Heard, ResponsePoint};
use crate::sweep::Gap;
use crate::{Error, sweep::Range};

/// Widths from a pole within which a peak may have any place.
const NEAR: f64 = 3.0;
/// Share of a width within which a state is at the pole.
const AT: f64 = 0.1;
/// Share of a stretch that a division leaves at either end.
const LEAST: f64 = 1e-4;
/// Most divisions of a step: beyond them, a stretch is rounding.
const DIVISIONS: usize = 44;
/// Those that one takes where all poles hold: a cubic that keeps turning there is rounding.
const HOLDING: usize = 6;
/// Most divisions towards a value at which there is no vibration.
const TOWARDS_GAP: usize = 20;
/// Relative rounding of a squared amplitude.
const ROUNDING: f64 = 1e-12;
/// Relative change of an amplitude along the shortest stretch that counts as none.
const STILL: f64 = 1e-3;

/// States from one end of a range to the other, and where there are none.
#[derive(Default)]
pub(super) struct Scan {
    pub(super) states: Vec<ResponsePoint>,
    /// Positions of states before which there is a gap.
    pub(super) after_gap: Vec<usize>,
    pub(super) gaps: Vec<Gap>,
}

/// States that leave no peak between them unseen; the reason if there are none.
pub(super) fn scan(along: &Along<'_>, range: &Range, start: &[f64]) -> Result<Scan, Error> {
    let mut scan = Scan::default();
    let value = |k: usize| range.low + (range.high - range.low) * k as f64 / range.steps as f64;
    let mut last = End::new(along, value(0), start)?;
    scan.begin(&mut last);
    for k in 1..=range.steps {
        let from = last.coordinates(start);
        let next = End::new(along, value(k), &from)?;
        last = scan.divide(along, last, next, DIVISIONS)?;
    }
    if scan.states.is_empty() {
        return Err(scan.gaps.into_iter().next().map_or(Error::CriticalState, |gap| gap.reason));
    }
    // An end at which the frequency is zero has no vibration, but everything beside it has.
    scan.gaps.retain(|gap| !matches!(gap.reason, Error::NoFrequency { .. }));
    Ok(scan)
}

/// An end of a stretch: a state, which may already belong to the scan, or the reason why there is none.
enum End {
    /// The position of a state of the scan, its value and its coordinates.
    Taken(usize, f64, Vec<f64>),
    Found(Box<ResponsePoint>),
    Missing(f64, Error),
}

impl End {
    fn new(along: &Along<'_>, value: f64, from: &[f64]) -> Result<Self, Error> {
        match along.state(value, from) {
            Ok(state) => Ok(Self::Found(state.into())),
            Err(Error::Stopped) => Err(Error::Stopped),
            Err(error) => Ok(Self::Missing(value, error)),
        }
    }

    fn value(&self) -> f64 {
        match self {
            Self::Taken(_, value, _) | Self::Missing(value, _) => *value,
            Self::Found(state) => state.value,
        }
    }

    fn coordinates(&self, otherwise: &[f64]) -> Vec<f64> {
        match self {
            Self::Taken(_, _, coordinates) => coordinates.clone(),
            Self::Found(state) => state.equilibrium.coordinates.to_vec(),
            Self::Missing(..) => otherwise.to_vec(),
        }
    }
}

impl Scan {
    /// Takes a state over.
    fn begin(&mut self, end: &mut End) {
        if let End::Found(_) = end {
            let index = self.states.len();
            let taken = End::Taken(index, end.value(), end.coordinates(&[]));
            if let End::Found(state) = core::mem::replace(end, taken) {
                self.states.push(*state);
            }
        }
    }

    /// Adds the states after `a` up to `b`; returns `b`.
    fn divide(&mut self, along: &Along<'_>, a: End, mut b: End, left: usize) -> Result<End, Error> {
        let mut division = MIDDLE;
        match (&a, &b) {
            (End::Missing(from, reason), End::Missing(to, _)) => {
                self.gap(*from, *to, reason);
                return Ok(b);
            }
            (End::Missing(..), _) | (_, End::Missing(..)) if left + TOWARDS_GAP <= DIVISIONS => {
                let (from, to) = (a.value(), b.value());
                if let End::Missing(_, reason) = &a {
                    self.gap(from, to, reason);
                    self.after_gap.push(self.states.len());
                    self.begin(&mut b);
                } else if let End::Missing(_, reason) = &b {
                    self.gap(from, to, reason);
                }
                return Ok(b);
            }
            (End::Taken(index, ..), End::Found(state)) => {
                let before = &self.states[*index];
                let Some(found) = division_between(before, state) else {
                    self.begin(&mut b);
                    return Ok(b);
                };
                division = found;
                if left == 0 {
                    let infinite = |k: &usize| division.cost < HOLDING && !still(before.heard(*k), state.heard(*k));
                    let from = before.value;
                    if let Some(k) = (0..state.lines.len()).find(infinite) {
                        let reason = along.resonance(k, state);
                        self.gap(from, state.value, &reason);
                        self.after_gap.push(self.states.len());
                    }
                    self.begin(&mut b);
                    return Ok(b);
                }
            }
            _ => {}
        }
        let (low, high) = (a.value(), b.value());
        let middle = low + division.share * (high - low);
        let left = left.saturating_sub(division.cost);
        let from = a.coordinates(&b.coordinates(&[]));
        let middle = End::new(along, middle, &from)?;
        let middle = self.divide(along, a, middle, left)?;
        self.divide(along, middle, b, left)
    }

    fn gap(&mut self, from: f64, to: f64, reason: &Error) {
        match self.gaps.last_mut() {
            Some(gap) if gap.to == from => gap.to = to,
            _ => self.gaps.push(Gap { from, to, reason: reason.clone() }),
        }
    }
}

/// Where to divide a stretch, as a share of it, and how many of the divisions that are left it takes.
struct Division {
    share: f64,
    cost: usize,
}

const MIDDLE: Division = Division { share: 0.5, cost: 1 };

/// Where to divide the stretch between two states; `None` if nothing can hide there.
///
/// Away from its own width, a single pole that comes nearer leaves at most a minimum, `|r / (i x) + g|^2` with `g` from all
/// others. A pole that is passed is found by its place; about it, a few widths are divided until it holds.
fn division_between(a: &ResponsePoint, b: &ResponsePoint) -> Option<Division> {
    (0..a.lines.len()).find_map(|k| division_of(a.heard(k), b.heard(k)))
}

fn division_of(a: Heard<'_>, b: Heard<'_>) -> Option<Division> {
    if !a.line.is_audible() && !b.line.is_audible() {
        return None;
    }
    let (mut approached, mut nearest) = (0, 0.5);
    for (from, to, back) in [(a, b, false), (b, a, true)] {
        let share = |share: f64| if back { 1.0 - share } else { share };
        let at = |part: f64| Some(Division { share: share(part), cost: 1 });
        for passage in from.passages(to).filter(|passage| !passage.holds) {
            let [here, there] = passage.off;
            let (width, change) = (passage.width, here - there);
            let least = here.abs().min(there.abs());
            if !passage.known {
                return Some(MIDDLE);
            }
            if here * there < 0.0 && least > AT * width {
                return at((here / change).clamp(LEAST, 1.0 - LEAST));
            }
            if least < NEAR * width {
                // From the pole outwards, or to either side of it.
                let beside = (1.2 * NEAR * width).copysign(there - here);
                let outwards = (beside - here) / (there - here);
                return at(if outwards > f64::EPSILON && outwards < 0.5 { outwards } else { 0.5 });
            }
            approached += 1;
            // Features scale with the distance from the pole: the middle is where it is the geometric mean.
            let middle = share((here / (here + (here * there).sqrt().copysign(here))).clamp(LEAST, 1.0 - LEAST));
            if (middle - 0.5).abs() > (nearest - 0.5_f64).abs() {
                nearest = middle;
            }
        }
    }
    let alone = approached <= 2;
    let cost = if approached == 0 { HOLDING } else { 1 };
    (!alone || turns_between(a, b)).then_some(Division { share: nearest, cost })
}

/// Whether the cubic through both ends has a slope whose sign neither end has.
fn turns_between(a: Heard<'_>, b: Heard<'_>) -> bool {
    let h = b.point.value - a.point.value;
    let (first, last) = (a.square(), b.square());
    let (f, g) = (first.slope, last.slope);
    if (f > 0.0) != (g > 0.0) {
        return false;
    }
    let mean = (last.value - first.value) / h;
    let rounding = ROUNDING * first.value.max(last.value) / h.abs();
    (1..8).any(|k| {
        let t = f64::from(k) / 8.0;
        let r = 1.0 - t;
        let value = r * (r - 2.0 * t) * f + t * (t - 2.0 * r) * g + 6.0 * t * r * mean;
        (value > 0.0) != (f > 0.0) && value.abs() > rounding
    })
}

/// Whether the amplitude is about the same at both states.
fn still(a: Heard<'_>, b: Heard<'_>) -> bool {
    let [a, b] = [a, b].map(|x| x.square().value);
    (a - b).abs() <= STILL * a.max(b)
}
