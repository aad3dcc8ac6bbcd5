//! Features common to all results: text, tables, and HTML for notebooks.
//!
//! # Python sees what Rust sees
//!
//! `runtime/python` wraps each result in one class (`results/shared.rs`): arrays by getters; text, sentences and tables
//! by what the result says of itself (`Answer`). Every question releases the interpreter's lock. `eigentol.pyi` is
//! generated from this source by a test, which `UPDATE_STUB=1` lets write it. The crate, and so the workspace, builds
//! without Python (stable interface, symbols left open).

use std::collections::BTreeMap;
use std::fmt::Write;

use eigentol::Input;
use eigentol_results::numbers::number;
use eigentol_tables::{Column, Subject, Table, Values};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays::{optional, vector};
use crate::errors::{Kind, new};
use crate::hints;
use crate::names::did_you_mean;

/// Defines a class around a result, with the text, tables and document of that result; a document restores it.
macro_rules! result {
    ($(#[$doc:meta])* $name:ident($inner:ty)) => {
        $(#[$doc])*
        #[pyclass(frozen, module = "eigentol")]
        pub(crate) struct $name(pub(crate) $inner);

        #[pymethods]
        impl $name {
            fn __repr__(&self) -> String {
                eigentol_tables::Answer::findings(&self.0).to_string()
            }

            fn _repr_html_(&self) -> String {
                $crate::results::html(&self.__repr__(), &eigentol_tables::Answer::tables(&self.0))
            }

            fn __eq__(&self, other: &Self) -> bool {
                self.0 == other.0
            }

            fn __reduce__<'py>(
                slf: &Bound<'py, Self>,
            ) -> PyResult<(Bound<'py, PyAny>, (String,))> {
                let text = slf.get().to_json(slf.py())?;
                Ok((slf.get_type().getattr("from_json")?, (text,)))
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
                $crate::results::table(py, &eigentol_tables::Answer::tables(&self.0), name)
            }

            /// The result as a JSON document, with every digit: what `eigentol --json` prints. Its schema is
            /// `eigentol.json_schema()`; under "result" it holds every number of the result, SI.
            fn to_json(&self, py: Python<'_>) -> PyResult<String> {
                let text = eigentol_tables::json::to_string(&self.0);
                text.map_err(|error| $crate::results::refused(py, &error))
            }

            /// The result that such a document holds, bit for bit. Raises InvalidValue for another text.
            #[classmethod]
            fn from_json(class: &Bound<'_, pyo3::types::PyType>, text: &str) -> PyResult<Self> {
                let read = eigentol_tables::json::read(text.as_bytes());
                read.map(Self).map_err(|error| $crate::results::refused(class.py(), &error))
            }

            /// Names of the tables.
            #[getter]
            fn tables(&self) -> Vec<String> {
                let all = eigentol_tables::Answer::tables(&self.0);
                all.into_iter().map(|x| x.name).collect()
            }

            /// The sentences of its text: what to know besides the tables.
            #[getter]
            fn notes(&self) -> Vec<String> {
                let found = eigentol_tables::Answer::findings(&self.0);
                found.notes().map(str::to_owned).collect()
            }

            /// Name of the mechanism; None where the result is an empty list.
            #[getter]
            fn mechanism(&self) -> Option<String> {
                let subject = eigentol_tables::Answer::subject(&self.0)?;
                Some(subject.description.name.to_string())
            }

            /// The inputs it belongs to, SI, by name, without one that varies; empty where derivatives are all there is.
            #[getter]
            fn operating_point(&self) -> std::collections::BTreeMap<String, f64> {
                $crate::results::operating_point(eigentol_tables::Answer::subject(&self.0))
            }
        }
    };
}
pub(crate) use result;

/// Attributes of classes, each with its docstring, type and value; with a word, methods that take it, such as the name of a
/// quantity.
macro_rules! attributes {
    ($class:ident, $($other:ident),+ ($own:ident, $py:ident) $all:tt) => {
        $crate::results::attributes! { $class($own, $py) $all }
        $crate::results::attributes! { $($other),+ ($own, $py) $all }
    };
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

pub(crate) fn operating_point(of: Option<Subject<'_>>) -> BTreeMap<String, f64> {
    let Some(of) = of else {
        return BTreeMap::new();
    };
    let varied = of.varied.map(Input::index);
    let each = of.description.inputs.iter().zip(of.inputs).enumerate();
    let fixed = each.filter(|(k, _)| Some(*k) != varied);
    fixed.map(|(_, (info, value))| (info.name.to_string(), *value)).collect()
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
    for column in &table.columns {
        let heading = column.heading();
        match &column.values {
            Values::Numbers(values) => {
                columns.set_item(heading, optional(py, values.iter().copied()))?;
            }
            Values::Whole(values) => match values.iter().copied().collect::<Option<Vec<i64>>>() {
                Some(whole) => columns.set_item(heading, vector(py, whole))?,
                None => {
                    let values = values.iter().map(|value| value.map(|x| x as f64));
                    columns.set_item(heading, optional(py, values))?;
                }
            },
            Values::Texts(values) => columns.set_item(heading, values.clone())?,
            Values::Flags(values) => columns.set_item(heading, values.clone())?,
        }
    }
    Ok(columns)
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
