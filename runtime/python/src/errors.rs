//! Errors as Python exceptions.

use std::path::Path;

use eigentol::Error;
use eigentol_interpreter::{Mistakes, ReadError};
use pyo3::exceptions::PyOSError;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyDict, PyTuple, PyType};

use crate::names::did_you_mean;

/// One mistake in a declaration.
#[pyclass(frozen, get_all, new = "from_fields", module = "eigentol")]
pub(crate) struct Mistake {
    /// Line, from 1.
    line: usize,
    /// Column of its first character, from 1.
    column: usize,
    /// Line of its end.
    end_line: usize,
    /// Column behind its last character.
    end_column: usize,
    /// What is wrong.
    message: String,
    /// What to do, or None.
    help: Option<String>,
}

#[pymethods]
impl Mistake {
    fn __getnewargs__(&self) -> (usize, usize, usize, usize, &str, Option<&str>) {
        let (start, end) = ((self.line, self.column), (self.end_line, self.end_column));
        (start.0, start.1, end.0, end.1, &self.message, self.help.as_deref())
    }

    fn __repr__(&self) -> String {
        format!("{}:{}: {}", self.line, self.column, self.message)
    }
}

/// Defines the exceptions: documentation, name, base in Python besides the first of them, attributes with their types.
macro_rules! exceptions {
    ($($(#[doc = $doc:literal])+ $kind:ident($base:literal $(, $attribute:literal)*);)+) => {
        /// Which exception it is.
        #[derive(Clone, Copy)]
        pub(crate) enum Kind {
            $($kind,)+
        }

        /// Name, base, documentation and attributes in the order of [`Kind`].
        const KINDS: &[(&str, &str, &str, &[&str])] =
            &[$((stringify!($kind), $base, concat!($($doc),+), &[$($attribute),*])),+];
    };
}

exceptions! {
    /// Any failure of this module.
    Error("Exception");
    /// A text declares no mechanism. `mistakes` lists what is wrong, each with `line`, `column`, `end_line`,
    /// `end_column`, `message` and `help`; `path` is the file, or None.
    DeclarationError("ValueError", "mistakes: list[Mistake]", "path: PathLike[str] | None");
    /// A value, unit, setting or list makes no sense (also a ValueError).
    InvalidValue("ValueError");
    /// Nothing has this name (also a LookupError).
    UnknownName("LookupError");
    /// No equilibrium was found from the start values. `coordinates` is the last state, SI.
    NoEquilibrium("", "coordinates: list[float]");
    /// The constraints cannot be met together from the start values. `coordinates` is the last state, SI.
    NotAssembled("", "coordinates: list[float]");
    /// The modes were not found.
    NoModes("");
    /// There is no steady vibration: nothing excites it, or it resonates without damping.
    NoVibration("");
    /// A derivative does not exist at this state.
    NoDerivative("");
    /// What was looked for is not in the range of the input.
    NotInRange("");
}

static TYPES: PyOnceLock<Vec<Py<PyType>>> = PyOnceLock::new();

fn types(py: Python<'_>) -> PyResult<&Vec<Py<PyType>>> {
    TYPES.get_or_try_init(py, || {
        let builtins = py.import("builtins")?;
        let mut all: Vec<Py<PyType>> = Vec::new();
        for (name, base, doc, _) in KINDS {
            let mut bases: Vec<Bound<'_, PyAny>> = Vec::new();
            bases.extend(all.first().map(|x| x.bind(py).clone().into_any()));
            if !base.is_empty() {
                bases.push(builtins.getattr(*base)?);
            }
            let namespace = PyDict::new(py);
            namespace.set_item("__module__", "eigentol")?;
            namespace.set_item("__doc__", doc.trim_start())?;
            let made = py.get_type::<PyType>();
            all.push(made.call1((name, PyTuple::new(py, bases)?, namespace))?.cast_into::<PyType>()?.unbind());
        }
        Ok(all)
    })
}

pub(crate) fn add_to(module: &Bound<'_, PyModule>) -> PyResult<()> {
    for exception in types(module.py())? {
        let exception = exception.bind(module.py());
        module.add(exception.name()?, exception)?;
    }
    Ok(())
}

/// An exception with a message.
pub(crate) fn new(py: Python<'_>, kind: Kind, message: String) -> PyErr {
    match types(py) {
        Ok(all) => PyErr::from_type(all[kind as usize].bind(py).clone(), (message,)),
        Err(error) => error,
    }
}

/// An exception with attached data.
fn with<'py>(py: Python<'py>, error: PyErr, attributes: impl FnOnce(&Bound<'py, PyAny>) -> PyResult<()>) -> PyErr {
    match attributes(error.value(py).as_any()) {
        Ok(()) => error,
        Err(other) => other,
    }
}

pub(crate) fn invalid(py: Python<'_>, message: String) -> PyErr {
    new(py, Kind::InvalidValue, message)
}

/// A failure of the solvers, with what may be to blame for it.
pub(crate) fn with_note(py: Python<'_>, error: Error, note: &str) -> PyErr {
    let message = format!("{error}; {note}");
    raised(py, error, message)
}

/// A failure of the solvers.
pub(crate) fn raise(py: Python<'_>, error: Error) -> PyErr {
    let message = error.to_string();
    raised(py, error, message)
}

fn raised(py: Python<'_>, error: Error, message: String) -> PyErr {
    let kind = match &error {
        Error::NotFinite { .. }
        | Error::WrongLength { .. }
        | Error::Unphysical { .. }
        | Error::NoSuchMode { .. }
        | Error::Setting { .. }
        | Error::UnknownHandle { .. } => Kind::InvalidValue,
        Error::UnknownName { .. } => Kind::UnknownName,
        Error::NoEquilibrium { .. } | Error::UnboundedReactions { .. } | Error::BranchLost { .. } => {
            Kind::NoEquilibrium
        }
        Error::NotAssembled { .. } => Kind::NotAssembled,
        Error::SingularMass { .. }
        | Error::NonsymmetricStiffness { .. }
        | Error::NoUndampedModes
        | Error::ModesNotFound { .. }
        | Error::PeriodicCoefficients { .. }
        | Error::UnequalBlades { .. }
        | Error::EigenvalueRange { .. } => Kind::NoModes,
        Error::NoExcitation { .. } | Error::NoFrequency { .. } | Error::Resonance { .. } => Kind::NoVibration,
        Error::CriticalState
        | Error::ClosesHereOnly { .. }
        | Error::NotOscillating { .. }
        | Error::ClusteredMode { .. }
        | Error::NextToPole { .. }
        | Error::Defective { .. }
        | Error::NotSmooth { .. }
        | Error::NoSensitivity { .. } => Kind::NoDerivative,
        Error::NotInRange { .. } => Kind::NotInRange,
        _ => Kind::Error,
    };
    let raised = |message| new(py, kind, message);
    match &error {
        Error::UnknownName { name, known, .. } => {
            let near = did_you_mean(name, known.iter().map(|x| &**x));
            raised(format!("{error}{near}"))
        }
        Error::NoSuchMode { mode, count } => {
            raised(format!("there is no mode {mode}: modes are counted from 0, and the mechanism has {count}"))
        }
        Error::NoEquilibrium { coordinates, .. }
        | Error::UnboundedReactions { coordinates, .. }
        | Error::BranchLost { coordinates, .. }
        | Error::NotAssembled { coordinates, .. } => {
            with(py, raised(message), |exception| exception.setattr("coordinates", coordinates.clone()))
        }
        _ => raised(message),
    }
}

/// A text that declares no mechanism.
pub(crate) fn declaration(py: Python<'_>, mistakes: &Mistakes, path: Option<&Path>) -> PyErr {
    let lines = mistakes.iter().map(ToString::to_string).collect();
    let mistakes = mistakes.iter().map(Mistake::from).collect();
    no_mechanism(py, lines, mistakes, path)
}

/// The exception for a text with mistakes, a line for each.
fn no_mechanism(py: Python<'_>, mut lines: Vec<String>, mistakes: Vec<Mistake>, path: Option<&Path>) -> PyErr {
    if let Some(path) = path {
        for line in &mut lines {
            line.insert_str(0, &format!("{}:", path.display()));
        }
    }
    let error = new(py, Kind::DeclarationError, lines.join("\n"));
    with(py, error, |exception| {
        exception.setattr("mistakes", mistakes)?;
        exception.setattr("path", path)
    })
}

impl From<&eigentol_interpreter::Mistake> for Mistake {
    fn from(mistake: &eigentol_interpreter::Mistake) -> Self {
        Self {
            line: mistake.line,
            column: mistake.column,
            end_line: mistake.end_line,
            end_column: mistake.end_column,
            message: mistake.message.clone(),
            help: mistake.help.clone(),
        }
    }
}

/// A file that gives no mechanism.
pub(crate) fn file(py: Python<'_>, error: ReadError) -> PyErr {
    match error {
        ReadError::Mistakes { path, mistakes } => declaration(py, &mistakes, Some(&path)),
        ReadError::File { path, source } => unreadable(&path, &source),
        other => new(py, Kind::Error, other.to_string()),
    }
}

/// A file that cannot be read.
pub(crate) fn unreadable(path: &Path, source: &std::io::Error) -> PyErr {
    match source.raw_os_error() {
        // With error number, text and file, Python chooses the subclass: FileNotFoundError, PermissionError ...
        Some(number) => {
            let text = source.to_string();
            let text = text.split(" (os error").next().unwrap_or_default();
            let path = path.to_string_lossy().into_owned();
            PyOSError::new_err((number, text.to_owned(), path))
        }
        None => PyOSError::new_err(format!("cannot read {}: {source}", path.display())),
    }
}

/// A URDF file that describes no robot.
pub(crate) fn urdf(py: Python<'_>, error: &eigentol_urdf::ImportError, path: &Path) -> PyErr {
    let mistake = |mistake: &eigentol_urdf::Mistake| Mistake {
        line: mistake.line as usize,
        column: mistake.column as usize,
        end_line: mistake.line as usize,
        end_column: mistake.column as usize,
        message: mistake.reason.to_string(),
        help: Some(mistake.reason.help()),
    };
    let lines = error.mistakes.iter().map(ToString::to_string).collect();
    let mistakes = error.mistakes.iter().map(mistake).collect();
    no_mechanism(py, lines, mistakes, Some(path))
}
