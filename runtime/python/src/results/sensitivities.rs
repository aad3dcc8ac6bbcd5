//! Sensitivities of modes and outputs.

use eigentol::second_order::SecondDerivatives;
use eigentol::sensitivity::{ModeSensitivity, Slopes};
use eigentol::{Complex, Quantity};
use pyo3::prelude::*;

use super::{attributes, result};
use crate::arrays::{Array1, Array2, NONE, matrix, optional_rows, vector};
use crate::errors::{Kind, new};
use crate::hints;
use crate::values::word;

/// Looks up a mode quantity by name.
pub(crate) fn quantity(py: Python<'_>, name: &str) -> PyResult<Quantity> {
    let words = [
        ("frequency", Quantity::Frequency),
        ("natural_frequency", Quantity::NaturalFrequency),
        ("damping_ratio", Quantity::DampingRatio),
        ("growth", Quantity::Growth),
    ];
    word(py, "quantity", name, &words)
}

result! {
    /// Total derivatives of all modes, per SI unit of inputs and design variables. `m` is the number of modes.
    Sensitivities(eigentol::Sensitivities)
}

impl Sensitivities {
    fn rows<'py>(
        &self,
        py: Python<'py>,
        columns: usize,
        of: impl Fn(&ModeSensitivity) -> Option<Vec<f64>>,
    ) -> PyResult<Array2<'py>> {
        optional_rows(py, columns, self.0.modes.iter().map(of))
    }

    fn complex<'py>(
        &self,
        py: Python<'py>,
        columns: usize,
        of: impl Fn(&Slopes<Complex>) -> Vec<Complex>,
    ) -> PyResult<Array2<'py, Complex>> {
        let row = |mode: &ModeSensitivity| match mode.s() {
            Some(slopes) => of(&slopes),
            None => vec![NONE; columns],
        };
        crate::arrays::rows(py, columns, self.0.modes.iter().map(row))
    }

    fn counts(&self) -> (usize, usize) {
        let of = &self.0.description;
        (of.inputs.len(), of.design.len())
    }
}

attributes! {
    Sensitivities(self, py) {
        /// How the derivatives were found, in words.
        method: String = self.0.method.to_string();
        /// Derivatives of the eigenvalues `s` by design variables, 1/s per SI unit, complex, shape (m, design); NaN where
        /// `s` has none.
        by_design: PyResult<Array2<'py, Complex>> =
            self.complex(py, self.counts().1, |slopes| slopes.by_design.to_vec());
        /// Derivatives of the eigenvalues `s` by inputs, 1/s per SI unit, complex, shape (m, inputs); NaN where `s` has
        /// none.
        by_input: PyResult<Array2<'py, Complex>> =
            self.complex(py, self.counts().0, |slopes| slopes.by_input.to_vec());
        /// Derivatives of `lambda = -Re s^2` by design variables, 1/s^2 per SI unit, shape (m, design).
        lambda_by_design: PyResult<Array2<'py>> =
            self.rows(py, self.counts().1, |mode| {
                Some(mode.lambda.by_design.to_vec())
            });
        /// Derivatives of `lambda = -Re s^2` by inputs, 1/s^2 per SI unit, shape (m, inputs).
        lambda_by_input: PyResult<Array2<'py>> =
            self.rows(py, self.counts().0, |mode| {
                Some(mode.lambda.by_input.to_vec())
            });
        /// Whether each mode is one of a cluster of nearly equal eigenvalues: then its derivatives belong to the computed
        /// basis only.
        clustered: Vec<bool> = self.0.modes.iter().map(|mode| mode.clustered).collect();
    }
}

#[pymethods]
impl Sensitivities {
    /// Derivatives of a quantity, "frequency" (rad/s), "natural_frequency" (rad/s), "damping_ratio" or "growth" (1/s),
    /// by inputs, shape (m, inputs), and by design variables, shape (m, design), per SI unit; NaN for a mode that has
    /// none.
    fn of<'py>(&self, py: Python<'py>, name: &hints::Quantity) -> PyResult<(Array2<'py>, Array2<'py>)> {
        let wanted = quantity(py, name)?;
        let (inputs, design) = self.counts();
        let by_input = |mode_sensitivity: &ModeSensitivity| Some(mode_sensitivity.of(wanted)?.by_input.to_vec());
        let by_design = |mode_sensitivity: &ModeSensitivity| Some(mode_sensitivity.of(wanted)?.by_design.to_vec());
        Ok((self.rows(py, inputs, by_input)?, self.rows(py, design, by_design)?))
    }
}

result! {
    /// First and second total derivatives of one mode, per SI unit. Quantities are "frequency" (rad/s),
    /// "natural_frequency" (rad/s), "damping_ratio", "growth" (1/s) and "lambda" (1/s^2).
    ModeCurvature(eigentol::second_order::ModeCurvature)
}

impl ModeCurvature {
    fn first(&self, py: Python<'_>, name: &str) -> PyResult<Slopes<f64>> {
        if name == "lambda" {
            return Ok(self.0.first.lambda.clone());
        }
        let slopes = self.0.first.of(quantity(py, name)?);
        slopes.ok_or_else(|| self.none(py, name))
    }

    fn second(&self, py: Python<'_>, name: &str) -> PyResult<SecondDerivatives<f64>> {
        if name == "lambda" {
            return Ok(self.0.lambda.clone());
        }
        let derivatives = self.0.of(quantity(py, name)?);
        derivatives.ok_or_else(|| self.none(py, name))
    }

    fn none(&self, py: Python<'_>, name: &str) -> PyErr {
        let message = format!("mode {} has no {name} to differentiate", self.0.mode + 1);
        new(py, Kind::NoDerivative, message)
    }
}

attributes! {
    ModeCurvature(self, py) {
        /// Its position, from 0.
        mode: usize = self.0.mode;
        /// Its eigenvalue, 1/s.
        eigenvalue: Complex = self.0.s;
        /// Whether it is one of a cluster of nearly equal eigenvalues.
        clustered: bool = self.0.first.clustered;
    }
}

attributes! {
    ModeCurvature(self, py, quantity: hints::QuantityOrLambda = "frequency") {
        /// First derivatives of a quantity by design variables, shape (design,).
        gradient: Array1<'py> = Ok(vector(py, self.first(py, quantity)?.by_design));
        /// First derivatives of a quantity by inputs, shape (inputs,).
        gradient_by_input: Array1<'py> = Ok(vector(py, self.first(py, quantity)?.by_input));
        /// The Hessian of a quantity by design variables, shape (design, design).
        hessian: Array2<'py> = matrix(py, &self.second(py, quantity)?.by_design);
        /// Second derivatives of a quantity by inputs, shape (inputs, inputs).
        by_input: Array2<'py> = matrix(py, &self.second(py, quantity)?.by_input);
        /// Second derivatives of a quantity by an input and a design variable, shape (inputs, design).
        by_input_and_design: Array2<'py> =
            matrix(py, &self.second(py, quantity)?.by_input_and_design);
    }
}

result! {
    /// First and second total derivatives of an output, per SI unit.
    OutputCurvature(eigentol::second_order::OutputCurvature)
}

attributes! {
    OutputCurvature(self, py) {
        /// Name of the output.
        output: String = self.0.description.outputs[self.0.output.index()].name.to_string();
        /// Its value, SI.
        value: f64 = self.0.value;
        /// First derivatives by design variables, shape (design,).
        gradient: Array1<'py> = vector(py, self.0.first.by_design.clone());
        /// First derivatives by inputs, shape (inputs,).
        gradient_by_input: Array1<'py> = vector(py, self.0.first.by_input.clone());
        /// Second derivatives by design variables, shape (design, design).
        hessian: PyResult<Array2<'py>> = matrix(py, &self.0.second.by_design);
        /// Second derivatives by inputs, shape (inputs, inputs).
        by_input: PyResult<Array2<'py>> = matrix(py, &self.0.second.by_input);
        /// Second derivatives by an input and a design variable, shape (inputs, design).
        by_input_and_design: PyResult<Array2<'py>> = matrix(py, &self.0.second.by_input_and_design);
    }
}

result! {
    /// First and second total derivatives, by design variables, of a value of an input at which something happens.
    EventCurvature(eigentol::second_order::EventCurvature)
}

attributes! {
    EventCurvature(self, py) {
        /// Its value, SI.
        value: f64 = self.0.value;
        /// First derivatives, shape (design,).
        gradient: Array1<'py> = vector(py, self.0.first.clone());
        /// Second derivatives, shape (design, design).
        hessian: PyResult<Array2<'py>> = matrix(py, &self.0.second);
    }
}

result! {
    /// Derivatives of the shapes of one mode, per SI unit, complex. `n` is the number of unknowns.
    ShapeSensitivity(eigentol::shapes::ShapeSensitivity)
}

attributes! {
    ShapeSensitivity(self, py) {
        /// Of the shape by inputs, shape (n, inputs).
        right_by_input: PyResult<Array2<'py, Complex>> = matrix(py, &self.0.right_by_input.transpose());
        /// Of the shape by design variables, shape (n, design).
        right_by_design: PyResult<Array2<'py, Complex>> = matrix(py, &self.0.right_by_design.transpose());
        /// Of the left vector by inputs, shape (n, inputs).
        left_by_input: PyResult<Array2<'py, Complex>> = matrix(py, &self.0.left_by_input.transpose());
        /// Of the left vector by design variables, shape (n, design).
        left_by_design: PyResult<Array2<'py, Complex>> = matrix(py, &self.0.left_by_design.transpose());
    }
}

result! {
    /// The declared outputs and their total derivatives, SI. `o` is their number.
    OutputSensitivities(eigentol::sensitivity::OutputSensitivities)
}

attributes! {
    OutputSensitivities(self, py) {
        /// Names of the outputs.
        names: Vec<&str> = crate::names::outputs(&self.0.description);
        /// Values, SI, shape (o,).
        values: Array1<'py> = vector(py, self.0.values.clone());
        /// Derivatives by inputs, shape (o, inputs); NaN where there is none.
        by_input: PyResult<Array2<'py>> = {
            let all = self.0.by_input.iter().map(|row| row.as_ref().map(|x| x.to_vec()));
            optional_rows(py, self.0.description.inputs.len(), all)
        };
        /// Derivatives by design variables, shape (o, design); NaN where there is none.
        by_design: PyResult<Array2<'py>> = {
            let all = self.0.by_design.iter().map(|row| row.as_ref().map(|x| x.to_vec()));
            optional_rows(py, self.0.description.design.len(), all)
        };
    }
}
