//! An equilibrium: the state, the linearised mechanism there, and its stability.

mod note;
mod stability;

pub use note::Note;
pub use stability::Stability;

use std::borrow::Cow;

use crate::algebra::{Matrix, Vector};
use crate::constraints::ConstraintState;
use crate::free::FreeDirections;
use crate::kernels::{DeviatingInputs, Kernels, Linear};
use crate::{Description, Error, PoseMargin, Shared, Text};

/// A dynamic equilibrium `g(0, 0, q*; u, b) = 0` (eq. 10) and the linearised mechanism there.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Equilibrium {
    /// `q*`: coordinates, rad or m, followed by speeds and reactions of constraints, if any, SI. A reaction is what
    /// `from` exerts on `to`, the tension for a distance, with the same sign as in outputs ([`Role`](crate::Role)).
    pub coordinates: Vector,
    /// The inputs it belongs to, SI.
    pub inputs: Vector,
    /// The design variables it belongs to, SI.
    pub design: Vector,
    /// Whether the mechanism stays there.
    pub stability: Stability,
    /// Eigenvalues `lambda` up to this size cannot be distinguished from zero, 1/s^2.
    ///
    /// It covers the effect of rounding of inputs, design and coordinates on an eigenvalue that nearly vanishes, and
    /// the remainder that the iteration leaves at a located critical state. Zero if no eigenvalue is small enough for
    /// it to matter, and if `Khat` is not symmetric.
    #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
    pub rounding: f64,
    /// The numbers of the spans of shafts, SI.
    #[cfg_attr(feature = "serde", serde(default))]
    pub spans: Vector,
    /// `Mhat`, `Chat`, `Khat` at `q*` (eqs. 15-17); with shafts those that are compiled.
    pub linear: Linear,
    /// Remaining residual, N or N m; at the positions of reactions the gaps of their constraints, in the direction of
    /// the reaction.
    pub residual: Vector,
    /// Largest remaining residual, each relative to the forces in its own equation and to what a millimetre or
    /// milliradian of each coordinate, plus 1.5e-5 of the coordinate itself, restores there. At most 2e-10 for a
    /// result.
    #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
    pub relative_residual: f64,
    /// Iterations spent.
    pub iterations: usize,
    /// The joint or beam closest to its singular pose, if the mechanism has joints of three turns or beams that turn about
    /// more than one axis.
    pub pose: Option<PoseMargin<f64>>,
    /// What the constraints leave free there, and which ones are redundant.
    pub constraints: ConstraintState,
    /// Directions along which nothing depends on where the mechanism stands.
    pub free: FreeDirections,
    /// The solver passed through an unstable region: the start value was not in the valley of the answer.
    pub left_unstable_region: bool,
    /// It was asked for whatever its stability: neighbouring designs are solved for the equilibrium next to it.
    #[cfg_attr(feature = "serde", serde(default))]
    pub kept: bool,
    /// What a user should know about how it was found.
    pub notes: Vec<Note>,
    /// The mechanism it belongs to.
    pub description: Shared<Description>,
}

impl Equilibrium {
    /// Whether nearby designs certainly have a result too, as far as the turning of beams is concerned.
    #[doc(hidden)]
    pub fn far_from_least_pose(&self) -> bool {
        self.pose.as_ref().is_none_or(|pose: &PoseMargin<f64>| pose.least == 0.0 || pose.margin > 3.0 * pose.least)
    }

    /// An empty state at these inputs and design variables, to be overwritten.
    #[inline]
    #[doc(hidden)]
    pub fn blank(description: &Shared<Description>, inputs: &[f64], design: &[f64]) -> Self {
        let n = description.coordinates.len();
        Self {
            coordinates: Vector::zeros(n),
            inputs: inputs.into(),
            design: design.into(),
            stability: Stability::Undecided,
            rounding: 0.0,
            spans: Vector::default(),
            linear: Linear::zeros(n),
            residual: Vector::zeros(n),
            relative_residual: f64::INFINITY,
            iterations: 0,
            pose: None,
            constraints: ConstraintState::open(n),
            free: FreeDirections::default(),
            left_unstable_region: false,
            kept: false,
            notes: Vec::new(),
            description: description.clone(),
        }
    }

    /// Names of the constraints that depend on each other; [`ConstraintState::redundant`] of them can be removed.
    pub fn dependent_constraints(&self) -> impl Iterator<Item = Text> {
        dependent_names(&self.description, &self.constraints.dependent)
    }

    /// [`Self::stability`] in words; a singular configuration has none.
    #[must_use]
    pub fn stability_word(&self) -> String {
        if self.constraints.singular {
            "not decided in a singular configuration".to_owned()
        } else {
            self.stability.to_string()
        }
    }

    /// [`Self::notes`] in words, without full stops.
    #[must_use]
    pub fn sentences(&self) -> Vec<String> {
        self.notes.iter().map(|note| note.sentence(self)).collect()
    }

    /// Reassigns this state to the mechanism with deviating inputs, all deviations zero.
    #[must_use]
    pub fn with_deviations<K: Kernels + ?Sized>(&self, of: &DeviatingInputs<'_, K>) -> Self {
        let inputs: Vec<usize> = of.inputs().map(|input| input.index()).collect();
        Self {
            design: of.design(&self.design),
            description: of.description(),
            free: self.free.with_deviations(&inputs),
            ..self.clone()
        }
    }

    /// `Khat` with the place held along free directions: the matrix of every equation for a change of the equilibrium.
    #[doc(hidden)]
    #[inline]
    pub fn held_stiffness(&self) -> Cow<'_, Matrix> {
        self.free.held(&self.linear.stiffness)
    }

    /// Refuses a singular configuration, for which the linearised mechanism is meaningless.
    #[doc(hidden)]
    pub fn regular(&self) -> Result<(), Error> {
        if self.constraints.singular {
            Err(Error::SingularConfiguration { constraints: self.dependent_constraints().collect() })
        } else {
            Ok(())
        }
    }
}

pub(crate) fn dependent_names(description: &Description, dependent: &[bool]) -> impl Iterator<Item = Text> {
    description
        .coordinates
        .iter()
        .zip(dependent)
        .filter(|(_, takes_part)| **takes_part)
        .map(|(info, _)| info.name.clone())
}
