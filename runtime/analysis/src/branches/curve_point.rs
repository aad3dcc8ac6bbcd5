//! A point on a branch with the data to continue from it, and the signs that reveal events between two points.

use super::curve::{ContinuationFailure, Curve, plane};
use super::local_scaling::{CurvePosition, Frame, System};
use crate::algebra::{Cholesky, Lu, Matrix, Vector, asymmetry, dot, times};
use crate::constraints::Structure;
use crate::equilibrium::{Equilibrium, SolvedState};
use crate::error::NotFound;
use crate::free::FreeDirections;
use crate::kernels::Linear;
use crate::modes::{completed, free_pairs, joined};
use crate::{Description, Mode};

/// A regular point of a branch.
#[derive(Clone, Debug)]
pub(crate) struct CurvePoint {
    pub(crate) place: CurvePosition,
    pub(crate) equilibrium: Equilibrium,
    /// Its general modes if they were needed to judge its stability; empty otherwise.
    pub(crate) judged: Vec<Mode>,
    pub(crate) frame: Frame,
    /// Unit tangent in local coordinates.
    pub(crate) tangent: CurvePosition,
    pub(crate) signs: Signs,
}

/// Signs that change at events.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Signs {
    /// The input decreases along the branch.
    pub(crate) falling: bool,
    /// The input is stationary along the branch.
    pub(crate) vertical: bool,
    /// `det [Khat dg/du; t^T] < 0`, corrected for the sign of each constraint and of what holds the place; changes where
    /// branches cross.
    pub(crate) crossed: bool,
    /// Whether the bases of the free directions and of their balances have another orientation than `W^T M Z > 0` at the
    /// first station has, followed from there.
    turned: bool,
    /// Number of negative eigenvalues of a symmetric `Khat` in the directions that the constraints leave free.
    pub(crate) negative: Option<usize>,
}

/// Least cosine between the free directions or balances of neighbouring points by which their orientation is followed.
const TURN: f64 = 0.3;
/// Tangents with a smaller input component are vertical.
pub(crate) const VERTICAL: f64 = 1e-10;

impl Curve<'_> {
    /// The station at a point of the branch, with its tangent on the side of `towards` (SI units).
    pub(crate) fn station(
        &self,
        curve_position: &CurvePosition,
        system: &System,
        judged: SolvedState,
        towards: &CurvePosition,
        before: Option<&CurvePoint>,
    ) -> Result<CurvePoint, ContinuationFailure> {
        let frame = self.frame(curve_position, system);
        let scaled = frame.scaled(system);
        let singular = ContinuationFailure::Missed(NotFound::NotIsolated);
        let towards = frame.direction(towards).unit();
        let factors = towards.and_then(|towards| plane(&scaled, &towards));
        let Some(factors) = factors else {
            return Err(singular);
        };
        let (q, [p]) = factors.solve(&Vector::zeros(self.size()), [1.0]);
        let tangent = CurvePosition { q, p }.unit().ok_or(singular)?;
        let vertical = tangent.p.abs() <= VERTICAL;
        let constraints = self.structure.constraints();
        let oriented = self.structure.holonomic() && judged.state.free.held.is_empty();
        let turned = oriented && turned(&judged.state, before)?;
        let signs = Signs {
            falling: match before {
                Some(before) if vertical => before.signs.falling,
                _ => tangent.p < 0.0,
            },
            vertical,
            // Each constraint flips the sign: its multiplier adds a negative eigenvalue.
            crossed: factors.negative_determinant()
                ^ (constraints % 2 == 1)
                ^ (oriented && self.flips(&judged.state.free))
                ^ turned,
            turned,
            negative: if vertical { None } else { negative(&judged.state.linear, &self.description) },
        };
        // Cramer: sign det Khat = sign t_p sign det [Khat dg/du; t^T].
        let odd = signs.falling != signs.crossed;
        if signs.negative.is_some_and(|count| (count % 2 == 1) != odd) {
            return Err(ContinuationFailure::Missed(NotFound::SingularStiffness));
        }
        Ok(CurvePoint {
            place: curve_position.clone(),
            equilibrium: judged.state,
            judged: judged.modes,
            frame,
            tangent,
            signs,
        })
    }

    /// A point of shafts with all of the lowest modes.
    pub(crate) fn completed(&self, mut point: CurvePoint) -> CurvePoint {
        if !self.description.spans.is_empty() {
            point.judged = completed(&point.equilibrium, point.judged);
            self.followed.borrow_mut().join(&point.judged);
        }
        point
    }

    /// A point with the modes of shafts that continue those of another.
    pub(crate) fn judged_beside(&self, mut point: CurvePoint, beside: &[Mode]) -> CurvePoint {
        point.judged = joined(&point.equilibrium, point.judged, beside);
        point
    }

    /// The first station of a branch, with its tangent towards the high end of the range.
    pub(crate) fn first_station(&self, mut judged: SolvedState) -> Result<CurvePoint, ContinuationFailure> {
        if judged.modes.is_empty() {
            judged.modes = self.judged(&mut judged.state).unwrap_or_default();
        }
        let equilibrium = &judged.state;
        let position =
            CurvePosition { q: equilibrium.coordinates.clone(), p: equilibrium.inputs[self.settings.input.index()] };
        let system = self.system(&position)?;
        let frame = self.frame(&position, &system);
        let scaled = frame.scaled(&system);
        let axis = |k: Option<usize>| CurvePosition {
            q: Vector::from_fn(self.size(), |i| if k == Some(i) { 1.0 } else { 0.0 }),
            p: if k.is_none() { 1.0 } else { 0.0 },
        };
        let mut best: Option<CurvePosition> = None;
        let mut share = 0.0;
        for k in core::iter::once(None).chain((0..self.size()).map(Some)) {
            let Some(factors) = plane(&scaled, &axis(k)) else {
                continue;
            };
            let (q, [p]) = factors.solve(&Vector::zeros(self.size()), [1.0]);
            let curve_position = CurvePosition { q, p };
            if curve_position.finite() && 1.0 / curve_position.norm() > share {
                share = 1.0 / curve_position.norm();
                best = curve_position.unit();
            }
        }
        let forward = (self.settings.high - self.settings.low).signum();
        let tangent = best.ok_or(ContinuationFailure::Missed(NotFound::NotIsolated))?;
        let tangent = tangent.scaled(if tangent.p * forward < 0.0 { -1.0 } else { 1.0 });
        let direction = frame.stretched(&tangent);
        self.station(&position, &system, judged, &direction, None)
    }
}

impl Curve<'_> {
    /// Whether holding the place makes the sign of the determinant another one: with columns `C` and rows `R`,
    /// `det(K + C R^T) = det(K + W Z^T) det(W^T C) det(R^T Z)` up to positive factors.
    fn flips(&self, free: &FreeDirections) -> bool {
        let place = &self.place;
        negative_product(&free.balances, &place.columns) ^ negative_product(&place.rows, &free.motions)
    }
}

/// Whether the bases of free directions and balances of a state are turned, as far as the mass tells; an error if a
/// neighbour is too far away to tell.
fn turned(state: &Equilibrium, before: Option<&CurvePoint>) -> Result<bool, ContinuationFailure> {
    let (free, mass) = (&state.free, &state.linear.mass);
    let Some(before) = before else {
        return Ok(negative_product(&free.balances, &moved(mass, &free.motions)));
    };
    let last = &before.equilibrium.free;
    let turns = [(&last.balances, &free.balances), (&last.motions, &free.motions)].map(|(a, b)| cosine(mass, a, b));
    if turns.iter().flatten().any(|turn| turn.abs() < TURN) {
        return Err(ContinuationFailure::Missed(NotFound::BendsSharply));
    }
    let odd = turns.iter().flatten().filter(|turn| **turn < 0.0).count() % 2 == 1;
    Ok(before.signs.turned ^ odd)
}

/// The cosine between two spaces in the metric of the mass, negative if their bases have opposite orientations; `None` if
/// they move no mass, or differ in dimension.
fn cosine(mass: &Matrix, a: &[Vector], b: &[Vector]) -> Option<f64> {
    // Away from equilibria a state has no free directions.
    if a.len() != b.len() {
        return None;
    }
    let moved = [a, b].map(|basis| moved(mass, basis));
    let product = |a: &[Vector], b: &[Vector]| Some(Lu::of(gram(a, b))?.determinant());
    let sizes = product(a, &moved[0])? * product(b, &moved[1])?;
    // Spaces at a right angle have a product that is not regular.
    let across = product(a, &moved[1]).unwrap_or(0.0);
    (sizes > 0.0).then(|| across / sizes.sqrt())
}

fn moved(mass: &Matrix, basis: &[Vector]) -> Vec<Vector> {
    basis.iter().map(|z| times(mass, z)).collect()
}

/// `A^T B`.
fn gram(a: &[Vector], b: &[Vector]) -> Matrix {
    Matrix::from_fn(a.len(), b.len(), |i, j| dot(&a[i], &b[j]))
}

/// Whether `det(A^T B)` is negative, for as many columns of either; not if it is zero.
fn negative_product(a: &[Vector], b: &[Vector]) -> bool {
    a.len() == b.len() && Lu::of(gram(a, b)).is_some_and(|factors| factors.negative_determinant())
}

impl CurvePoint {
    /// The same point with the tangent reversed.
    pub(crate) fn reversed(&self) -> Self {
        Self {
            tangent: self.tangent.scaled(-1.0),
            signs: Signs { falling: !self.signs.falling, crossed: !self.signs.crossed, ..self.signs },
            ..self.clone()
        }
    }

    /// Whether the determinant of `Khat` (reduced by constraints) is positive and, if it is symmetric, every eigenvalue
    /// is.
    pub(crate) fn stiff(&self) -> bool {
        self.signs.falling == self.signs.crossed && self.signs.negative.is_none_or(|count| count == 0)
    }

    /// Tangent in SI units.
    pub(crate) fn direction(&self) -> CurvePosition {
        self.frame.stretched(&self.tangent)
    }
}

/// Number of negative eigenvalues of a symmetric `Khat` in the directions that the constraints leave free.
fn negative(linear: &Linear, description: &Description) -> Option<usize> {
    if !symmetric_to_rounding(linear, description) {
        return None;
    }
    if Structure::of(description).open() && Cholesky::new(&linear.stiffness).is_ok() {
        return Some(0);
    }
    Some(free_pairs(linear, description).ok()?.negative())
}

/// Whether `Khat` has modes of its own: it is symmetric, and none of it belongs to speeds.
pub(crate) fn symmetric_to_rounding(linear: &Linear, description: &Description) -> bool {
    Structure::of(description).holonomic() && (description.symmetric_stiffness || asymmetry(&linear.stiffness) <= 1e-11)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn orientations_in_the_metric_of_the_mass() {
        let mass = Matrix::from([[2.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 5.0]]);
        let basis = |rows: &[[f64; 3]]| rows.iter().map(|x| Vector::from(&x[..])).collect();
        let plane: Vec<Vector> = basis(&[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
        let swapped: Vec<Vector> = basis(&[[0.0, 3.0, 0.0], [1.0, 0.0, 0.0]]);
        let across: Vec<Vector> = basis(&[[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]);
        assert_eq!(cosine(&mass, &plane, &swapped), Some(-1.0));
        assert_eq!(cosine(&mass, &plane, &across), Some(0.0));
        assert_eq!(cosine(&mass, &plane, &plane[..1]), None);
        assert_eq!(cosine(&mass, &plane[..1], &plane), None);
        assert_eq!(cosine(&mass, &plane, &[]), None);
    }
}
