//! Free directions: whether the loads along them stay balanced when a variable changes, and which outputs depend on the
//! place.

use super::redundancy::ROUNDING;
use crate::algebra::{Matrix, Values, Vector, dot, largest, times};
use crate::equilibrium::{OperatingPoint, SMALL_MOTION, without_rounding};
use crate::kernels::Kernels;
use crate::{Complex, Equilibrium, Error, Text};

/// Share of a variable's effect on the terms of a balance below which it counts as no effect, compared with the forces
/// themselves.
const OF_FORCES: f64 = 1e-12;

/// Checks that the loads along free directions stay balanced: `W^T dg/du = 0` and `W^T dg/db = 0`. Otherwise there is
/// no equilibrium for neighbouring values, and nothing has a derivative.
///
/// # Errors
/// [`Error::BalancesHereOnly`].
#[inline]
pub(super) fn check(mechanism: &dyn Kernels, at: &Equilibrium) -> Result<(), Error> {
    if at.free.is_empty() { Ok(()) } else { check_balanced(mechanism, at) }
}

#[cold]
fn check_balanced(mechanism: &dyn Kernels, at: &Equilibrium) -> Result<(), Error> {
    let (q, u, b) = (&at.coordinates, &at.inputs, &at.design);
    let (by_input, by_design) = mechanism.residual_partials(q, u, b);
    let Err(failure) = balanced(mechanism, at, (&by_input, &by_design)) else {
        return Ok(());
    };
    // Terms that cancel at all values, as where one load is a function of another, leave their rounding.
    let together = |(by_input, by_design): (Matrix, Matrix)| -> Vector {
        by_input.as_flattened().iter().chain(by_design.as_flattened()).copied().collect()
    };
    let all = together((by_input.clone(), by_design.clone()));
    let point = OperatingPoint::unchecked(mechanism, u, b);
    let left = without_rounding(&point.data(), q, &all, |q, u, b| together(mechanism.residual_partials(q, u, b)));
    let left = left.ok_or(failure)?;
    let (inputs, design) = left.split_at(by_input.as_flattened().len());
    let rows = |columns: usize, entries: &[f64]| Matrix::from_rows(columns, entries.to_vec());
    balanced(mechanism, at, (&rows(u.len(), inputs), &rows(b.len(), design)))
}

/// Whether derivatives of the residual leave the loads along free directions balanced.
fn balanced(mechanism: &dyn Kernels, at: &Equilibrium, (by_input, by_design): (&Matrix, &Matrix)) -> Result<(), Error> {
    let (u, b) = (&at.inputs, &at.design);
    let forces = forces(mechanism, at);
    let moved = |partials: &Matrix, values: &[f64], w: &[f64]| {
        let weights = w.map(f64::abs);
        let least = OF_FORCES * dot(&weights, &forces);
        (0..values.len()).find(|&j| {
            let column = partials.column(j);
            let (change, terms) = (dot(w, &column).abs(), dot(&weights, &column.map(f64::abs)));
            change > ROUNDING * terms && change * (SMALL_MOTION + values[j].abs()) > least
        })
    };
    for (w, z) in at.free.balances.iter().zip(&at.free.motions) {
        let input = moved(by_input, u, w).map(|j| &at.description.inputs[j].name);
        let design = || moved(by_design, b, w).map(|j| &at.description.design[j].name);
        if let Some(variable) = input.or_else(design) {
            return Err(Error::BalancesHereOnly { coordinates: moving(at, z), variable: variable.clone() });
        }
    }
    Ok(())
}

/// Whether an output with these derivatives by the unknowns depends on the position along free directions that no held
/// unknown determines.
pub fn depends(at: &Equilibrium, by_unknown: &[f64]) -> bool {
    at.free.undetermined().iter().any(|z| {
        let terms = by_unknown.iter().zip(z).fold(0.0, |sum, (a, z)| sum + (a * z).abs());
        dot(by_unknown, z).abs() > ROUNDING * terms
    })
}

/// The same of the amplitude of a vibration `y` with these derivatives: that its phase does, as that of an unbalance on what turns
/// freely, is no matter.
pub fn amplitude_depends(at: &Equilibrium, y: Complex, by_unknown: impl Fn(usize) -> Complex) -> bool {
    at.free.undetermined().iter().any(|z| {
        let each = z.iter().enumerate().map(|(j, z)| by_unknown(j) * z);
        let (sum, terms) = each.fold((Complex::ZERO, 0.0), |(sum, terms), own| (sum + own, terms + own.norm()));
        let along = if y == Complex::ZERO { sum.norm() } else { (y.conj() / y.norm() * sum).re.abs() };
        along > ROUNDING * terms
    })
}

/// The forces in each equation: inertia, applied forces, and what its stiffnesses restore over the coordinates
/// themselves or a small motion.
fn forces(mechanism: &dyn Kernels, at: &Equilibrium) -> Vector {
    let parts = mechanism.residual_parts(&at.coordinates, &at.inputs, &at.design);
    let reach = at.coordinates.map(|q| q.abs() + SMALL_MOTION);
    let restored = times(&at.linear.stiffness.map(f64::abs), &reach);
    Vector::from_fn(reach.len(), |i| parts.inertia[i].abs() + parts.applied[i].abs() + restored[i])
}

/// The names of the unknowns that take part in a motion.
fn moving(at: &Equilibrium, z: &[f64]) -> Vec<Text> {
    let most = largest(z);
    let part = (0..z.len()).filter(|&j| z[j].abs() > ROUNDING * most);
    part.map(|j| at.description.unknown_name(j)).collect()
}
