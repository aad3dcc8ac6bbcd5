//! The shift of the equilibrium: `Khat dq* = -dg` for every input and design variable, with one factorisation.

use super::pencil::Direction;
use super::{check_state, free_directions, redundancy};
use crate::algebra::{Lu, Matrix, Vector, all_finite_matrix};
use crate::kernels::Kernels;
use crate::scalar::Real as _;
use crate::{Description, Equilibrium, Error, Shared};

/// Derivatives of the equilibrium coordinates.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct EquilibriumShift {
    /// `by_input[i][j] = dq*_i/du_j`, SI.
    pub by_input: Matrix,
    /// `by_design[i][j] = dq*_i/db_j`, SI.
    pub by_design: Matrix,
    /// The inputs it belongs to, SI.
    pub inputs: Vector,
    /// The mechanism it belongs to.
    pub description: Shared<Description>,
}

/// The shift of an equilibrium with every input and design variable.
///
/// # Errors
/// [`Error::CriticalState`] if `Khat` is singular, [`Error::ClosesHereOnly`] if redundant constraints contradict each
/// other as soon as a variable changes, [`Error::OutsideDomain`] if a derivative is not finite.
pub fn equilibrium_shift(mechanism: &dyn Kernels, at: &Equilibrium) -> Result<EquilibriumShift, Error> {
    check_state(mechanism, at)?;
    redundancy::check(mechanism, at)?;
    free_directions::check(mechanism, at)?;
    let factors = Lu::new(&at.held_stiffness()).ok_or(Error::CriticalState)?;
    let mut partials = mechanism.residual_partials(&at.coordinates, &at.inputs, &at.design);
    at.free.add_to_partials(&mut partials);
    let (by_input, by_design) = partials;
    let shift = EquilibriumShift {
        by_input: solve_columns(&factors, by_input),
        by_design: solve_columns(&factors, by_design),
        inputs: at.inputs.clone(),
        description: at.description.clone(),
    };
    if all_finite_matrix(&shift.by_input) && all_finite_matrix(&shift.by_design) {
        Ok(shift)
    } else {
        Err(outside_domain(at))
    }
}

/// The directions in which a state moves with each input and each design variable, including the shift of the
/// equilibrium.
pub fn directions(mechanism: &dyn Kernels, at: &Equilibrium) -> Result<impl Iterator<Item = Direction> + use<>, Error> {
    let EquilibriumShift { by_input, by_design, .. } = equilibrium_shift(mechanism, at)?;
    let (u, p) = (by_input.column_count(), by_design.column_count());
    let inputs = (0..u).map(move |k| Direction {
        coordinates: by_input.column(k),
        inputs: unit(u, k),
        design: Vector::zeros(p),
    });
    let design = (0..p).map(move |k| Direction {
        coordinates: by_design.column(k),
        inputs: Vector::zeros(u),
        design: unit(p, k),
    });
    Ok(inputs.chain(design))
}

fn unit(size: usize, k: usize) -> Vector {
    Vector::from_fn(size, |i| if i == k { 1.0 } else { 0.0 })
}

/// `-Khat^-1 partials`.
fn solve_columns(factors: &Lu<f64>, mut partials: Matrix) -> Matrix {
    partials = f64::run(
        #[inline(always)]
        || factors.solve_columns(&partials),
    );
    partials.as_flattened_mut().iter_mut().for_each(|value| *value = -*value);
    partials
}

/// Says that a derivative does not exist here.
pub fn outside_domain(at: &Equilibrium) -> Error {
    Error::OutsideDomain {
        mechanism: at.description.name.clone(),
        what: "a derivative",
        coordinates: at.coordinates.to_vec(),
    }
}
