//! Exact second total derivatives of an output, by differentiating its adjoint gradient along the change of the
//! equilibrium with each variable.

use super::adjoint::Adjoint;
use super::derivatives::{SecondDerivatives, symmetric};
use crate::algebra::{Matrix, all_finite};
use crate::error::NoDerivative;
use crate::kernels::{CurvatureKernels, Gradient, Kernels};
use crate::sensitivity::{Slopes, directions};
use crate::{Description, Equilibrium, Error, Output, Shared};

/// First and second total derivatives of one output, SI.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct OutputCurvature {
    /// The output.
    pub output: Output,
    /// Its value.
    pub value: f64,
    /// First derivatives, from the same gradient.
    pub first: Slopes<f64>,
    /// Second derivatives.
    pub second: SecondDerivatives<f64>,
    /// Largest difference between mirrored second derivatives before averaging, relative to the largest derivative:
    /// zero in exact arithmetic.
    pub asymmetry: f64,
    /// The mechanism it belongs to.
    pub description: Shared<Description>,
}

/// First and second total derivatives of an output with respect to all inputs and design variables, including the
/// motion of the equilibrium.
///
/// # Errors
/// [`Error::UnknownHandle`], [`Error::CriticalState`] if `Khat` is singular, [`Error::NoSensitivity`] if a derivative
/// is not finite, such as that of the distance from an axis at a point on it.
pub fn output_curvature(
    mechanism: &dyn CurvatureKernels,
    at: &Equilibrium,
    output: Output,
) -> Result<OutputCurvature, Error> {
    let kernels: &dyn Kernels = mechanism;
    let (q, u, b) = (&at.coordinates, &at.inputs, &at.design);
    let o = output.index();
    let outputs = kernels.outputs(q, u, b);
    let Some(&value) = outputs.get(o) else {
        return Err(Error::UnknownHandle {
            kind: "output",
            index: o,
            mechanism: at.description.name.clone(),
            count: outputs.len(),
        });
    };
    let directions = directions(kernels, at)?;
    let adjoint = Adjoint::new(mechanism, at)?;
    let mut room = Gradient::zeros(kernels.sizes());
    let mut gradient = row(o, kernels.output_partials(q, u, b));
    let w = adjoint.total(&mut gradient, &mut room);
    let rows: Vec<_> = directions
        .map(|direction| {
            let partials = mechanism.output_partials_along(q, u, b, direction.parts());
            let mut change = row(o, partials);
            adjoint.total_along(&mut change, &w, &direction, &mut room);
            slopes(change)
        })
        .collect();
    let (second, asymmetry) = symmetric(&rows, u.len(), f64::abs);
    let first = slopes(gradient);
    let finite = all_finite(&first.by_input) && all_finite(&first.by_design);
    if !(value.is_finite() && finite && second.iter().all(|value| value.is_finite())) {
        return Err(Error::NoSensitivity { reason: NoDerivative::NotSmooth });
    }
    Ok(OutputCurvature { output, value, first, second, asymmetry, description: at.description.clone() })
}

/// The partial derivatives of one output.
fn row(output: usize, partials: [Matrix; 3]) -> Gradient {
    let [coordinates, inputs, design] = partials.each_ref().map(|matrix| (&matrix[output]).into());
    Gradient { coordinates, inputs, design }
}

fn slopes(gradient: Gradient) -> Slopes<f64> {
    Slopes { by_input: gradient.inputs, by_design: gradient.design }
}
