//! Weights that make the equations comparable when Newton's method runs on all unknowns.

use super::operating_point::{Failure, OperatingPoint};
use crate::algebra::Vector;
use crate::constraints::inertias;

/// Inverse generalised masses, which make the squares of forces and moments comparable.
///
/// The gap of a constraint counts as the force with which the largest stiffness of the mechanism would resist the
/// motion that closes it. In mechanisms without any other stiffness, a reaction acts as the stiffness against a unit
/// motion.
pub(super) fn weights(point: &OperatingPoint<'_>, q: &[f64]) -> Result<Vector, Failure> {
    let structure = point.structure;
    let linear = &point.linear(q)?;
    let mut weight = Vector::zeros(q.len());
    if structure.open() {
        for (i, weight) in weight.iter_mut().enumerate() {
            let mass = linear.mass[i][i];
            if mass.is_nan() || mass <= 0.0 {
                return Err(Failure::SingularMass(i));
            }
            *weight = 1.0 / mass;
        }
        return Ok(weight);
    }
    let mass = inertias(linear, structure);
    let motions = structure.motions();
    let stiffest = (0..motions).fold(0.0, |most: f64, i| {
        let row = &linear.stiffness[i];
        let reactions =
            (motions..q.len()).fold(0.0, |most: f64, j| most.max((row[j] * q[j]).abs()));
        most.max(row[i].abs().max(reactions) / mass[i])
    });
    let stiffest = if stiffest > 0.0 { stiffest } else { 1.0 };
    for i in 0..motions {
        weight[i] = 1.0 / mass[i];
    }
    for i in structure.constraint_rows() {
        let row = &linear.stiffness[i];
        let mobility = (0..motions).fold(0.0, |sum, j| sum + row[j] * row[j] / mass[j]);
        if mobility > 0.0 {
            weight[i] = stiffest * stiffest / mobility;
        } else {
            // Nothing can close the gap from here; any weight will do as long as the gap is seen.
            weight[i] =
                stiffest * stiffest * mass[..motions].iter().fold(0.0, |a: f64, &b| a.max(b));
        }
    }
    if weight.iter().all(|value| value.is_finite()) {
        Ok(weight)
    } else {
        Err(Failure::OutsideDomain {
            what: "the mass matrix",
            coordinates: q.into(),
        })
    }
}
