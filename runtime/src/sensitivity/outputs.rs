//! Total derivatives of the declared outputs.

use super::shift::{equilibrium_shift, outside_domain};
use crate::array::all_finite;
use crate::{Description, Equilibrium, Error, Mechanism};

/// Outputs at an equilibrium and their total derivatives, SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OutputSensitivities<const U: usize, const P: usize, const O: usize> {
    /// Values.
    pub values: [f64; O],
    /// `by_input[o][j]`: derivative of output `o` by input `j`; `None` where the output has a value but no derivative, as
    /// the distance from an axis has none on it.
    pub by_input: [Option<[f64; U]>; O],
    /// `by_design[o][j]`: derivative of output `o` by design variable `j`; `None` likewise.
    pub by_design: [Option<[f64; P]>; O],
    /// The mechanism they belong to.
    pub description: &'static Description,
}

/// Values and total derivatives of the outputs, the shift of the equilibrium included.
///
/// # Errors
/// [`Error::CriticalState`] when `Khat` is singular, [`Error::OutsideDomain`] when a value is not finite.
pub fn output_sensitivities<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    mechanism: &M,
    at: &Equilibrium<N, U, P>,
) -> Result<OutputSensitivities<U, P, O>, Error>
where
    M: Mechanism<N, U, P, O>,
{
    let shift = equilibrium_shift(mechanism, at)?;
    let values = mechanism.outputs(&at.coordinates, &at.inputs, &at.design);
    let (by_coordinate, mut by_input, mut by_design) =
        mechanism.output_partials(&at.coordinates, &at.inputs, &at.design);
    for o in 0..O {
        for (i, rate) in by_coordinate[o].iter().enumerate() {
            for (total, moved) in by_input[o].iter_mut().zip(&shift.by_input[i]) {
                *total += rate * moved;
            }
            for (total, moved) in by_design[o].iter_mut().zip(&shift.by_design[i]) {
                *total += rate * moved;
            }
        }
    }
    if !all_finite(&values) {
        return Err(outside_domain(at));
    }
    Ok(OutputSensitivities {
        values,
        by_input: by_input.map(|slopes| all_finite(&slopes).then_some(slopes)),
        by_design: by_design.map(|slopes| all_finite(&slopes).then_some(slopes)),
        description: at.description,
    })
}
