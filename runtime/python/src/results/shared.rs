//! Features common to all results: text, tables, and HTML for notebooks.
//!
//! # Python sees what Rust sees
//!
//! `runtime/python` wraps each result in one class (`results/shared.rs`): arrays by getters, text by its report, tables
//! by `runtime/tables`. Every question releases the interpreter's lock. `eigentol.pyi` states the types by hand; a test
//! compares it with the module. The crate, and so the workspace, builds without Python (stable interface, symbols left
//! open).

use std::fmt::Write;

use eigentol_compiler::base::nearest::nearest;
use eigentol_tables::{Column, Table, Values};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays::{optional, vector};
use crate::errors::{Kind, new};

/// Defines a class around a result, with the text and tables of that result.
macro_rules! result {
    ($(#[$doc:meta])* $name:ident($inner:ty)) => {
        $(#[$doc])*
        #[pyclass(frozen, module = "eigentol")]
        pub(crate) struct $name(pub(crate) $inner);

        #[pymethods]
        impl $name {
            fn __repr__(&self) -> String {
                self.0.to_string()
            }

            fn _repr_html_(&self) -> String {
                $crate::results::html(&self.0.to_string(), &eigentol_tables::tables(&self.0))
            }

            /// A table of the result as a dictionary, a column for each heading ("frequency [rad/s]"), which
            /// pandas.DataFrame and polars.DataFrame take. Values are in declared units. Without a name it is the
            /// first, the answer.
            #[pyo3(signature = (name=None))]
            fn table<'py>(
                &self,
                py: Python<'py>,
                name: Option<&str>,
            ) -> PyResult<Bound<'py, pyo3::types::PyDict>> {
                $crate::results::table(py, &eigentol_tables::tables(&self.0), name)
            }

            /// The result as a JSON document, with every digit: what `eigentol --json` prints. Its schema is
            /// `eigentol.json_schema()`.
            fn to_json(&self, py: Python<'_>) -> PyResult<String> {
                use $crate::results::Document as _;
                let text = self.0.document();
                text.map_err(|error| {
                    $crate::errors::new(py, $crate::errors::Kind::Error, error.to_string())
                })
            }

            /// Names of the tables.
            #[getter]
            fn tables(&self) -> Vec<String> {
                let all = eigentol_tables::tables(&self.0);
                all.into_iter().map(|own| own.name).collect()
            }
        }
    };
}
pub(crate) use result;

/// A result that a JSON document can hold.
pub(crate) trait Document {
    fn document(&self) -> Result<String, eigentol_tables::Error>;
}

impl<A: eigentol_tables::Answer> Document for A {
    fn document(&self) -> Result<String, eigentol_tables::Error> {
        eigentol_tables::json::to_string(self)
    }
}

/// The JSON Schema of the documents that `to_json` gives, as a text.
#[pyfunction]
pub(crate) fn json_schema() -> &'static str {
    eigentol_tables::json::SCHEMA
}

/// The table with this name, or the first, as a dictionary.
pub(crate) fn table<'py>(
    py: Python<'py>,
    all: &[Table],
    name: Option<&str>,
) -> PyResult<Bound<'py, PyDict>> {
    let found = match name {
        None => all.first(),
        Some(name) => all.iter().find(|own| own.name == name),
    };
    if let Some(found) = found {
        return dictionary(py, found);
    }
    let name = name.unwrap_or_default();
    let known: Vec<&str> = all.iter().map(|own| own.name.as_str()).collect();
    let near = nearest(name, known.iter().copied());
    let near = near.map_or_else(String::new, |near| format!("; did you mean `{near}`?"));
    let message = format!(
        "there is no table `{name}`: there are {}{near}",
        known.join(", ")
    );
    Err(new(py, Kind::UnknownName, message))
}

/// Numbers become arrays with NaN for missing values; words and other columns with missing values become lists.
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
                None => columns.set_item(heading, values.clone())?,
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
    for table in all.iter().filter(|own| own.rows() > 0) {
        let _ = write!(
            text,
            "<details><summary>{}</summary><table><thead><tr>",
            escaped(&table.name)
        );
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

/// Formats one entry, numbers with six digits.
fn cell(column: &Column, row: usize) -> String {
    let shown = match &column.values {
        Values::Numbers(values) => values[row].map(six_digits),
        Values::Whole(values) => values[row].map(|value| value.to_string()),
        Values::Texts(values) => values[row].clone(),
        Values::Flags(values) => values[row].map(|yes| if yes { "yes" } else { "no" }.to_owned()),
    };
    shown.unwrap_or_default()
}

fn six_digits(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 {
        "0".to_owned()
    } else if (1e-3..1e6).contains(&size) {
        let before = size.log10().floor() as i32;
        format!("{value:.*}", usize::try_from(5 - before).unwrap_or(0))
    } else {
        format!("{value:.5e}")
    }
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
}
