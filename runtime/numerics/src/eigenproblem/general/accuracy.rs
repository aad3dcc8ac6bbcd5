//! Error estimates for the eigenvalues.

use num_complex::Complex64;

use super::cluster::ComputedPairs;
use super::measure::Pair;
use super::pair::INACCURATE;
use super::pencil::{bound, modulus};
use super::solver::PairSolver;

/// Errors in terms of the rounding of all elements to first order: what roundings of the products add to it. The most seen
/// among 11,174 eigenvalues of random machines, known to 34 digits, is 2.6.
pub(super) const MARGIN: f64 = 3.0;
/// Eigenvalues farther away than this many errors are ignored.
const FAR: f64 = 8.0;
/// Accepted error of the sum of the eigenvalues, relative to their sizes.
const SUM: f64 = 1e-7;
/// Cosine above which vectors count as parallel, as for eigenvalues split from a defective one.
const PARALLEL: f64 = 0.9;
/// Condition number above which the vectors of a cluster do not distinguish it from an eigenvalue that it almost meets.
pub(super) const DEFECTIVE: f64 = 1e6;

/// Whether the pair needs the second method: its error is far larger than rounding in the pencil explains.
pub(super) fn in_trouble(pair: &Pair) -> bool {
    let step = modulus(pair.newton);
    let far = step > 64.0 * pair.doubt() && step > 1e-12 * modulus(pair.s);
    !pair.merged && (far || pair.residual > INACCURATE)
}

/// The pairs before or behind pair `i` that the pencil cannot tell from it, although they did not merge.
fn crowd<'f>(computed: &'f ComputedPairs, i: usize) -> impl Iterator<Item = usize> + use<'f> {
    let pair = &computed.pairs[i];
    // One that is far from defective has no other with the same vectors that close.
    let reach = if pair.condition <= DEFECTIVE { pair.reach.max(pair.radius()) } else { pair.reach };
    let near = move |j: &usize| (pair.s - computed.pairs[*j].s).norm() <= reach;
    (0..computed.count).filter(move |&j| j != i && !pair.merged).filter(near)
}

/// Whether the pencil cannot tell pair `i` from another one, although they did not merge.
pub(super) fn is_crowded(computed: &ComputedPairs, i: usize) -> bool {
    crowd(computed, i).next().is_some()
}

/// Whether pair `i` is the same as another one: one eigenvalue found twice in place of two.
pub(super) fn is_repeated(solver: &mut PairSolver, computed: &ComputedPairs, i: usize) -> bool {
    crowd(computed, i).any(|j| {
        let (own, other) = (vector(computed, i), vector(computed, j));
        solver.pencil.multiply(own, false, &mut solver.of_right);
        modulus(solver.overlap(other, false)) > PARALLEL
    })
}

/// How far the sum of the eigenvalues is from the one that the pencil requires; zero if their errors explain it. An
/// eigenvalue found twice in place of another spoils it.
pub(super) fn missing(pairs: &[Pair], required: f64) -> f64 {
    let (mut sum, mut allowed) = (0.0, 0.0);
    for pair in pairs {
        let weight = if pair.conjugate { 2.0 } else { 1.0 };
        sum += weight * pair.s.re;
        allowed += weight * (pair.error + SUM * modulus(pair.s));
    }
    let missing = (sum - required).abs();
    if missing <= allowed { 0.0 } else { missing }
}

/// Fills in the second-order errors of the pairs that are `open`: from their residuals and the resolvent, to which every
/// other eigenvalue contributes `phi_j psi_j^T / ((s_j - s) slope_j)`, or, where this is not small, by a correction.
/// Eigenvalues that may be the same are left out: they share a cluster, or their errors are those of a defective one.
pub(super) fn second_order(solver: &mut PairSolver, computed: &mut ComputedPairs, open: &[bool]) {
    if !open.contains(&true) {
        return;
    }
    let size = |x: &[Complex64]| x.iter().fold(0.0, |most: f64, x| most.max(bound(*x)));
    let n = solver.pencil.n;
    let vectors = computed.right.chunks_exact(n).zip(computed.left.chunks_exact(n));
    let pairs = computed.pairs[..computed.count].iter().zip(vectors);
    let weights: Vec<f64> = pairs.map(|(pair, (right, left))| size(right) * size(left) / modulus(pair.slope)).collect();
    for i in (0..computed.count).filter(|&i| open[i]) {
        let pair = &computed.pairs[i];
        let apart = |s: Complex64| {
            let distance = modulus(s - pair.s);
            (distance > pair.radius()).then_some(distance)
        };
        let mut second = pair
            .second_order(1.0 / others(computed, i).filter_map(|(s, j, _)| Some(weights[j] / apart(s)?)).sum::<f64>());
        if second > pair.doubt() {
            let range = i * n..(i + 1) * n;
            let (right, left) = (&computed.right[range.clone()], &computed.left[range]);
            second = second.min(solver.second_order(pair, right, left));
        }
        computed.pairs[i].second = second;
    }
}

/// Fills in the errors of all pairs that are not part of a cluster. Returns whether each eigenvalue is clearly
/// distinct: of two that almost meet, one may be found in place of the other.
pub(super) fn estimate(solver: &mut PairSolver, computed: &mut ComputedPairs) -> bool {
    let mut all_told_apart = true;
    for i in 0..computed.count {
        let told_apart = if computed.pairs[i].merged {
            computed.pairs[i].condition <= DEFECTIVE
        } else {
            let (error, told_apart) = error(solver, computed, i);
            computed.pairs[i].error = error;
            told_apart
        };
        all_told_apart &= told_apart;
    }
    all_told_apart
}

/// The error of an eigenvalue, and whether it is clearly distinct from the others.
fn error(solver: &mut PairSolver, computed: &ComputedPairs, i: usize) -> (f64, bool) {
    let pair = &computed.pairs[i];
    let step = modulus(pair.newton);
    let rounding = pair.rounding();
    let first = MARGIN * pair.doubt() + 2.0 * step + pair.second + rounding;
    let n = solver.pencil.n;
    let mut gap = f64::INFINITY;
    for (s, _, _) in others(computed, i) {
        gap = gap.min(modulus(s - pair.s));
    }
    if FAR * first <= gap && pair.residual <= INACCURATE && !in_trouble(pair) {
        return (first, true);
    }
    let error = first.max(solver.noise(pair.condition));
    // Take a perturbation that moves an eigenvalue by p to first order. If it is one of a pair at distance d that meets
    // in a defective eigenvalue, it moves by delta with delta (1 + delta / d) = p.
    let mut partner = 0.0_f64;
    solver.pencil.multiply(vector(computed, i), false, &mut solver.of_right);
    for (s, j, conjugate) in others(computed, i) {
        let distance = modulus(s - pair.s);
        let near = distance < FAR * error;
        if near && modulus(solver.overlap(vector(computed, j), conjugate)) > PARALLEL {
            partner = partner.max(distance);
        }
    }
    let reduced = if partner > 0.0 {
        // Four times the root of the quadratic, because p is only an estimate.
        8.0 * error / (1.0 + (1.0 + 4.0 * error / partner).sqrt())
    } else {
        error
    };
    let most = solver.pencil.rate(pair.s) * solver.relative().powf(0.5 / n as f64);
    (reduced.min(most).max(rounding), false)
}

impl PairSolver<'_> {
    /// `x^H M phi`, or `x^T M phi` for the conjugate of `x`, with the right vector multiplied last.
    fn overlap(&self, x: &[Complex64], conjugate: bool) -> Complex64 {
        let weighed = self.pencil.weighed(&self.of_right).iter();
        x.iter().zip(weighed).map(|(x, mass)| if conjugate { x * mass } else { x.conj() * mass }).sum()
    }
}

fn vector<'f>(computed: &'f ComputedPairs, i: usize) -> &'f [Complex64] {
    let n = computed.right.len() / computed.pairs.len();
    &computed.right[i * n..(i + 1) * n]
}

/// The other eigenvalues: value, pair, and whether the value is the conjugate of that pair.
fn others<'f>(computed: &'f ComputedPairs, i: usize) -> impl Iterator<Item = (Complex64, usize, bool)> + use<'f> {
    let pairs = &computed.pairs[..computed.count];
    let themselves = pairs.iter().enumerate().filter(move |(j, _)| *j != i);
    let conjugates = pairs.iter().enumerate().filter(|(_, pair)| pair.conjugate);
    themselves.map(|(j, pair)| (pair.s, j, false)).chain(conjugates.map(|(j, pair)| (pair.s.conj(), j, true)))
}
