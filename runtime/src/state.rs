//! An equilibrium: the state, the linearised mechanism there, and whether it would stay.

use crate::algebra::Vector;
use crate::constraints::ConstraintState;
use crate::kernels::{DeviatingInputs, Kernels, Linear};
use crate::{Description, Error, PoseMargin, Shared, Text};

/// A dynamic equilibrium `g(0, 0, q*; u, b) = 0` (eq. 10) and the linearised mechanism there.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Equilibrium {
    /// `q*`: coordinates, rad or m; after them, where there are any, speeds and the reactions of constraints, SI: what `from`
    /// exerts on `to`, of a distance the tension; with the sign that outputs have ([`Role`](crate::Role)).
    pub coordinates: Vector,
    /// The inputs it belongs to, SI.
    pub inputs: Vector,
    /// The design variables it belongs to, SI.
    pub design: Vector,
    /// Whether the mechanism would stay there.
    pub stability: Stability,
    /// Eigenvalues `lambda` up to this size cannot be told from zero, 1/s^2: what rounding of inputs, design and coordinates
    /// changes in one that nearly vanishes, and what its iteration leaves at a critical state that was located. Zero where no
    /// eigenvalue is so small that it matters, and where `Khat` is not symmetric.
    #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
    pub rounding: f64,
    /// `Mhat`, `Chat`, `Khat` at `q*` (eqs. 15-17).
    pub linear: Linear,
    /// Remaining residual, N or N m; in the places of reactions what their constraints are open by, in the direction of the
    /// reaction.
    pub residual: Vector,
    /// Greatest remaining residual, each relative to the forces in its own equation and to what a millimetre or
    /// milliradian of each coordinate, with 1.5e-5 of the coordinate itself, restores there. A result has at most 2e-10.
    #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
    pub relative_residual: f64,
    /// Iterations spent.
    pub iterations: usize,
    /// The joint nearest to its singular pose, if the mechanism has joints of three turns.
    pub pose: Option<PoseMargin<f64>>,
    /// What the constraints leave free there, and which say the same.
    pub constraints: ConstraintState,
    /// The solver met an unstable region on its way: the start value was not in the valley of the answer.
    pub left_unstable_region: bool,
    /// The mechanism it belongs to.
    pub description: Shared<Description>,
}

impl Equilibrium {
    /// What a state at these inputs and design variables is written over.
    #[inline]
    pub(crate) fn blank(description: &Shared<Description>, inputs: &[f64], design: &[f64]) -> Self {
        let n = description.coordinates.len();
        Self {
            coordinates: Vector::zeros(n),
            inputs: inputs.into(),
            design: design.into(),
            stability: Stability::Undecided,
            rounding: 0.0,
            linear: Linear::zeros(n),
            residual: Vector::zeros(n),
            relative_residual: f64::INFINITY,
            iterations: 0,
            pose: None,
            constraints: ConstraintState::open(n),
            left_unstable_region: false,
            description: description.clone(),
        }
    }

    /// Names of the constraints that depend on each other: [`ConstraintState::redundant`] of them can go.
    pub fn dependent_constraints(&self) -> impl Iterator<Item = Text> {
        dependent_names(&self.description, &self.constraints.dependent)
    }

    /// The same state of the mechanism whose inputs deviate, deviations zero.
    #[must_use]
    pub fn with_deviations<K: Kernels + ?Sized>(&self, of: &DeviatingInputs<'_, K>) -> Self {
        Self {
            design: of.design(&self.design),
            description: of.description(),
            ..self.clone()
        }
    }

    /// Refuses a singular configuration, of which the linearised mechanism says nothing.
    pub(crate) fn regular(&self) -> Result<(), Error> {
        if self.constraints.singular {
            Err(Error::SingularConfiguration {
                constraints: self.dependent_constraints().collect(),
            })
        } else {
            Ok(())
        }
    }
}

pub(crate) fn dependent_names(
    description: &Description,
    dependent: &[bool],
) -> impl Iterator<Item = Text> {
    let infos = description.coordinates.iter().zip(dependent);
    infos
        .filter(|(_, takes_part)| **takes_part)
        .map(|(info, _)| info.name.clone())
}

/// Stability of an equilibrium against small disturbances.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Stability {
    /// Stable: no small disturbance grows.
    Stable,
    /// Stable by gyroscopic forces alone, which hold directions without stiffness; the least dissipation destroys it.
    GyroscopicallyStabilised {
        /// Number of directions with negative stiffness.
        negative: usize,
    },
    /// Some oscillation neither grows nor decays within rounding, and no theorem says that it does not grow.
    Marginal,
    /// Not unstable, but this many directions have no stiffness: the mechanism rests anywhere along them.
    Neutral {
        /// Number of eigenvalues that are zero within rounding.
        zero: usize,
    },
    /// A disturbance grows without oscillation (static instability).
    Divergent {
        /// Number of negative eigenvalues `lambda`, or of growing real eigenvalues `s`.
        negative: usize,
    },
    /// A disturbance grows in an oscillation (dynamic instability).
    Flutter {
        /// Number of growing oscillations.
        growing: usize,
    },
    /// The general eigenvalues, which would decide it, were not found to working accuracy.
    Undecided,
}

impl Stability {
    /// Whether small disturbances stay small as far as the linearised mechanism tells, neutral directions included.
    #[must_use]
    pub fn holds(self) -> bool {
        matches!(
            self,
            Self::Stable
                | Self::GyroscopicallyStabilised { .. }
                | Self::Marginal
                | Self::Neutral { .. }
        )
    }
}
