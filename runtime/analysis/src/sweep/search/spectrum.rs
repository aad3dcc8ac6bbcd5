//! The eigenvalues of one state of a step.

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
    /// Whether its motion grows, as its mode says.
    pub(super) grows: bool,
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

    pub(super) fn conjugate(self) -> Self {
        Self { value: self.value.conj(), slope: self.slope.conj(), ..self }
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

/// The eigenvalues of three states with their conjugates, in the order of the middle one: in each row one that is
/// followed from state to state, as far as its slope tells.
///
/// Nothing is found by these rows: a wrong one makes a number that no cubic fits, so that another state is solved.
pub(super) fn rows(states: [&[Root]; 3], t: [f64; 3]) -> Vec<[Root; 3]> {
    let mut lists = states.map(|roots| {
        let pairs = roots.iter().filter(|root| root.paired);
        let all = roots.iter().copied();
        let mut all: Vec<Root> = all.chain(pairs.map(|root| root.conjugate())).collect();
        // Where two zeros meet, neither has a slope.
        for root in all.iter_mut().filter(|root| root.neutral) {
            root.slope = Complex::ZERO;
        }
        all
    });
    // A motion that nothing resists may count once or, as two zeros, twice.
    let most = lists.iter().map(Vec::len).max().unwrap_or(0);
    for list in &mut lists {
        if let Some(&zero) = list.iter().find(|root| root.neutral) {
            list.resize(most, zero);
        }
    }
    let [first, middle, last] = &lists;
    let before = links(first, middle, t[1] - t[0]);
    let after = links(last, middle, t[1] - t[2]);
    // Of a shaft an oscillation may begin or end between two states.
    let row = |k: usize| Some([*first.get(before[k])?, middle[k], *last.get(after[k])?]);
    (0..middle.len()).filter_map(row).filter(|row: &[Root; 3]| !row.iter().all(|root| root.neutral)).collect()
}

/// For each of the second eigenvalues the first one that meets it best halfway.
fn links(first: &[Root], second: &[Root], h: f64) -> Vec<usize> {
    let mut costs = Vec::with_capacity(first.len() * second.len());
    for (i, a) in first.iter().enumerate() {
        for (j, b) in second.iter().enumerate() {
            let plain = (a.value - b.value).norm();
            let met = (a.value + a.slope * (0.5 * h) - b.value + b.slope * (0.5 * h)).norm();
            costs.push((if met.is_finite() { met } else { plain }, i, j));
        }
    }
    costs.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut taken = vec![false; first.len()];
    let mut links = vec![usize::MAX; second.len()];
    for (_, i, j) in costs {
        if !taken[i] && links[j] == usize::MAX {
            (taken[i], links[j]) = (true, i);
        }
    }
    links
}
