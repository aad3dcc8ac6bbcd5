//! Assembly: finds positions that close the loops of a mechanism, from values that need not.

use super::constraint_projection::{close, close_speeds, free, gaps};
use super::operating_point::{Failure, OperatingPoint};
use crate::algebra::{Lu, Matrix, Vector, add_scaled};
use crate::constraints::{ConstraintState, Rows, Structure, Tangent, all_rows};
use crate::kernels::Kernels;
use crate::state::dependent_names;
use crate::{Coordinate, Description, Error, Shared, Text};

/// The assembly mode: on which side of the dead centres a mechanism is assembled.
///
/// It is the sign of the determinant of `Phi_q` over the coordinates that are not held, with constraints and
/// coordinates in the order of their declaration (of dependent constraints, the first ones). Any motion from one side
/// to the other, with the held coordinates free to move, passes through a dead centre, so states on different sides are
/// in different assembly modes. States on the same side may be in different modes, too.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum AssemblyMode {
    /// The determinant is positive.
    Positive,
    /// The determinant is negative.
    Negative,
}

/// An assembled mechanism.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Assembly {
    /// The assembled state, SI: coordinates that meet the constraints, rad or m; speeds that meet the constraints on
    /// velocities, and reactions that balance the forces, as far as possible.
    pub coordinates: Vector,
    /// Which coordinates were held.
    pub held: Vec<bool>,
    /// How far each coordinate and speed moved from its start value; zero for reactions.
    pub moved: Vector,
    /// The remaining gap of each constraint, at the position of its reaction and in its direction, m or rad (on
    /// velocities m/s or rad/s): rounding only.
    pub gaps: Vector,
    /// Iterations spent.
    pub iterations: usize,
    /// The degrees of freedom that the constraints leave, and which constraints are redundant.
    pub constraints: ConstraintState,
    /// The assembly mode; known if as many coordinates are held as there are degrees of freedom and the state is not a
    /// dead centre.
    pub mode: Option<AssemblyMode>,
    /// How well the constraints determine the coordinates that are not held: one at best, zero at a dead centre.
    #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
    pub margin: f64,
    /// The state is a dead centre or a singular configuration: to first order, coordinates that are not held can move
    /// on their own or cannot follow those that are.
    pub singular: bool,
    /// The inputs it belongs to, SI.
    pub inputs: Vector,
    /// The mechanism it belongs to.
    pub description: Shared<Description>,
}

impl Assembly {
    /// Names of the constraints that depend on each other; [`ConstraintState::redundant`] of them can be removed.
    pub fn dependent_constraints(&self) -> impl Iterator<Item = Text> {
        dependent_names(&self.description, &self.constraints.dependent)
    }

    /// The moves of coordinates and speeds and the gaps of constraints, in one vector.
    pub(crate) fn changes(&self) -> Vector {
        add_scaled(&self.moved, 1.0, &self.gaps)
    }
}

/// Margin below which a state counts as a dead centre: the constraints meet there in a double root, so rounding leaves
/// only half of the digits.
const DEAD_CENTRE: f64 = 1e-6;

/// Assembles a mechanism: moves the coordinates that are not in `held` from `start` to the nearest position that meets
/// the constraints.
///
/// `u` are inputs, `b` design variables, `start` coordinates (then speeds; values for reactions are ignored), all SI.
/// The start values of the coordinates that are not held select the assembly mode. A mechanism without constraints
/// stays where it is.
///
/// # Errors
/// [`Error::NotAssembled`] with the gaps that remain, if too many coordinates are held, links are too short, or
/// constraints contradict each other. [`Error::WrongLength`], [`Error::NotFinite`], [`Error::Unphysical`],
/// [`Error::OutsideDomain`], [`Error::UnknownHandle`].
pub fn assemble(
    mechanism: &dyn Kernels,
    u: &[f64],
    b: &[f64],
    start: &[f64],
    held: &[Coordinate],
) -> Result<Assembly, Error> {
    let point = OperatingPoint::new(mechanism, u, b)?;
    point.check_start(start)?;
    let mut fixed = vec![false; point.size()];
    for coordinate in held {
        match fixed.get_mut(coordinate.index()) {
            Some(slot) => *slot = true,
            None => {
                return Err(Error::UnknownHandle {
                    kind: "coordinate",
                    index: coordinate.index(),
                    mechanism: point.description.name.clone(),
                    count: point.size(),
                });
            }
        }
    }
    assembled(&point, start, &fixed).map_err(|failure| failure.explain(&point.description))
}

fn assembled(point: &OperatingPoint<'_>, start: &[f64], held: &[bool]) -> Result<Assembly, Failure> {
    let structure = point.structure;
    let (x, iterations) = closed(point, start, held)?;
    let (residual, _) = point.evaluate_start(&x)?;
    let motions = point.motions();
    let at = gaps(point, &x).ok_or_else(|| Failure::OutsideDomain { what: "the residual", coordinates: x.to_vec() })?;
    let free_rows = Rows::balanced(free(&at.rows, held));
    let all = Rows::balanced(at.rows.clone());
    let linear = point.linear(&x)?;
    let arguments = (&x[..], point.inputs, point.design);
    let constraints = if structure.open() {
        ConstraintState::open(point.size())
    } else {
        ConstraintState::new(point.mechanism, arguments, &Tangent::new(&linear, structure))
    };
    let margin = if free_rows.rank < all.rank { 0.0 } else { free_rows.least };
    let dead = margin <= DEAD_CENTRE;
    let mode = if dead || constraints.singular { None } else { mode(&at.rows, all.rank, held, structure) };
    let mut moved = add_scaled(&x, -1.0, start);
    moved[motions..].fill(0.0);
    let mut gaps = residual;
    gaps[..motions].fill(0.0);
    Ok(Assembly {
        coordinates: x,
        held: held.to_vec(),
        moved,
        gaps,
        iterations,
        singular: dead || constraints.singular,
        constraints,
        mode,
        margin,
        inputs: point.inputs.into(),
        description: point.description.clone(),
    })
}

/// The state nearest to `start` that meets the constraints, with the reactions that balance it best, and the number of
/// iterations.
pub(super) fn closed(point: &OperatingPoint<'_>, start: &[f64], held: &[bool]) -> Result<(Vector, usize), Failure> {
    let structure = point.structure;
    let motions = point.motions();
    let mut start = Vector::from(start);
    start[motions..].fill(0.0);
    let (mut x, iterations) = close(point, &start, held)?;
    if structure.velocity_constraints > 0 {
        x = close_speeds(point, &x, held).unwrap_or(x);
    }
    let (residual, stiffness) = point.evaluate_start(&x)?;
    let mut force = residual.map(|value| -value);
    force[motions..].fill(0.0);
    let reactions = all_rows(&stiffness, structure).multipliers(&force);
    x[motions..].copy_from_slice(&reactions);
    Ok((x, iterations))
}

/// The sign of the determinant of the first independent rows over the coordinates that are not held; `None` if the
/// matrix is not square.
fn mode(rows: &Matrix, rank: usize, held: &[bool], structure: Structure) -> Option<AssemblyMode> {
    let columns: Vec<usize> = (0..structure.coordinates).filter(|&j| !held[j]).collect();
    if rank == 0 || columns.len() != rank {
        return None;
    }
    let mut chosen: Vec<usize> = Vec::new();
    for k in 0..structure.position_constraints {
        chosen.push(k);
        let first = Matrix::from_fn(chosen.len(), rows.column_count(), |i, j| rows[chosen[i]][j]);
        if Rows::balanced(first).dependent() > 0 {
            chosen.pop();
        }
        if chosen.len() == rank {
            break;
        }
    }
    if chosen.len() < rank {
        return None;
    }
    let block = Matrix::from_fn(rank, rank, |i, j| rows[chosen[i]][columns[j]]);
    Lu::new(&block).map(|lu| if lu.negative_determinant() { AssemblyMode::Negative } else { AssemblyMode::Positive })
}
