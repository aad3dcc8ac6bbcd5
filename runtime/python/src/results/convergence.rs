//! Changes of answers with more coordinates of beams.

use eigentol::convergence::Change;
use pyo3::prelude::*;

use super::{attributes, result};
use crate::arrays::{Array1, Array2, or_nan, rows, vector};

result! {
    /// How far frequencies, damping ratios and outputs change with one and with two more coordinates of each component of
    /// the beams. `k` is the number of answers.
    Convergence(eigentol::Convergence)
}

impl Convergence {
    fn each<T>(&self, of: impl Fn(&Change) -> T) -> impl Iterator<Item = T> {
        self.0.changes.iter().map(of)
    }
}

attributes! {
    Convergence(self, py) {
        /// Names of the answers, modes counted from 1: "frequency 1".
        names: Vec<String> = self.each(|x| x.answer.name(&self.0.description)).collect();
        /// Values with the declared coordinates, SI, shape (k,).
        values: Array1<'py> = vector(py, self.each(|x| x.value));
        /// What one and two more coordinates add, relative to the larger of the two values compared, shape (k, 2); NaN
        /// where the answer no longer exists.
        changes: PyResult<Array2<'py>> =
            rows(py, 2, self.each(|row| row.relative.map(or_nan).to_vec()));
        /// Why peaks along an input are not compared: a text, or None.
        without_peaks: Option<String> = Some(self.0.without_peaks.as_ref()?.to_string());
    }
}
