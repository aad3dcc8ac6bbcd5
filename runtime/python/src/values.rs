//! Numbers and names passed from Python.

use eigentol::{Description, Error, Text, Unit};
use eigentol_interpreter::{Mistakes, WantedError, value};
use numpy::{AllowTypeChange, PyArrayLike1};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyInt, PyString};

use crate::errors::{Kind, invalid, new, raise};
use crate::names::did_you_mean;

/// A finite number, SI, given as a number or as text with a unit.
pub(crate) fn number(given: &Bound<'_, PyAny>, unit: &Unit, name: &str) -> PyResult<f64> {
    let py = given.py();
    let what = format!("`{name}`");
    let parsed = match given.cast::<PyString>() {
        Ok(text) => {
            let text = text.to_cow()?;
            value(&text, unit, &what).map_err(|mistakes| refused(py, &text, &mistakes))?
        }
        Err(_) => given.extract::<f64>().map_err(|_| {
            if given.is_instance_of::<PyInt>() {
                invalid(py, format!("`{name}`: the number is too large"))
            } else {
                wrong_type(given, name)
            }
        })?,
    };
    if parsed.is_finite() { Ok(parsed) } else { Err(not_finite(py, name, parsed)) }
}

pub(crate) fn not_finite(py: Python<'_>, name: &str, value: f64) -> PyErr {
    invalid(py, format!("`{name}` is {value}: give a finite value"))
}

pub(crate) fn all_finite(py: Python<'_>, name: &str, values: &[f64]) -> PyResult<()> {
    values.iter().find(|value| !value.is_finite()).map_or(Ok(()), |value| Err(not_finite(py, name, *value)))
}

/// The index of a mode, from 0.
pub(crate) fn mode_number(py: Python<'_>, mode: i64) -> PyResult<usize> {
    usize::try_from(mode).map_err(|_| invalid(py, format!("mode {mode}: modes are counted from 0")))
}

/// A response or a requirement.
pub(crate) fn text(given: &Bound<'_, PyAny>, example: &str) -> PyResult<String> {
    given
        .extract()
        .map_err(|_| PyTypeError::new_err(format!("a text is needed, such as \"{example}\"; modes count from 1")))
}

/// The exception for a text that is no response or requirement.
pub(crate) fn meaningless(py: Python<'_>, error: WantedError) -> PyErr {
    match error {
        WantedError::Meaning { message, help } => invalid(py, format!("{message}; {help}")),
        WantedError::Value { place, mistakes } => refused(py, &place, &mistakes),
        WantedError::Name(error) => raise(py, error),
        other => invalid(py, other.to_string()),
    }
}

/// The exception for a text that is not a value.
pub(crate) fn refused(py: Python<'_>, text: &str, mistakes: &Mistakes) -> PyErr {
    let each = mistakes.iter().map(|mistake| match &mistake.help {
        Some(help) => format!("{} ({help})", mistake.message),
        None => mistake.message.clone(),
    });
    let each: Vec<String> = each.collect();
    invalid(py, format!("\"{text}\": {}", each.join("; ")))
}

pub(crate) fn wrong_type(given: &Bound<'_, PyAny>, name: &str) -> PyErr {
    let kind = given.get_type().name();
    let kind = kind.map_or_else(|_| "this".to_owned(), |kind| kind.to_string());
    PyTypeError::new_err(format!(
        "`{name}`: a number (SI) or a text with a unit such as \"3000 rpm\" is needed, not {kind}"
    ))
}

/// A quantity with a name and a unit.
#[derive(Clone)]
pub(crate) struct Quantity {
    pub(crate) name: Text,
    pub(crate) unit: Unit,
}

/// What a list of numbers belongs to.
#[derive(Clone, Copy)]
pub(crate) enum List {
    Coordinates,
    Inputs,
    Design,
}

impl List {
    pub(crate) fn kind(self) -> &'static str {
        match self {
            Self::Coordinates => "coordinate",
            Self::Inputs => "input",
            Self::Design => "design variable",
        }
    }

    pub(crate) fn quantities(self, of: &Description) -> Vec<Quantity> {
        match self {
            Self::Coordinates => named(of.coordinates.iter().map(|coordinate| (&coordinate.name, &coordinate.unit))),
            Self::Inputs => named(of.inputs.iter().map(|input| (&input.name, &input.unit))),
            Self::Design => named(of.design.iter().map(|variable| (&variable.name, &variable.unit))),
        }
    }

    /// The default values, SI.
    fn usual(self, of: &Description) -> Vec<f64> {
        match self {
            Self::Coordinates => vec![0.0; of.coordinates.len()],
            Self::Inputs => vec![0.0; of.inputs.len()],
            Self::Design => of.design.iter().map(|variable| variable.nominal).collect(),
        }
    }

    /// Index and unit of the entry with this name.
    pub(crate) fn find(self, py: Python<'_>, of: &Description, name: &str) -> PyResult<(usize, Unit)> {
        let quantities = self.quantities(of);
        if let Some(index) = quantities.iter().position(|one| one.name == *name) {
            return Ok((index, quantities[index].unit.clone()));
        }
        Err(unknown(py, of, self, name))
    }

    /// A value for each entry, SI: from a dictionary of names that overrides the defaults, or from a list.
    pub(crate) fn read(self, py: Python<'_>, of: &Description, given: Option<&Bound<'_, PyAny>>) -> PyResult<Vec<f64>> {
        self.over(self.usual(of), py, of, given)
    }

    /// Overrides these values by name, or replaces them by a list.
    fn over(
        self,
        mut values: Vec<f64>,
        py: Python<'_>,
        of: &Description,
        given: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Vec<f64>> {
        let Some(given) = given.filter(|given| !given.is_none()) else {
            return Ok(values);
        };
        if let Ok(named) = given.cast::<PyDict>() {
            for (name, value) in named {
                let name = name.extract::<String>()?;
                let (index, unit) = self.find(py, of, &name)?;
                values[index] = number(&value, &unit, &name)?;
            }
            return Ok(values);
        }
        let list = numbers(given, self.kind())?;
        if list.len() == values.len() {
            Ok(list)
        } else {
            Err(raise(py, Error::WrongLength { kind: self.plural(), found: list.len(), expected: values.len() }))
        }
    }

    /// A change for each entry, SI; zero for names not given.
    pub(crate) fn changes(
        self,
        py: Python<'_>,
        of: &Description,
        given: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Vec<f64>> {
        self.over(vec![0.0; self.usual(of).len()], py, of, given)
    }

    fn plural(self) -> &'static str {
        match self {
            Self::Coordinates => "coordinates",
            Self::Inputs => "inputs",
            Self::Design => "design variables",
        }
    }
}

fn named<'a>(all: impl Iterator<Item = (&'a Text, &'a Unit)>) -> Vec<Quantity> {
    let quantity = |(name, unit): (&Text, &Unit)| Quantity { name: name.clone(), unit: unit.clone() };
    all.map(quantity).collect()
}

/// The exception for a name missing from this list; another list may have it.
fn unknown(py: Python<'_>, of: &Description, list: List, name: &str) -> PyErr {
    let other = [List::Coordinates, List::Inputs, List::Design]
        .into_iter()
        .find(|other| other.quantities(of).iter().any(|one| one.name == *name));
    let quantities = list.quantities(of);
    if let Some(other) = other {
        let (mechanism, kind, other) = (&of.name, list.kind(), other.kind());
        let article = if other == "input" { "an" } else { "a" };
        let message = format!("`{mechanism}` has no {kind} `{name}`: that is {article} {other}");
        return new(py, Kind::UnknownName, message);
    }
    let error = Error::UnknownName {
        kind: list.kind(),
        name: name.to_owned(),
        mechanism: of.name.clone(),
        known: quantities.into_iter().map(|one| one.name).collect(),
    };
    raise(py, error)
}

/// A list of numbers.
pub(crate) fn numbers(given: &Bound<'_, PyAny>, name: &str) -> PyResult<Vec<f64>> {
    match given.extract::<PyArrayLike1<'_, f64, AllowTypeChange>>() {
        Ok(array) => Ok(array.as_array().iter().copied().collect()),
        Err(_) => {
            Err(PyTypeError::new_err(format!("`{name}`: a list or a one-dimensional array of numbers is needed")))
        }
    }
}

/// One of several words.
pub(crate) fn word<T: Copy>(py: Python<'_>, what: &str, given: &str, words: &[(&'static str, T)]) -> PyResult<T> {
    if let Some((_, meaning)) = words.iter().find(|(word, _)| *word == given) {
        return Ok(*meaning);
    }
    let known: Vec<&str> = words.iter().map(|(word, _)| *word).collect();
    let near = did_you_mean(given, known.iter().copied());
    let message = format!("{what} `{given}`: one of {} is needed{near}", known.join(", "));
    Err(invalid(py, message))
}
