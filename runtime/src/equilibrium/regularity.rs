//! Whether an equilibrium is one where constraints are about to lose their independence.
//!
//! Let `s` be the distance from a singular configuration of the constraints, and `F` the applied force in the direction that
//! they no longer hold there. Beside it their reactions grow as `F / s`. A gap `d` turns the directions they leave free by
//! `d / s^2`, so that an imbalance `F d / s^2` goes unseen; a stiffness `K` makes a displacement of it, which at
//! `s^3 = F d / K` reaches the singular configuration. For gaps of rounding this is about a micrometre in a metre: there states
//! stand at random, balanced to all digits, by reactions of a million times the weight, that are no equilibria. The test is
//! therefore not a residual, but how far rounding moves a state towards the singular configuration.

use super::convergence::FLOOR;
use super::problem::{Failure, Problem};
use crate::array::{Lu, dot, greater, largest, transpose};
use crate::constraints::{ConstraintState, NEARLY, Tangent, placed};
use crate::{Linear, Mechanism};

/// Share of the distance from a singular configuration by which rounding may move an equilibrium: beyond it, reactions and
/// stiffness have less than three digits.
const KNOWN: f64 = 1e-3;
/// Forces beside a singular configuration are those in it, but for what stiffness makes of the distance, times this.
const BESIDE: f64 = 10.0;
/// Share in the weakest combination of constraints that counts as taking part.
const TAKES_PART: f64 = 1e-3;

/// What the constraints are at a state that is at rest to rounding. A state that rounding takes to a singular configuration
/// counts as being there, and is an equilibrium if forces balance there by finite reactions.
///
/// # Errors
/// [`Failure::Unbalanced`] where they do not.
pub(super) fn constraint_state<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    problem: &Problem<'_, M, N, U, P, O>,
    q: &[f64; N],
    residual: &[f64; N],
    linear: &Linear<f64, N>,
) -> Result<ConstraintState<N>, Failure<N>>
where
    M: Mechanism<N, U, P, O>,
{
    let structure = Problem::<M, N, U, P, O>::STRUCTURE;
    if structure.open() {
        return Ok(ConstraintState::open());
    }
    let tangent = Tangent::new(linear, structure);
    let place = (q, problem.inputs, problem.design);
    let mut found = ConstraintState::new(problem.mechanism, place, &tangent);
    if found.singular || tangent.all.least > NEARLY {
        return Ok(found);
    }
    let weakest = Weakest::new(problem, q, &tangent);
    if weakest.moved(linear, &noise(problem, q, residual, linear)) <= KNOWN {
        return Ok(found);
    }
    found.singular = true;
    for (k, place) in structure.constraint_rows().enumerate() {
        let share = (weakest.combination[place] * tangent.all.size[k]).abs() * tangent.all.least;
        found.dependent[place] |= share > TAKES_PART;
    }
    let force = weakest.force(problem, q);
    if force == 0.0 {
        return Ok(found);
    }
    let downhill = -force.signum() / largest(&weakest.direction);
    Err(Failure::Unbalanced {
        coordinates: *q,
        downhill: weakest.direction.map(|value| downhill * value),
        dependent: found.dependent,
    })
}

/// Why a search that ended at `q` found nothing, if that is a singular configuration beside it in which forces do not balance.
#[cold]
pub(super) fn unbalanced<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    problem: &Problem<'_, M, N, U, P, O>,
    q: &[f64; N],
) -> Option<Failure<N>>
where
    M: Mechanism<N, U, P, O>,
{
    let linear = problem.linear(q).ok()?;
    let residual = problem.residual(q);
    let state = match constraint_state(problem, q, &residual, &linear) {
        Err(failure) => return Some(failure),
        Ok(state) => state,
    };
    if !state.singular {
        return None;
    }
    // In the singular configuration itself all its directions are free.
    let tangent = Tangent::new(&linear, Problem::<M, N, U, P, O>::STRUCTURE);
    let uphill = tangent.lift(&tangent.project(&residual));
    let steepest = largest(&uphill);
    (steepest > 0.0).then(|| Failure::Unbalanced {
        coordinates: *q,
        downhill: uphill.map(|value| -value / steepest),
        dependent: state.dependent,
    })
}

/// The direction of motion that constraints hold least.
struct Weakest<const N: usize> {
    direction: [f64; N],
    /// Multipliers of constraints that together hold it: the force of one in it, and no force across.
    combination: [f64; N],
    /// Derivative by every unknown of what they hold it by, relative to that: the inverse of the distance from where they do not.
    approach: [f64; N],
}

impl<const N: usize> Weakest<N> {
    fn new<M, const U: usize, const P: usize, const O: usize>(
        problem: &Problem<'_, M, N, U, P, O>,
        q: &[f64; N],
        tangent: &Tangent<N>,
    ) -> Self
    where
        M: Mechanism<N, U, P, O>,
    {
        let (direction, combination) = tangent.all.weakest();
        let combination = placed(tangent.structure, &combination);
        let curvature = problem.mechanism.linear_along(
            q,
            problem.inputs,
            problem.design,
            &combination,
            &[0.0; U],
            &[0.0; P],
        );
        let columns = transpose(&curvature.stiffness);
        Self {
            direction,
            combination,
            approach: columns.map(|column| dot(&column, &direction)),
        }
    }

    /// The greatest share of the distance by which residuals of this size move a state; infinite where its stiffness is singular.
    fn moved(&self, linear: &Linear<f64, N>, residual: &[f64; N]) -> f64 {
        Lu::new(&transpose(&linear.stiffness)).map_or(f64::INFINITY, |lu| {
            let by_residual = lu.solve(&self.approach);
            (0..N).fold(0.0, |sum, i| sum + by_residual[i].abs() * residual[i])
        })
    }

    /// The force in the direction that is left to reactions; zero where it may be the stiffness over the distance from the singular
    /// configuration that makes it.
    fn force<M, const U: usize, const P: usize, const O: usize>(
        &self,
        problem: &Problem<'_, M, N, U, P, O>,
        q: &[f64; N],
    ) -> f64
    where
        M: Mechanism<N, U, P, O>,
    {
        let motions = Problem::<M, N, U, P, O>::MOTIONS;
        let released = core::array::from_fn(|j| if j < motions { q[j] } else { 0.0 });
        let Some((residual, stiffness)) = problem.evaluate_plain(&released) else {
            return f64::INFINITY;
        };
        let force = dot(&self.direction, &residual);
        let steepest = dot(&self.approach, &self.approach);
        let change = (0..motions).fold(0.0, |sum, i| {
            let row = (0..motions).fold(0.0, |sum, j| {
                sum + (stiffness[i][j] * self.approach[j]).abs()
            });
            sum + self.direction[i].abs() * row
        });
        if force.abs() * steepest <= BESIDE * change {
            0.0
        } else {
            force
        }
    }
}

/// What a residual cannot tell from zero: what is left of it, or the rounding of what it is summed from.
fn noise<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    problem: &Problem<'_, M, N, U, P, O>,
    q: &[f64; N],
    residual: &[f64; N],
    linear: &Linear<f64, N>,
) -> [f64; N]
where
    M: Mechanism<N, U, P, O>,
{
    let parts = problem.parts(q);
    let unknowns = problem.description().coordinates;
    core::array::from_fn(|i| {
        let terms = (0..N).fold(parts.inertia[i].abs() + parts.applied[i].abs(), |sum, j| {
            let angle = unknowns
                .get(j)
                .is_some_and(|info| info.unit.symbol == "rad");
            // A length that turns is rounded as a whole.
            let size = if angle {
                greater(1.0, q[j].abs())
            } else {
                q[j].abs()
            };
            sum + linear.stiffness[i][j].abs() * size
        });
        greater(residual[i].abs(), FLOOR * terms)
    })
}
