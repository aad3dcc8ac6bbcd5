//! Detects equilibria at which constraints are about to become dependent.
//!
//! Let `s` be the distance from a singular configuration of the constraints, and `F` the applied force in the direction
//! in which they give no support there. Close to it their reactions grow as `F / s`. A gap `d` rotates the directions
//! that they leave free by `d / s^2`, so that an imbalance `F d / s^2` goes unnoticed. With a stiffness `K` this makes
//! a displacement, which reaches the singular configuration at `s^3 = F d / K`. For gaps of rounding this is about a
//! micrometre in a metre: states found there are random, balanced to all digits by reactions of a million times the
//! weight, and are no equilibria.
//!
//! # Near a singular configuration, residuals are not informative
//!
//! Reactions grow there as the inverse of the distance, and constraint gaps within rounding turn the free directions:
//! any state within about a micrometre balances to all digits. The test is therefore how far rounding moves a result
//! towards the singular configuration (error analysis above). If that is more than a
//! thousandth of its distance, the state counts as singular and is an equilibrium if forces balance without the lost
//! constraint directions; if not, the search continues downhill.

use super::convergence::FLOOR;
use super::operating_point::{Failure, OperatingPoint};
use crate::algebra::{Lu, Vector, dot, greater, largest};
use crate::constraints::{ConstraintState, Tangent, curvature, placed};
use crate::kernels::Linear;

/// Share of the distance from a singular configuration by which rounding may move an equilibrium. Beyond it, reactions
/// and stiffness have less than three correct digits.
const KNOWN: f64 = 1e-3;
/// The force close to a singular configuration counts as zero up to this multiple of what the stiffness contributes
/// over the distance.
const BESIDE: f64 = 10.0;
/// Curvature, 1/m, below which a path is straight and its curvature rounding.
const STRAIGHT: f64 = 1e-6;
/// Share of the largest part in a weak combination of constraints above which a constraint takes part in it.
const TAKES_PART: f64 = 1e-3;

/// The state of the constraints at a configuration that is at rest to rounding.
///
/// If rounding can move it to a singular configuration, it counts as being there; it is an equilibrium if finite
/// reactions balance the forces there.
///
/// # Errors
/// [`Failure::Unbalanced`] if they do not.
pub fn constraint_state(
    point: &OperatingPoint<'_>,
    q: &[f64],
    residual: &[f64],
    linear: &Linear,
) -> Result<ConstraintState, Failure> {
    let structure = point.structure;
    if structure.open() {
        return Ok(ConstraintState::open(point.size()));
    }
    let tangent = Tangent::new(linear, structure);
    let arguments = (q, point.inputs, point.design);
    let mut constraint_state = ConstraintState::new(point.mechanism, arguments, &tangent);
    if constraint_state.singular || tangent.all.hardly_supported().next().is_none() {
        return Ok(constraint_state);
    }
    let noise = noise(point, q, residual, linear);
    let each = tangent.all.hardly_supported();
    let mut each = each.map(|i| Weak::new(point, q, &tangent, i));
    let Some(weak) = each.find(|weak| weak.moved(linear, &noise) > KNOWN) else {
        return Ok(constraint_state);
    };
    constraint_state.singular = true;
    let rows = || structure.constraint_rows().enumerate();
    let share = |(k, index): (usize, usize)| (weak.combination[index] * tangent.all.size[k]).abs();
    let most = rows().map(share).fold(0.0, greater);
    for (k, row) in rows() {
        constraint_state.dependent[row] |= share((k, row)) > TAKES_PART * most;
    }
    let force = weak.force(point, q);
    if force == 0.0 {
        return Ok(constraint_state);
    }
    let downhill = -force.signum() / largest(&weak.direction);
    Err(Failure::Unbalanced {
        coordinates: q.into(),
        downhill: weak.direction.map(|value| downhill * value).into(),
        dependent: constraint_state.dependent,
    })
}

/// Explains a failed search that ended at `q` next to a singular configuration in which forces do not balance.
#[cold]
pub(crate) fn unbalanced(point: &OperatingPoint<'_>, q: &[f64]) -> Option<Failure> {
    let linear = point.linear(q).ok()?;
    let residual = point.residual(q);
    let state = match constraint_state(point, q, &residual, &linear) {
        Err(failure) => return Some(failure),
        Ok(state) => state,
    };
    if !state.singular {
        return None;
    }
    // In the singular configuration itself all of these directions are free.
    let tangent = Tangent::new(&linear, point.structure);
    let uphill = tangent.lift(&tangent.project(&residual));
    let steepest = largest(&uphill);
    (steepest > 0.0).then(|| Failure::Unbalanced {
        coordinates: q.into(),
        downhill: uphill.map(|value| -value / steepest).into(),
        dependent: state.dependent,
    })
}

/// A direction of motion in which the constraints give hardly any support.
struct Weak {
    direction: Vector,
    /// Multipliers of the constraints that together support it: their force along it is one, across it zero.
    combination: Vector,
    /// Derivative of that support with respect to every unknown, relative to the support: the inverse of the distance
    /// to where it vanishes.
    approach: Vector,
}

impl Weak {
    /// The direction of basis vector `i` of all constraints.
    fn new(point: &OperatingPoint<'_>, q: &[f64], tangent: &Tangent, i: usize) -> Self {
        let (direction, combination) = tangent.all.support(i);
        let combination = placed(tangent.structure, &combination);
        // The support is `combination^T Khat direction`.
        let none = Vector::zeros(point.size());
        let approach =
            point.mechanism.pencil_gradient(q, point.inputs, point.design, [&combination, &none, &none, &direction]);
        Self { direction, combination, approach: approach.coordinates }
    }

    /// The largest share of the distance by which residuals of this size move a state; infinite if its stiffness is
    /// singular.
    fn moved(&self, linear: &Linear, residual: &[f64]) -> f64 {
        Lu::new(&linear.stiffness.transpose()).map_or(f64::INFINITY, |lu| {
            let by_residual = lu.solve(&self.approach);
            (0..residual.len()).fold(0.0, |sum, i| sum + by_residual[i].abs() * residual[i])
        })
    }

    /// The force along the direction that only reactions support; zero if the stiffness over the distance from the
    /// singular configuration can explain it.
    fn force(&self, point: &OperatingPoint<'_>, q: &[f64]) -> f64 {
        let motions = point.motions();
        let mut released = Vector::from(q);
        released[motions..].fill(0.0);
        let Some((residual, stiffness)) = point.evaluate_plain(&released) else {
            return f64::INFINITY;
        };
        let force = dot(&self.direction, &residual);
        let steepest = dot(&self.approach, &self.approach);
        let change = (0..motions).fold(0.0, |sum, i| {
            let row = (0..motions).fold(0.0, |sum, j| sum + (stiffness[i][j] * self.approach[j]).abs());
            sum + self.direction[i].abs() * row
        });
        if force.abs() * steepest <= BESIDE * change { 0.0 } else { force }
    }
}

/// Residual that cannot be distinguished from zero: the remaining residual, or the rounding of its terms.
///
/// A gap adds lengths that the coordinates may hardly change to first order, as those of bars in one line: to second
/// order they do. The length of a rod between two points is in no coordinate; it is the radius on which its end moves.
fn noise(point: &OperatingPoint<'_>, q: &[f64], residual: &[f64], linear: &Linear) -> Vector {
    let parts = point.parts(q);
    let unknowns = &point.description.coordinates;
    let turns = |j: usize| unknowns[j].unit.symbol == *"rad";
    // A length that rotates is rounded as a whole.
    let size = Vector::from_fn(q.len(), |j| if turns(j) { greater(1.0, q[j].abs()) } else { q[j].abs() });
    let coordinates = 0..point.structure.coordinates;
    let slides = Vector::from_fn(q.len(), |j| if coordinates.contains(&j) && !turns(j) { 1.0 } else { 0.0 });
    let arguments = (q, point.inputs, point.design);
    Vector::from_fn(q.len(), |i| {
        let mut terms = parts.inertia[i].abs() + parts.applied[i].abs();
        terms += magnitude(&linear.stiffness[i], &size);
        if point.structure.position_rows().contains(&i) {
            let bent = curvature(point.mechanism, arguments, point.structure, i);
            let by_row: Vector = bent.iter().map(|row| magnitude(row, &size)).collect();
            terms += magnitude(&by_row, &size);
            let slope = magnitude(&linear.stiffness[i], &slides);
            let by_slides = bent.iter().map(|row| magnitude(row, &slides));
            let bend = magnitude(&by_slides.collect::<Vector>(), &slides);
            if bend > STRAIGHT * slope {
                terms += slope * slope / bend;
            }
        }
        greater(residual[i].abs(), FLOOR * terms)
    })
}

/// `sum_j |values_j| size_j`.
fn magnitude(values: &[f64], size: &[f64]) -> f64 {
    values.iter().zip(size).fold(0.0, |sum, (value, size)| sum + value.abs() * size)
}
