//! The search for all pairs from starting values, and the values themselves.

use num_complex::Complex64;

use super::cluster::ComputedPairs;
use super::measure::Pair;
use super::pencil::Pencil;
use super::solver::PairSolver;
use super::{aberth, accuracy, census, cluster, schur};

/// Largest residual of an accepted pair, relative to the terms in it.
const ACCEPTED: f64 = 1e-9;
/// Residual of a pair that is exact up to rounding.
const ROUNDING: f64 = 4.0 * f64::EPSILON;
/// Condition number up to which both vectors from the linearisation belong to the same eigenvalue.
const SURE: f64 = 1e10;

/// All eigenvalues of the linearisation of a scaled pencil, given its Hessenberg form, which is destroyed; from the
/// second method if QR does not converge.
pub(super) fn linear_values(
    pencil: &Pencil,
    form: &mut [f64],
    complex: &mut [Complex64],
    order: &mut [usize],
    open: &mut [bool],
    values: &mut [Complex64],
) {
    let n = pencil.n;
    let count = values.len();
    if let Some(steps) = schur::eigenvalues(count, form, values) {
        census::note(|census| census.steps += steps);
        return;
    }
    for (i, value) in values.iter_mut().enumerate() {
        *value = Complex64::from_polar(1.0, 0.4 + i as f64 * std::f64::consts::TAU / count as f64);
    }
    open.fill(true);
    let (q, work) = complex.split_at_mut(n * n);
    aberth::improve(pencil, values, open, q, order, work);
    open.fill(true);
    aberth::symmetrise(values, open);
}

/// Values from which the search starts.
#[derive(Clone, Copy)]
pub(crate) struct Values<'a> {
    values: &'a [Complex64],
    /// Vectors close to their own are known.
    near: bool,
    /// Which of them come from the pencil itself, so that the vectors of the linearisation are not theirs.
    improved: &'a [bool],
}

impl<'a> Values<'a> {
    /// Eigenvalues of the linearisation.
    pub(super) fn of(values: &'a [Complex64]) -> Self {
        Self { values, near: false, improved: &[] }
    }

    /// Those predicted from a nearby problem.
    pub(super) fn near(values: &'a [Complex64]) -> Self {
        Self { near: true, ..Self::of(values) }
    }

    /// Some of them improved on the pencil.
    pub(super) fn improved(values: &'a [Complex64], improved: &'a [bool]) -> Self {
        Self { improved, ..Self::of(values) }
    }

    /// Distance from value `i` to the nearest other one.
    fn gap(&self, i: usize) -> f64 {
        let mut gap = f64::INFINITY;
        for (j, other) in self.values.iter().enumerate() {
            if j != i {
                gap = gap.min((self.values[i] - other).norm_sqr());
            }
        }
        gap.sqrt()
    }
}

/// Finds all pairs from these values and, if they are near, from the vectors in `computed`. Returns the number of pairs
/// that failed; a pair that would be refused counts more than all others.
pub(super) fn find(solver: &mut PairSolver, computed: &mut ComputedPairs, from: Values, label: &mut [usize]) -> usize {
    let n = solver.pencil.n;
    let values = from.values;
    let upper: Vec<Complex64> = values.iter().copied().filter(|s| s.im >= 0.0).collect();
    let mut open = vec![false; upper.len()];
    if let Some(iteration) = &mut solver.iteration {
        iteration.vectors(&solver.linearisation, &upper, computed.right, computed.left);
    }
    computed.count = 0;
    for (i, &s) in values.iter().enumerate() {
        if s.im < 0.0 {
            continue;
        }
        let gap = from.gap(i);
        let range = computed.count * n..(computed.count + 1) * n;
        let (right, left) = (&mut computed.right[range.clone()], &mut computed.left[range]);
        let mut pair = Pair::NONE;
        if solver.iteration.is_some() && from.improved.get(i) != Some(&true) {
            pair = solver.polished((s, gap), right, left);
            open[computed.count] = pair.condition <= SURE && !accuracy::in_trouble(&pair);
        }
        if !open[computed.count] {
            pair = solver.pair(s, gap, from.near, right, left);
        }
        computed.pairs[computed.count] = pair;
        computed.count += 1;
    }
    accuracy::second_order(solver, computed, &open);
    let mut troubles = usize::from(cluster::merge(solver, computed, label));
    for (i, pair) in computed.pairs[..computed.count].iter().enumerate() {
        let vectors = i * n..(i + 1) * n;
        let (right, left) = (&computed.right[vectors.clone()], &computed.left[vectors]);
        troubles += usize::from(accuracy::is_repeated(solver, computed, i));
        if accuracy::in_trouble(pair) {
            troubles += 1;
            if accepted(solver, pair, right, left).is_none() {
                troubles += 4 * n;
            }
        }
    }
    let told_apart = accuracy::estimate(solver, computed);
    troubles += usize::from(from.near && !told_apart);
    if accuracy::missing(&computed.pairs[..computed.count], solver.linearisation.sum()) > 0.0 {
        troubles += 4 * n;
    }
    troubles
}

/// The eigenvalues from the second method, which starts from those of the first and holds the good ones fixed. `false`
/// if too many are bad for a pencil of this size.
#[cold]
pub(super) fn second_values(
    solver: &mut PairSolver,
    computed: &ComputedPairs,
    second: &mut [Complex64],
    spare: &mut [Complex64],
    open: &mut [bool],
    marked: &mut [bool],
) -> bool {
    let mut filled = 0;
    for (i, pair) in computed.pairs[..computed.count].iter().enumerate() {
        let crowded = accuracy::is_crowded(computed, i);
        let unsure = solver.noise(pair.condition) > 1e-3 * pair.s.norm();
        let bad = unsure || crowded || accuracy::in_trouble(pair);
        let reach = pair.newton.norm().max(if crowded { pair.s.norm() } else { f64::EPSILON * pair.s.norm() });
        let reach = if reach.is_finite() { reach } else { 1.0 };
        for s in [Some(pair.s), pair.conjugate.then_some(pair.s.conj())].into_iter().flatten() {
            open[filled] = bad;
            second[filled] = s;
            if bad {
                second[filled] += Complex64::from_polar(0.5 * reach, 1.0 + 2.4 * filled as f64);
            }
            filled += 1;
        }
    }
    marked.copy_from_slice(open);
    let bad = open.iter().filter(|&&open| open).count();
    if solver.pencil.n > aberth::LARGE && 2 * bad > open.len() {
        return false;
    }
    let (pencil, q, order) = (&solver.pencil, &mut *solver.q, &mut *solver.order);
    aberth::improve(pencil, second, open, q, order, spare);
    aberth::symmetrise(second, marked);
    true
}

/// The residual of a pair, if it passes the check.
pub(super) fn accepted(solver: &mut PairSolver, pair: &Pair, right: &[Complex64], left: &[Complex64]) -> Option<f64> {
    if pair.residual <= ACCEPTED {
        return Some(pair.residual);
    }
    solver.pencil.multiply(right, false, &mut solver.of_right);
    solver.pencil.multiply(left, true, &mut solver.of_left);
    // Relative to the matrices, because the terms are rounding themselves.
    solver.is_rounding(pair.s, right, left, 4.0).then_some(ROUNDING)
}
