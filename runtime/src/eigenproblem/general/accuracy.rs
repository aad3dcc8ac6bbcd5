//! Error estimates for the eigenvalues.

use num_complex::Complex64;

use super::cluster::Found;
use super::measure::Pair;
use super::pair::INACCURATE;
use super::pencil::modulus;
use super::solver::Solver;

/// Eigenvalues farther away than this many errors are ignored.
const FAR: f64 = 8.0;
/// Accepted error of the sum of the eigenvalues, relative to their sizes.
const SUM: f64 = 1e-7;
/// Cosine above which vectors count as parallel, as for eigenvalues split from a defective one.
const PARALLEL: f64 = 0.9;
/// Condition number above which the vectors of a cluster do not distinguish it from an eigenvalue that it almost meets.
const DEFECTIVE: f64 = 1e6;

/// Whether the pair needs the second method: its error is far larger than rounding in the pencil explains.
pub(super) fn in_trouble(pair: &Pair) -> bool {
    let step = modulus(pair.newton);
    let far = step > 64.0 * pair.doubt() && step > 1e-12 * modulus(pair.s);
    !pair.merged && (far || pair.residual > INACCURATE)
}

/// Whether the eigenvalues have the required sum, within their errors: an eigenvalue found twice in place of another
/// spoils it.
pub(super) fn is_complete(solver: &Solver, found: &Found) -> bool {
    let (mut sum, mut allowed) = (0.0, 0.0);
    for pair in &found.pairs[..found.count] {
        let weight = if pair.conjugate { 2.0 } else { 1.0 };
        sum += weight * pair.s.re;
        allowed += weight * (pair.error + SUM * modulus(pair.s));
    }
    (sum - solver.linearisation.sum()).abs() <= allowed
}

/// Fills in the errors of all pairs that are not part of a cluster. Returns whether each eigenvalue is clearly
/// distinct: of two that almost meet, one may be found in place of the other.
pub(super) fn estimate(solver: &mut Solver, found: &mut Found) -> bool {
    let mut all_told_apart = true;
    for i in 0..found.count {
        let told_apart = if found.pairs[i].merged {
            found.pairs[i].condition <= DEFECTIVE
        } else {
            let (error, told_apart) = error(solver, found, i);
            found.pairs[i].error = error;
            told_apart
        };
        all_told_apart &= told_apart;
    }
    all_told_apart
}

/// The error of an eigenvalue, and whether it is clearly distinct from the others.
fn error(solver: &mut Solver, found: &Found, i: usize) -> (f64, bool) {
    let pair = &found.pairs[i];
    let step = modulus(pair.newton);
    let own = pair.own();
    let first = pair.doubt() + 2.0 * step + pair.second + own;
    let n = solver.pencil.n;
    let mut gap = f64::INFINITY;
    for (s, _, _) in others(found, i) {
        gap = gap.min(modulus(s - pair.s));
    }
    if FAR * first <= gap && pair.residual <= INACCURATE && !in_trouble(pair) {
        return (first, true);
    }
    let error = first.max(solver.noise(pair.condition));
    // Take a perturbation that moves an eigenvalue by p to first order. If it is one of a pair at distance d that meets
    // in a defective eigenvalue, it moves by delta with delta (1 + delta / d) = p.
    let mut partner = 0.0_f64;
    solver
        .pencil
        .multiply(vector(found, i), false, &mut solver.of_right);
    for (s, j, conjugate) in others(found, i) {
        let distance = modulus(s - pair.s);
        if distance < FAR * error {
            let parallel = vector(found, j)
                .iter()
                .zip(solver.pencil.weighed(&solver.of_right))
                .map(|(x, mass)| if conjugate { x * mass } else { x.conj() * mass })
                .sum::<Complex64>();
            if modulus(parallel) > PARALLEL {
                partner = partner.max(distance);
            }
        }
    }
    let reduced = if partner > 0.0 {
        // Four times the root of the quadratic, because p is only an estimate.
        8.0 * error / (1.0 + (1.0 + 4.0 * error / partner).sqrt())
    } else {
        error
    };
    let most = solver.pencil.rate(pair.s) * solver.relative().powf(0.5 / n as f64);
    (reduced.min(most).max(own), false)
}

fn vector<'f>(found: &'f Found, i: usize) -> &'f [Complex64] {
    let n = found.right.len() / found.pairs.len();
    &found.right[i * n..(i + 1) * n]
}

/// The other eigenvalues: value, pair, and whether the value is the conjugate of that pair.
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
