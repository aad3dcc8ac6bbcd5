//! The overall procedure, on slices of any size.

use num_complex::Complex64;

use super::cluster::Found;
use super::linearisation::Linearisation;
use super::measure::Pair;
use super::order::{finish, sort};
use super::pencil::{Pencil, Products};
use super::prediction::{Near, predict};
use super::scaled_pencil::{Eigenproblem, Scaled, not_found, scaled};
use super::scratch::{Work, take};
use super::solver::Solver;
use super::{Root, aberth, accuracy, cluster, hessenberg, schur};
use crate::eigenproblem::symmetric::Trouble;

/// Largest residual of an accepted pair, relative to the terms in it.
const ACCEPTED: f64 = 1e-9;
/// Residual of a pair that is exact up to rounding.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// All eigenvalues of the linearisation of a scaled pencil; from the second method if QR does not converge.
fn linear_values(
    pencil: &Pencil,
    companion: &mut [f64],
    vector: &mut [f64],
    complex: &mut [Complex64],
    order: &mut [usize],
    open: &mut [bool],
    values: &mut [Complex64],
) {
    let n = pencil.n;
    let count = values.len();
    hessenberg::reduce(count, companion, vector);
    if schur::eigenvalues(count, companion, values) {
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

/// Roots with `Im s >= 0`, without their conjugates, ascending in `|s|`, then in `Im s`, then in `Re s`.
pub(crate) fn solve(problem: Eigenproblem) -> Result<Vec<Root>, Trouble> {
    solve_near(problem, &[])
}

/// Like [`solve`], but starts from the roots of a nearby problem if they predict all roots.
pub(crate) fn solve_near(problem: Eigenproblem, near: &[Near]) -> Result<Vec<Root>, Trouble> {
    let n = problem.size();
    if n == 0 {
        return Ok(Vec::new());
    }
    let mut work = Work::new(n);
    let (mut real, mut complex) = (&mut work.real[..], &mut work.complex[..]);
    let (mut indices, mut flags) = (&mut work.indices[..], &mut work.flags[..]);
    let Scaled {
        pencil,
        right: right_units,
        left: left_units,
        rate,
    } = scaled(problem, &mut real)?;
    let count = pencil.degree.eigenvalues(n);
    let companion = take(&mut real, count * count);
    let vector = take(&mut real, count);
    let linearisation = Linearisation::new(&pencil, companion, take(&mut real, 3 * n * n + 2 * n))?;
    let values = take(&mut complex, count);
    let q = take(&mut complex, n * n);
    let spare = take(&mut complex, 4 * n * n);
    let order = take(&mut indices, 2 * n);
    let label = take(&mut indices, count);
    let open = take(&mut flags, count);
    let marked = take(&mut flags, count);
    let mut solver = Solver {
        of_right: Products::new(n, take(&mut complex, 3 * n), take(&mut real, 3 * n)),
        of_left: Products::new(n, take(&mut complex, 3 * n), take(&mut real, 3 * n)),
        basis_right: take(&mut complex, n * n),
        basis_left: take(&mut complex, n * n),
        cross: take(&mut complex, n * n),
        pencil,
        linearisation,
        q,
        order,
    };
    let mut found = Found {
        count: 0,
        pairs: &mut work.pairs[..count],
        right: take(&mut complex, count * n),
        left: take(&mut complex, count * n),
    };
    let predicted = predict(problem, near, rate, values);
    let mut troubles = match predicted {
        true => {
            for (i, near) in near.iter().enumerate() {
                let place = i * n..(i + 1) * n;
                start(&mut found.right[place.clone()], near.right, right_units);
                start(&mut found.left[place], near.left, left_units);
            }
            find(&mut solver, &mut found, values, true, label)
        }
        false => usize::MAX,
    };
    if troubles > 0 {
        let (pencil, order) = (&solver.pencil, &mut *solver.order);
        linear_values(pencil, companion, vector, spare, order, open, values);
        troubles = find(&mut solver, &mut found, values, false, label);
    }
    if troubles > 0 {
        let second = take(&mut complex, count);
        second_values(&mut solver, &found, second, spare, open, marked);
        if find(&mut solver, &mut found, second, false, label) >= troubles {
            find(&mut solver, &mut found, values, false, label);
        }
    }
    if !accuracy::is_complete(&solver, &found) {
        return Err(not_found());
    }
    let places = &mut label[..found.count];
    for (i, place) in places.iter_mut().enumerate() {
        *place = i;
    }
    sort(places, |&i| found.pairs[i].s);
    let mut roots = Vec::with_capacity(found.count);
    for (mode, &i) in places.iter().enumerate() {
        let pair = &found.pairs[i];
        let vectors = i * n..(i + 1) * n;
        let (phi, psi) = (&found.right[vectors.clone()], &found.left[vectors]);
        let Some(residual) = accepted(&mut solver, pair, phi, psi) else {
            let residual = pair.residual;
            return Err(Trouble::Inaccurate { mode, residual });
        };
        roots.push(Root {
            s: pair.s * rate,
            right: finish(phi, right_units),
            left: finish(psi, left_units),
            residual,
            error: pair.error * rate,
            condition: pair.condition,
        });
    }
    Ok(roots)
}

/// The residual of a pair, if it passes the check.
fn accepted(
    solver: &mut Solver,
    pair: &Pair,
    right: &[Complex64],
    left: &[Complex64],
) -> Option<f64> {
    if pair.residual <= ACCEPTED {
        return Some(pair.residual);
    }
    solver.pencil.multiply(right, false, &mut solver.of_right);
    solver.pencil.multiply(left, true, &mut solver.of_left);
    // Relative to the matrices, because the terms are rounding themselves.
    let rounding = solver.is_rounding(pair.s, right, left, 4.0);
    rounding.then_some(ROUNDING)
}

/// Writes a vector in the units of the scaled pencil.
fn start(into: &mut [Complex64], vector: &[Complex64], units: &[f64]) {
    for ((into, x), unit) in into.iter_mut().zip(vector).zip(units) {
        *into = x / unit;
    }
}

/// Finds all pairs from the starting `values` and, if these are `near`, from the vectors in `found`. Returns the number
/// of pairs that failed; a pair that would be refused counts more than all others.
fn find(
    solver: &mut Solver,
    found: &mut Found,
    values: &[Complex64],
    near: bool,
    label: &mut [usize],
) -> usize {
    let n = solver.pencil.n;
    found.count = 0;
    for (i, &s) in values.iter().enumerate() {
        if s.im < 0.0 {
            continue;
        }
        let mut gap = f64::INFINITY;
        for (j, other) in values.iter().enumerate() {
            if j != i {
                gap = gap.min((s - other).norm_sqr());
            }
        }
        let place = found.count * n..(found.count + 1) * n;
        found.pairs[found.count] = solver.pair(
            s,
            gap.sqrt(),
            near,
            &mut found.right[place.clone()],
            &mut found.left[place],
        );
        found.count += 1;
    }
    let mut troubles = usize::from(cluster::merge(solver, found, label));
    for (i, pair) in found.pairs[..found.count].iter().enumerate() {
        let vectors = i * n..(i + 1) * n;
        let (right, left) = (&found.right[vectors.clone()], &found.left[vectors]);
        if accuracy::in_trouble(pair) {
            troubles += 1;
            if accepted(solver, pair, right, left).is_none() {
                troubles += 4 * n;
            }
        }
    }
    let told_apart = accuracy::estimate(solver, found);
    troubles += usize::from(near && !told_apart);
    if !accuracy::is_complete(solver, found) {
        troubles += 4 * n;
    }
    troubles
}

/// The eigenvalues from the second method, which starts from those of the first and holds the good ones fixed.
#[cold]
fn second_values(
    solver: &mut Solver,
    found: &Found,
    second: &mut [Complex64],
    spare: &mut [Complex64],
    open: &mut [bool],
    marked: &mut [bool],
) {
    let mut filled = 0;
    for (i, pair) in found.pairs[..found.count].iter().enumerate() {
        let crowded = found.pairs[..found.count]
            .iter()
            .enumerate()
            .any(|(j, other)| i != j && !pair.merged && (pair.s - other.s).norm() <= pair.reach);
        let unsure = solver.noise(pair.condition) > 1e-3 * pair.s.norm();
        let bad = unsure || crowded || accuracy::in_trouble(pair);
        let reach = pair.newton.norm().max(if crowded {
            pair.s.norm()
        } else {
            f64::EPSILON * pair.s.norm()
        });
        let reach = if reach.is_finite() { reach } else { 1.0 };
        for s in [Some(pair.s), pair.conjugate.then_some(pair.s.conj())]
            .into_iter()
            .flatten()
        {
            open[filled] = bad;
            second[filled] = s;
            if bad {
                second[filled] += Complex64::from_polar(0.5 * reach, 1.0 + 2.4 * filled as f64);
            }
            filled += 1;
        }
    }
    marked.copy_from_slice(open);
    let (pencil, q, order) = (&solver.pencil, &mut *solver.q, &mut *solver.order);
    aberth::improve(pencil, second, open, q, order, spare);
    aberth::symmetrise(second, marked);
}
