//! The page that answers while one edits.

use std::sync::{Mutex, PoisonError};

use eigentol_interpreter::Interpreted;
use eigentol_live::{Server, Subject, compiled, read_file};
use pyo3::exceptions::{PyOSError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::hints::Anything;
use crate::mechanism::Mechanism;
use crate::results::attributes;
use crate::settings::{self, Settings};
use crate::study::Study;

/// A page on this machine that answers while one edits: a notebook shows it, and any browser on this machine at its `address`.
///
/// It ends with `stop()`, with its `with` block, or when nothing refers to it.
#[pyclass(frozen, module = "eigentol")]
pub(crate) struct Live {
    server: Mutex<Option<Server>>,
    address: String,
}

impl Live {
    /// Ends the server. Its thread may wait for the interpreter, which is let go meanwhile.
    fn end(&self, py: Python<'_>) {
        let server = self.server.lock().unwrap_or_else(PoisonError::into_inner).take();
        py.detach(|| drop(server));
    }
}

impl Drop for Live {
    fn drop(&mut self) {
        // At its end the interpreter ends all threads.
        let _ = Python::try_attach(|py| self.end(py));
    }
}

attributes! {
    Live(self, py) {
        /// The address of the page. It holds a token: whoever knows it on this machine sees the page.
        address: &str = &self.address;
    }
}

#[pymethods]
impl Live {
    /// Ends the page.
    fn stop(&self, py: Python<'_>) {
        self.end(py);
    }

    fn _repr_html_(&self) -> String {
        let address = &self.address;
        format!(
            "<iframe src=\"{address}\" width=\"100%\" height=\"760\" style=\"border: 0\"></iframe>\
             <p><a href=\"{address}\" target=\"_blank\" rel=\"noreferrer\">In a window of its own</a></p>"
        )
    }

    fn __repr__(&self) -> String {
        format!("Live page at {}", self.address)
    }

    fn __enter__(slf: Bound<'_, Self>) -> Bound<'_, Self> {
        slf
    }

    fn __exit__(&self, py: Python<'_>, _kind: Anything<'_>, _value: Anything<'_>, _trace: Anything<'_>) {
        self.end(py);
    }
}

#[pymethods]
impl Study {
    /// A page on this machine that answers while one edits, beginning with this study: sliders for all values and tolerances, modes
    /// in motion, sensitivities, bands, Campbell diagram and response. Saving the file of the mechanism updates it. `port` 0 is
    /// any that is free.
    ///
    /// Raises OSError when the port cannot be had.
    #[pyo3(signature = (port=0))]
    fn live(&self, py: Python<'_>, port: usize) -> PyResult<Live> {
        let port = u16::try_from(port).map_err(|_| PyValueError::new_err("`port`: 0 to 65535"))?;
        let mechanism = self.mechanism(py);
        let own = mechanism.get();
        let (text, file) = (own.text().to_owned(), own.file.clone());
        let name = match &file {
            Some(file) => file.display().to_string(),
            None => own.inner.description().name.to_string(),
        };
        let mut settings = self.written(py)?;
        if let Some(name) = file.as_ref().and_then(|file| file.file_name()) {
            settings.insert("mechanism".to_owned(), name.display().to_string().into());
        }
        let given = self.given(py);
        let subject = Subject {
            name,
            read: Box::new(move || match &file {
                Some(file) => read_file(file),
                None => Ok(text.clone()),
            }),
            compile: Box::new(compiled),
            study: Box::new(move |compilation| {
                Python::attach(|py| {
                    let machine = mechanism.get().stated(py, Interpreted::new(compilation));
                    let study = machine.and_then(|machine| settings::study(machine, given.bind(py)));
                    study.map_err(|error| error.value(py).to_string())
                })
            }),
            settings,
        };
        let server =
            py.detach(|| Server::start(subject, port)).map_err(|error| PyOSError::new_err(error.to_string()))?;
        Ok(Live { address: server.address(), server: Mutex::new(Some(server)) })
    }
}

impl Study {
    /// The values and tolerances of this study as a study file has them.
    fn written(&self, py: Python<'_>) -> PyResult<toml::Table> {
        let (d, given) = (self.inner.description(), self.given(py));
        let named = |setting: &str| -> PyResult<Option<Bound<'_, PyDict>>> {
            let found = given.bind(py).get_item(setting)?;
            Ok(found.and_then(|found| found.cast_into().ok()))
        };
        let inputs =
            d.inputs.iter().zip(self.inner.input_values()).map(|(info, value)| (&info.name, &info.unit, value));
        let design =
            d.design.iter().zip(self.inner.design_values()).map(|(info, value)| (&info.name, &info.unit, value));
        let starts = d.coordinates.iter().zip(self.inner.start_values());
        let starts = starts.map(|(info, value)| (&info.name, &info.unit, value));
        let mut all = toml::Table::new();
        let values = [("inputs", "set"), ("design", "set"), ("start", "start")];
        let quantities: Vec<_> = inputs.chain(design).chain(starts).collect();
        for (setting, key) in values {
            let Some(named) = named(setting)? else { continue };
            let table = all.entry(key).or_insert_with(|| toml::Table::new().into());
            for (name, unit, value) in &quantities {
                if let (true, Some(table)) = (named.contains(&***name)?, table.as_table_mut()) {
                    let text = format!("{} {}", unit.from_si(**value), unit.symbol);
                    table.insert(name.to_string(), text.trim_end().into());
                }
            }
        }
        if let Some(named) = named("tolerances")? {
            let mut texts = toml::Table::new();
            for (name, given) in named {
                let name = name.extract::<String>()?;
                // Numbers are in SI, and a study file has texts.
                let unit = quantities.iter().find(|(known, ..)| ***known == *name).map(|(_, unit, _)| *unit);
                let text = match (given.extract::<String>(), given.extract::<f64>(), unit) {
                    (Ok(text), ..) => text,
                    (_, Ok(width), Some(unit)) => format!("{} {}", unit.from_si(width), unit.symbol),
                    _ => continue,
                };
                texts.insert(name, text.trim_end().into());
            }
            all.insert("tolerance".to_owned(), texts.into());
        }
        Ok(all)
    }
}

#[pymethods]
impl Mechanism {
    /// `Study(mechanism, **settings).live()`.
    #[pyo3(signature = (**settings))]
    fn live(slf: &Bound<'_, Self>, settings: Option<&Settings<'_>>) -> PyResult<Live> {
        Study::new(slf, settings)?.live(slf.py(), 0)
    }
}

impl Mechanism {
    /// Another mechanism in the units in which this one states its answers.
    fn stated(&self, py: Python<'_>, machine: Interpreted) -> PyResult<Interpreted> {
        let (units, frequency) = &self.stated;
        Self::with_units(py, machine, units, frequency.as_deref())
    }
}
