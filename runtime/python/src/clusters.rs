//! Modes whose eigenvalues are equal, or so close that tolerances mix them.

use std::fmt;

use eigentol::clusters::{self, ClusterTolerance};
use eigentol_tables::Tables;
use pyo3::prelude::*;

use crate::arrays::{Array1, vector};
use crate::results::{Document, result};
use crate::study::Study;
use crate::values::{List, mode_number};

/// All clusters of a study.
pub(crate) struct All(Vec<ClusterTolerance>);

impl fmt::Display for All {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.0.is_empty() {
            return f.write_str("tolerances bring no modes together\n");
        }
        self.0.iter().try_for_each(|own| write!(f, "{own}"))
    }
}

impl Tables for All {
    fn tables(&self) -> Vec<eigentol_tables::Table> {
        self.0[..].tables()
    }
}

impl Document for All {
    fn document(&self) -> Result<String, eigentol_tables::Error> {
        eigentol_tables::json::to_string(&self.0)
    }
}

#[pymethods]
impl Study {
    /// The modes that tolerances bring together, and their spread.
    fn clusters(&self, py: Python<'_>) -> PyResult<Clusters> {
        let found = self.ask(py, |study| study.clusters())?;
        Ok(Clusters(All(found)))
    }

    /// Derivatives of the eigenvalues in the cluster of a mode, counted from 0, along a change of inputs and design
    /// variables: lists, SI, or dictionaries by name; what is not named stays as it is. Equal eigenvalues split
    /// differently in each direction.
    #[pyo3(signature = (mode, inputs=None, design=None))]
    fn directional_derivatives(
        &self,
        py: Python<'_>,
        mode: i64,
        inputs: Option<&Bound<'_, PyAny>>,
        design: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<DirectionalDerivatives> {
        let mode = mode_number(py, mode)?;
        let of = self.inner.description();
        let inputs = List::Inputs.changes(py, of, inputs)?;
        let design = List::Design.changes(py, of, design)?;
        let found = self.ask(py, |study| {
            study.directional_derivatives(mode, (&inputs, &design))
        });
        found.map(DirectionalDerivatives)
    }
}

result! {
    /// The modes that tolerances bring together. `k` is the number of clusters; their members stand in the table.
    Clusters(All)
}

#[pymethods]
impl Clusters {
    fn __len__(&self) -> usize {
        self.0.0.len()
    }

    /// Positions of the modes of each cluster, from 0.
    #[getter]
    fn modes(&self) -> Vec<Vec<usize>> {
        self.0.0.iter().map(|own| own.modes.clone()).collect()
    }

    /// Least distance of two members, in standard deviations of their difference, shape (k,).
    #[getter]
    fn distances<'py>(&self, py: Python<'py>) -> Array1<'py> {
        vector(py, self.0.0.iter().map(|own| own.distance))
    }

    /// Whether the members of each have merged into one eigenvalue that no derivative describes.
    #[getter]
    fn defective(&self) -> Vec<bool> {
        self.0.0.iter().map(ClusterTolerance::defective).collect()
    }
}

/// Derivatives of the eigenvalues of one cluster along one direction. `k` is the number of its modes; which derivative
/// belongs to which mode is not defined.
#[pyclass(frozen, module = "eigentol")]
pub(crate) struct DirectionalDerivatives(clusters::DirectionalDerivatives);

#[pymethods]
impl DirectionalDerivatives {
    /// Positions of the modes, from 0.
    #[getter]
    fn modes(&self) -> Vec<usize> {
        self.0.modes.clone()
    }

    /// Derivatives of lambda (1/s^2) of undamped modes, of s (1/s) of general ones, ascending, complex, shape (k,).
    #[getter]
    fn eigenvalues<'py>(&self, py: Python<'py>) -> Array1<'py, eigentol::Complex> {
        vector(py, self.0.eigenvalues.iter().copied())
    }

    /// Derivatives of the frequencies, rad/s, ascending, shape (k,); None for modes that do not oscillate.
    #[getter]
    fn frequencies<'py>(&self, py: Python<'py>) -> Option<Array1<'py>> {
        let own = self.0.frequencies.as_ref()?;
        Some(vector(py, own.iter().copied()))
    }

    fn __repr__(&self) -> String {
        format!("DirectionalDerivatives(modes={:?})", self.0.modes)
    }
}
