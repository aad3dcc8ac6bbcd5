//! Eigenvalues that the pencil cannot distinguish: one mean value, and vectors that span the eigenspaces.

use num_complex::Complex64;

use super::measure::Pair;
use super::pencil::modulus;
use super::solver::PairSolver;

/// The pairs found so far; the vectors of pair `i` are components `i n .. (i + 1) n`.
pub(super) struct ComputedPairs<'a> {
    pub(super) count: usize,
    pub(super) pairs: &'a mut [Pair],
    pub(super) right: &'a mut [Complex64],
    pub(super) left: &'a mut [Complex64],
}

/// One eigenvalue and its eigenspaces as found.
pub(super) struct Cluster {
    pub(super) s: Complex64,
    pub(super) multiplicity: usize,
    /// Spread of the eigenvalues it represents, and their largest radius and reach.
    pub(super) spread: f64,
    pub(super) radius: f64,
    pub(super) reach: f64,
    /// Largest condition number of its members as found.
    pub(super) condition: f64,
    pub(super) nullity: usize,
    /// Vectors `0..regular` belong to semisimple eigenvalues.
    pub(super) regular: usize,
}

/// Criterion that links eigenvalues to a cluster.
#[derive(Clone, Copy, PartialEq)]
enum Links {
    /// They may be the same; merged only if they have as many independent vectors.
    Loose,
    /// The pencil is the same there up to rounding; merged in any case.
    Tight,
}

impl Links {
    fn join(self, pair: &Pair, other: &Pair, distance: f64) -> bool {
        match self {
            Self::Loose => distance <= pair.radius() + other.radius(),
            Self::Tight => distance <= pair.reach.max(other.reach),
        }
    }

    /// Whether a pair may be the same as its conjugate.
    fn real(self, pair: &Pair) -> bool {
        !pair.conjugate || self.join(pair, pair, 2.0 * pair.s.im)
    }
}

/// Merges eigenvalues that cannot be distinguished. Returns whether a pair was found twice in place of two different
/// ones.
pub(super) fn merge(solver: &mut PairSolver, computed: &mut ComputedPairs, label: &mut [usize]) -> bool {
    let mut collapsed = false;
    for links in [Links::Loose, Links::Tight] {
        let count = computed.count;
        if link(links, &computed.pairs[..count], label) {
            for first in 0..count {
                if label[first] == first {
                    collapsed |= merge_one(solver, computed, &label[..count], first, links);
                }
            }
        }
    }
    collapsed
}

/// Labels each pair with the first of its cluster; returns whether there are clusters.
fn link(links: Links, pairs: &[Pair], label: &mut [usize]) -> bool {
    let mut any = false;
    for (i, pair) in pairs.iter().enumerate() {
        label[i] = i;
        if pair.merged {
            continue;
        }
        any |= pair.conjugate && links.real(pair);
        for (j, other) in pairs[..i].iter().enumerate() {
            if !other.merged && links.join(pair, other, modulus(pair.s - other.s)) {
                any = true;
                let (old, new) = (label[i].max(label[j]), label[i].min(label[j]));
                label[..=i].iter_mut().filter(|label| **label == old).for_each(|label| *label = new);
            }
        }
    }
    any
}

/// Merges one cluster if justified; returns whether it turned out to be one eigenvalue found twice.
fn merge_one(
    solver: &mut PairSolver,
    computed: &mut ComputedPairs,
    label: &[usize],
    first: usize,
    links: Links,
) -> bool {
    if computed.pairs[first].merged {
        return false;
    }
    let members = || (0..label.len()).filter(|&i| label[i] == first);
    let real = members().any(|i| links.real(&computed.pairs[i]));
    let weight = |i: usize| {
        if real && computed.pairs[i].conjugate { 2 } else { 1 }
    };
    let multiplicity: usize = members().map(weight).sum();
    if multiplicity < 2 {
        return false;
    }
    let mut s = Complex64::ZERO;
    for i in members() {
        s += computed.pairs[i].s * weight(i) as f64 / multiplicity as f64;
    }
    if real {
        s.im = 0.0;
    }
    let (mut spread, mut radius, mut reach, mut condition) = (0.0_f64, 0.0_f64, 0.0_f64, 0.0_f64);
    for i in members() {
        spread = spread.max(modulus(computed.pairs[i].s - s));
        radius = radius.max(computed.pairs[i].radius());
        reach = reach.max(computed.pairs[i].reach);
        condition = condition.max(computed.pairs[i].condition);
    }
    let mut cluster = Cluster { s, multiplicity, spread, radius, reach, condition, nullity: 0, regular: 0 };
    solver.eigenspaces(&mut cluster);
    if cluster.regular < multiplicity {
        if links == Links::Loose {
            return false;
        }
        if cluster.regular == cluster.nullity {
            return true;
        }
    }
    if (0..cluster.nullity).any(|k| solver.is_poor(&cluster, k)) {
        return links == Links::Tight && cluster.regular == multiplicity;
    }
    // The members keep their positions; additional members of a real cluster go to the end.
    let end = computed.count;
    let extra = multiplicity - members().count();
    computed.count += extra;
    for (k, member) in members().chain(end..end + extra).enumerate() {
        solver.place(&cluster, k, !real, member, computed);
    }
    false
}
