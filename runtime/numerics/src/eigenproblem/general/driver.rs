//! The overall procedure, on slices of any size.

use num_complex::Complex64;

use super::cluster::ComputedPairs;
use super::gyroscopic::{Oscillation, oscillations};
use super::iteration::Iteration;
use super::linearisation::Linearisation;
use super::order::{finish, sort};
use super::pencil::Products;
use super::prediction::{ApproximatePair, predict};
use super::scaled_pencil::{Eigenproblem, Scaled, scaled};
use super::scratch::{Work, take};
use super::search::{Values, accepted, find, linear_values, second_values};
use super::solver::PairSolver;
use super::{Root, accuracy, census, hessenberg};
use crate::eigenproblem::symmetric::EigenproblemError;

/// Up to this size, every pair is found by factors of its own.
const DIRECT: usize = 8;

/// Roots with `Im s >= 0`, without their conjugates, ascending in `|s|`, then in `Im s`, then in `Re s`.
pub fn solve(problem: Eigenproblem) -> Result<Vec<Root>, EigenproblemError> {
    solve_near(problem, &[])
}

/// Like [`solve`], but starts from the roots of a nearby problem if they predict all roots.
pub fn solve_near(problem: Eigenproblem, near: &[ApproximatePair]) -> Result<Vec<Root>, EigenproblemError> {
    let n = problem.size();
    if n == 0 {
        return Ok(Vec::new());
    }
    let mut work = Work::new(n);
    let (mut real, mut complex) = (&mut work.real[..], &mut work.complex[..]);
    let (mut indices, mut flags) = (&mut work.indices[..], &mut work.flags[..]);
    let Scaled { pencil, right: right_units, left: left_units, rate } = scaled(problem, &mut real)?;
    if n > DIRECT
        && let Some(oscillations) = oscillations(&pencil)
    {
        census::note(|census| census.conservative += 1);
        let root = |oscillation: Oscillation| oscillation.root(rate, right_units);
        return Ok(oscillations.into_iter().map(root).collect());
    }
    census::note(|census| census.general += 1);
    let count = pencil.degree.eigenvalues(n);
    let companion = take(&mut real, count * count);
    let reflections = take(&mut real, count * count);
    let vector = take(&mut real, count);
    let linearisation = Linearisation::new(&pencil, companion, take(&mut real, 3 * n * n + 2 * n))?;
    let values = take(&mut complex, count);
    let q = take(&mut complex, n * n);
    let spare = take(&mut complex, 4 * n * n);
    let order = take(&mut indices, 2 * n);
    let label = take(&mut indices, count);
    let open = take(&mut flags, count);
    let marked = take(&mut flags, count);
    let mut solver = PairSolver {
        of_right: Products::new(n, take(&mut complex, 3 * n), take(&mut real, 6 * n)),
        of_left: Products::new(n, take(&mut complex, 3 * n), take(&mut real, 6 * n)),
        basis_right: take(&mut complex, n * n),
        basis_left: take(&mut complex, n * n),
        cross: take(&mut complex, n * n + n),
        pencil,
        linearisation,
        q,
        order,
        iteration: None,
    };
    let mut computed = ComputedPairs {
        count: 0,
        pairs: &mut work.pairs[..count],
        right: take(&mut complex, count * n),
        left: take(&mut complex, count * n),
    };
    let predicted = n <= DIRECT && predict(problem, near, rate, values);
    let mut troubles = if predicted {
        for (i, near) in near.iter().enumerate() {
            let range = i * n..(i + 1) * n;
            start(&mut computed.right[range.clone()], near.right, right_units);
            start(&mut computed.left[range], near.left, left_units);
        }
        find(&mut solver, &mut computed, Values::near(values), label)
    } else {
        usize::MAX
    };
    if troubles > 0 {
        let form = if n <= DIRECT {
            hessenberg::reduce(count, companion, reflections, vector)
        } else {
            hessenberg::reduce_graded(count, companion, reflections, vector)
        };
        let mut copy = form.h.to_vec();
        let (pencil, order) = (&solver.pencil, &mut *solver.order);
        linear_values(pencil, &mut copy, spare, order, open, values);
        solver.iteration = (n > DIRECT).then(|| Iteration::new(form, &solver.linearisation));
        troubles = find(&mut solver, &mut computed, Values::of(values), label);
        if troubles > 0 {
            let second = take(&mut complex, count);
            if second_values(&mut solver, &computed, second, spare, open, marked) {
                let second = Values::improved(second, marked);
                if find(&mut solver, &mut computed, second, label) >= troubles {
                    find(&mut solver, &mut computed, Values::of(values), label);
                }
            }
        }
    }
    // Any of them may be the one that stands in the place of another: none is more accurate than that.
    let missing = accuracy::missing(&computed.pairs[..computed.count], solver.linearisation.sum());
    let places = &mut label[..computed.count];
    for (i, slot) in places.iter_mut().enumerate() {
        *slot = i;
    }
    sort(places, |&i| computed.pairs[i].s);
    let mut roots = Vec::with_capacity(computed.count);
    for (mode, &i) in places.iter().enumerate() {
        let pair = &computed.pairs[i];
        let vectors = i * n..(i + 1) * n;
        let (phi, psi) = (&computed.right[vectors.clone()], &computed.left[vectors]);
        let (s, error) = (pair.s * rate, pair.error.max(missing) * rate);
        if !s.is_finite() || error.is_nan() {
            let residual = pair.residual;
            return Err(EigenproblemError::Inaccurate { mode, residual });
        }
        // An eigenvalue with its error is an answer; without vectors it has no derivative.
        let (residual, condition) = match accepted(&mut solver, pair, phi, psi) {
            Some(residual) => (residual, pair.condition),
            None => (pair.residual, f64::INFINITY),
        };
        roots.push(Root {
            s,
            right: finish(phi, right_units),
            left: finish(psi, left_units),
            residual,
            error,
            condition,
        });
    }
    Ok(roots)
}

/// Writes a vector in the units of the scaled pencil.
fn start(into: &mut [Complex64], vector: &[Complex64], units: &[f64]) {
    for ((into, x), unit) in into.iter_mut().zip(vector).zip(units) {
        *into = x / unit;
    }
}
