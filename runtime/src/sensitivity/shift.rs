//! How the equilibrium itself moves: `Khat dq* = -dg` for every input and design variable with one factorisation.

use super::pencil::Direction;
use super::redundancy;
use crate::array::{Lu, transpose};
use crate::{Description, Equilibrium, Error, Mechanism};

/// Derivatives of the equilibrium coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EquilibriumShift<const N: usize, const U: usize, const P: usize> {
    /// `by_input[i][j] = dq*_i/du_j`, SI.
    pub by_input: [[f64; U]; N],
    /// `by_design[i][j] = dq*_i/db_j`, SI.
    pub by_design: [[f64; P]; N],
    /// The mechanism it belongs to.
    pub description: &'static Description,
}

/// The shift of an equilibrium by every input and design variable.
///
/// # Errors
/// [`Error::CriticalState`] when `Khat` is singular, [`Error::ClosesHereOnly`] where redundant constraints contradict each
/// other as soon as a variable changes, [`Error::OutsideDomain`] when a derivative is not finite.
pub fn equilibrium_shift<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    mechanism: &M,
    at: &Equilibrium<N, U, P>,
) -> Result<EquilibriumShift<N, U, P>, Error>
where
    M: Mechanism<N, U, P, O>,
{
    redundancy::check(mechanism, at)?;
    let factors = Lu::new(&at.linear.stiffness).ok_or(Error::CriticalState)?;
    let (by_input, by_design) =
        mechanism.residual_partials(&at.coordinates, &at.inputs, &at.design);
    let shift = EquilibriumShift {
        by_input: solve_columns(&factors, &by_input),
        by_design: solve_columns(&factors, &by_design),
        description: at.description,
    };
    let finite = shift
        .by_input
        .iter()
        .flatten()
        .chain(shift.by_design.iter().flatten());
    if finite.copied().all(f64::is_finite) {
        Ok(shift)
    } else {
        Err(outside_domain(at))
    }
}

/// The directions in which a state moves with each input and each design variable, the equilibrium included.
pub(super) fn directions<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    mechanism: &M,
    at: &Equilibrium<N, U, P>,
) -> Result<impl Iterator<Item = Direction<N, U, P>> + use<M, N, U, P, O>, Error>
where
    M: Mechanism<N, U, P, O>,
{
    let shift = equilibrium_shift(mechanism, at)?;
    let (by_input, by_design) = (transpose(&shift.by_input), transpose(&shift.by_design));
    let inputs = (0..U).map(move |k| Direction {
        coordinates: by_input[k],
        inputs: unit(k),
        design: [0.0; P],
    });
    let design = (0..P).map(move |k| Direction {
        coordinates: by_design[k],
        inputs: [0.0; U],
        design: unit(k),
    });
    Ok(inputs.chain(design))
}

fn unit<const K: usize>(k: usize) -> [f64; K] {
    core::array::from_fn(|i| if i == k { 1.0 } else { 0.0 })
}

fn solve_columns<const N: usize, const C: usize>(
    factors: &Lu<f64, N>,
    partials: &[[f64; C]; N],
) -> [[f64; C]; N] {
    let columns = transpose(partials);
    transpose(&columns.map(|column| factors.solve(&column).map(|value| -value)))
}

pub(super) fn outside_domain<const N: usize, const U: usize, const P: usize>(
    at: &Equilibrium<N, U, P>,
) -> Error {
    Error::OutsideDomain {
        mechanism: at.description.name,
        what: "a derivative",
        coordinates: at.coordinates.to_vec(),
    }
}
