//! A mechanism at one operating point.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Duration;

use eigentol::Error;
use eigentol_interpreter::Interpreted;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};

use crate::arrays::{Array1, vector};
use crate::errors::{raise, with_note};
use crate::mechanism::Mechanism;
use crate::motion::Motion;
use crate::results::attributes;
use crate::settings::{self, Settings};

/// Interval between checks for Ctrl-C while waiting for an answer.
const BETWEEN_SIGNALS: Duration = Duration::from_millis(50);

/// A mechanism at one operating point, with tolerances and settings.
///
/// Every value is a number, SI, or a text with a unit; a study starts from the declared nominal values and tolerances,
/// with inputs and start values of zero.
///
///     study = eigentol.Study(mechanism, inputs={"speed": "3000 rpm"}, tolerances={"l": "3%"})
///
/// Settings:
///   inputs, design: values by name.
///   start: where the search for the equilibrium starts, by coordinate; held while a mechanism with loops is assembled.
///   guess: the same for dependent coordinates, which move freely.
///   hold: values of unknowns where steady motions come in a family; derivatives hold them too.
///   stay: True for the equilibrium next to the start whatever its stability. Start values of an unstable equilibrium are kept
///       without it: `notes` of the equilibrium says so.
///   at: an equilibrium found by `equilibria`, whatever its stability.
///   tolerances: by name of a design variable or an input: a half-width, a text ("3%", "+0.2 -0.1 mm uniform",
///       "one of [9, 10] mm"), or a pair of deviations, lower and upper. Per cent given here are of the value that the
///       study has, whatever `replace` changes; per cent of the declaration are of the declared nominal value of a design
///       variable, also where `design` sets another, as in Rust and in the command.
///   measured: arrays of measured values by name, SI, which take the place of a tolerance.
///   sigma_level: standard deviations that a half-width stands for (3).
///   correlation: matrix of the design variables, and after them of the inputs that have a tolerance.
///   policy: "stable", or "nearest" for the equilibrium next to the start whatever its stability. With coasting joints, rolling
///       wheels or forces without a potential, "stable" is the same as "nearest": look at `stability`.
///   family: "undamped" or "general"; unless given, modes neglect nothing.
///   samples (3000), seed (0), stream (0), threads (0: all), keep_samples (False), vectors (True): of sampling.
///   steps: in which a range is searched (200).
///
/// A study does not change: `replace` gives another one.
#[pyclass(frozen, module = "eigentol")]
pub(crate) struct Study {
    pub(crate) inner: eigentol::Study<Interpreted>,
    mechanism: Py<Mechanism>,
    settings: Py<PyDict>,
}

impl Study {
    /// Runs an analysis while other Python threads continue.
    pub(crate) fn ask<R: Send>(
        &self,
        py: Python<'_>,
        question: impl FnOnce(&eigentol::Study<Interpreted>) -> Result<R, Error> + Send,
    ) -> PyResult<R> {
        py.detach(|| question(&self.inner)).map_err(|error| self.explain(py, error))
    }

    /// The exception for a failure. Where values may be to blame, it names the inputs that were never given any.
    fn explain(&self, py: Python<'_>, error: Error) -> PyErr {
        let by_values = matches!(
            error,
            Error::Unphysical { .. }
                | Error::OutsideDomain { .. }
                | Error::InfiniteOutput { .. }
                | Error::SingularMass { .. }
                | Error::NoEquilibrium { .. }
                | Error::NotAssembled { .. }
        );
        let names = if by_values { settings::unset_inputs(&self.inner, self.settings.bind(py)) } else { Vec::new() };
        let note = match &names[..] {
            [] => return raise(py, error),
            [name] => format!("the input `{name}` was given no value and counts as 0"),
            names => {
                let names = names.join("`, `");
                format!("the inputs `{names}` were given no values and count as 0")
            }
        };
        with_note(py, error, &note)
    }

    /// Runs a long analysis like [`Self::ask`]; Ctrl-C ends it and is raised.
    pub(crate) fn ask_stoppably<R: Send>(
        &self,
        py: Python<'_>,
        question: impl FnOnce(&eigentol::Study<Interpreted>) -> Result<R, Error> + Send,
    ) -> PyResult<R> {
        self.stoppably(py, question)?.map_err(|error| self.explain(py, error))
    }

    /// Runs an analysis; Ctrl-C ends it and is raised.
    pub(crate) fn stoppably<R: Send>(
        &self,
        py: Python<'_>,
        question: impl FnOnce(&eigentol::Study<Interpreted>) -> R + Send,
    ) -> PyResult<R> {
        let stop = Arc::new(AtomicBool::new(false));
        let study = self.inner.clone().stop(Arc::clone(&stop));
        let here = thread::current();
        thread::scope(|scope| {
            let work = scope.spawn(|| {
                let answer = question(&study);
                here.unpark();
                answer
            });
            let interrupted = loop {
                py.detach(|| thread::park_timeout(BETWEEN_SIGNALS));
                if work.is_finished() {
                    break None;
                }
                if let Err(interrupt) = py.check_signals() {
                    stop.store(true, Ordering::Relaxed);
                    break Some(interrupt);
                }
            };
            let joined = py.detach(|| work.join());
            match (interrupted, joined) {
                (Some(interrupt), _) => Err(interrupt),
                (None, Ok(answer)) => Ok(answer),
                (None, Err(panic)) => std::panic::resume_unwind(panic),
            }
        })
    }

    /// The settings as given.
    pub(crate) fn given(&self, py: Python<'_>) -> Py<PyDict> {
        self.settings.clone_ref(py)
    }

    fn with(mechanism: &Bound<'_, Mechanism>, settings: Bound<'_, PyDict>) -> PyResult<Self> {
        Ok(Self {
            inner: settings::study(mechanism.get().inner.clone(), &settings)?,
            mechanism: mechanism.clone().unbind(),
            settings: settings.unbind(),
        })
    }
}

attributes! {
    Study(self, py) {
        /// The settings as given.
        settings: PyResult<Settings<'py>> = settings::copied(self.settings.bind(py));
        /// Values of the inputs, SI, shape (inputs,).
        inputs: Array1<'py> = vector(py, self.inner.input_values().iter().copied());
        /// Values of the design variables, SI, shape (design,).
        design: Array1<'py> = vector(py, self.inner.design_values().iter().copied());
        /// Standard deviations of the design variables, and after them of the inputs that have a tolerance, SI.
        sigmas: PyResult<Array1<'py>> = {
            Ok(vector(py, self.ask(py, |study| study.tolerances())?.sigmas().iter().copied()))
        };
    }
}

#[pymethods]
impl Study {
    #[new]
    #[pyo3(signature = (mechanism, **settings))]
    pub(crate) fn new(mechanism: &Bound<'_, Mechanism>, settings: Option<&Settings<'_>>) -> PyResult<Self> {
        let settings = match settings {
            Some(given) => settings::copied(given)?,
            None => PyDict::new(mechanism.py()),
        };
        Self::with(mechanism, settings)
    }

    /// The same study with other settings. Dictionaries by name change the names in them only.
    #[pyo3(signature = (**settings))]
    fn replace(&self, py: Python<'_>, settings: Option<&Settings<'_>>) -> PyResult<Self> {
        let current = self.settings.bind(py);
        let all = match settings {
            Some(others) => settings::merged(current, others)?,
            None => settings::copied(current)?,
        };
        Self::with(self.mechanism.bind(py), all)
    }

    /// The mechanism.
    #[getter]
    pub(crate) fn mechanism(&self, py: Python<'_>) -> Py<Mechanism> {
        self.mechanism.clone_ref(py)
    }

    /// The nonlinear motion at the inputs and the design of this study, for `scipy.integrate.solve_ivp`.
    fn motion(&self, py: Python<'_>) -> Motion {
        Motion::new(self.mechanism(py), self.inner.input_values().to_vec(), self.inner.design_values().to_vec())
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let name = self.inner.description().name.clone();
        let settings = self.settings.bind(py).repr()?;
        Ok(format!("Study of {name} with {settings}"))
    }

    fn __getnewargs_ex__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyTuple>, Bound<'py, PyDict>)> {
        let mechanism = PyTuple::new(py, [self.mechanism.bind(py)])?;
        Ok((mechanism, self.settings.bind(py).clone()))
    }
}
