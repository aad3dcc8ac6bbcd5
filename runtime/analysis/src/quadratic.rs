//! Second-order models of responses at the nominal design.

use std::collections::BTreeMap;

use eigentol_solve::error::NoDerivative;

use crate::algebra::{Matrix, Vector};
use crate::kernels::CurvatureKernels;
use crate::response::{Response, Responses};
use crate::second_order::{
    EventCurvature, ModeCurvature, Quadratic, critical_curvature, crossing_curvature, mode_curvature, output_curvature,
};
use crate::{Error, Quantity};

/// Second-order models of responses, those of one mode from the same derivatives of its eigenvalue.
#[doc(hidden)]
pub struct QuadraticModels<'a> {
    mechanism: &'a dyn CurvatureKernels,
    responses: &'a Responses<'a>,
    of_mode: BTreeMap<usize, Result<ModeCurvature, Error>>,
}

/// The second-order model of a response.
#[doc(hidden)]
pub struct QuadraticModel {
    /// The model over the design variables.
    pub quadratic: Quadratic,
    /// First derivatives with respect to the inputs, and second ones with respect to an input and a design variable.
    pub by_input: Option<(Vector, Matrix)>,
}

impl<'a> QuadraticModels<'a> {
    /// For responses of `mechanism`.
    pub fn new(mechanism: &'a dyn CurvatureKernels, responses: &'a Responses<'a>) -> Self {
        Self { mechanism, responses, of_mode: BTreeMap::new() }
    }

    /// The model of a response.
    ///
    /// # Errors
    /// [`Error::NoSensitivity`] for peaks, whose second derivatives would need third ones of the amplitude;
    /// [`Error::NotOscillating`] for a mode without the quantity; [`Error::NoResponse`] for a critical value, crossing or
    /// amplitude that does not exist; what the second derivatives of each response say.
    pub fn of(&mut self, response: Response) -> Result<QuadraticModel, Error> {
        let (mechanism, at) = (self.mechanism, self.responses.nominal());
        let missing = Error::NoResponse { response: 0, missing: 1, needed: 1, method: "second order" };
        match response {
            Response::Mode { mode, quantity } => self.of_mode(mode, quantity),
            Response::Output(output) => {
                let expansion = output_curvature(mechanism, at, output)?;
                Ok(QuadraticModel {
                    quadratic: Quadratic {
                        value: expansion.value,
                        slopes: expansion.first.by_design,
                        curvature: expansion.second.by_design,
                    },
                    by_input: Some((expansion.first.by_input, expansion.second.by_input_and_design)),
                })
            }
            Response::Vibration(vibration) => {
                let ((value, first), second) = vibration.quadratic(mechanism, at)?.ok_or(missing)?;
                Ok(QuadraticModel {
                    quadratic: Quadratic { value, slopes: first.by_design, curvature: second.by_design },
                    by_input: Some((first.by_input, second.by_input_and_design)),
                })
            }
            Response::Peak { .. } => Err(Error::NoSensitivity { reason: NoDerivative::Peak }),
            Response::Critical(range) => {
                let state = self.responses.critical_state(&at.design, range);
                critical_curvature(mechanism, &state.ok_or(missing)?).map(QuadraticModel::along)
            }
            Response::Crossing { .. } => {
                let state = self.responses.first_crossing(&at.design, &response);
                crossing_curvature(mechanism, &state.ok_or(missing)?).map(QuadraticModel::along)
            }
        }
    }

    fn of_mode(&mut self, mode: usize, quantity: Quantity) -> Result<QuadraticModel, Error> {
        let modes = self.responses.modes();
        let solve = || mode_curvature(self.mechanism, self.responses.nominal(), modes, mode);
        let curvature = self.of_mode.entry(mode).or_insert_with(solve).as_ref().map_err(Clone::clone)?;
        let lambda = modes.modes[mode].lambda;
        let silent = || Error::NotOscillating { mode, lambda };
        let quadratic = curvature.quadratic(quantity).ok_or_else(silent)?;
        let first = curvature.first.of(quantity).ok_or_else(silent)?;
        let second = curvature.of(quantity).ok_or_else(silent)?;
        Ok(QuadraticModel { quadratic, by_input: Some((first.by_input, second.by_input_and_design)) })
    }
}

impl QuadraticModel {
    /// The model of a value of the input.
    fn along(event_curvature: EventCurvature) -> Self {
        Self {
            quadratic: Quadratic {
                value: event_curvature.value,
                slopes: event_curvature.first,
                curvature: event_curvature.second,
            },
            by_input: None,
        }
    }
}
