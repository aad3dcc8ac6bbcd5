//! The class of all results without one of their own: the description of a result, as Python sees it.

use std::collections::BTreeMap;

use eigentol::Input;
use eigentol_figures::{Figure, Style, figure_of};
use eigentol_tables::{Error, Table, json};
use pyo3::exceptions::PyAttributeError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

use super::result;
use super::shared::column;
use crate::arrays::vector;
use crate::errors::{Kind, new};
use crate::names::did_you_mean;

/// What a result says of itself, whatever its type.
pub(crate) trait Described: Send + Sync + 'static {
    fn text(&self) -> String;
    fn notes(&self) -> Vec<String>;
    fn all_tables(&self) -> Vec<Table>;
    fn mechanism(&self) -> Option<String>;
    fn operating_point(&self) -> BTreeMap<String, f64>;
    fn kind(&self) -> &str;
    fn document(&self) -> Result<String, Error>;
    /// Its figure, if results of this type have one.
    fn figure(&self) -> Option<Result<Figure, eigentol_figures::Error>>;
    /// Every number of it, SI, as the document has them.
    fn fields(&self) -> serde_json::Result<Value>;
}

impl<A: eigentol_tables::Answer + Serialize + Send + Sync + 'static> Described for A {
    fn text(&self) -> String {
        self.findings().to_string()
    }

    fn notes(&self) -> Vec<String> {
        self.findings().notes().map(str::to_owned).collect()
    }

    fn all_tables(&self) -> Vec<Table> {
        self.tables()
    }

    fn mechanism(&self) -> Option<String> {
        Some(self.subject()?.description.name.to_string())
    }

    fn operating_point(&self) -> BTreeMap<String, f64> {
        let Some(of) = self.subject() else {
            return BTreeMap::new();
        };
        let varied = of.varied.map(Input::index);
        let fixed = of.description.inputs.iter().zip(of.inputs).enumerate().filter(|(k, _)| Some(*k) != varied);
        fixed.map(|(_, (info, value))| (info.name.to_string(), *value)).collect()
    }

    fn kind(&self) -> &str {
        A::KIND
    }

    fn document(&self) -> Result<String, Error> {
        json::to_string(self)
    }

    fn figure(&self) -> Option<Result<Figure, eigentol_figures::Error>> {
        figure_of(self, &Style::default())
    }

    fn fields(&self) -> serde_json::Result<Value> {
        serde_json::to_value(self)
    }
}

/// A result of which there is nothing but its document.
struct Document {
    document: String,
    read: Value,
    tables: Vec<Table>,
    text: String,
}

impl Document {
    /// Of a document, and the text of the result if that is known.
    fn read(document: &str, text: Option<&str>) -> Result<Box<dyn Described>, Error> {
        let tables = json::read_tables(document.as_bytes())?;
        let read: Value = serde_json::from_str(document).map_err(|error| Error::Content(error.to_string()))?;
        let mut found = Self { document: document.to_owned(), read, tables, text: String::new() };
        found.text = text.map_or_else(|| found.outline(), str::to_owned);
        Ok(Box::new(found))
    }
}

impl Document {
    /// What can be said without the type of the result.
    fn outline(&self) -> String {
        let title = format!("{}: {}", self.mechanism().unwrap_or_default(), self.kind());
        let notes = self.notes().into_iter().map(|note| format!("  {note}"));
        std::iter::once(title).chain(notes).map(|line| line + "\n").collect()
    }
}

impl Described for Document {
    fn text(&self) -> String {
        self.text.clone()
    }

    fn notes(&self) -> Vec<String> {
        let notes = self.read["notes"].as_array().into_iter().flatten();
        notes.filter_map(|note| note.as_str().map(str::to_owned)).collect()
    }

    fn all_tables(&self) -> Vec<Table> {
        self.tables.clone()
    }

    fn mechanism(&self) -> Option<String> {
        self.read["mechanism"].as_str().map(str::to_owned)
    }

    fn operating_point(&self) -> BTreeMap<String, f64> {
        let declared = self.read["description"]["inputs"].as_array().into_iter().flatten();
        let value = |info: &Value| {
            let name = info["name"].as_str()?;
            let value = self.read["inputs"][name]["value"].as_f64()?;
            Some((name.to_owned(), value * info["unit"]["scale"].as_f64()?))
        };
        declared.filter_map(value).collect()
    }

    fn kind(&self) -> &str {
        self.read["kind"].as_str().unwrap_or_default()
    }

    fn document(&self) -> Result<String, Error> {
        Ok(self.document.clone())
    }

    fn figure(&self) -> Option<Result<Figure, eigentol_figures::Error>> {
        None
    }

    fn fields(&self) -> serde_json::Result<Value> {
        Ok(self.read["result"].clone())
    }
}

/// A typed result from its document.
pub(crate) fn typed<A: eigentol_tables::Answer + DeserializeOwned>(
    document: &str,
    _text: Option<&str>,
) -> Result<A, Error> {
    json::read(document.as_bytes())
}

result! {
    /// A result as it describes itself: what is printed, tables, and every number behind them.
    ///
    /// `answer["sigma"]` is the column of that name or heading in the first table that has one, in the unit of
    /// `answer.units["sigma"]`: an array with NaN for missing numbers, or a list of texts or flags. Attributes are the fields
    /// of the result, SI, as its document has them under "result": a number, a text, an array for lists of numbers,
    /// however deep, and an object or a list of objects for what has fields again; the last axis of complex numbers has
    /// length two, so that `x @ [1, 1j]` is the complex array. `dir(answer)` lists them. A list of results has `entries`.
    Answer(Box<dyn Described>), Document::read
}

impl Answer {
    pub(crate) fn new(result: impl Described) -> Self {
        Self(Box::new(result))
    }

    /// The fields of the result; of a list, its entries.
    fn fields<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let fields = self.0.fields().map_err(|error| new(py, Kind::Error, error.to_string()))?;
        match fields {
            Value::Array(_) => object(py, &serde_json::json!({ "entries": fields })),
            _ => object(py, &fields),
        }
    }
}

#[pymethods]
impl Answer {
    /// The column of this name or heading, in its declared unit.
    fn __getitem__<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        let tables = self.0.all_tables();
        let columns = || tables.iter().flat_map(|table| &table.columns);
        match columns().find(|x| x.name == name || x.heading() == name) {
            Some(found) => column(py, found),
            None => {
                let near = did_you_mean(name, columns().map(|x| x.name.as_str()));
                Err(new(py, Kind::UnknownName, format!("there is no column `{name}`{near}")))
            }
        }
    }

    /// A field of the result, SI.
    fn __getattr__<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        if name.starts_with('_') {
            Err(PyAttributeError::new_err(name.to_owned()))
        } else {
            self.fields(py)?.getattr(name)
        }
    }

    fn __dir__(slf: &Bound<'_, Self>) -> PyResult<Vec<String>> {
        let mut names: Vec<String> = slf.get_type().dir()?.extract()?;
        let fields = slf.get().fields(slf.py())?.getattr("__dict__")?;
        names.extend(fields.cast::<PyDict>()?.keys().extract::<Vec<String>>()?);
        Ok(names)
    }

    /// The units of the columns, by name.
    #[getter]
    fn units(&self) -> BTreeMap<String, String> {
        let tables = self.0.all_tables().into_iter();
        tables.flat_map(|table| table.columns).rev().map(|column| (column.name, column.unit)).collect()
    }

    /// Its kind, as documents name it: "first-order spread".
    #[getter]
    fn kind(&self) -> &str {
        self.0.kind()
    }
}

/// A value of a document in Python.
fn object<'py>(py: Python<'py>, value: &Value) -> PyResult<Bound<'py, PyAny>> {
    if let (Value::Array(_), Some((shape, numbers))) = (value, array(value)) {
        let array = vector(py, numbers).into_any().call_method1("reshape", (shape,))?;
        return if whole(value) { array.call_method1("astype", ("int64",)) } else { Ok(array) };
    }
    Ok(match value {
        Value::Null => py.None().into_bound(py),
        Value::Bool(yes) => yes.into_pyobject(py)?.to_owned().into_any(),
        Value::Number(number) => match (number.as_u64(), number.as_i64()) {
            (Some(whole), _) => whole.into_pyobject(py)?.into_any(),
            (None, Some(whole)) => whole.into_pyobject(py)?.into_any(),
            _ => number.as_f64().into_pyobject(py)?,
        },
        Value::String(text) => match infinite(text) {
            Some(number) => number.into_pyobject(py)?.into_any(),
            None => text.into_pyobject(py)?.into_any(),
        },
        Value::Array(all) => {
            let each: Vec<_> = all.iter().map(|value| object(py, value)).collect::<PyResult<_>>()?;
            PyList::new(py, each)?.into_any()
        }
        // What was found, in place of how a failure would be told.
        Value::Object(fields) if fields.len() == 1 && fields.contains_key("Ok") => object(py, &fields["Ok"])?,
        Value::Object(fields) => {
            let named = PyDict::new(py);
            for (name, value) in fields.iter().filter(|(name, _)| *name != "description") {
                named.set_item(name, object(py, value)?)?;
            }
            py.import("types")?.getattr("SimpleNamespace")?.call((), Some(&named))?
        }
    })
}

/// Infinity as documents write it.
fn infinite(text: &str) -> Option<f64> {
    match text {
        "Infinity" => Some(f64::INFINITY),
        "-Infinity" => Some(f64::NEG_INFINITY),
        _ => None,
    }
}

/// Shape and entries of nested lists of numbers, with NaN for what is missing.
fn array(value: &Value) -> Option<(Vec<usize>, Vec<f64>)> {
    let all = match value {
        Value::Array(all) => all,
        Value::String(text) => return Some((Vec::new(), vec![infinite(text)?])),
        other => return Some((Vec::new(), vec![other.as_f64()?])),
    };
    let parts: Vec<_> = all.iter().map(|x| (!x.is_null()).then(|| array(x))).collect();
    let shape = parts.iter().flatten().next()?.as_ref()?.0.clone();
    let missing = vec![f64::NAN; shape.iter().product()];
    let mut entries = Vec::new();
    for part in parts {
        match part {
            Some(part) => {
                let (_, numbers) = part.filter(|(other, _)| *other == shape)?;
                entries.extend(numbers);
            }
            None => entries.extend(&missing),
        }
    }
    Some(([vec![all.len()], shape].concat(), entries))
}

/// Whether all numbers are whole ones, such as positions.
fn whole(value: &Value) -> bool {
    match value {
        Value::Array(all) => all.iter().all(whole),
        other => other.is_u64() || other.is_i64(),
    }
}
