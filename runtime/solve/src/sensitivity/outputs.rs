//! Total derivatives of the declared outputs.

use super::free_directions;
use super::shift::equilibrium_shift;
use crate::algebra::{Matrix, Vector, add_to, all_finite};
use crate::kernels::Kernels;
use crate::{Description, Equilibrium, Error, Shared};

/// Outputs at an equilibrium and their total derivatives, SI.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct OutputSensitivities {
    /// Values.
    pub values: Vector,
    /// `by_input[o][j]`: derivative of output `o` with respect to input `j`; `None` if the output has a value but no
    /// derivative, like the distance from an axis on that axis, or a place that nothing determines.
    pub by_input: Vec<Option<Vector>>,
    /// `by_design[o][j]`: derivative of output `o` with respect to design variable `j`; `None` as in `by_input`.
    pub by_design: Vec<Option<Vector>>,
    /// The inputs they belong to, SI.
    pub inputs: Vector,
    /// The mechanism they belong to.
    pub description: Shared<Description>,
}

/// Values and total derivatives of the outputs, including the shift of the equilibrium.
///
/// # Errors
/// [`Error::CriticalState`] if `Khat` is singular, [`Error::InfiniteOutput`] if a value is not finite.
pub fn output_sensitivities(mechanism: &dyn Kernels, at: &Equilibrium) -> Result<OutputSensitivities, Error> {
    let shift = equilibrium_shift(mechanism, at)?;
    let values = mechanism.outputs(&at.coordinates, &at.inputs, &at.design);
    let [by_coordinate, mut by_input, mut by_design] =
        mechanism.output_partials(&at.coordinates, &at.inputs, &at.design);
    for (o, rates) in by_coordinate.iter().enumerate() {
        for (i, rate) in rates.iter().enumerate() {
            add_to(&mut by_input[o], *rate, &shift.by_input[i]);
            add_to(&mut by_design[o], *rate, &shift.by_design[i]);
        }
    }
    if let Some(infinite) = values.iter().position(|value| !value.is_finite()) {
        return Err(Error::InfiniteOutput {
            output: at.description.outputs[infinite].name.clone(),
            coordinates: at.coordinates.to_vec(),
        });
    }
    let rows = |slopes: &Matrix| {
        slopes
            .iter()
            .zip(by_coordinate.iter())
            .map(|(row, rates)| {
                let exists = all_finite(row) && !free_directions::depends(at, rates);
                exists.then(|| row.into())
            })
            .collect()
    };
    Ok(OutputSensitivities {
        values,
        by_input: rows(&by_input),
        by_design: rows(&by_design),
        inputs: at.inputs.clone(),
        description: at.description.clone(),
    })
}
