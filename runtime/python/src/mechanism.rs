//! A mechanism read from a text.

use std::collections::BTreeMap;
use std::path::PathBuf;

use eigentol::Role;
use eigentol_interpreter::{Interpreted, UnitError};
use pyo3::prelude::*;
use pyo3::types::{IntoPyDict, PyDict, PyType};

use crate::errors::{self, Kind, new};
use crate::names;
use crate::results::attributes;
use crate::values::{List, refused};

/// A mechanism: names, units and kernels.
///
/// It comes from a declaration in the language of eigentol, by `from_file` or `from_text`.
#[pyclass(frozen, module = "eigentol")]
pub(crate) struct Mechanism {
    pub(crate) inner: Interpreted,
    text: String,
    /// Where it was read from.
    pub(crate) file: Option<PathBuf>,
    /// Units in which answers are stated, by name, and the unit of frequencies.
    pub(crate) stated: (BTreeMap<String, String>, Option<String>),
}

impl Mechanism {
    fn of_roles(&self, wanted: impl Fn(Role) -> bool) -> Vec<&str> {
        let of = self.inner.description();
        names::coordinates(of)
            .into_iter()
            .zip(of.coordinates.iter())
            .filter(|(_, info)| wanted(info.role))
            .map(|(name, _)| name)
            .collect()
    }

    /// A mechanism that states its answers in these units, and frequencies in this one.
    pub(crate) fn with_units(
        py: Python<'_>,
        mut machine: Interpreted,
        units: &BTreeMap<String, String>,
        frequency: Option<&str>,
    ) -> PyResult<Interpreted> {
        for (name, unit) in units {
            machine = machine.in_unit(name, unit).map_err(|error| match error {
                UnitError::Mistakes(mistakes) => refused(py, unit, &mistakes),
                other => new(py, Kind::UnknownName, other.to_string()),
            })?;
        }
        match frequency {
            None => Ok(machine),
            Some(unit) => machine.frequencies_in(unit).map_err(|mistakes| refused(py, unit, &mistakes)),
        }
    }

    /// Reads the mechanism declared in a text.
    pub(crate) fn read(py: Python<'_>, text: String) -> PyResult<Self> {
        match py.detach(|| Interpreted::from_text(&text)) {
            Ok(inner) => Ok(Self { inner, text, file: None, stated: Default::default() }),
            Err(mistakes) => Err(errors::declaration(py, &mistakes, None)),
        }
    }
}

/// What a mechanism is restored from: text, units, unit of frequencies.
type Restored = (String, BTreeMap<String, String>, Option<String>);

/// In Python `dict[str, float]`.
type Nominal<'py> = Bound<'py, PyDict>;

/// In Python `dict[str, str]`.
type Units<'py> = Bound<'py, PyDict>;

attributes! {
    Mechanism(self, py) {
        /// Its name.
        name: String = self.inner.description().name.to_string();
        /// Names of the unknowns in the order of arrays: coordinates (rad or m), after them those whose speed is the
        /// unknown (SI), after these the reactions of constraints (SI).
        unknowns: Vec<&str> = names::coordinates(self.inner.description());
        /// Names of the coordinates, those among them whose speed is the unknown: `eigentol check` counts the same.
        coordinates: Vec<&str> = self.of_roles(|role| matches!(role, Role::Position | Role::Speed));
        /// Names of the coordinates of which the speed, not the position, is the unknown.
        speeds: Vec<&str> = self.of_roles(|role| role == Role::Speed);
        /// Names of the reactions of constraints.
        reactions: Vec<&str> = self.of_roles(|role| !matches!(role, Role::Position | Role::Speed));
        /// Names of the inputs in the order of arrays.
        inputs: Vec<&str> = names::inputs(self.inner.description());
        /// Names of the design variables in the order of arrays.
        design: Vec<&str> = names::design(self.inner.description());
        /// Names of the outputs in the order of arrays.
        outputs: Vec<&str> = names::outputs(self.inner.description());
        /// Names of the excitations in the order of arrays.
        excitations: Vec<&str> = names::excitations(self.inner.description());
        /// What each excitation was declared as: "unbalance", "harmonic" or "shaken".
        excitation_kinds: Vec<&str> =
            self.inner.description().excitations.iter().map(|excitation| &*excitation.kind).collect();
        /// The frequency of each excitation in terms of the speeds of running coordinates: "1 spin"; empty for a frequency
        /// of its own.
        excitation_orders: Vec<&str> =
            self.inner.description().excitations.iter().map(|excitation| &*excitation.order).collect();
        /// The harmonics of a forced response, each a list of the excitations that have one frequency in every design.
        harmonics: Vec<Vec<&str>> = names::harmonics(self.inner.description());
        /// The nominal design, SI, by name.
        nominal: PyResult<Nominal<'py>> = {
            self.inner.description().design.iter().map(|x| (&*x.name, x.nominal)).into_py_dict(py)
        };
        /// The declared unit of every input, design variable, unknown and output, by name: "rpm".
        units: PyResult<Units<'py>> = {
            let of = self.inner.description();
            let outputs = of.outputs.iter().map(|output| (output.name.clone(), output.unit.clone()));
            let lists = [List::Coordinates, List::Design, List::Inputs];
            outputs.chain(lists.into_iter().flat_map(|list| list.quantities(of)).map(|other| (other.name, other.unit))).map(|(name, unit)| (name.to_string(), unit.symbol.to_string())).into_py_dict(py)
        };
    }
}

#[pymethods]
impl Mechanism {
    /// The mechanism that a file declares.
    ///
    /// Raises OSError (FileNotFoundError ...) when the file cannot be read, DeclarationError with line and column of
    /// every mistake.
    #[classmethod]
    fn from_file(class: &Bound<'_, PyType>, path: PathBuf) -> PyResult<Self> {
        let py = class.py();
        let read = || {
            let inner = Interpreted::from_file(&path)?;
            Ok((inner, std::fs::read_to_string(&path).unwrap_or_default()))
        };
        let (inner, text) = py.detach(read).map_err(|error| errors::file(py, error))?;
        Ok(Self { inner, text, file: Some(path), stated: Default::default() })
    }

    /// The mechanism that a text declares: `mechanism Name { ... }`.
    ///
    /// Raises DeclarationError with line and column of every mistake.
    #[classmethod]
    fn from_text(class: &Bound<'_, PyType>, text: String) -> PyResult<Self> {
        Self::read(class.py(), text)
    }

    /// The declaration.
    #[getter]
    pub(crate) fn text(&self) -> &str {
        &self.text
    }

    fn __repr__(&self, py: Python<'_>) -> String {
        let of = self.inner.description();
        let listed = |names: Vec<&str>| if names.is_empty() { "none".to_owned() } else { names.join(", ") };
        format!(
            "Mechanism {}\n  coordinates: {}\n  reactions: {}\n  inputs: {}\n  design: {}\n  outputs: {}\n  excitations: {}",
            of.name,
            listed(self.coordinates(py)),
            listed(self.reactions(py)),
            listed(names::inputs(of)),
            listed(names::design(of)),
            listed(names::outputs(of)),
            listed(names::excitations(of)),
        )
    }

    /// The same mechanism, whose answers state inputs, design variables, coordinates and outputs in these units, by name, and
    /// frequencies in the unit `frequency`: `mechanism.in_units({"orbit": "um"}, frequency="Hz")`. Arrays stay in SI.
    ///
    /// Raises UnknownName for a name that nothing has, InvalidValue for a text that is no unit of it.
    #[pyo3(signature = (units=None, frequency=None))]
    fn in_units(
        &self,
        py: Python<'_>,
        units: Option<BTreeMap<String, String>>,
        frequency: Option<String>,
    ) -> PyResult<Self> {
        let units = units.unwrap_or_default();
        let inner = Self::with_units(py, self.inner.clone(), &units, frequency.as_deref())?;
        let (mut known, last) = self.stated.clone();
        known.extend(units);
        Ok(Self { inner, text: self.text.clone(), file: self.file.clone(), stated: (known, frequency.or(last)) })
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Restored)> {
        let own = slf.get();
        let (units, frequency) = own.stated.clone();
        Ok((slf.get_type().getattr("_restored")?, (own.text.clone(), units, frequency)))
    }

    #[classmethod]
    fn _restored(
        class: &Bound<'_, PyType>,
        text: String,
        units: BTreeMap<String, String>,
        frequency: Option<String>,
    ) -> PyResult<Self> {
        Self::read(class.py(), text)?.in_units(class.py(), Some(units), frequency)
    }
}
