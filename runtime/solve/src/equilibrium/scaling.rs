//! What makes equations and unknowns comparable when Newton's method runs on all unknowns.
//!
//! # No unit is special
//!
//! `Khat` holds stiffnesses, damping and the unit vectors of constraints; in a micromachine the stiffnesses are
//! rounding errors compared with the unit vectors. Whether a matrix is singular is therefore not judged by the size of
//! a pivot but by what was subtracted to get it: one that is left over from cancelling terms counts as zero
//! (`algebra/lu.rs`). Scaling the matrix first would need a structure for each matrix and performed worse near singular
//! configurations. Newton's method compares gaps with forces, and speeds with coordinates, by the fastest rate of the
//! mechanism; a shortened step must reduce the residual only by its share. What counts as a large change of a
//! coordinate (the reach of a first step, the distance at which two equilibria differ, the unit of arc length) is a
//! radian or `Description::length`: the geometric mean of the shortest and the longest length that the declaration
//! writes. Two settings still assume metres: the smallest motion against which a residual is measured, and the
//! curvature that counts as straight.

use core::ops::Range;

use super::operating_point::{Failure, OperatingPoint};
use crate::algebra::Vector;
use crate::constraints::{Structure, inertias};
use crate::kernels::Linear;

/// Inverse generalised masses, which make the squares of forces and moments comparable.
///
/// The gap of a constraint counts as the force with which the mechanism would resist the motion that closes it, at its
/// [`fastest`] rate: a spring for a position, a damper for a velocity.
pub(super) fn weights(point: &OperatingPoint<'_>, q: &[f64]) -> Result<Vector, Failure> {
    let structure = point.structure;
    let linear = &point.linear(q)?;
    let mut weight = Vector::zeros(q.len());
    if structure.open() {
        for (i, weight) in weight.iter_mut().enumerate() {
            let mass = linear.mass[i][i];
            if mass.is_nan() || mass <= 0.0 {
                return Err(point.singular_mass(q, i));
            }
            *weight = 1.0 / mass;
        }
        return Ok(weight);
    }
    let mass = inertias(linear, structure);
    let motions = structure.motions();
    let rate = match fastest(linear, structure, &mass, q) {
        0.0 => 1.0,
        rate => rate,
    };
    for i in 0..motions {
        weight[i] = 1.0 / mass[i];
    }
    for i in structure.constraint_rows() {
        let row = &linear.stiffness[i];
        let mobility = |of: Range<usize>| of.fold(0.0, |sum, j| sum + row[j] * row[j] / mass[j]);
        let by_speeds = mobility(structure.speed_range());
        let by_coordinates = mobility(0..structure.coordinates);
        weight[i] = if structure.velocity_rows().contains(&i) && by_speeds > 0.0 {
            rate * rate / by_speeds
        } else if by_coordinates > 0.0 {
            rate.powi(4) / by_coordinates
        } else {
            // Nothing can close the gap from here; any weight will do as long as the gap is seen.
            rate.powi(4) * mass[..motions].iter().fold(0.0, |a: f64, &b| a.max(b))
        };
    }
    if weight.iter().all(|value| value.is_finite()) {
        Ok(weight)
    } else {
        Err(Failure::OutsideDomain { what: "the mass matrix", coordinates: q.into() })
    }
}

/// Units of coordinates and speeds in which the first step is limited: a large change of a coordinate, and for a speed
/// the [`fastest`] rate.
pub(super) fn units(point: &OperatingPoint<'_>, q: &[f64]) -> Result<Vector, Failure> {
    let structure = point.structure;
    let mut units = Vector::from_fn(structure.motions(), |i| point.description.large(i));
    if structure.speeds > 0 {
        let linear = &point.linear(q)?;
        let rate = fastest(linear, structure, &inertias(linear, structure), q);
        if rate > 0.0 && rate.is_finite() {
            units[structure.speed_range()].fill(rate);
        }
    }
    Ok(units)
}

/// The fastest rate of the mechanism, 1/s: of a coordinate on its stiffness, or of a speed against its damping. A
/// reaction acts on a coordinate as a stiffness against a unit motion. Zero if nothing resists any motion.
fn fastest(linear: &Linear, structure: Structure, mass: &[f64], q: &[f64]) -> f64 {
    let elastic = (0..structure.coordinates).map(|i| {
        let row = &linear.stiffness[i];
        (structure.constraint_rows().map(|j| (row[j] * q[j]).abs()).fold(row[i].abs(), f64::max) / mass[i]).sqrt()
    });
    let damped = structure.speed_range().map(|i| linear.stiffness[i][i].abs() / mass[i]);
    elastic.chain(damped).fold(0.0, f64::max)
}
