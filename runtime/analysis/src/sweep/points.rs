//! Results along an input.

use super::condition::{Change, Crossing};
use super::search::Searched;
use crate::algebra::Vector;
use crate::branches::SpecialKind;
use crate::{Description, Equilibrium, Error, Input, Modes, Shared};

/// A sweep; iterating over it yields its points.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Sweep {
    /// The swept input.
    pub input: Input,
    /// One point per value.
    pub points: Vec<SweepPoint>,
    /// Critical values of the input, where stiffness vanishes on the way from the first value to the last, each located
    /// to rounding accuracy on the branch before it. Like all events, they depend on the first and the last value only;
    /// without two values in ascending or descending order there are none.
    pub critical: Vec<CriticalState>,
    /// Values at which an oscillation starts or stops growing; none for undamped modes.
    pub flutter_onsets: Vec<Crossing>,
    /// The range that was searched for events, and how finely; `None` without a range.
    pub searched: Option<Searched>,
    /// Number of values not reached because the run was stopped.
    pub unreached: usize,
    /// The inputs, SI; all but the swept one keep their values.
    pub inputs: Vector,
    /// The mechanism it belongs to.
    pub description: Shared<Description>,
}

impl IntoIterator for Sweep {
    type Item = SweepPoint;
    type IntoIter = std::vec::IntoIter<Self::Item>;

    fn into_iter(self) -> Self::IntoIter {
        self.points.into_iter()
    }
}

impl<'a> IntoIterator for &'a Sweep {
    type Item = &'a SweepPoint;
    type IntoIter = core::slice::Iter<'a, SweepPoint>;

    fn into_iter(self) -> Self::IntoIter {
        self.points.iter()
    }
}

/// One point of a sweep.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SweepPoint {
    /// Value of the swept input, SI.
    pub value: f64,
    /// The equilibrium, or the reason why there is none.
    pub equilibrium: Result<Equilibrium, Error>,
    /// The modes at this point: modes with the same label are the same motion along the whole sweep.
    pub modes: Result<Modes, Error>,
}

impl SweepPoint {
    /// Equilibrium and modes, or the reason why one of them is missing.
    pub(crate) fn solved(&self) -> Result<(&Equilibrium, &Modes), &Error> {
        Ok((self.equilibrium.as_ref()?, self.modes.as_ref()?))
    }

    /// Equilibrium and modes as buffers to overwrite, or the reason why one of them is missing.
    pub(super) fn solved_mut(&mut self) -> Result<(&mut Equilibrium, &mut Modes), &mut Error> {
        Ok((self.equilibrium.as_mut()?, self.modes.as_mut()?))
    }
}

/// A state where `Khat` is singular.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct CriticalState {
    /// The varied input.
    pub input: Input,
    /// Its critical value, SI.
    pub value: f64,
    /// The kind of critical point.
    pub kind: SpecialKind,
    /// Whether a motion without oscillation begins or ceases to grow there.
    pub change: Change,
    /// The equilibrium at the critical value, on the branch that is stable below it; its critical mode counts as
    /// neutral.
    pub equilibrium: Equilibrium,
    /// Critical vector: `Khat v = 0`, `v^T Mhat v = 1`, largest component positive; one of several if degenerate. With
    /// speeds of coasting coordinates, `Mhat` includes their inertia, which otherwise is part of `Chat`.
    pub v: Vector,
    /// Left critical vector: `Khat^T w = 0`, `w^T Mhat v = 1` with the same `Mhat`; equal to `v` for a symmetric `Khat`.
    pub w: Vector,
}
