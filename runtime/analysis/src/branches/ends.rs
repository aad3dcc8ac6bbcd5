//! Where and why a walk along a branch ends.

use super::BranchEnd;
use super::curve::{ContinuationFailure, Corrected, Curve};
use super::curve_point::{CurvePoint, VERTICAL};
use super::local_scaling::CurvePosition;
use crate::algebra::Vector;
use crate::equilibrium::Failure;
use crate::error::NotFound;
use crate::{Equilibrium, Error};

/// Fraction of the range by which a branch that runs along one of its ends may stray due to rounding.
pub(super) const STRAY: f64 = 1e-9;
/// Local distance over which a branch coincides with its tangent to rounding.
const BESIDE: f64 = 1e-7;

/// The last station, unless the walk is already there, and how the branch ends.
type LastStep = (Option<CurvePoint>, BranchEnd);

impl Curve<'_> {
    /// Like [`Self::arrive`], for an end of the range that is a singular point: tangent and signs are those of the
    /// previous station.
    pub(super) fn arrive_singular(
        &self,
        corrected: &Corrected,
        before: &CurvePoint,
    ) -> Result<CurvePoint, ContinuationFailure> {
        let (position, system) = (&corrected.place, &corrected.system);
        let judged = self.equilibrium(position, system, corrected.iterations, None)?;
        let frame = self.frame(position, system);
        let tangent = frame.direction(&before.direction()).unit();
        Ok(CurvePoint {
            place: position.clone(),
            equilibrium: judged.state,
            judged: judged.modes,
            frame,
            tangent: tangent.ok_or(ContinuationFailure::Missed(NotFound::NotIsolated))?,
            signs: before.signs,
        })
    }

    pub(crate) fn end_at(&self, bound: f64) -> BranchEnd {
        if bound == self.settings.bounds().0 { BranchEnd::Low } else { BranchEnd::High }
    }

    /// The end of the range at which a station is about to leave it.
    pub(super) fn leaving(&self, at: &CurvePoint) -> Option<BranchEnd> {
        let (least, most) = self.settings.bounds();
        let rate = at.tangent.p;
        if at.place.p <= least && rate < -VERTICAL {
            Some(self.end_at(least))
        } else if at.place.p >= most && rate > VERTICAL {
            Some(self.end_at(most))
        } else {
            None
        }
    }

    /// The end of the range beyond which an input lies.
    pub(super) fn beyond(&self, p: f64) -> Option<f64> {
        let (least, most) = self.settings.bounds();
        if p < least {
            Some(least)
        } else if p > most {
            Some(most)
        } else {
            None
        }
    }

    /// The point of the branch exactly at an end of the range.
    pub(super) fn land(
        &self,
        at: &CurvePoint,
        outside: &Corrected,
        bound: f64,
    ) -> Result<Corrected, ContinuationFailure> {
        let share = at.frame.local(&CurvePosition { p: bound, ..at.place.clone() }).p / outside.local.p;
        // A step that turns back between the points would land on the wrong side of the turn.
        if at.tangent.p * outside.local.p <= 0.0 || !(0.0..=1.0).contains(&share) {
            return Err(ContinuationFailure::Missed(NotFound::TurnsBack));
        }
        let from = outside.local.scaled(share);
        let input = CurvePosition { q: Vector::zeros(self.size()), p: 1.0 };
        let mut landed = self.correct(&at.frame, &from, &input, 0.5 * outside.local.norm())?;
        landed.place.p = bound;
        landed.system = self.system(&landed.place)?;
        Ok(landed)
    }

    /// Steps along the tangent to an end of the range right next to a station, where the branch is singular. No step is
    /// needed if the station is already there.
    pub(super) fn last_step(&self, at: &CurvePoint) -> Option<LastStep> {
        let (least, most) = self.settings.bounds();
        let away = |bound: f64| (bound - at.place.p) / self.settings.range();
        let bound = if away(least).abs() < away(most).abs() { least } else { most };
        if away(bound) == 0.0 {
            return Some((None, self.end_at(bound)));
        }
        let step = at.tangent.scaled(away(bound) / at.tangent.p);
        if !(step.norm() <= BESIDE && step.dot(&at.tangent) > 0.0) {
            return None;
        }
        let mut position = at.frame.place(&step);
        position.p = bound;
        let system = self.system(&position).ok()?;
        let corrected = Corrected { local: step, place: position, system, iterations: 0 };
        let station = self.arrive_singular(&corrected, at).ok()?;
        Some((Some(station), self.end_at(bound)))
    }

    pub(crate) fn broken_off(&self, trouble: ContinuationFailure, at: &Equilibrium) -> BranchEnd {
        match trouble {
            ContinuationFailure::OutsideDomain(q) => BranchEnd::Domain(Error::OutsideDomain {
                mechanism: self.description.name.clone(),
                what: "the residual",
                coordinates: q.to_vec(),
            }),
            ContinuationFailure::Unphysical(error) => BranchEnd::Domain(error),
            ContinuationFailure::Refused(failure @ (Failure::OutsideDomain { .. } | Failure::BentTooFar(_))) => {
                BranchEnd::Domain(failure.explain(&self.description))
            }
            ContinuationFailure::Refused(failure) => BranchEnd::Lost(failure.explain(&self.description)),
            ContinuationFailure::Missed(reason) => {
                let input = &self.description.inputs[self.settings.input.index()];
                BranchEnd::Lost(Error::BranchLost {
                    reason,
                    input: input.name.clone(),
                    value: at.inputs[self.settings.input.index()],
                    unit: input.unit.clone(),
                    coordinates: at.coordinates.to_vec(),
                })
            }
        }
    }
}
