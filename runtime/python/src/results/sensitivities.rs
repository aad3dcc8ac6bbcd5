//! Sensitivities of modes and outputs.

use eigentol::sensitivity::{ModeSensitivity, Slopes};
use eigentol::{Complex, Quantity};
use pyo3::prelude::*;

use super::{Described, attributes, family, result};
use crate::arrays::{Array2, NONE, optional_rows};
use crate::hints;
use crate::values::word;

/// Looks up a mode quantity by name.
pub(crate) fn quantity(py: Python<'_>, name: &str) -> PyResult<Quantity> {
    let words = [
        ("frequency", Quantity::Frequency),
        ("natural_frequency", Quantity::NaturalFrequency),
        ("damping_ratio", Quantity::DampingRatio),
        ("growth", Quantity::Growth),
        ("log_decrement", Quantity::LogDecrement),
    ];
    word(py, "quantity", name, &words)
}

result! {
    /// Total derivatives of all modes, per SI unit of inputs and design variables. `m` is the number of modes.
    Sensitivities(eigentol::Sensitivities), crate::results::typed
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
        /// "undamped" or "general".
        family: &'static hints::Family = family(self.0.family);
    }
}

#[pymethods]
impl Sensitivities {
    /// Derivatives of a quantity, "frequency" (rad/s), "natural_frequency" (rad/s), "damping_ratio", "log_decrement" or
    /// "growth" (1/s), by inputs, shape (m, inputs), and by design variables, shape (m, design), per SI unit; NaN for a mode that has
    /// none.
    fn of<'py>(&self, py: Python<'py>, name: &hints::Quantity) -> PyResult<(Array2<'py>, Array2<'py>)> {
        let wanted = quantity(py, name)?;
        let (inputs, design) = self.counts();
        let by_input = |mode_sensitivity: &ModeSensitivity| Some(mode_sensitivity.of(wanted)?.by_input.to_vec());
        let by_design = |mode_sensitivity: &ModeSensitivity| Some(mode_sensitivity.of(wanted)?.by_design.to_vec());
        Ok((self.rows(py, inputs, by_input)?, self.rows(py, design, by_design)?))
    }
}
