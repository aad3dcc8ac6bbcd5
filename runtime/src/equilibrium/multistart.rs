//! Several equilibria of one mechanism, from a reproducible set of start values.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

use super::{Policy, Problem, settle};
use crate::{Description, Equilibrium, Error, Mechanism};

/// Where to start from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Search<const N: usize> {
    /// Least start value of each coordinate, rad or m.
    pub lower: [f64; N],
    /// Greatest start value of each coordinate, rad or m.
    pub upper: [f64; N],
    /// Number of random starts; each is followed to a stable and to the nearest equilibrium.
    pub starts: usize,
    /// The same seed gives the same starts.
    pub seed: u64,
}

/// Finds distinct equilibria from random starts in a box and from `start`, in the order of discovery.
///
/// States that differ by full turns of an angle and have equal stiffness count as one. An empty list means that no
/// start led to an equilibrium; completeness is not promised.
///
/// # Errors
/// [`Error::NotFinite`], [`Error::Unphysical`].
pub fn find_equilibria<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    mechanism: &M,
    u: &[f64; U],
    b: &[f64; P],
    start: &[f64; N],
    search: &Search<N>,
) -> Result<Vec<Equilibrium<N, U, P>>, Error>
where
    M: Mechanism<N, U, P, O>,
{
    let problem = Problem::new(mechanism, u, b)?;
    problem.check_start(start)?;
    problem.check_start(&search.lower)?;
    problem.check_start(&search.upper)?;
    let mut random = ChaCha8Rng::seed_from_u64(search.seed);
    let mut found: Vec<Equilibrium<N, U, P>> = Vec::new();
    let mut from = *start;
    for _ in 0..=search.starts {
        for policy in [Policy::Stable, Policy::Nearest] {
            if let Ok(state) = settle(&problem, &from, policy)
                && !found
                    .iter()
                    .any(|known| same(known, &state, problem.description()))
            {
                found.push(state);
            }
        }
        from = core::array::from_fn(|i| {
            let fraction = (random.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
            search.lower[i] + fraction * (search.upper[i] - search.lower[i])
        });
    }
    Ok(found)
}

const CLOSE: f64 = 1e-6;

fn same<const N: usize, const U: usize, const P: usize>(
    a: &Equilibrium<N, U, P>,
    b: &Equilibrium<N, U, P>,
    description: &Description,
) -> bool {
    let Some(turned) = turned(&a.coordinates, &b.coordinates, description) else {
        return false;
    };
    let (k_a, k_b) = (&a.linear.stiffness, &b.linear.stiffness);
    let scale = CLOSE * crate::array::largest_element(k_a);
    !turned
        || k_a
            .iter()
            .flatten()
            .zip(k_b.iter().flatten())
            .all(|(x, y)| (x - y).abs() <= scale)
}

/// Whether full turns of angles lie between two states; `None` when something else does.
pub(super) fn turned<const N: usize>(
    a: &[f64; N],
    b: &[f64; N],
    description: &Description,
) -> Option<bool> {
    let mut turned = false;
    for i in 0..N {
        let difference = (a[i] - b[i]).abs();
        let scale = CLOSE * (1.0 + a[i].abs());
        if difference <= scale {
            continue;
        }
        let angle = description
            .coordinates
            .get(i)
            .is_some_and(|info| info.unit.symbol == "rad");
        let turns = difference / core::f64::consts::TAU;
        if !angle || (turns - turns.round()).abs() > scale {
            return None;
        }
        turned = true;
    }
    Some(turned)
}
