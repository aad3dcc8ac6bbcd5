//! Branches of equilibria: how equilibria move with one input, where they turn back, where they cross, and where they
//! are stable.
//!
//! A branch is followed by pseudo-arclength continuation in `(q, u_k)`, so that it may turn back at limit points; special
//! points are located to rounding, and at branch points the other branch is followed as well.

mod bordered;
mod branch_point;
mod curve;
mod curve_point;
mod ends;
mod explore;
mod fold;
mod local_scaling;
mod locate;
mod settings;
mod special;
mod visited;
mod walk;

pub(crate) use bordered::Bordered;
pub(crate) use curve::Curve;
pub(crate) use curve_point::CurvePoint;
pub use explore::{branch, branches, branches_each};
pub use settings::Continuation;
pub use special::{SpecialKind, SpecialPoint};

use crate::algebra::Vector;
use crate::equilibrium::{Equilibrium, Stability, coincide, turned_towards};
use crate::{Description, Error, Input, Shared};

/// A point of a branch.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct BranchPoint {
    /// The input there, SI.
    pub value: f64,
    /// The equilibrium there; its stability counts the critical modes of special points as neutral.
    pub equilibrium: Equilibrium,
    /// `dq/ds` along the branch, in the order of its points; with [`Self::input_tangent`] of length one in the units of
    /// [`Continuation`].
    pub tangent: Vector,
    /// `du/ds` along the branch, SI.
    pub input_tangent: f64,
}

impl BranchPoint {
    fn reversed(mut self) -> Self {
        self.tangent = self.tangent.map(|value| -value);
        self.input_tangent = -self.input_tangent;
        self
    }
}

/// Where and why a branch ends.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum BranchEnd {
    /// At the low end of the range.
    Low,
    /// At the high end of the range.
    High,
    /// At a branch point: the arm of a pitchfork begins and ends there.
    BranchPoint,
    /// Nowhere: the branch comes back to where it started.
    Closed,
    /// A coordinate grows without bound.
    Escape,
    /// At the edge of the domain of the equations; the error says which.
    Domain(Error),
    /// The branch goes on, but the greatest number of points was reached.
    PointLimit,
    /// The branch could not be followed; the error says why.
    Lost(Error),
    /// The branch goes on, but the work was stopped ([`Watch::stop`](crate::Watch::stop)).
    Stopped,
}

/// A connected line of equilibria.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Branch {
    /// The input that varies.
    pub input: Input,
    /// Points from one end to the other, special points among them.
    pub points: Vec<BranchPoint>,
    /// Points at which `Khat` is singular, in their order along the branch.
    pub special: Vec<SpecialPoint>,
    /// How it ends before its first and after its last point.
    pub ends: [BranchEnd; 2],
    /// The mechanism it belongs to.
    pub description: Shared<Description>,
}

impl Branch {
    /// The branch cut at its special points, which belong to both sides, and where the stability changes otherwise.
    #[must_use]
    pub fn stretches(&self) -> Vec<(Stability, &[BranchPoint])> {
        let mut runs = Vec::new();
        let mut start = 0;
        let mut inside = None;
        for (k, point) in self.points.iter().enumerate() {
            let stability = point.equilibrium.stability;
            if self.is_special(point) {
                if k > start {
                    runs.push((inside.unwrap_or(stability), &self.points[start..=k]));
                }
                (start, inside) = (k, None);
            } else if let Some(before) = inside
                && before != stability
            {
                runs.push((before, &self.points[start..k]));
                (start, inside) = (k, Some(stability));
            } else {
                inside = Some(stability);
            }
        }
        if let Some(stability) = inside {
            runs.push((stability, &self.points[start..]));
        }
        runs
    }

    /// The stretches that are stable or neutral.
    #[must_use]
    pub fn stable(&self) -> Vec<&[BranchPoint]> {
        let stretches = self.stretches().into_iter();
        let stable = stretches.filter(|(stability, _)| stability.holds());
        stable.map(|(_, run)| run).collect()
    }

    fn is_special(&self, point: &BranchPoint) -> bool {
        self.special.iter().any(|special| {
            special.value == point.value
                && special.equilibrium.coordinates == point.equilibrium.coordinates
        })
    }
}

/// The branches that were found.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Branches {
    /// The branches, in the order in which they were found; each once.
    pub branches: Vec<Branch>,
    /// The search ended at [`Continuation::max_branches`], or was stopped, although there may be more.
    pub truncated: bool,
}

impl Branches {
    /// Stable stretches of all branches, each with its branch.
    pub fn stable(&self) -> impl Iterator<Item = (&Branch, &[BranchPoint])> + '_ {
        let stretches = |branch| {
            Branch::stable(branch)
                .into_iter()
                .map(move |stretch| (branch, stretch))
        };
        self.branches.iter().flat_map(stretches)
    }

    /// Every special point once, those that differ by full turns of an angle counting as one.
    #[must_use]
    pub fn special(&self) -> Vec<&SpecialPoint> {
        let values = self.branches.iter().flat_map(|branch| &branch.points);
        let size = values.fold(0.0, |most: f64, point| most.max(point.value.abs()));
        let mut all: Vec<&SpecialPoint> = Vec::new();
        for special in self.branches.iter().flat_map(|branch| &branch.special) {
            let at = &special.equilibrium;
            let known = |other: &&SpecialPoint| {
                let there = &other.equilibrium;
                let turned = turned_towards(&there.coordinates, &at.coordinates, &at.description);
                (other.value - special.value).abs() <= 1e-10 * size
                    && coincide(&turned, &at.coordinates, false, &at.description)
            };
            if !all.iter().any(known) {
                all.push(special);
            }
        }
        all
    }
}
