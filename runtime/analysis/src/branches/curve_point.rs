//! A point on a branch with the data to continue from it, and the signs that reveal events between two points.

use super::curve::{ContinuationFailure, Curve, plane};
use super::local_scaling::{CurvePosition, Frame, System};
use crate::algebra::{Cholesky, Vector, asymmetry};
use crate::constraints::Structure;
use crate::equilibrium::{Equilibrium, SolvedState};
use crate::error::NotFound;
use crate::kernels::Linear;
use crate::modes::free_pairs;
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
    /// `det [Khat dg/du; t^T] < 0`, corrected for the sign of each constraint; changes where branches cross.
    pub(crate) crossed: bool,
    /// Number of negative eigenvalues of a symmetric `Khat` in the directions that the constraints leave free.
    pub(crate) negative: Option<usize>,
}

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
        before: Option<&Signs>,
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
        let signs = Signs {
            falling: match before {
                Some(before) if vertical => before.falling,
                _ => tangent.p < 0.0,
            },
            vertical,
            // Each constraint flips the sign: its multiplier adds a negative eigenvalue.
            crossed: factors.negative_determinant() != (constraints % 2 == 1),
            negative: if vertical {
                None
            } else {
                negative(&judged.state.linear, &self.description)
            },
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

    /// The first station of a branch, with its tangent towards the high end of the range.
    pub(crate) fn first_station(
        &self,
        judged: SolvedState,
    ) -> Result<CurvePoint, ContinuationFailure> {
        let equilibrium = &judged.state;
        let position = CurvePosition {
            q: equilibrium.coordinates.clone(),
            p: equilibrium.inputs[self.settings.input.index()],
        };
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

impl CurvePoint {
    /// The same point with the tangent reversed.
    pub(crate) fn reversed(&self) -> Self {
        Self {
            tangent: self.tangent.scaled(-1.0),
            signs: Signs {
                falling: !self.signs.falling,
                crossed: !self.signs.crossed,
                ..self.signs
            },
            ..self.clone()
        }
    }

    /// Whether the determinant of `Khat` (reduced by constraints) is positive and, if it is symmetric, every eigenvalue
    /// is.
    pub(crate) fn stiff(&self) -> bool {
        self.signs.falling == self.signs.crossed
            && self.signs.negative.is_none_or(|count| count == 0)
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
    Structure::of(description).holonomic()
        && (description.symmetric_stiffness || asymmetry(&linear.stiffness) <= 1e-11)
}
