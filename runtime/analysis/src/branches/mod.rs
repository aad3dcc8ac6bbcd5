//! Branches of equilibria: how equilibria move with one input, where they turn back, where they cross, and where they
//! are stable.
//!
//! A branch is followed by pseudo-arclength continuation in `(q, u_k)`, so that it can turn back at limit points.
//! Special points are located to rounding accuracy, and at branch points the other branch is followed as well.
//!
//! # Branches
//!
//! Sweeps follow the stable equilibrium from point to point; `branches/` follows curves of equilibria wherever they go.
//! Branch points are located as saddles of the reduced (Lyapunov-Schmidt) function of the critical mode and the input,
//! regular at pitchforks and transcritical points alike, where the eigenvalue along the branch loses half of its
//! digits.

mod answer;
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

pub use answer::branch_table;
pub(crate) use bordered::Bordered;
pub(crate) use curve::{ContinuationFailure, Curve};
pub(crate) use curve_point::CurvePoint;
pub use explore::{branch, branches, branches_each};
pub(crate) use local_scaling::CurvePosition;
pub use settings::Continuation;
pub(crate) use special::{Located, critical_inertia};
pub use special::{SpecialKind, SpecialPoint};
pub(crate) use walk::Pass;

use core::fmt;

use crate::algebra::Vector;
use crate::equilibrium::{Equilibrium, Stability, coincide, turned_towards};
use crate::{Description, Error, Input, Shared};

/// A point of a branch.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct BranchPoint {
    /// Value of the input, SI.
    pub value: f64,
    /// The equilibrium; at a special point its critical modes count as neutral.
    pub equilibrium: Equilibrium,
    /// `dq/ds` along the branch, in the order of its points; together with [`Self::input_tangent`] it has length one in
    /// the units of [`Continuation`].
    pub tangent: Vector,
    /// `du/ds` along the branch, SI.
    pub input_tangent: f64,
    /// The outputs, SI.
    #[cfg_attr(feature = "serde", serde(default))]
    pub outputs: Vector,
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
    /// At the low end of the range: its smaller value, in whichever direction it is given.
    Low,
    /// At the high end of the range: its larger value.
    High,
    /// At a branch point: an arm of a pitchfork begins or ends there, or nothing could be followed beyond it.
    BranchPoint,
    /// Nowhere: the branch returns to its start.
    Closed,
    /// A coordinate grows without bound.
    Escape,
    /// At the edge of the domain of the equations; the error says which.
    Domain(Error),
    /// The branch continues, but the maximum number of points was reached.
    PointLimit,
    /// The branch could not be followed; the error says why.
    Lost(Error),
    /// The branch continues, but the work was stopped ([`Watch::stop`](crate::Watch::stop)).
    Stopped,
}

impl fmt::Display for BranchEnd {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Low => write!(f, "low end of the range"),
            Self::High => write!(f, "high end of the range"),
            Self::BranchPoint => write!(f, "branch point"),
            Self::Closed => write!(f, "closed"),
            Self::Escape => write!(f, "infinity"),
            Self::Domain(error) => write!(f, "edge of the domain: {error}"),
            Self::PointLimit => write!(f, "limit on the number of points"),
            Self::Stopped => write!(f, "stopped"),
            Self::Lost(error) => write!(f, "lost: {error}"),
        }
    }
}

/// A connected curve of equilibria.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Branch {
    /// The varied input.
    pub input: Input,
    /// Points from one end to the other, including special points.
    pub points: Vec<BranchPoint>,
    /// Points at which `Khat` is singular, in order along the branch.
    pub special: Vec<SpecialPoint>,
    /// How it ends before its first and after its last point.
    pub ends: [BranchEnd; 2],
    /// The mechanism it belongs to.
    pub description: Shared<Description>,
}

impl Branch {
    /// The branch cut at its special points, which belong to both sides, and at other changes of stability.
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
        self.stretches().into_iter().filter(|(stability, _)| stability.holds()).map(|(_, run)| run).collect()
    }

    fn is_special(&self, point: &BranchPoint) -> bool {
        self.special.iter().any(|special| {
            special.value == point.value && special.equilibrium.coordinates == point.equilibrium.coordinates
        })
    }
}

/// The branches found.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Branches {
    /// The branches, in the order in which they were found, without duplicates.
    pub branches: Vec<Branch>,
    /// Whether the search ended at [`Continuation::max_branches`] or was stopped, so that there may be more.
    pub truncated: bool,
}

impl Branches {
    /// Stable stretches of all branches, each with its branch.
    pub fn stable(&self) -> impl Iterator<Item = (&Branch, &[BranchPoint])> + '_ {
        let stretches = |branch| Branch::stable(branch).into_iter().map(move |stretch| (branch, stretch));
        self.branches.iter().flat_map(stretches)
    }

    /// All special points without duplicates; those that differ by full turns of an angle count as one.
    #[must_use]
    pub fn special(&self) -> Vec<&SpecialPoint> {
        let size = self
            .branches
            .iter()
            .flat_map(|branch| &branch.points)
            .fold(0.0, |most: f64, point| most.max(point.value.abs()));
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
