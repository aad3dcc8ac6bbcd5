//! Eigenvalues at one state of a step, and which of them belong together at three states.
//!
//! Eigenvalues that are followed by their slopes are smooth functions wherever they keep apart, also where they cross.
//! Where two real ones become a conjugate pair, neither is smooth, but their sum and their product are.

use super::cubic::cubic;
use crate::Complex;

/// An eigenvalue: `s` of a general mode with `Im s >= 0`, or `lambda` of an undamped one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Root {
    pub(super) value: Complex,
    /// Its derivative along the step.
    pub(super) slope: Complex,
    #[doc(hidden)]
    pub error: f64,
    /// Whether it stands for a conjugate pair.
    pub(super) paired: bool,
    /// Whether it is zero to rounding.
    pub(super) neutral: bool,
}

/// Share of their slopes by which those of equal eigenvalues may differ.
const ALIKE: f64 = 1e-6;
/// Relative error beyond which eigenvalues merge rather than equal each other.
const KNOWN: f64 = 1e-9;

impl Root {
    /// Whether two eigenvalues are equal and move alike, as those of one motion in two directions; where others meet,
    /// they have no slopes or different ones.
    pub(super) fn is_like(&self, other: &Self) -> bool {
        let error = self.error + other.error;
        let turn = (self.slope - other.slope).norm();
        let known = error <= KNOWN * self.value.norm();
        let equal = known && (self.value - other.value).norm() <= error;
        equal && turn <= ALIKE * (self.slope.norm() + other.slope.norm())
    }
}

/// The numbers at one state of a step.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Spectrum {
    /// The place along the step, from 0 to 1.
    pub(super) t: f64,
    /// The actual input and its derivative along the step.
    pub(super) input: [f64; 2],
    /// The eigenvalues of the modes.
    pub(super) roots: Vec<Root>,
    /// The eigenvalues of a symmetric `Khat` relative to `Mhat`, if those of the modes do not include them.
    pub(super) stiffness: Vec<Root>,
}

/// Positions of one eigenvalue at three states.
pub(super) type Chain = [usize; 3];

/// A conjugate pair or two real eigenvalues that become one: their positions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Two {
    Pair(usize),
    Real(usize, usize),
}

/// The eigenvalues of three states as functions.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Chains {
    /// Conjugate pairs that stay so.
    pub(super) pairs: Vec<Chain>,
    /// Real eigenvalues that stay so.
    pub(super) real: Vec<Chain>,
    /// Pairs that are real at some of the states.
    pub(super) changing: Vec<[Two; 3]>,
}

/// The eigenvalues of two neighbouring states: where those of the first go, and where those of the second come from.
struct Link {
    ahead: Vec<Option<usize>>,
    behind: Vec<Option<usize>>,
    /// Pairs of the first state that are real at the second: the pair and both of these.
    split: Vec<(usize, [usize; 2])>,
    /// Pairs of the second state that are real at the first.
    joined: Vec<(usize, [usize; 2])>,
}

impl Chains {
    /// Follows the eigenvalues through three states; `None` if their numbers do not fit.
    pub(super) fn new(states: [&[Root]; 3], t: [f64; 3]) -> Option<Self> {
        let [first, middle, last] = states;
        let before = link(first, middle, t[1] - t[0])?;
        let after = link(middle, last, t[2] - t[1])?;
        let mut chains = Self::default();
        for (k, root) in middle.iter().enumerate() {
            match (before.behind[k], after.ahead[k]) {
                (Some(i), Some(j)) if root.paired => chains.pairs.push([i, k, j]),
                (Some(i), Some(j)) => chains.real.push([i, k, j]),
                _ if root.paired => {
                    let from = side(before.behind[k], &before.joined, k)?;
                    let to = side(after.ahead[k], &after.split, k)?;
                    chains.changing.push([from, Two::Pair(k), to]);
                }
                _ => {}
            }
        }
        // Two real ones that are a pair before or after.
        let mut done = vec![false; middle.len()];
        for &(i, both) in &before.split {
            let to = across(middle, both, &after)?;
            (chains.changing).push([Two::Pair(i), Two::Real(both[0], both[1]), to]);
            for k in both {
                done[k] = true;
            }
        }
        for &(j, both) in &after.joined {
            if done[both[0]] && done[both[1]] {
                continue;
            }
            let [Some(a), Some(b)] = both.map(|k| before.behind[k]) else {
                return None;
            };
            chains
                .changing
                .push([Two::Real(a, b), Two::Real(both[0], both[1]), Two::Pair(j)]);
        }
        Some(chains)
    }
}

/// What a pair of the middle state is at a neighbour.
fn side(partner: Option<usize>, changed: &[(usize, [usize; 2])], k: usize) -> Option<Two> {
    if let Some(i) = partner {
        return Some(Two::Pair(i));
    }
    let (_, both) = changed.iter().find(|(pair, _)| *pair == k)?;
    Some(Two::Real(both[0], both[1]))
}

/// What two real eigenvalues of the middle state are at the last one.
fn across(middle: &[Root], both: [usize; 2], after: &Link) -> Option<Two> {
    match both.map(|k| after.ahead[k]) {
        [Some(a), Some(b)] => Some(Two::Real(a, b)),
        [None, None] => {
            // Of equal pairs, any will do.
            let equal = |a: usize, b: usize| {
                let (a, b) = (&middle[a], &middle[b]);
                (a.value - b.value).norm() <= a.error + b.error
            };
            let same = |x: &[usize; 2], [a, b]: [usize; 2]| equal(x[0], a) && equal(x[1], b);
            let fits = |x: &[usize; 2]| same(x, both) || same(x, [both[1], both[0]]);
            let (pair, _) = after.joined.iter().find(|(_, x)| fits(x))?;
            Some(Two::Pair(*pair))
        }
        _ => None,
    }
}

fn link(first: &[Root], second: &[Root], h: f64) -> Option<Link> {
    let mut costs = Vec::new();
    for (i, a) in first.iter().enumerate() {
        let ahead = a.value + a.slope * (0.5 * h);
        for (j, b) in second.iter().enumerate() {
            if a.paired == b.paired {
                let apart = (ahead - (b.value - b.slope * (0.5 * h))).norm();
                let plain = (a.value - b.value).norm();
                let apart = if apart.is_finite() { apart } else { plain };
                costs.push((apart, i, j));
            }
        }
    }
    costs.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut link = Link {
        ahead: vec![None; first.len()],
        behind: vec![None; second.len()],
        split: Vec::new(),
        joined: Vec::new(),
    };
    for (_, i, j) in costs {
        if link.ahead[i].is_none() && link.behind[j].is_none() {
            (link.ahead[i], link.behind[j]) = (Some(j), Some(i));
        }
    }
    let left = |links: &[Option<usize>], roots: &[Root]| {
        let open = |&k: &usize| links[k].is_none();
        let all = (0..roots.len()).filter(open);
        let (pairs, real): (Vec<usize>, Vec<usize>) = all.partition(|&k| roots[k].paired);
        (pairs, real)
    };
    let (pairs, real) = left(&link.ahead, first);
    let (other_pairs, other_real) = left(&link.behind, second);
    link.split = halves(first, &pairs, second, other_real, h)?;
    link.joined = halves(second, &other_pairs, first, real, -h)?;
    Some(link)
}

/// For each of the `pairs`, the two real eigenvalues of the other state, at a distance `h`, whose sum and product it
/// meets halfway; `None` unless that uses all of them.
fn halves(
    here: &[Root],
    pairs: &[usize],
    there: &[Root],
    mut real: Vec<usize>,
    h: f64,
) -> Option<Vec<(usize, [usize; 2])>> {
    if real.len() != 2 * pairs.len() {
        return None;
    }
    let mut matches = Vec::with_capacity(pairs.len());
    for &pair in pairs {
        let wanted = ahead(here, Two::Pair(pair), 0.5 * h);
        let (both, _) = nearest_real(there, &real, wanted, -0.5 * h)?;
        real.retain(|r| !both.contains(r));
        matches.push((pair, both));
    }
    Some(matches)
}

/// The sum and the product of two eigenvalues at a distance from their state.
fn ahead(roots: &[Root], two: Two, distance: f64) -> [f64; 2] {
    sum_and_product(roots, two).map(|[value, slope]| match slope.is_finite() {
        true => value + slope * distance,
        false => value,
    })
}

/// The two of the real eigenvalues at these positions whose sum and product, at a distance, are nearest to others, and
/// by how much they miss them.
fn nearest_real(
    roots: &[Root],
    real: &[usize],
    wanted: [f64; 2],
    distance: f64,
) -> Option<([usize; 2], f64)> {
    let two = real.iter().enumerate();
    let two = two.flat_map(|(k, &a)| real[k + 1..].iter().map(move |&b| [a, b]));
    let missed = two.map(|[a, b]| {
        let there = ahead(roots, Two::Real(a, b), distance);
        ([a, b], missed(there, wanted))
    });
    missed.min_by(|a, b| a.1.total_cmp(&b.1))
}

/// How far a sum and a product are from others, as squares of eigenvalues.
fn missed([sum, product]: [f64; 2], wanted: [f64; 2]) -> f64 {
    let size = wanted[0].abs().max(wanted[1].abs().sqrt());
    (sum - wanted[0]).abs() * size + (product - wanted[1]).abs()
}

/// The conjugate pair, or the two real eigenvalues, nearest to a sum and a product.
pub(super) fn nearest_two(roots: &[Root], wanted: [f64; 2]) -> Option<Two> {
    let (pairs, real): (Vec<usize>, Vec<usize>) = (0..roots.len()).partition(|&r| roots[r].paired);
    let pair = pairs.into_iter().map(|r| {
        let s = roots[r].value;
        (Two::Pair(r), missed([2.0 * s.re, s.norm_sqr()], wanted))
    });
    let both = nearest_real(roots, &real, wanted, 0.0);
    let both = both.map(|([a, b], missed)| (Two::Real(a, b), missed));
    let nearest = pair.chain(both).min_by(|a, b| a.1.total_cmp(&b.1));
    nearest.map(|(two, _)| two)
}

/// Value and slope of the sum and of the product of both eigenvalues.
pub(super) fn sum_and_product(roots: &[Root], two: Two) -> [[f64; 2]; 2] {
    match two {
        Two::Pair(k) => {
            let (s, ds) = (roots[k].value, roots[k].slope);
            let product = [s.norm_sqr(), 2.0 * (s.conj() * ds).re];
            [[2.0 * s.re, 2.0 * ds.re], product]
        }
        Two::Real(a, b) => {
            let [a, b] = [a, b].map(|k| [roots[k].value.re, roots[k].slope.re]);
            let product = [a[0] * b[0], a[0] * b[1] + a[1] * b[0]];
            [[a[0] + b[0], a[1] + b[1]], product]
        }
    }
}

/// The eigenvalue of a chain between its states, on the cubics through them.
pub(super) fn between(states: [&[Root]; 3], chain: Chain, t: [f64; 3], at: f64) -> Complex {
    let piece = usize::from(at > t[1]);
    let end = |k: usize| {
        let root = &states[k][chain[k]];
        [root.value, root.slope]
    };
    let h = t[piece + 1] - t[piece];
    cubic(end(piece), end(piece + 1), h, (at - t[piece]) / h)[0]
}
