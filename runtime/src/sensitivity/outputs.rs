//! Total derivatives of the declared outputs.

use super::shift::{equilibrium_shift, outside_domain};
use crate::{Description, Equilibrium, Error, Mechanism};

/// Outputs at an equilibrium and their total derivatives, SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OutputSensitivities<const U: usize, const P: usize, const O: usize> {
    /// Values.
    pub values: [f64; O],
    /// `by_input[o][j]`: derivative of output `o` by input `j`.
    pub by_input: [[f64; U]; O],
    /// `by_design[o][j]`: derivative of output `o` by design variable `j`.
    pub by_design: [[f64; P]; O],
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
    let rates = by_input.iter().flatten().chain(by_design.iter().flatten());
    if values.iter().chain(rates).all(|value| value.is_finite()) {
        Ok(OutputSensitivities {
            values,
            by_input,
            by_design,
            description: at.description,
        })
    } else {
        Err(outside_domain(at))
    }
}
