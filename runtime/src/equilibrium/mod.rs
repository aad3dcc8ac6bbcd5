//! Dynamic equilibria: where a mechanism stays at rest relative to its drives, and whether it would.

mod assembly;
pub(crate) mod branch;
mod closing;
pub(crate) mod convergence;
mod critical;
mod crossing;
mod descent;
mod end;
mod follow;
mod multistart;
mod newton;
pub(crate) mod prediction;
mod problem;
mod quick;
mod range;
mod regularity;
mod root;
mod settle;
mod space;
mod stability;
mod sweep;
mod track;
mod turns;
mod weights;

pub use assembly::{Assembly, AssemblyMode, assemble};
pub use branch::{
    Branch, BranchEnd, BranchPoint, Branches, Continuation, SpecialKind, SpecialPoint, branch,
    branches,
};
pub(crate) use critical::critical_states_on;
pub use critical::{CriticalState, critical_state};
pub(crate) use crossing::between;
pub use crossing::{Condition, Crossing, Line, crossings, flutter_onsets};
pub(crate) use follow::follow;
pub use multistart::{Search, find_equilibria};
pub use range::Range;
pub(crate) use range::check_input;
pub use stability::Stability;
pub use sweep::{Sweep, SweepPoint, sweep};
pub use track::Following;
pub(crate) use track::Tracker;

pub(crate) use problem::{Failure, Problem, check_count, name};
pub(crate) use settle::{settle, settle_into};

pub use crate::constraints::ConstraintState;

use crate::dense::Vector;
use crate::kernels::{Kernels, Linear};
use crate::{Description, Error, PoseMargin, Shared, Text};

/// Which equilibrium is wanted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Policy {
    /// A stable one, by descent in the amended potential; where descent finds none, the nearest one, whose
    /// [`Stability`] then says what it is. From a start without positive stiffness the nearest one is taken when
    /// gyroscopic forces hold it. Needs a symmetric `Khat`; without it the same as `Nearest`.
    #[default]
    Stable,
    /// The one that Newton's method reaches from the start value, whatever its stability.
    Nearest,
}

/// A dynamic equilibrium `g(0, 0, q*; u, b) = 0` (eq. 10) and the linearised mechanism there.
#[derive(Clone, Debug, PartialEq)]
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
    pub rounding: f64,
    /// `Mhat`, `Chat`, `Khat` at `q*` (eqs. 15-17).
    pub linear: Linear,
    /// Remaining residual, N or N m; in the places of reactions what their constraints are open by, in the direction of the
    /// reaction.
    pub residual: Vector,
    /// Greatest remaining residual, each relative to the forces in its own equation and to what a millimetre or
    /// milliradian of each coordinate, with 1.5e-5 of the coordinate itself, restores there. A result has at most 2e-10.
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
    /// What a state of a problem is written over.
    #[inline]
    pub(crate) fn blank(problem: &Problem<'_>) -> Self {
        let n = problem.size();
        Self {
            coordinates: Vector::zeros(n),
            inputs: problem.inputs.into(),
            design: problem.design.into(),
            stability: Stability::Undecided,
            rounding: 0.0,
            linear: Linear::zeros(n),
            residual: Vector::zeros(n),
            relative_residual: f64::INFINITY,
            iterations: 0,
            pose: None,
            constraints: ConstraintState::open(n),
            left_unstable_region: false,
            description: problem.description.clone(),
        }
    }

    /// Names of the constraints that depend on each other: [`ConstraintState::redundant`] of them can go.
    pub fn dependent_constraints(&self) -> impl Iterator<Item = Text> {
        dependent_names(&self.description, &self.constraints.dependent)
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

fn dependent_names(description: &Description, dependent: &[bool]) -> impl Iterator<Item = Text> {
    let infos = description.coordinates.iter().zip(dependent);
    infos
        .filter(|(_, takes_part)| **takes_part)
        .map(|(info, _)| info.name.clone())
}

/// Finds a dynamic equilibrium from the start value `start`.
///
/// `u` inputs, `b` design variables, `start` coordinates, all SI. With [`Policy::Stable`] a start exactly on an
/// unstable equilibrium is left along its most unstable mode, towards positive values of the mode's largest component.
///
/// A mechanism with constraints is first moved from `start` the shortest way to where it closes ([`assemble`] does that with
/// coordinates held); the reactions in `start` do not matter.
///
/// # Errors
/// [`Error::WrongLength`], [`Error::NotFinite`], [`Error::Unphysical`], [`Error::SingularMass`], [`Error::OutsideDomain`],
/// [`Error::NotAssembled`], [`Error::NoEquilibrium`].
pub fn equilibrium(
    mechanism: &dyn Kernels,
    u: &[f64],
    b: &[f64],
    start: &[f64],
    policy: Policy,
) -> Result<Equilibrium, Error> {
    let problem = Problem::new(mechanism, u, b)?;
    problem.check_start(start)?;
    let mut state = Equilibrium::blank(&problem);
    settle_into(&problem, start, policy, &mut state)
        .map_err(|failure| failure.explain(&problem.description))?;
    Ok(state)
}
