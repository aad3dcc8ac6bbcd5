//! Sensitivities of modes and outputs.

use eigentol::second_order::{EventCurvature, OutputCurvature, SecondDerivatives};
use eigentol::sensitivity::{ModeSensitivity, Slopes};
use eigentol::{Complex, Matrix, Quantity, Vector};
use pyo3::prelude::*;

use super::result;
use crate::arrays::{Array1, Array2, matrix, optional_rows, vector};
use crate::errors::{Kind, new};
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
        let none = Complex::new(f64::NAN, f64::NAN);
        let row = |mode: &ModeSensitivity| match mode.s() {
            Some(slopes) => of(&slopes),
            None => vec![none; columns],
        };
        crate::arrays::rows(py, columns, self.0.modes.iter().map(row))
    }

    fn counts(&self) -> (usize, usize) {
        let of = &self.0.description;
        (of.inputs.len(), of.design.len())
    }
}

#[pymethods]
impl Sensitivities {
    /// Derivatives of the eigenvalues `s` by design variables, 1/s per SI unit, complex, shape (m, design); NaN where
    /// `s` has none.
    #[getter]
    fn by_design<'py>(&self, py: Python<'py>) -> PyResult<Array2<'py, Complex>> {
        self.complex(py, self.counts().1, |own| own.by_design.to_vec())
    }

    /// Derivatives of the eigenvalues `s` by inputs, 1/s per SI unit, complex, shape (m, inputs); NaN where `s` has
    /// none.
    #[getter]
    fn by_input<'py>(&self, py: Python<'py>) -> PyResult<Array2<'py, Complex>> {
        self.complex(py, self.counts().0, |own| own.by_input.to_vec())
    }

    /// Derivatives of `lambda = -Re s^2` by design variables, 1/s^2 per SI unit, shape (m, design).
    #[getter]
    fn lambda_by_design<'py>(&self, py: Python<'py>) -> PyResult<Array2<'py>> {
        self.rows(py, self.counts().1, |own| {
            Some(own.lambda.by_design.to_vec())
        })
    }

    /// Derivatives of `lambda = -Re s^2` by inputs, 1/s^2 per SI unit, shape (m, inputs).
    #[getter]
    fn lambda_by_input<'py>(&self, py: Python<'py>) -> PyResult<Array2<'py>> {
        self.rows(py, self.counts().0, |own| {
            Some(own.lambda.by_input.to_vec())
        })
    }

    /// Derivatives of a quantity, "frequency" (rad/s), "natural_frequency" (rad/s), "damping_ratio" or "growth" (1/s),
    /// by inputs, shape (m, inputs), and by design variables, shape (m, design), per SI unit; NaN for a mode that has
    /// none.
    fn of<'py>(&self, py: Python<'py>, name: &str) -> PyResult<(Array2<'py>, Array2<'py>)> {
        let wanted = quantity(py, name)?;
        let (inputs, design) = self.counts();
        let by_input = |own: &ModeSensitivity| Some(own.of(wanted)?.by_input.to_vec());
        let by_design = |own: &ModeSensitivity| Some(own.of(wanted)?.by_design.to_vec());
        Ok((
            self.rows(py, inputs, by_input)?,
            self.rows(py, design, by_design)?,
        ))
    }

    /// Whether each mode is one of a cluster of nearly equal eigenvalues: then its derivatives belong to the computed
    /// basis only.
    #[getter]
    fn clustered(&self) -> Vec<bool> {
        self.0.modes.iter().map(|own| own.clustered).collect()
    }
}

/// First and second total derivatives of one mode, per SI unit.
#[pyclass(frozen, module = "eigentol")]
pub(crate) struct ModeCurvature(pub(crate) eigentol::second_order::ModeCurvature);

impl ModeCurvature {
    fn second(&self, py: Python<'_>, name: &str) -> PyResult<SecondDerivatives<f64>> {
        if name == "lambda" {
            return Ok(self.0.lambda.clone());
        }
        let wanted = quantity(py, name)?;
        self.0.of(wanted).ok_or_else(|| self.none(py, name))
    }

    fn none(&self, py: Python<'_>, name: &str) -> PyErr {
        let message = format!("mode {} has no {name} to differentiate", self.0.mode);
        new(py, Kind::NoDerivative, message)
    }
}

/// Quantities are "frequency" (rad/s), "natural_frequency" (rad/s), "damping_ratio", "growth" (1/s); second derivatives
/// also of "lambda" (1/s^2).
#[pymethods]
impl ModeCurvature {
    /// Its eigenvalue, 1/s.
    #[getter]
    fn eigenvalue(&self) -> Complex {
        self.0.s
    }

    /// First derivatives of a quantity by design variables, shape (design,).
    #[pyo3(signature = (quantity="frequency"))]
    fn gradient<'py>(&self, py: Python<'py>, quantity: &str) -> PyResult<Array1<'py>> {
        if quantity == "lambda" {
            return Ok(vector(py, self.0.first.lambda.by_design.clone()));
        }
        let wanted = self::quantity(py, quantity)?;
        let slopes = self.0.first.of(wanted);
        let slopes = slopes.ok_or_else(|| self.none(py, quantity))?;
        Ok(vector(py, slopes.by_design))
    }

    /// The Hessian of a quantity by design variables, shape (design, design).
    #[pyo3(signature = (quantity="frequency"))]
    fn hessian<'py>(&self, py: Python<'py>, quantity: &str) -> PyResult<Array2<'py>> {
        matrix(py, &self.second(py, quantity)?.by_design)
    }

    /// Second derivatives of a quantity by inputs, shape (inputs, inputs).
    #[pyo3(signature = (quantity="frequency"))]
    fn by_input<'py>(&self, py: Python<'py>, quantity: &str) -> PyResult<Array2<'py>> {
        matrix(py, &self.second(py, quantity)?.by_input)
    }

    /// Second derivatives of a quantity by an input and a design variable, shape (inputs, design).
    #[pyo3(signature = (quantity="frequency"))]
    fn by_input_and_design<'py>(&self, py: Python<'py>, quantity: &str) -> PyResult<Array2<'py>> {
        matrix(py, &self.second(py, quantity)?.by_input_and_design)
    }

    /// Greatest difference of mirrored second derivatives, relative to the greatest: exact arithmetic would give zero.
    #[getter]
    fn asymmetry(&self) -> f64 {
        self.0.asymmetry
    }

    fn __repr__(&self) -> String {
        let (of, mode, s) = (&self.0.description.name, self.0.mode, self.0.s);
        format!("First and second derivatives of mode {mode} of {of}, s = {s} 1/s")
    }
}

/// First and second total derivatives of one number, per SI unit.
#[pyclass(frozen, module = "eigentol")]
pub(crate) struct Curvature {
    value: f64,
    gradient: Vector,
    hessian: Matrix,
    asymmetry: f64,
    what: String,
}

impl From<OutputCurvature> for Curvature {
    fn from(own: OutputCurvature) -> Self {
        let of = &own.description;
        let name = of.outputs.get(own.output.index()).map(|info| &*info.name);
        Self {
            value: own.value,
            gradient: own.first.by_design,
            hessian: own.second.by_design,
            asymmetry: own.asymmetry,
            what: format!("output {} of {}", name.unwrap_or("?"), of.name),
        }
    }
}

impl From<EventCurvature> for Curvature {
    fn from(own: EventCurvature) -> Self {
        let of = &own.description;
        let name = of.inputs.get(own.input.index()).map(|info| &*info.name);
        Self {
            value: own.value,
            gradient: own.first,
            hessian: own.second,
            asymmetry: own.asymmetry,
            what: format!("critical {} of {}", name.unwrap_or("?"), of.name),
        }
    }
}

#[pymethods]
impl Curvature {
    /// The number, SI.
    #[getter]
    fn value(&self) -> f64 {
        self.value
    }

    /// First derivatives by design variables, shape (design,).
    #[getter]
    fn gradient<'py>(&self, py: Python<'py>) -> Array1<'py> {
        vector(py, self.gradient.clone())
    }

    /// Second derivatives by design variables, shape (design, design).
    #[getter]
    fn hessian<'py>(&self, py: Python<'py>) -> PyResult<Array2<'py>> {
        matrix(py, &self.hessian)
    }

    /// Greatest difference of mirrored second derivatives, relative to the greatest: exact arithmetic would give zero.
    #[getter]
    fn asymmetry(&self) -> f64 {
        self.asymmetry
    }

    fn __repr__(&self) -> String {
        format!(
            "First and second derivatives of {}, {} SI",
            self.what, self.value
        )
    }
}

/// Derivatives of the shapes of one mode, per SI unit, complex: a row for each variable, a column for each unknown.
#[pyclass(frozen, module = "eigentol")]
pub(crate) struct ShapeSensitivity(pub(crate) eigentol::shapes::ShapeSensitivity);

#[pymethods]
impl ShapeSensitivity {
    /// Of the shape by inputs, shape (inputs, n).
    #[getter]
    fn right_by_input<'py>(&self, py: Python<'py>) -> PyResult<Array2<'py, Complex>> {
        matrix(py, &self.0.right_by_input)
    }

    /// Of the shape by design variables, shape (design, n).
    #[getter]
    fn right_by_design<'py>(&self, py: Python<'py>) -> PyResult<Array2<'py, Complex>> {
        matrix(py, &self.0.right_by_design)
    }

    /// Of the left vector by inputs, shape (inputs, n).
    #[getter]
    fn left_by_input<'py>(&self, py: Python<'py>) -> PyResult<Array2<'py, Complex>> {
        matrix(py, &self.0.left_by_input)
    }

    /// Of the left vector by design variables, shape (design, n).
    #[getter]
    fn left_by_design<'py>(&self, py: Python<'py>) -> PyResult<Array2<'py, Complex>> {
        matrix(py, &self.0.left_by_design)
    }

    fn __repr__(&self) -> String {
        format!(
            "Derivatives of the shapes of a mode of {}",
            self.0.description.name
        )
    }
}

result! {
    /// The declared outputs and their total derivatives, SI. `o` is their number.
    OutputSensitivities(eigentol::sensitivity::OutputSensitivities)
}

#[pymethods]
impl OutputSensitivities {
    /// Names of the outputs.
    #[getter]
    fn names(&self) -> Vec<&str> {
        crate::names::outputs(&self.0.description)
    }

    /// Values, SI, shape (o,).
    #[getter]
    fn values<'py>(&self, py: Python<'py>) -> Array1<'py> {
        vector(py, self.0.values.clone())
    }

    /// Derivatives by inputs, shape (o, inputs); NaN where there is none.
    #[getter]
    fn by_input<'py>(&self, py: Python<'py>) -> PyResult<Array2<'py>> {
        let columns = self.0.description.inputs.len();
        let all = self.0.by_input.iter();
        optional_rows(
            py,
            columns,
            all.map(|row| row.as_ref().map(|own| own.to_vec())),
        )
    }

    /// Derivatives by design variables, shape (o, design); NaN where there is none.
    #[getter]
    fn by_design<'py>(&self, py: Python<'py>) -> PyResult<Array2<'py>> {
        let columns = self.0.description.design.len();
        let all = self.0.by_design.iter();
        optional_rows(
            py,
            columns,
            all.map(|row| row.as_ref().map(|own| own.to_vec())),
        )
    }
}
