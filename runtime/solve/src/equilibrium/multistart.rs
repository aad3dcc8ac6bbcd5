//! Finds several equilibria of one mechanism from a reproducible set of start values.

use std::ops::Deref;

use eigentol_statistics::random::RandomNumbers;

use super::turns::{coincide, turned_towards, turns_do_not_count};
use super::{OperatingPoint, Policy, SolvedState, solve};
use crate::algebra::Vector;
use crate::constraints::Structure;
use crate::free::Held;
use crate::kernels::Kernels;
use crate::setters;
use crate::{Coordinate, Description, Equilibrium, Error, Role, Shared, Stability, Watch};

/// Where to start a search for several equilibria.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Search {
    /// Smallest start value of each coordinate, rad or m, then of each speed and reaction; those of reactions are
    /// ignored.
    pub lower: Vector,
    /// Largest start value of each coordinate, rad or m.
    pub upper: Vector,
    /// Minimum number of random starts; each is followed to a stable and to the nearest equilibrium. More starts follow
    /// until the finds so far suggest that no equilibrium is missing. Default 32.
    pub starts: usize,
    /// Seed of the starts; the same seed gives the same starts. Default 0.
    pub seed: u64,
    /// The unknowns that hold a member of a family of steady motions; empty for those that the declaration holds, or
    /// where there is no family.
    #[cfg_attr(feature = "serde", serde(default))]
    pub held: Vec<Held>,
}

/// Distinct equilibria of one mechanism at one operating point, in the order of discovery. Dereferences to their list.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Equilibria {
    /// The equilibria.
    pub states: Vec<Equilibrium>,
    /// Number of places from which they were searched.
    #[cfg_attr(feature = "serde", serde(default))]
    pub starts: usize,
    /// Whether the finds suggest that further equilibria exist.
    #[cfg_attr(feature = "serde", serde(default))]
    pub more_expected: bool,
    /// The inputs they belong to, SI.
    pub inputs: Vector,
    /// The mechanism they belong to.
    pub description: Shared<Description>,
}

impl Deref for Equilibria {
    type Target = [Equilibrium];

    fn deref(&self) -> &[Equilibrium] {
        &self.states
    }
}

impl IntoIterator for Equilibria {
    type Item = Equilibrium;
    type IntoIter = std::vec::IntoIter<Equilibrium>;

    fn into_iter(self) -> Self::IntoIter {
        self.states.into_iter()
    }
}

impl Search {
    setters!(starts: usize, seed: u64, held: Vec<Held>);

    /// No start but this one, SI.
    #[doc(hidden)]
    #[must_use]
    pub fn at(start: &[f64]) -> Self {
        Self { lower: start.into(), upper: start.into(), starts: 0, seed: 0, held: Vec::new() }
    }

    /// Starts about the state `about`: between bounds for the coordinates and speeds that have some, anywhere within half
    /// a turn either way for other angles. Values are SI.
    ///
    /// # Errors
    /// [`Error::Setting`] if a displacement or a speed has no bounds, because nothing says how far it may move. Where
    /// constraints close loops, displacements may do without: they follow from the others.
    pub fn within(description: &Description, about: &[f64], bounds: &[(Coordinate, f64, f64)]) -> Result<Self, Error> {
        let structure = Structure::of(description);
        let (mut lower, mut upper) = (Vector::from(about), Vector::from(about));
        let mut missing = Vec::new();
        for (i, info) in description.coordinates.iter().enumerate() {
            let bound = bounds.iter().find(|(unknown, ..)| unknown.index() == i);
            if let Some(&(_, low, high)) = bound {
                (lower[i], upper[i]) = (low, high);
                continue;
            }
            let angle = info.unit.symbol == *"rad";
            match info.role {
                Role::Position if angle => {
                    lower[i] -= core::f64::consts::PI;
                    upper[i] += core::f64::consts::PI;
                }
                Role::Position if structure.position_constraints > 0 => {}
                Role::Position | Role::Speed => missing.push(format!("`{}`", info.name)),
                Role::PositionReaction | Role::VelocityReaction => {}
            }
        }
        if missing.is_empty() {
            Ok(Self::new(lower, upper))
        } else {
            Err(Error::setting(
                "search for equilibria",
                format!("nothing says how far {} may move: give bounds", missing.join(", ")),
            ))
        }
    }

    /// Starts in the box from `lower` to `upper`: one value for each unknown, SI.
    pub fn new(lower: impl Into<Vector>, upper: impl Into<Vector>) -> Self {
        Self { lower: lower.into(), upper: upper.into(), starts: 32, seed: 0, held: Vec::new() }
    }
}

/// Maximum number of starts beyond those requested.
const MOST_STARTS: f64 = 2000.0;

/// Limit on the additions and multiplications of one iteration for each further start: some three seconds in all.
const BUDGET: f64 = 2.7e8;

/// Number of further starts that are worth their time: a chain of 32 bars has some 2^32 equilibria.
fn affordable(description: &Description) -> usize {
    let n = description.coordinates.len() as f64;
    let kernel = description.kernel("residual_and_stiffness");
    let kernel = kernel.map_or(0, |kernel| kernel.operations) as f64;
    // The elimination and the eigenvalues that say whether the equilibrium is stable.
    (BUDGET / (kernel + 30.0 * n.powi(3))).min(MOST_STARTS) as usize
}

/// Finds distinct equilibria from random starts in a box and from `start`, in the order of discovery.
///
/// After [`Search::starts`] the search continues until less than half a further equilibrium is expected. After meeting
/// `w` equilibria `n` times in all, one expects `w (w + 1) / (n - w - 2)` others, unless some are much harder to meet
/// (Boender and Rinnooy Kan 1987). The search ends after 2000 further starts at the latest, and of many coordinates after
/// fewer; [`Equilibria::more_expected`] says so. With [`Search::starts`] set to zero there are no random starts.
/// A step of `watch` is a start; a search that is stopped returns what it has found.
///
/// States that differ by full turns of an angle count as one if a full turn leaves forces and stiffnesses unchanged,
/// but not if a spring or a screw counts the turns. An empty list means that no start led to an equilibrium;
/// completeness is not guaranteed.
///
/// # Errors
/// [`Error::WrongLength`], [`Error::NotFinite`], [`Error::Unphysical`].
pub fn find_equilibria(
    mechanism: &dyn Kernels,
    u: &[f64],
    b: &[f64],
    start: &[f64],
    search: &Search,
    watch: Watch<'_>,
) -> Result<Equilibria, Error> {
    let point = OperatingPoint::new(mechanism, u, b)?.held_by(&search.held);
    point.check_start(start)?;
    point.check_start(&search.lower)?;
    point.check_start(&search.upper)?;
    let mut random = RandomNumbers::new(search.seed, 0);
    let mut distinct: Vec<Equilibrium> = Vec::new();
    let mut from = Vector::from(start);
    let (mut isolated, mut met, mut starts) = (0, 0, 0);
    let most = search.starts + affordable(&point.description);
    let more = |isolated, met| search.starts > 0 && more_expected(isolated, met);
    while (starts <= search.starts || starts <= most && more(isolated, met)) && !watch.stopped() {
        for policy in [Policy::Stable, Policy::Nearest] {
            let Ok(SolvedState { state, .. }) = solve(&point, &from, policy) else {
                continue;
            };
            met += 1;
            let known = |known| same(&point, known, &state);
            if !distinct.iter().any(known) {
                isolated += usize::from(!matches!(state.stability, Stability::Neutral { .. }));
                distinct.push(state);
            }
        }
        from =
            Vector::from_fn(start.len(), |i| search.lower[i] + random.fraction() * (search.upper[i] - search.lower[i]));
        starts += 1;
        watch.advance(1);
    }
    Ok(Equilibria {
        states: distinct,
        starts,
        more_expected: more(isolated, met),
        inputs: u.into(),
        description: point.description.clone(),
    })
}

/// Starts beside one from which the search comes to rest at no equilibrium.
const BESIDE: usize = 8;

/// The equilibrium found from the first of some starts around `start` that leads to one; each is farther away.
#[cold]
pub(super) fn from_beside(point: &OperatingPoint<'_>, start: &[f64], policy: Policy) -> Option<SolvedState> {
    let mut random = RandomNumbers::new(0, 0);
    let (motions, share) = (point.motions(), 1.0 / BESIDE as f64);
    (1..=BESIDE).find_map(|k| {
        let beside = Vector::from_fn(start.len(), |i| {
            let reach = share * k as f64 * point.description.large(i);
            let moved = start[i] + reach * (2.0 * random.fraction() - 1.0);
            if i < motions { moved } else { start[i] }
        });
        solve(point, &beside, policy).ok()
    })
}

/// Whether half an equilibrium or more is still expected, after `found` distinct ones were met `met` times.
fn more_expected(found: usize, met: usize) -> bool {
    2 * found * (found + 1) >= met.saturating_sub(found + 2)
}

/// Whether two equilibria are the same place.
fn same(point: &OperatingPoint<'_>, known: &Equilibrium, state: &Equilibrium) -> bool {
    let description = &point.description;
    let (q, other) = (&known.coordinates, &state.coordinates);
    let turned = turned_towards(q, other, description);
    let singular = known.constraints.singular && state.constraints.singular;
    coincide(&turned, other, singular, description) && (turned == *q || turns_do_not_count(point, q, &turned))
}
