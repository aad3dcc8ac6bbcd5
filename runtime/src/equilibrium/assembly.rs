//! Assembly: positions in which the loops of a mechanism close, from values that need not.

use super::closing::{close, close_speeds, free, gaps};
use super::problem::{Failure, Problem};
use crate::array::{Lu, Square};
use crate::constraints::{ConstraintState, Rows, Structure, Tangent, all_rows, placed};
use crate::{Coordinate, Description, Error, Mechanism};

/// On which side of the dead centres a mechanism is assembled: the sign of the determinant of `Phi_q` by the coordinates
/// that are not held, constraints and coordinates in the order of their declaration (of constraints that depend on each other
/// the first). A motion from one side to the other, the held coordinates free to move, passes a dead centre: states on
/// different sides are different assembly modes. States on the same side may be, too.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AssemblyMode {
    /// The determinant is positive.
    Positive,
    /// The determinant is negative.
    Negative,
}

/// An assembled mechanism.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Assembly<const N: usize> {
    /// Coordinates that meet the constraints, rad or m; speeds that do as far as speeds can; reactions that balance the
    /// forces there as well as reactions can. SI.
    pub coordinates: [f64; N],
    /// Which coordinates were held.
    pub held: [bool; N],
    /// How far each coordinate and speed moved from its start value; zero in the places of reactions.
    pub moved: [f64; N],
    /// What each constraint stays open by, in the direction of its reaction and in its place, m or rad (on velocities m/s or
    /// rad/s): rounding.
    pub gaps: [f64; N],
    /// Iterations spent.
    pub iterations: usize,
    /// What the constraints leave free, and which say the same.
    pub constraints: ConstraintState<N>,
    /// The assembly mode, when as many coordinates are held as are free, and the state is no dead centre.
    pub mode: Option<AssemblyMode>,
    /// How independent the constraints are by the coordinates that are not held: one at best, zero at a dead centre.
    pub margin: f64,
    /// A dead centre, or a singular configuration: coordinates that are not held can move, or cannot follow, to first order.
    pub singular: bool,
    /// The mechanism it belongs to.
    pub description: &'static Description,
}

impl<const N: usize> Assembly<N> {
    /// Names of the constraints that depend on each other: [`ConstraintState::redundant`] of them can go.
    pub fn dependent_constraints(&self) -> impl Iterator<Item = &'static str> {
        super::dependent_names(self.description, self.constraints.dependent)
    }

    /// Of coordinates and speeds the motions, of constraints the gaps.
    pub(crate) fn changes(&self) -> [f64; N] {
        core::array::from_fn(|i| self.moved[i] + self.gaps[i])
    }
}

/// Margin below which a state is a dead centre to working accuracy: constraints meet there as a double root, which rounding
/// leaves at half of the digits.
const DEAD_CENTRE: f64 = 1e-6;

/// Assembles a mechanism: moves the coordinates that are not in `held` from `start` the shortest way to where the
/// constraints are met.
///
/// `u` inputs, `b` design variables, `start` coordinates (speeds after them; what stands in the places of reactions does not
/// matter), all SI. Start values of the coordinates that are not held choose the assembly mode. An open mechanism is assembled
/// as it is.
///
/// # Errors
/// [`Error::NotAssembled`] with the gaps that remain: too many coordinates held, lengths that do not reach, constraints that
/// contradict each other. [`Error::NotFinite`], [`Error::Unphysical`], [`Error::OutsideDomain`], [`Error::UnknownHandle`].
pub fn assemble<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    mechanism: &M,
    u: &[f64; U],
    b: &[f64; P],
    start: &[f64; N],
    held: &[Coordinate],
) -> Result<Assembly<N>, Error>
where
    M: Mechanism<N, U, P, O>,
{
    let problem = Problem::new(mechanism, u, b)?;
    problem.check_start(start)?;
    let mut fixed = [false; N];
    for coordinate in held {
        match fixed.get_mut(coordinate.0) {
            Some(place) => *place = true,
            None => {
                return Err(Error::UnknownHandle {
                    kind: "coordinate",
                    index: coordinate.0,
                    mechanism: M::DESCRIPTION.name,
                    count: N,
                });
            }
        }
    }
    assembled(&problem, start, &fixed).map_err(|failure| failure.explain(problem.description()))
}

fn assembled<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    problem: &Problem<'_, M, N, U, P, O>,
    start: &[f64; N],
    held: &[bool; N],
) -> Result<Assembly<N>, Failure<N>>
where
    M: Mechanism<N, U, P, O>,
{
    let structure = Problem::<M, N, U, P, O>::STRUCTURE;
    let (x, iterations) = closed(problem, start, held)?;
    let outside = Failure::OutsideDomain {
        what: "the residual",
        coordinates: x,
    };
    let (residual, _) = problem.evaluate(&x).ok_or(outside)?;
    let motions = Problem::<M, N, U, P, O>::MOTIONS;
    let at = gaps(problem, &x).ok_or(outside)?;
    let free_rows = Rows::balanced(structure.position_constraints, |k| free(&at.rows[k], held));
    let all = Rows::balanced(structure.position_constraints, |k| at.rows[k]);
    let linear = problem.linear(&x)?;
    let place = (&x, problem.inputs, problem.design);
    let constraints = if structure.open() {
        ConstraintState::open()
    } else {
        ConstraintState::new(problem.mechanism, place, &Tangent::new(&linear, structure))
    };
    let margin = if free_rows.rank < all.rank {
        0.0
    } else {
        free_rows.least
    };
    let dead = margin <= DEAD_CENTRE;
    let mode = if dead || constraints.singular {
        None
    } else {
        mode(&at.rows, all.rank, held, structure)
    };
    Ok(Assembly {
        coordinates: x,
        held: *held,
        moved: core::array::from_fn(|j| if j < motions { x[j] - start[j] } else { 0.0 }),
        gaps: core::array::from_fn(|i| if i < motions { 0.0 } else { residual[i] }),
        iterations,
        constraints,
        mode,
        margin,
        singular: dead || constraints.singular,
        description: problem.description(),
    })
}

/// The state nearest to `start` that meets the constraints, with the reactions that balance best, and the iterations it
/// took.
pub(super) fn closed<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    problem: &Problem<'_, M, N, U, P, O>,
    start: &[f64; N],
    held: &[bool; N],
) -> Result<([f64; N], usize), Failure<N>>
where
    M: Mechanism<N, U, P, O>,
{
    let structure = Problem::<M, N, U, P, O>::STRUCTURE;
    let motions = Problem::<M, N, U, P, O>::MOTIONS;
    let start = core::array::from_fn(|j| if j < motions { start[j] } else { 0.0 });
    let (mut x, iterations) = close(problem, &start, held)?;
    if structure.velocity_constraints > 0 {
        x = close_speeds(problem, &x, held).unwrap_or(x);
    }
    let (residual, stiffness) = problem.evaluate_start(&x)?;
    let force = core::array::from_fn(|j| if j < motions { -residual[j] } else { 0.0 });
    let reactions = placed(
        structure,
        &all_rows(&stiffness, structure).multipliers(&force),
    );
    for (place, reaction) in x.iter_mut().zip(reactions).skip(motions) {
        *place = reaction;
    }
    Ok((x, iterations))
}

/// The sign of the determinant of the first independent rows by the coordinates that are not held; `None` where their
/// numbers differ.
fn mode<const N: usize>(
    rows: &Square<N>,
    rank: usize,
    held: &[bool; N],
    structure: Structure,
) -> Option<AssemblyMode> {
    let columns = (0..structure.coordinates).filter(|&j| !held[j]);
    if rank == 0 || columns.clone().count() != rank {
        return None;
    }
    let mut chosen = [0; N];
    let mut count = 0;
    for k in 0..structure.position_constraints {
        chosen[count] = k;
        if Rows::balanced(count + 1, |i| rows[chosen[i]]).rank == count + 1 {
            count += 1;
        }
        if count == rank {
            break;
        }
    }
    let mut block = [[0.0; N]; N];
    for (i, row) in block.iter_mut().enumerate() {
        if i < rank {
            for (place, j) in row.iter_mut().zip(columns.clone()) {
                *place = rows[chosen[i]][j];
            }
        } else {
            row[i] = 1.0;
        }
    }
    Lu::new(&block).map(|lu| {
        if lu.negative_determinant() {
            AssemblyMode::Negative
        } else {
            AssemblyMode::Positive
        }
    })
}
