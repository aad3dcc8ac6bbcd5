//! Results on matplotlib, and as pandas and xarray know them; responses as tools of others know functions. The modules in
//! Python that do it are part of this one.

use std::ffi::CStr;

use eigentol_figures::{Error, Figure};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::ffi::c_str;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyModule;

use crate::hints::{Anything, Table};

const FIGURES: &CStr = c_str!(include_str!("../figures.py"));
const TOOLS: &CStr = c_str!(include_str!("../tools.py"));

/// A function of the module for figures.
fn function<'py>(py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
    static MODULE: PyOnceLock<Py<PyModule>> = PyOnceLock::new();
    let read = || PyModule::from_code(py, FIGURES, c"eigentol/figures.py", c"eigentol.figures").map(Bound::unbind);
    MODULE.get_or_try_init(py, read)?.bind(py).getattr(name)
}

/// A function of the module for tools of others.
pub(crate) fn tool<'py>(py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
    static MODULE: PyOnceLock<Py<PyModule>> = PyOnceLock::new();
    let read = || PyModule::from_code(py, TOOLS, c"eigentol/tools.py", c"eigentol.tools").map(Bound::unbind);
    MODULE.get_or_try_init(py, read)?.bind(py).getattr(name)
}

/// Draws a figure, on these axes if they are given.
pub(crate) fn plot<'py>(
    py: Python<'py>,
    figure: Option<Result<Figure, Error>>,
    ax: Option<Anything<'py>>,
) -> PyResult<Anything<'py>> {
    let figure = figure.ok_or_else(|| PyTypeError::new_err("this result has no figure"))?;
    let figure = figure.map_err(|error| PyValueError::new_err(error.to_string()))?;
    let text = serde_json::to_string(&figure).map_err(|error| PyValueError::new_err(error.to_string()))?;
    let read = py.import("json")?.call_method1("loads", (text,))?;
    function(py, "plot")?.call1((read, ax))
}

/// A page that a notebook shows.
pub(crate) fn page<'py>(py: Python<'py>, html: &str) -> PyResult<Anything<'py>> {
    function(py, "Page")?.call1((html,))
}

/// The table as a `pandas.DataFrame`.
pub(crate) fn frame<'py>(py: Python<'py>, table: Table<'py>) -> PyResult<Anything<'py>> {
    function(py, "frame")?.call1((table,))
}

/// The table as an `xarray.Dataset`.
pub(crate) fn dataset<'py>(py: Python<'py>, table: Table<'py>, name: Option<&str>) -> PyResult<Anything<'py>> {
    function(py, "dataset")?.call1((table, name))
}
