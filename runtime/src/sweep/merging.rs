//! Onsets of flutter where two frequencies merge: without damping, both oscillations keep their amplitude on one side,
//! and one of them grows on the other.
//!
//! There the growth is a square root of the distance, and beyond it neither mode is one of those before. What changes is
//! the number of growing oscillations; bisection follows it.

use super::condition::{Condition, Crossing};
use super::points::SweepPoint;
use super::track::Tracker;
use crate::{Equilibrium, Mode, Modes, Policy, Stability};

/// Relative distance of two eigenvalues that are about to merge. At a distance `d` from the onset it is about `sqrt(d)`.
const MERGING: f64 = 1e-4;
/// Bisections: more than the digits of a number.
const BISECTIONS: usize = 64;

/// Finds the onset between two neighbouring points of the nearest equilibria; `None` if there is none, or if it is of
/// another kind.
pub(super) fn onset(
    tracker: &Tracker<'_>,
    before: &SweepPoint,
    after: &SweepPoint,
) -> Option<Crossing> {
    let known = before.solved().ok()?;
    let (state, modes) = after.solved().ok()?;
    let count = growing(known.1);
    // Where gyroscopic forces cease to hold an equilibrium, the search for a stable one has left it.
    let held = |state: &Equilibrium| {
        matches!(
            state.stability,
            Stability::GyroscopicallyStabilised { .. } | Stability::Marginal
        )
    };
    if growing(modes) == count && held(known.0) == held(state) {
        return None;
    }
    let at = |value| tracker.near_with(Policy::Nearest, value, known).ok();
    if growing(&at(after.value)?.1) == count {
        return None;
    }
    let (mut low, mut high) = (before.value, after.value);
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (low + high);
        if middle == low || middle == high {
            break;
        }
        match growing(&at(middle)?.1) == count {
            true => low = middle,
            false => high = middle,
        }
    }
    // On the calm side both oscillations are there.
    let (first, second) = (at(low)?, at(high)?);
    let (value, (equilibrium, modes)) = match growing(&first.1) < growing(&second.1) {
        true => (low, first),
        false => (high, second),
    };
    Some(Crossing {
        input: tracker.input,
        value,
        condition: Condition::FlutterOnset,
        mode: about_to_merge(&modes)?,
        equilibrium,
        modes,
    })
}

/// Number of growing oscillations.
fn growing(modes: &Modes) -> usize {
    let grows = |mode: &&Mode| mode.frequency().is_some() && mode.s.re > mode.error;
    modes.modes.iter().filter(grows).count()
}

/// The oscillation that has another one closest to it, relative to its frequency.
fn about_to_merge(modes: &Modes) -> Option<usize> {
    let oscillates = |mode: &Mode| mode.frequency().is_some();
    let all = modes.modes.iter().enumerate();
    let all = all.filter(|(_, mode)| oscillates(mode));
    let distances = all.flat_map(|(r, own)| {
        let others = modes.modes[r + 1..].iter();
        let others = others.filter(|other| oscillates(other));
        others.map(move |other| (r, (own.s - other.s).norm() / own.s.norm()))
    });
    let closest = distances.min_by(|a, b| a.1.total_cmp(&b.1));
    closest.and_then(|(r, distance)| (distance < MERGING).then_some(r))
}
