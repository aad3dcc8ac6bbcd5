//! Values of an input where stiffness vanishes on a branch of equilibria: critical speeds.

use super::points::CriticalState;
use super::range::Range;
use super::track::Following;
use crate::algebra::Vector;
use crate::branches::{BranchEnd, Continuation, Curve, CurvePoint, SpecialPoint};
use crate::equilibrium::{Policy, equilibrium};
use crate::kernels::DirectionalKernels;
use crate::{Equilibrium, Error, Input, Stability};

/// Bounds on the largest step of the continuation, whatever number of steps is requested.
const FINEST_STEP: f64 = 1e-4;
const COARSEST_STEP: f64 = 0.05;
/// Maximum number of continuation points.
const MOST_POINTS: usize = 50_000;

/// Finds the first input value at which the branch that is stable at `range.low` loses its stiffness: a limit point or
/// branch point, located to rounding accuracy.
///
/// The branch itself is followed by continuation, even where a neighbouring branch is the stable one, with steps of at
/// most `1/steps` of the range (clamped to between 1e-4 and 0.05). A branch that runs to infinity is not critical. A
/// non-symmetric `Khat` is critical where its determinant changes sign.
///
/// # Errors
/// [`Error::NotInRange`] if the branch keeps its stiffness; the cause if the branch cannot be followed to the end of
/// the range; otherwise as [`equilibrium`].
pub fn critical_state(
    mechanism: &dyn DirectionalKernels,
    u: &[f64],
    b: &[f64],
    start: &[f64],
    range: Range,
) -> Result<CriticalState, Error> {
    range.check(&mechanism.description())?;
    let settings = Continuation {
        max_step: (1.0 / range.steps as f64).clamp(FINEST_STEP, COARSEST_STEP),
        max_points: MOST_POINTS,
        ..Continuation::new(range.input, range.low, range.high)
    };
    let curve = Curve::new(mechanism, u, b, &settings)?;
    let inputs = curve.inputs_at(range.low);
    let state = equilibrium(mechanism, &inputs, b, start, Policy::Stable)?;
    let curve = curve.about(&state);
    let mut found = None;
    let end = match curve.begin(&state) {
        Ok(station) => {
            let stop = |special: &SpecialPoint, before: &CurvePoint| {
                // Two directions without stiffness leave the determinant of a non-symmetric one positive.
                let diverges = matches!(before.equilibrium.stability, Stability::Divergent { .. });
                if before.stiff() && !diverges {
                    found = Some(special.clone());
                }
                found.is_some()
            };
            curve.walk(&station, &station.place, stop).end
        }
        Err(trouble) => curve.broken_off(trouble, &state),
    };
    match (found, end) {
        (Some(special), _) => Ok(CriticalState {
            input: range.input,
            value: special.value,
            kind: special.kind,
            equilibrium: special.equilibrium,
            v: special.v,
            w: special.w,
        }),
        (None, BranchEnd::Domain(error) | BranchEnd::Lost(error)) => Err(error),
        (None, _) => {
            let input = &curve.description.inputs[range.input.index()];
            Err(Error::NotInRange {
                what: "critical value",
                input: input.name.clone(),
                low: range.low,
                high: range.high,
                unit: input.unit.clone(),
            })
        }
    }
}

/// Maximum number of critical states on one path: a safeguard, far above what real machines have.
const MOST_STATES: usize = 32;

/// A path of stable equilibria, reduced to what is needed to find its critical states.
pub(crate) struct Path {
    /// Whether stable equilibria are followed.
    stable: bool,
    /// Value, state, and whether the path reaches it from the previous state so smoothly that no critical state lies
    /// between. Of consecutive smooth states only the last is kept.
    stations: Vec<(f64, Vector, bool)>,
    /// The first and the last value.
    ends: Option<(f64, f64)>,
    /// The first value beyond the last one, if no state was found there.
    lost: Option<f64>,
    ascends: bool,
    descends: bool,
}

impl Path {
    pub(crate) fn new(following: Following) -> Self {
        Self {
            stable: following.policy == Policy::Stable,
            stations: Vec::new(),
            ends: None,
            lost: None,
            ascends: true,
            descends: true,
        }
    }

    /// Extends the path by a state, if there is one.
    pub(crate) fn add(&mut self, value: f64, state: &Result<Equilibrium, Error>, smooth: bool) {
        if !self.stable {
            return;
        }
        let Ok(state) = state else {
            self.lost.get_or_insert(value);
            return;
        };
        self.lost = None;
        match &mut self.ends {
            None => self.ends = Some((value, value)),
            Some((_, last)) => {
                self.ascends &= *last < value;
                self.descends &= *last > value;
                *last = value;
            }
        }
        match self.stations.last_mut() {
            Some(last) if last.2 && smooth => {
                last.0 = value;
                last.1.copy_from_slice(&state.coordinates);
            }
            _ => self
                .stations
                .push((value, state.coordinates.clone(), smooth)),
        }
    }

    /// The critical states, each on the branch that leads up to it. Empty if the path does not follow stable equilibria
    /// or if its values are not monotonic.
    pub(crate) fn critical_states(
        &self,
        mechanism: &dyn DirectionalKernels,
        (u, b): (&[f64], &[f64]),
        input: Input,
    ) -> Vec<CriticalState> {
        let mut found = Vec::new();
        let Some((first, mut last)) = self.ends.filter(|_| self.ascends || self.descends) else {
            return found;
        };
        let mut stations = self.stations.clone();
        if let Some((_, state, _)) = stations.last()
            && let Some(lost) = self.lost
            && (self.ascends && lost > last || self.descends && lost < last)
        {
            stations.push((lost, state.clone(), false));
            last = lost;
        }
        let direction = last - first;
        let mut rest = &stations[..];
        while let [(low, start, _), after @ ..] = rest
            && found.len() < MOST_STATES
        {
            // The stretch on which a critical state cannot be excluded.
            let steps = after.iter().take_while(|(.., smooth)| !smooth).count();
            if steps == 0 {
                rest = after;
                continue;
            }
            let range = Range {
                input,
                low: *low,
                high: after[steps - 1].0,
                steps,
            };
            let Ok(critical) = critical_state(mechanism, u, b, start, range) else {
                rest = &rest[steps..];
                continue;
            };
            let beyond =
                |(value, ..): &(f64, Vector, bool)| (value - critical.value) * direction > 0.0;
            let next = rest.iter().position(beyond).unwrap_or(rest.len());
            rest = &rest[next.max(1)..];
            found.push(critical);
        }
        found
    }
}
