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
    pub(super) error: f64,
    /// Whether it stands for a conjugate pair.
    pub(super) paired: bool,
    /// Whether it is zero to rounding.
    pub(super) neutral: bool,
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
            let to = across(both, &after.ahead, &after.joined)?;
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
fn side(own: Option<usize>, changed: &[(usize, [usize; 2])], k: usize) -> Option<Two> {
    if let Some(i) = own {
        return Some(Two::Pair(i));
    }
    let (_, both) = changed.iter().find(|(pair, _)| *pair == k)?;
    Some(Two::Real(both[0], both[1]))
}

/// What two real eigenvalues of the middle state are at the last one.
fn across(
    both: [usize; 2],
    ahead: &[Option<usize>],
    joined: &[(usize, [usize; 2])],
) -> Option<Two> {
    match both.map(|k| ahead[k]) {
        [Some(a), Some(b)] => Some(Two::Real(a, b)),
        [None, None] => {
            let same = |own: &[usize; 2]| *own == both || *own == [both[1], both[0]];
            let (pair, _) = joined.iter().find(|(_, own)| same(own))?;
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
    let mut found = Link {
        ahead: vec![None; first.len()],
        behind: vec![None; second.len()],
        split: Vec::new(),
        joined: Vec::new(),
    };
    for (_, i, j) in costs {
        if found.ahead[i].is_none() && found.behind[j].is_none() {
            (found.ahead[i], found.behind[j]) = (Some(j), Some(i));
        }
    }
    let left = |own: &[Option<usize>], roots: &[Root]| {
        let open = |&k: &usize| own[k].is_none();
        let all = (0..roots.len()).filter(open);
        let (pairs, real): (Vec<usize>, Vec<usize>) = all.partition(|&k| roots[k].paired);
        (pairs, real)
    };
    let (pairs, real) = left(&found.ahead, first);
    let (other_pairs, other_real) = left(&found.behind, second);
    found.split = halves(first, &pairs, second, other_real)?;
    found.joined = halves(second, &other_pairs, first, real)?;
    Some(found)
}

/// For each of the `pairs`, the two of the real eigenvalues of the other state that are nearest to its real part;
/// `None` unless that uses all of them.
fn halves(
    here: &[Root],
    pairs: &[usize],
    there: &[Root],
    mut real: Vec<usize>,
) -> Option<Vec<(usize, [usize; 2])>> {
    if real.len() != 2 * pairs.len() {
        return None;
    }
    let mut found = Vec::with_capacity(pairs.len());
    for &pair in pairs {
        let apart = |k: &usize| (there[*k].value.re - here[pair].value.re).abs();
        real.sort_by(|a, b| apart(a).total_cmp(&apart(b)));
        let rest = real.split_off(2);
        found.push((pair, [real[0], real[1]]));
        real = rest;
    }
    Some(found)
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
