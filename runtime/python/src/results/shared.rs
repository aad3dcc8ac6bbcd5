//! Features common to all results: text, tables, and HTML for notebooks.
//!
//! # Python sees what Rust sees
//!
//! A result is what it says of itself: text, sentences, tables and document follow from its description (`Answer` of
//! Rust), in Python by one class, `Answer`. Those of which many arrays are wanted have a class of their own with getters.
//! Every question releases the interpreter's lock. `eigentol.pyi` is generated from this source by a test, which
//! `UPDATE_STUB=1` lets write it. The crate, and so the workspace, builds without Python (stable interface, symbols left
//! open).

use std::fmt::Write;

use eigentol_results::numbers::number;
use eigentol_tables::{Column, Table, Values};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays::{optional, vector};
use crate::errors::{Kind, new};
use crate::hints;
use crate::names::did_you_mean;

/// Defines a class around a result, with the text, tables and document of that result; `read` restores it from one.
macro_rules! result {
    ($(#[$doc:meta])* $name:ident($inner:ty), $read:expr) => {
        $(#[$doc])*
        #[pyclass(frozen, module = "eigentol")]
        pub(crate) struct $name(pub(crate) $inner);

        #[pymethods]
        impl $name {
            fn __repr__(&self) -> String {
                self.0.text()
            }

            fn _repr_html_(&self) -> String {
                $crate::results::html(&self.__repr__(), &self.0.all_tables())
            }

            fn __eq__(&self, other: &Self) -> bool {
                matches!((self.0.document(), other.0.document()), (Ok(own), Ok(other)) if own == other)
            }

            fn __reduce__<'py>(
                slf: &Bound<'py, Self>,
            ) -> PyResult<(Bound<'py, PyAny>, (String, String))> {
                let own = slf.get();
                Ok((slf.get_type().getattr("_restored")?, (own.to_json(slf.py())?, own.__repr__())))
            }

            #[classmethod]
            fn _restored(class: &Bound<'_, pyo3::types::PyType>, document: &str, text: &str) -> PyResult<Self> {
                $read(document, Some(text)).map(Self).map_err(|error| $crate::results::refused(class.py(), &error))
            }

            /// A table of the result as a dictionary, a column for each heading ("frequency [rad/s]"), which
            /// pandas.DataFrame and polars.DataFrame take. Values are in declared units. Without a name it is the
            /// first, the answer.
            #[pyo3(signature = (name=None))]
            fn table<'py>(
                &self,
                py: Python<'py>,
                name: Option<&str>,
            ) -> PyResult<$crate::hints::Table<'py>> {
                $crate::results::table(py, &self.0.all_tables(), name)
            }

            /// Draws the figure of the result on matplotlib axes, new ones unless `ax` is given: one pair, or as many as
            /// the figure has panels. Returns the axes.
            ///
            /// Raises TypeError for a result that has no figure, ImportError without matplotlib.
            #[pyo3(signature = (ax=None))]
            fn plot<'py>(
                &self,
                py: Python<'py>,
                ax: Option<$crate::hints::Anything<'py>>,
            ) -> PyResult<$crate::hints::Anything<'py>> {
                $crate::figures::plot(py, self.0.figure(), ax)
            }

            /// A table of the result as a pandas.DataFrame; without a name the first, the answer.
            #[pyo3(signature = (name=None))]
            fn to_frame<'py>(
                &self,
                py: Python<'py>,
                name: Option<&str>,
            ) -> PyResult<$crate::hints::Anything<'py>> {
                $crate::figures::frame(py, $crate::results::table(py, &self.0.all_tables(), name)?)
            }

            /// A table of the result as an xarray.Dataset, without a name the first. Its axes are the input that varies, and
            /// what tells the rows at one value apart: the mode, the output, the excitations. Units are attributes.
            ///
            /// Raises ValueError for a table whose rows have no axes.
            #[pyo3(signature = (name=None))]
            fn to_xarray<'py>(
                &self,
                py: Python<'py>,
                name: Option<&str>,
            ) -> PyResult<$crate::hints::Anything<'py>> {
                $crate::figures::dataset(py, $crate::results::table(py, &self.0.all_tables(), name)?, name)
            }

            /// The result as a JSON document, with every digit: what `eigentol --json` prints. Its schema is
            /// `eigentol.json_schema()`; under "result" it holds every number of the result, SI.
            fn to_json(&self, py: Python<'_>) -> PyResult<String> {
                self.0.document().map_err(|error| $crate::results::refused(py, &error))
            }

            /// The result that such a document holds, bit for bit. Raises InvalidValue for another text.
            #[classmethod]
            fn from_json(class: &Bound<'_, pyo3::types::PyType>, text: &str) -> PyResult<Self> {
                $read(text, None).map(Self).map_err(|error| $crate::results::refused(class.py(), &error))
            }

            /// Names of the tables.
            #[getter]
            fn tables(&self) -> Vec<String> {
                self.0.all_tables().into_iter().map(|x| x.name).collect()
            }

            /// The sentences of its text: what to know besides the tables.
            #[getter]
            fn notes(&self) -> Vec<String> {
                self.0.notes()
            }

            /// Name of the mechanism; None where the result is an empty list.
            #[getter]
            fn mechanism(&self) -> Option<String> {
                self.0.mechanism()
            }

            /// The inputs it belongs to, SI, by name, without one that varies; empty where derivatives are all there is.
            #[getter]
            fn operating_point(&self) -> std::collections::BTreeMap<String, f64> {
                self.0.operating_point()
            }
        }
    };
}
pub(crate) use result;

/// Attributes of classes, each with its docstring, type and value; with a word, methods that take it, such as the name of a
/// quantity.
macro_rules! attributes {
    ($class:ident($own:ident, $py:ident) {
        $($(#[$doc:meta])* $name:ident: $type:ty = $value:expr;)+
    }) => {
        #[pymethods]
        impl $class {
            $(
                $(#[$doc])*
                #[getter]
                fn $name<'py>(&$own, $py: Python<'py>) -> $type {
                    let _ = $py;
                    $value
                }
            )+
        }
    };
    ($class:ident($own:ident, $py:ident, $word:ident: $words:ty = $usual:tt) {
        $($(#[$doc:meta])* $name:ident: $type:ty = $value:expr;)+
    }) => {
        #[pymethods]
        impl $class {
            $(
                $(#[$doc])*
                #[pyo3(signature = ($word=$usual))]
                fn $name<'py>(&$own, $py: Python<'py>, $word: &$words) -> PyResult<$type> {
                    $value
                }
            )+
        }
    };
}
pub(crate) use attributes;

/// The exception for a document that cannot be written or read.
pub(crate) fn refused(py: Python<'_>, error: &eigentol_tables::Error) -> PyErr {
    let kind = match error {
        eigentol_tables::Error::Write(_) => Kind::Error,
        _ => Kind::InvalidValue,
    };
    new(py, kind, error.to_string())
}

/// The JSON Schema of the documents that `to_json` gives, as a text.
#[pyfunction]
pub(crate) fn json_schema() -> &'static str {
    eigentol_tables::json::SCHEMA
}

/// The table with this name, or the first, as a dictionary.
pub(crate) fn table<'py>(py: Python<'py>, all: &[Table], name: Option<&str>) -> PyResult<hints::Table<'py>> {
    let found = match name {
        None => all.first(),
        Some(name) => all.iter().find(|x| x.name == name),
    };
    if let Some(found) = found {
        return dictionary(py, found);
    }
    let name = name.unwrap_or_default();
    let known: Vec<&str> = all.iter().map(|x| x.name.as_str()).collect();
    let near = did_you_mean(name, known.iter().copied());
    let message = format!("there is no table `{name}`: there are {}{near}", known.join(", "));
    Err(new(py, Kind::UnknownName, message))
}

/// Numbers become arrays with NaN for missing ones, words and flags lists with None.
fn dictionary<'py>(py: Python<'py>, table: &Table) -> PyResult<Bound<'py, PyDict>> {
    let columns = PyDict::new(py);
    for each in &table.columns {
        columns.set_item(each.heading(), column(py, each)?)?;
    }
    Ok(columns)
}

pub(crate) fn column<'py>(py: Python<'py>, column: &Column) -> PyResult<Bound<'py, PyAny>> {
    Ok(match &column.values {
        Values::Numbers(values) => optional(py, values.iter().copied()).into_any(),
        Values::Whole(values) => match values.iter().copied().collect::<Option<Vec<i64>>>() {
            Some(whole) => vector(py, whole).into_any(),
            None => optional(py, values.iter().map(|value| value.map(|x| x as f64))).into_any(),
        },
        Values::Texts(values) => values.clone().into_pyobject(py)?,
        Values::Flags(values) => values.clone().into_pyobject(py)?,
    })
}

/// HTML for a notebook: the text, followed by collapsible tables.
pub(crate) fn html(report: &str, all: &[Table]) -> String {
    let mut text = format!("<pre>{}</pre>", escaped(report));
    for table in all.iter().filter(|x| x.rows() > 0) {
        let _ = write!(text, "<details><summary>{}</summary><table><thead><tr>", escaped(&table.name));
        for column in &table.columns {
            let _ = write!(text, "<th>{}</th>", escaped(&column.heading()));
        }
        text += "</tr></thead><tbody>";
        for row in 0..table.rows() {
            text += "<tr>";
            for column in &table.columns {
                let _ = write!(text, "<td>{}</td>", escaped(&cell(column, row)));
            }
            text += "</tr>";
        }
        text += "</tbody></table></details>";
    }
    text
}

/// One entry, numbers with six digits.
fn cell(column: &Column, row: usize) -> String {
    let shown = match &column.values {
        Values::Numbers(values) => values[row].map(number),
        Values::Whole(values) => values[row].map(|value| value.to_string()),
        Values::Texts(values) => values[row].clone(),
        Values::Flags(values) => values[row].map(|yes| if yes { "yes" } else { "no" }.to_owned()),
    };
    shown.unwrap_or_default()
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
