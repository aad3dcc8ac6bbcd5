//! Pseudo-arclength continuation: follows a branch along its tangent with steps adapted to the curvature.

use super::curve::{ContinuationFailure, Corrected, Curve};
use super::curve_point::CurvePoint;
use super::ends::STRAY;
use super::local_scaling::CurvePosition;
use super::special::{Junction, Located, SpecialPoint, make_critical};
use super::{BranchEnd, BranchPoint};
use crate::Equilibrium;
use crate::algebra::Vector;
use crate::error::NotFound;
use crate::kernels::Kernels;

/// Minimum cosine of the angle between the tangents at two neighbouring points.
const STRAIGHT: f64 = 0.9;
/// Maximum distance of a point from the tangent, relative to the step.
const BEND: f64 = 0.3;
/// First steps away from a branch point, as fractions of the largest step: small, so that no event lies within them, as
/// far as rounding permits.
const DEPARTURES: [f64; 6] = [2e-3, 2e-2, 0.2, 2e-4, 2e-5, 2e-6];
/// Local distance within which two points are the same.
pub(super) const SAME: f64 = 1e-7;

/// The result of a walk in one direction, excluding the start itself.
pub(crate) struct Walk {
    pub(crate) points: Vec<BranchPoint>,
    pub(crate) special: Vec<SpecialPoint>,
    pub(crate) junctions: Vec<(Junction, bool)>,
    pub(crate) end: BranchEnd,
}

/// How a walk goes on after a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Pass {
    On,
    /// The step may have led to another branch: a shorter one instead.
    Shorter,
    Stop,
}

/// One accepted step.
struct Step {
    station: CurvePoint,
    located: Vec<Located>,
    end: Option<BranchEnd>,
    /// Factor for the length of the next step.
    growth: f64,
}

impl Curve<'_> {
    /// Follows the branch from a station along its tangent until the branch ends. `pass` sees every step from one station
    /// to the next and says how to go on. The branch started at `home`.
    pub(crate) fn walk(
        &self,
        start: &CurvePoint,
        home: &CurvePosition,
        mut pass: impl FnMut(&CurvePoint, &CurvePoint, &[Located]) -> Pass,
    ) -> Walk {
        let settings = self.settings;
        let mut walk =
            Walk { points: Vec::new(), special: Vec::new(), junctions: Vec::new(), end: BranchEnd::PointLimit };
        let largest = |curve_position: &CurvePosition| {
            let q = curve_position.q[..self.structure.motions()].iter().zip(&self.large);
            q.fold(0.0, |most: f64, (value, large)| most.max((value / large).abs()))
        };
        let far = settings.escape * (1.0 + largest(home));
        let mut at = start.clone();
        let mut length = 0.2 * settings.max_step;
        let mut refused: Option<ContinuationFailure> = None;
        let mut seen = 0;
        while walk.points.len() < settings.max_points {
            self.watch.advance(walk.points.len() - seen);
            seen = walk.points.len();
            if self.watch.stopped() {
                walk.end = BranchEnd::Stopped;
                return walk;
            }
            if let Some(end) = self.leaving(&at) {
                walk.end = end;
                return walk;
            }
            let steps = walk.points.len();
            let step = match self.advance(&at, length, home, steps) {
                Ok(step) => step,
                Err(trouble) => {
                    length *= 0.5;
                    // Near the edge of a domain, Newton's method fails for other reasons too.
                    let reason = refused.take().filter(ContinuationFailure::at_edge).unwrap_or(trouble);
                    if length.is_nan() || length < settings.min_step {
                        walk.end = match self.last_step(&at) {
                            Some((station, end)) => {
                                walk.points.extend(station.map(|station| self.point(&station)));
                                end
                            }
                            None => self.broken_off(reason, &at.equilibrium),
                        };
                        return walk;
                    }
                    refused = Some(reason);
                    continue;
                }
            };
            match pass(&at, &step.station, &step.located) {
                Pass::Shorter if length > 2.0 * settings.min_step => {
                    length *= 0.5;
                    refused = Some(ContinuationFailure::Missed(NotFound::BendsSharply));
                    continue;
                }
                Pass::Stop => {
                    walk.end = BranchEnd::Stopped;
                    return walk;
                }
                Pass::On | Pass::Shorter => {}
            }
            let growth = if refused.take().is_some() { step.growth.min(1.0) } else { step.growth };
            for located in step.located {
                let special = located.special;
                walk.points.push(self.special_point(&special, &located.direction));
                walk.special.push(special.clone());
                if let Some(junction) = located.junction {
                    let home_again = at.frame.at(junction.frame.origin.clone()).local(home).norm() <= SAME;
                    walk.junctions.push((junction, located.ends_arm));
                    if steps > 2 && home_again && !located.ends_arm {
                        walk.end = BranchEnd::Closed;
                        return walk;
                    }
                }
                if located.ends_arm {
                    walk.end = BranchEnd::BranchPoint;
                    return walk;
                }
            }
            walk.points.push(self.point(&step.station));
            if let Some(end) = step.end {
                walk.end = end;
                return walk;
            }
            if largest(&step.station.place) > far {
                walk.end = BranchEnd::Escape;
                return walk;
            }
            length = (length * growth).min(settings.max_step);
            at = step.station;
        }
        walk
    }

    pub(crate) fn outputs(&self, at: &Equilibrium) -> Vector {
        (self.mechanism as &dyn Kernels).outputs(&at.coordinates, &at.inputs, &at.design)
    }

    pub(crate) fn point(&self, station: &CurvePoint) -> BranchPoint {
        let direction = station.direction();
        let mut equilibrium = station.equilibrium.clone();
        if station.signs.vertical {
            // Equilibria form a continuum at one input: the mode along it is neutral.
            make_critical(&mut equilibrium, 1);
        }
        BranchPoint {
            value: station.place.p,
            outputs: self.outputs(&equilibrium),
            equilibrium,
            tangent: direction.q,
            input_tangent: direction.p,
        }
    }

    /// A special point as a branch point of the branch that passes it in this direction (SI units).
    pub(crate) fn special_point(&self, special: &SpecialPoint, direction: &CurvePosition) -> BranchPoint {
        let curve_position = CurvePosition { q: special.equilibrium.coordinates.clone(), p: special.value };
        let length =
            self.system(&curve_position).map_or(1.0, |system| self.frame(&curve_position, &system).length(direction));
        let tangent = direction.scaled(1.0 / length);
        BranchPoint {
            value: special.value,
            outputs: self.outputs(&special.equilibrium),
            equilibrium: special.equilibrium.clone(),
            tangent: tangent.q,
            input_tangent: tangent.p,
        }
    }

    /// The first station of the branch that leaves a junction in a local direction; `None` if it leaves the range at
    /// once or cannot be followed.
    pub(crate) fn depart(&self, junction: &Junction, direction: &CurvePosition) -> Option<CurvePoint> {
        let frame = &junction.frame;
        DEPARTURES.iter().find_map(|share| {
            let length = share * self.settings.max_step;
            let from = direction.scaled(length);
            let corrected = self.correct(frame, &from, direction, BEND * length).ok()?;
            let towards = frame.stretched(direction);
            let station = self.arrive(&corrected, &towards, None).ok()?;
            let on =
                self.beyond(corrected.place.p).is_none() && straight(&frame.direction(&station.direction()), direction);
            on.then_some(station)
        })
    }

    fn advance(
        &self,
        at: &CurvePoint,
        length: f64,
        home: &CurvePosition,
        steps: usize,
    ) -> Result<Step, ContinuationFailure> {
        let (frame, tangent) = (&at.frame, &at.tangent);
        let from = tangent.scaled(length);
        let mut corrected = self.correct(frame, &from, tangent, BEND * length)?;
        let mut end = None;
        if let Some(bound) = self.beyond(corrected.place.p) {
            let stray = (corrected.place.p - bound).abs();
            if at.signs.vertical && stray <= STRAY * self.settings.range() {
                corrected.place.p = bound;
                corrected.system = self.system(&corrected.place)?;
            } else {
                corrected = self.land(at, &corrected, bound)?;
                end = Some(self.end_at(bound));
            }
        }
        let mut station = self.arrive(&corrected, &at.direction(), Some(at));
        if station.is_err() && end.is_some() {
            station = self.arrive_singular(&corrected, at);
        }
        let station = station?;
        if !straight(&frame.direction(&station.direction()), tangent) {
            return Err(ContinuationFailure::Missed(NotFound::BendsSharply));
        }
        let mut located = Vec::new();
        self.locate(at, &station, &mut located)?;
        if steps > 2 && self.passes(at, &corrected, home) {
            end = Some(BranchEnd::Closed);
        }
        let bend = corrected.local.plus(-1.0, &from).norm() / length;
        let growth = if corrected.iterations > 5 || bend > 0.5 * BEND {
            0.7
        } else if bend < 0.1 {
            2.0
        } else {
            1.0
        };
        Ok(Step { station, located, end, growth })
    }

    pub(super) fn arrive(
        &self,
        corrected: &Corrected,
        towards: &CurvePosition,
        before: Option<&CurvePoint>,
    ) -> Result<CurvePoint, ContinuationFailure> {
        let position = &corrected.place;
        let system = &corrected.system;
        let judged = self.equilibrium(position, system, corrected.iterations, None)?;
        self.station(position, system, judged, towards, before)
    }

    /// Whether the step from a station passes a point.
    fn passes(&self, at: &CurvePoint, to: &Corrected, curve_position: &CurvePosition) -> bool {
        let end = &to.local;
        let target = at.frame.local(curve_position);
        let along = target.dot(end) / end.dot(end);
        if !(0.0..=1.0).contains(&along) || target.plus(-along, end).norm() > BEND * end.norm() {
            return false;
        }
        let Some(normal) = end.unit() else {
            return false;
        };
        self.correct(&at.frame, &end.scaled(along), &normal, end.norm())
            .is_ok_and(|corrected| corrected.local.plus(-1.0, &target).norm() <= SAME)
    }
}

fn straight(direction: &CurvePosition, tangent: &CurvePosition) -> bool {
    direction.dot(tangent) >= STRAIGHT * direction.norm() * tangent.norm()
}
