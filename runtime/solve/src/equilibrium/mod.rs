//! Dynamic equilibria: where a mechanism can rest relative to its drives, and whether it stays there.

mod acceptance;
mod answer;
mod assembly;
mod balance;
mod branch;
mod constraint_projection;
mod convergence;
mod descent;
mod finish;
mod member;
mod multistart;
mod newton;
mod newton_fast_path;
mod operating_point;
mod prediction;
mod regularity;
mod root;
mod scaling;
mod search_space;
mod solve;
mod stability;
mod turns;

pub use assembly::{Assembly, AssemblyMode, assemble};
pub use multistart::{Equilibria, Search, find_equilibria};

pub(crate) use balance::without_rounding;
#[doc(hidden)]
pub use branch::Branch;
#[doc(hidden)]
pub use convergence::{ACCEPTED, LAST_STEP, ROUNDED, ROUNDING, SMALL_MOTION, TOLERANCE, relative_residual};
#[doc(hidden)]
pub use finish::SolvedState;
#[doc(hidden)]
pub use operating_point::{Failure, OperatingPoint};
#[doc(hidden)]
pub use prediction::{MISSED, Path, STILL, confirmed};
#[doc(hidden)]
pub use regularity::constraint_state;
#[doc(hidden)]
pub use root::{Bracket, refine};
#[doc(hidden)]
pub use solve::{solve, solve_from_prediction, solve_into};
#[doc(hidden)]
pub use stability::{Verdict, judge, judge_critical};
#[doc(hidden)]
pub use turns::{coincide, turned_towards, turns_do_not_count};

pub use crate::constraints::ConstraintState;
pub use crate::free::{FreeDirections, Held};
pub use crate::state::{Equilibrium, Note, Stability};

use crate::error::NotFound;
use crate::kernels::Kernels;
use crate::{Error, Mode};

/// Which equilibrium to find.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Policy {
    /// A stable equilibrium, by descent in the amended potential.
    ///
    /// If descent finds none, the nearest equilibrium; its [`Stability`] then tells what it is. From a start without
    /// positive stiffness, the nearest one is taken if gyroscopic forces hold it.
    ///
    /// Without a symmetric `Khat`, or with coasting coordinates or rolling wheels, there is no potential, and this is
    /// the same as `Nearest`: an unstable equilibrium may be found although there are stable ones.
    #[default]
    Stable,
    /// The equilibrium that Newton's method reaches from the start value, whatever its stability: the upright pendulum, the
    /// far side of a snap-through. Its derivatives are those of that equilibrium, and samples of tolerances stay near it.
    Nearest,
}

/// What is needed of an equilibrium.
#[doc(hidden)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Needed {
    /// The state: its stability is left [undecided](Stability::Undecided) where only eigenvalues decide it.
    State,
    /// Its stability, too.
    Verdict,
    /// And its modes.
    #[default]
    Modes,
}

impl Policy {
    /// The policy for designs near that of a known equilibrium: about an unstable one, or one that was asked for whatever
    /// its stability, the equilibrium next to it.
    #[doc(hidden)]
    pub fn about(known: &Equilibrium) -> Self {
        if known.stability.holds() && !known.kept { Self::Stable } else { Self::Nearest }
    }
}

/// Finds a dynamic equilibrium from the start value `start`.
///
/// `u` are inputs, `b` design variables, `start` coordinates, all SI. With [`Policy::Stable`] a start exactly on an
/// unstable equilibrium is left along its most unstable mode, towards positive values of the mode's largest component;
/// a `Study` stays there if that start was given.
///
/// A mechanism with constraints is first moved from `start` to the nearest position that closes its loops ([`assemble`]
/// does that with some coordinates held); the reactions in `start` are ignored.
///
/// # Errors
/// [`Error::WrongLength`], [`Error::NotFinite`], [`Error::Unphysical`], [`Error::SingularMass`],
/// [`Error::OutsideDomain`], [`Error::NotAssembled`], [`Error::NoEquilibrium`].
pub fn equilibrium(
    mechanism: &dyn Kernels,
    u: &[f64],
    b: &[f64],
    start: &[f64],
    policy: Policy,
) -> Result<Equilibrium, Error> {
    let mut state = Equilibrium::blank(&mechanism.description(), u, b);
    let mut point = OperatingPoint::new(mechanism, u, b)?;
    point.ask(&[], Vec::new());
    equilibrium_into(&point, start, policy, &mut state)?;
    Ok(state)
}

/// Like [`equilibrium`], but overwrites a blank state of this point, whose values are checked here, and returns
/// [`SolvedState::modes`].
pub fn equilibrium_into(
    point: &OperatingPoint<'_>,
    start: &[f64],
    policy: Policy,
    state: &mut Equilibrium,
) -> Result<Vec<Mode>, Error> {
    point.check_values()?;
    point.check_start(start)?;
    solve_into(point, start, policy, state).or_else(|failure| {
        let comes_to_rest =
            matches!(failure, Failure::NotFound { reason: NotFound::IterationLimit | NotFound::Minimum, .. });
        let beside = comes_to_rest.then(|| multistart::from_beside(point, start, policy));
        let Some(mut found) = beside.flatten() else {
            return Err(failure.explain(&point.description));
        };
        let unknowns = 0..point.motions();
        let far = solve::far(point, start, &found.state.coordinates, unknowns);
        found.state.notes.extend(far);
        *state = found.state;
        Ok(found.modes)
    })
}
