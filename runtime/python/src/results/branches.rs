//! Branches of equilibria.

use pyo3::prelude::*;

use super::result;
use crate::arrays::{Array1, Array2, rows, vector};

result! {
    /// The branches of equilibria along an input.
    Branches(eigentol::branches::Branches)
}

#[pymethods]
impl Branches {
    /// The branches.
    #[getter]
    fn branches(&self) -> Vec<Branch> {
        self.0.branches.iter().cloned().map(Branch).collect()
    }

    fn __len__(&self) -> usize {
        self.0.branches.len()
    }
}

result! {
    /// One branch of equilibria. `k` is the number of its points, `n` that of the unknowns.
    Branch(eigentol::branches::Branch)
}

#[pymethods]
impl Branch {
    /// Values of the input, SI, shape (k,).
    #[getter]
    fn values<'py>(&self, py: Python<'py>) -> Array1<'py> {
        vector(py, self.0.points.iter().map(|own| own.value))
    }

    /// Unknowns, SI, shape (k, n).
    #[getter]
    fn coordinates<'py>(&self, py: Python<'py>) -> PyResult<Array2<'py>> {
        let all = self.0.points.iter();
        let all = all.map(|own| own.equilibrium.coordinates.to_vec());
        rows(py, self.0.description.coordinates.len(), all)
    }

    /// Whether no small disturbance grows exponentially, at each point; nothing resists a neutral motion, which counts as stable.
    #[getter]
    fn stable(&self) -> Vec<bool> {
        let all = self.0.points.iter();
        all.map(|own| own.equilibrium.stability.holds()).collect()
    }

    /// Special points: what each is, in words, and the value of the input there, SI.
    #[getter]
    fn special(&self) -> Vec<(String, f64)> {
        let all = self.0.special.iter();
        all.map(|own| (own.kind.to_string(), own.value)).collect()
    }

    /// How it ends at either side, in words.
    #[getter]
    fn ends(&self) -> Vec<String> {
        self.0.ends.iter().map(ToString::to_string).collect()
    }

    fn __len__(&self) -> usize {
        self.0.points.len()
    }
}
