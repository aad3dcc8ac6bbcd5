//! Sampling runs split into parts, for many processes and machines.

use eigentol::tolerance::PartialMonteCarlo;
use eigentol_tables::part;
use pyo3::prelude::*;
use pyo3::types::PyType;

use crate::errors::{Kind, new, raise};
use crate::hints;
use crate::results::{MonteCarlo, attributes};
use crate::settings::whole;
use crate::study::Study;

/// Some samples of a Monte Carlo run: parts merge to the same bits as the whole, in any order and from any machine.
#[pyclass(name = "PartialMonteCarlo", module = "eigentol")]
pub(crate) struct Part(PartialMonteCarlo);

attributes! {
    Part(self, py) {
        /// First sample and the one behind the last of each range that is done.
        ranges: Vec<(u64, u64)> =
            self.0.ranges().into_iter().map(|range| (range.start, range.end)).collect();
        /// The same of the ranges that are missing.
        missing: Vec<(u64, u64)> =
            self.0.missing().into_iter().map(|range| (range.start, range.end)).collect();
    }
}

#[pymethods]
impl Part {
    /// The text of a file: what the command `eigentol sample --partial` writes and `eigentol merge` reads.
    fn to_json(&self, py: Python<'_>) -> PyResult<String> {
        part::to_string(&self.0).map_err(|error| new(py, Kind::Error, error.to_string()))
    }

    /// A part from such a text.
    #[classmethod]
    fn from_json(_class: &Bound<'_, PyType>, py: Python<'_>, text: &str) -> PyResult<Self> {
        part::read(text).map(Self).map_err(|error| new(py, Kind::InvalidValue, error.to_string()))
    }

    /// Adds samples of the same run; those of another one, and samples that are here already, are refused.
    fn merge(slf: &Bound<'_, Self>, other: &Bound<'_, Self>) -> PyResult<()> {
        let other = other.borrow().0.clone();
        slf.borrow_mut().0.merge(other).map_err(|error| raise(slf.py(), error))
    }

    /// Statistics of the samples that are done.
    fn result(&self) -> MonteCarlo {
        MonteCarlo(self.0.result())
    }

    fn __repr__(&self, py: Python<'_>) -> String {
        format!("PartialMonteCarlo(ranges={:?})", self.ranges(py))
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, (String,))> {
        let text = slf.borrow().to_json(py)?;
        Ok((slf.get_type().getattr("from_json")?, (text,)))
    }
}

#[pymethods]
impl Study {
    /// The samples `start` to below `stop` of `monte_carlo`, with the same seed: parts merge to the same bits as the
    /// whole run.
    fn samples_between(&self, py: Python<'_>, start: &hints::Count<'_>, stop: &hints::Count<'_>) -> PyResult<Part> {
        let (start, stop) = (whole(start, "start")?, whole(stop, "stop")?);
        self.ask_stoppably(py, |study| study.samples_between(start..stop)).map(Part)
    }
}
