//! Several equilibria of one mechanism, from a reproducible set of start values.

use eigentol_statistics::random::RandomNumbers;

use super::turns::{coincide, turned_towards, turns_do_not_count};
use super::{Judged, OperatingPoint, Policy, solve};
use crate::algebra::Vector;
use crate::kernels::Kernels;
use crate::setters::setters;
use crate::{Equilibrium, Error, Stability};

/// Where to start from.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Search {
    /// Least start value of each coordinate, rad or m; then of speeds and reactions, of which the latter are ignored.
    pub lower: Vector,
    /// Greatest start value of each coordinate, rad or m.
    pub upper: Vector,
    /// Least number of random starts; each is followed to a stable and to the nearest equilibrium. More follow until, by what
    /// was found, no other is to be expected. 32 unless set.
    pub starts: usize,
    /// The same seed gives the same starts. 0 unless set.
    pub seed: u64,
}

impl Search {
    setters!(starts: usize, seed: u64);

    /// Starts in the box from `lower` to `upper`: one value for each unknown, SI.
    pub fn new(lower: impl Into<Vector>, upper: impl Into<Vector>) -> Self {
        Self {
            lower: lower.into(),
            upper: upper.into(),
            starts: 32,
            seed: 0,
        }
    }
}

/// Most starts beyond those asked for.
const MOST_STARTS: usize = 2000;

/// Finds distinct equilibria from random starts in a box and from `start`, in the order of discovery.
///
/// After [`Search::starts`] the search goes on until less than half a further equilibrium is to be expected. Having met `w`
/// equilibria `n` times in all, one expects `w (w + 1) / (n - w - 2)` others, unless some are much harder to meet (Boender and
/// Rinnooy Kan 1987). It ends after 2000 further starts at the latest; zero starts stay zero.
///
/// States that differ by full turns of an angle count as one where a full turn leaves forces and stiffnesses the same, not where
/// a spring or a screw counts the turns. An empty list means that no
/// start led to an equilibrium; completeness is not promised.
///
/// # Errors
/// [`Error::WrongLength`], [`Error::NotFinite`], [`Error::Unphysical`].
pub fn find_equilibria(
    mechanism: &dyn Kernels,
    u: &[f64],
    b: &[f64],
    start: &[f64],
    search: &Search,
) -> Result<Vec<Equilibrium>, Error> {
    let point = OperatingPoint::new(mechanism, u, b)?;
    point.check_start(start)?;
    point.check_start(&search.lower)?;
    point.check_start(&search.upper)?;
    let mut random = RandomNumbers::new(search.seed, 0);
    let mut found: Vec<Equilibrium> = Vec::new();
    let mut from = Vector::from(start);
    let (mut isolated, mut met) = (0, 0);
    for done in 0.. {
        let further = search.starts > 0 && done <= search.starts + MOST_STARTS;
        if done > search.starts && !(further && more_expected(isolated, met)) {
            break;
        }
        for policy in [Policy::Stable, Policy::Nearest] {
            let Ok(Judged { state, .. }) = solve(&point, &from, policy) else {
                continue;
            };
            met += 1;
            let known = |known| same(&point, known, &state);
            if !found.iter().any(known) {
                isolated += usize::from(!matches!(state.stability, Stability::Neutral { .. }));
                found.push(state);
            }
        }
        from = Vector::from_fn(start.len(), |i| {
            search.lower[i] + random.fraction() * (search.upper[i] - search.lower[i])
        });
    }
    Ok(found)
}

/// Whether half an equilibrium or more is to be expected beside these, which were met so often.
fn more_expected(found: usize, met: usize) -> bool {
    2 * found * (found + 1) >= met.saturating_sub(found + 2)
}

/// Whether two equilibria are one place.
fn same(point: &OperatingPoint<'_>, known: &Equilibrium, state: &Equilibrium) -> bool {
    let description = &point.description;
    let (q, other) = (&known.coordinates, &state.coordinates);
    let turned = turned_towards(q, other, description);
    let singular = known.constraints.singular && state.constraints.singular;
    coincide(&turned, other, singular, description)
        && (turned == *q || turns_do_not_count(point, q, &turned))
}
