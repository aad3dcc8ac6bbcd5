//! A report of a study as one HTML file.

use std::fs;
use std::path::PathBuf;

use eigentol_figures::{deflections, mode_shapes};
use eigentol_report::{Error, Report, Style, motion};
use pyo3::exceptions::{PyOSError, PyTypeError};
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use crate::errors::raise;
use crate::figures;
use crate::hints::Anything;
use crate::study::Study;
use crate::values::all_finite;

/// Modes in a figure of deflection curves.
const DRAWN: usize = 6;
/// Their displacement, as a fraction of the size, so small that nothing but the mode is seen.
const SMALL: f64 = 1e-4;

/// An input, its values and perhaps a unit. In Python `tuple[str, ArrayLike] | tuple[str, ArrayLike, str]`.
type Along<'py> = Bound<'py, PyTuple>;

/// In Python `Literal["Hz", "rad/s"]`.
type FrequencyUnit = str;

#[pymethods]
impl Study {
    /// The equilibrium, modes and forced vibrations in motion: a page that a notebook shows, and that `save(path)` writes for
    /// a browser.
    fn motion_page<'py>(&self, py: Python<'py>) -> PyResult<Anything<'py>> {
        let page = py.detach(|| motion(&self.inner, &Style::default()));
        figures::page(py, &page.map_err(|error| refused(py, error))?)
    }

    /// Draws the modes on matplotlib axes: of beams the bent equilibrium and deflection curves of the first modes that
    /// oscillate, of other machines the shapes by coordinate, as `modes().plot()` does. Returns the axes.
    #[pyo3(signature = (ax=None))]
    fn plot_modes<'py>(&self, py: Python<'py>, ax: Option<Anything<'py>>) -> PyResult<Anything<'py>> {
        let drawn = py.detach(|| {
            let (scene, modes) = (self.inner.picture()?, self.inner.modes()?);
            let moving =
                modes.foremost(DRAWN).into_iter().filter_map(|mode| self.inner.mode_pictures(mode, 4, SMALL).ok());
            let moving: Vec<_> = moving.collect();
            let style = Style::default();
            Ok(if scene.beams.is_empty() {
                mode_shapes(&modes, &style)
            } else {
                deflections(&scene, &modes, &moving, &style)
            })
        });
        figures::plot(py, Some(drawn.map_err(|error| raise(py, error))?), ax)
    }

    /// Writes a report: one HTML file with the mechanism in 3-D, its modes in motion, charts, verdicts and tables.
    ///
    /// `sweep` is a tuple of the name of an input and values of it, SI or texts with units, and may have a unit for
    /// plain numbers as its third entry: `("speed", range(0, 6001, 100), "rpm")`. `orders` are multiples of that input
    /// whose crossings are marked. Samples and seed are those of the study. `mode_names` are what figures and sentences
    /// call the modes, the first one first, and `frequency_unit` is the unit of frequencies in them, `"Hz"` or
    /// `"rad/s"`.
    ///
    /// Raises OSError when the file cannot be written. What an analysis refuses is said in the report.
    #[expect(clippy::too_many_arguments, reason = "keywords of Python")]
    #[pyo3(signature = (path, sweep=None, orders=vec![], title=None, mode_names=vec![], frequency_unit=None))]
    fn report(
        &self,
        py: Python<'_>,
        path: PathBuf,
        sweep: Option<&Along<'_>>,
        orders: Vec<f64>,
        title: Option<String>,
        mode_names: Vec<String>,
        frequency_unit: Option<&FrequencyUnit>,
    ) -> PyResult<()> {
        let style = Style::default().name_modes(mode_names);
        let style = match frequency_unit {
            None => style,
            Some("Hz") => style.hertz(),
            Some("rad/s") => style.radians_per_second(),
            Some(other) => {
                let setting = "frequency_unit";
                let reason = format!("\"Hz\" or \"rad/s\", not {other:?}");
                return Err(raise(py, eigentol::Error::setting(setting, reason)));
            }
        };
        all_finite(py, "orders", &orders)?;
        let text = self.mechanism(py).get().text().to_owned();
        let sweep = match sweep {
            None => None,
            Some(sweep) => {
                let (input, values, unit) = parts(sweep)?;
                Some(self.values(py, &input, &values, unit.as_deref())?)
            }
        };
        let html = self.stoppably(py, |study| {
            let report = Report::new(study).style(style);
            let mut report = report.declaration(text).orders(&orders);
            if let Some(title) = title {
                report = report.title(title);
            }
            if let Some((input, values)) = &sweep {
                report = report.sweep(*input, values);
            }
            report.html()
        })?;
        let html = html.map_err(|error| refused(py, error))?;
        fs::write(&path, html).map_err(|source| PyOSError::new_err(Error::Write { path, source }.to_string()))
    }
}

/// The exception for a page that is not written.
fn refused(py: Python<'_>, error: Error) -> PyErr {
    match error {
        Error::Study(error) => raise(py, error),
        other => PyOSError::new_err(other.to_string()),
    }
}

/// Name, values, unit.
fn parts<'py>(sweep: &Bound<'py, PyTuple>) -> PyResult<(String, Bound<'py, PyAny>, Option<String>)> {
    match sweep.len() {
        2 => {
            let (input, values) = sweep.extract()?;
            Ok((input, values, None))
        }
        3 => sweep.extract(),
        _ => Err(PyTypeError::new_err("a sweep is a tuple: (\"speed\", values) or (\"speed\", values, \"rpm\")")),
    }
}
