//! How far each eigenvalue may be off.

use num_complex::Complex64;

use super::cluster::Found;
use super::pair::{INACCURATE, Pair, Solver};

/// Eigenvalues farther away than this many errors do not matter.
const FAR: f64 = 8.0;
/// Vectors of eigenvalues that come from one defective eigenvalue are parallel to this.
const PARALLEL: f64 = 0.9;

/// Whether the pair needs the second method: its error is far beyond what rounding in the pencil explains.
pub(super) fn in_trouble(pair: &Pair) -> bool {
    let step = pair.newton.norm();
    let far = step > 64.0 * pair.doubt() && step > 1e-12 * pair.s.norm();
    !pair.merged && (far || pair.residual > INACCURATE)
}

/// Fills in the errors of all pairs that are not part of a cluster.
pub(super) fn estimate(solver: &mut Solver, found: &mut Found) {
    for i in 0..found.count {
        if !found.pairs[i].merged {
            found.pairs[i].error = error(solver, found, i);
        }
    }
}

fn error(solver: &mut Solver, found: &Found, i: usize) -> f64 {
    let pair = &found.pairs[i];
    let step = pair.newton.norm();
    let own = f64::EPSILON * pair.s.norm();
    let first = pair.doubt() + 2.0 * step + pair.second + own;
    let mut gap = f64::INFINITY;
    for (s, _, _) in others(found, i) {
        gap = gap.min((s - pair.s).norm());
    }
    if FAR * first <= gap && pair.residual <= INACCURATE {
        return first;
    }
    let error = first.max(solver.noise(pair.condition));
    // A perturbation p of an almost multiple root moves it by delta with delta prod(delta + d_j) = p prod(d_j).
    let n = solver.pencil.n;
    let vector = |j: usize| j * n..(j + 1) * n;
    solver
        .pencil
        .multiply(&found.right[vector(i)], false, &mut solver.of_right);
    let log_product = |delta: f64| {
        let mut log = delta.ln();
        for (s, j, conjugate) in others(found, i) {
            let distance = (s - pair.s).norm();
            if distance > 0.0 && FAR * error > distance {
                let parallel = found.right[vector(j)]
                    .iter()
                    .zip(solver.of_right.mass.iter())
                    .map(|(x, mass)| if conjugate { x * mass } else { x.conj() * mass })
                    .sum::<Complex64>();
                if parallel.norm() > PARALLEL {
                    log += (delta / distance).ln_1p();
                }
            }
        }
        log
    };
    if !error.is_finite() {
        return f64::INFINITY;
    }
    let target = error.ln();
    let (mut low, mut high) = (target - 40.0, target);
    for _ in 0..20 {
        let middle = 0.5 * (low + high);
        if log_product(middle.exp()) < target {
            low = middle;
        } else {
            high = middle;
        }
    }
    (2.0 * high.exp()).max(own)
}

/// The other eigenvalues: value, pair, whether it is the conjugate of that pair.
fn others<'f>(
    found: &'f Found,
    i: usize,
) -> impl Iterator<Item = (Complex64, usize, bool)> + use<'f> {
    let pairs = &found.pairs[..found.count];
    let themselves = pairs.iter().enumerate().filter(move |(j, _)| *j != i);
    let conjugates = pairs.iter().enumerate().filter(|(_, pair)| pair.conjugate);
    themselves
        .map(|(j, pair)| (pair.s, j, false))
        .chain(conjugates.map(|(j, pair)| (pair.s.conj(), j, true)))
}
