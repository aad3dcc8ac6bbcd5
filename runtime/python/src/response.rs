//! A scalar response of the design, as a function of arrays of designs.

use std::sync::Arc;

use eigentol::forced::Measure;
use eigentol::peaks::PeakQuantity;
use eigentol::response::{self, Responses, Vibration, Workspace};
use eigentol::sweep::{Condition, Line, Range};
use eigentol::{Equilibrium, Error, Excitation, Modes, Output};
use eigentol_interpreter::Interpreted;
use numpy::{AllowTypeChange, PyArrayDyn, PyArrayLike2, PyArrayMethods};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{IntoPyDict, PyTuple};

use crate::arrays::{Array1, or_nan, rows, vector};
use crate::errors::{invalid, raise};
use crate::results::{attributes, quantity};
use crate::study::Study;
use crate::values::{List, mode_number, number, numbers, word};
use crate::{hints, names};

/// A number that a design gives: a quantity of a mode, an output, the amplitude of its vibration, a critical value of an
/// input. `response(x)` evaluates
/// it.
///
/// `x` holds the variables `names`, SI: an array of shape (variables,), for one number, or of shape (N, variables), for
/// an array of shape (N,). Every design is solved anew from the nominal equilibrium, its modes matched to the nominal
/// ones by shape. NaN stands where a design has no stable equilibrium or no such response.
///
/// For OpenTURNS:
///
///     openturns.PythonFunction(
///         len(response.names), 1,
///         func=lambda x: [response(x)],
///         func_sample=lambda xs: response(xs)[:, None],
///         gradient=lambda x: response.gradient(x)[:, None],
///     )
#[pyclass(frozen, module = "eigentol")]
pub(crate) struct Response {
    mechanism: Interpreted,
    /// Study, kind and arguments that it was made of.
    given: (Py<Study>, String, Py<PyTuple>),
    nominal: Arc<(Equilibrium, Modes)>,
    wanted: response::Response,
    variables: Vec<usize>,
    text: String,
}

/// Parses a response: "frequency" and other quantities of a mode, ("output", name), ("vibration", output, excitation,
/// measure), ("greatest" or "peak", input, low, high, output, excitation, measure), ("critical", input, low, high),
/// ("resonance", mode, input, low, high, order) or ("flutter", mode, input, low, high).
pub(crate) fn wanted(
    study: &eigentol::Study<Interpreted>,
    what: &str,
    given: &Bound<'_, PyTuple>,
) -> PyResult<response::Response> {
    let py = given.py();
    let count = |expected: usize, list: &str| match given.len() == expected {
        true => Ok(()),
        false => Err(PyTypeError::new_err(format!("\"{what}\" needs {list}"))),
    };
    match what {
        "output" => {
            count(1, "the name of an output")?;
            let name = given.get_item(0)?.extract::<String>()?;
            let output = study.find_output(&name).map_err(|error| raise(py, error))?;
            Ok(response::Response::Output(Output::new(output.index())))
        }
        "vibration" => {
            if !(1..=3).contains(&given.len()) {
                count(1, "the name of an output, and perhaps of an excitation and a measure")?;
            }
            vibration(study, given).map(response::Response::Vibration)
        }
        "greatest" | "peak" => {
            if !(4..=6).contains(&given.len()) {
                count(
                    4,
                    "the name of an input, a low and a high value, the name of an output, and perhaps of an excitation and a measure",
                )?;
            }
            Ok(response::Response::Peak {
                vibration: vibration(study, &given.get_slice(3, given.len()))?,
                range: range(study, given, 0)?,
                quantity: match what {
                    "greatest" => PeakQuantity::Height,
                    _ => PeakQuantity::Place,
                },
            })
        }
        "critical" => {
            count(3, "the name of an input, a low and a high value")?;
            range(study, given, 0).map(response::Response::Critical)
        }
        "resonance" | "flutter" => {
            let list = "the number of a mode, the name of an input, a low and a high value";
            match (what, given.len()) {
                (_, 4) | ("resonance", 5) => {}
                ("resonance", _) => count(5, &format!("{list}, and perhaps an order"))?,
                _ => count(4, list)?,
            }
            let order = given.get_item(4).map_or(Ok(1.0), |order| order.extract())?;
            Ok(response::Response::Crossing {
                mode: mode_number(py, given.get_item(0)?.extract()?)?,
                condition: match what {
                    "resonance" => Condition::Line(Line::from(order)),
                    _ => Condition::FlutterOnset,
                },
                range: range(study, given, 1)?,
            })
        }
        other => {
            let quantity = quantity(py, other)?;
            count(1, "the number of a mode, from 0")?;
            let mode = mode_number(py, given.get_item(0)?.extract()?)?;
            Ok(response::Response::Mode { mode, quantity })
        }
    }
}

/// The amplitude of an output under an excitation, or under all if they have one frequency.
fn vibration(study: &eigentol::Study<Interpreted>, given: &Bound<'_, PyTuple>) -> PyResult<Vibration> {
    let py = given.py();
    let name = given.get_item(0)?.extract::<String>()?;
    let output = study.find_output(&name).map_err(|error| raise(py, error))?;
    let excitation = match given.get_item(1) {
        Ok(name) => {
            let excitation = study.find_excitation(&name.extract::<String>()?);
            excitation.map_err(|error| raise(py, error))?
        }
        Err(_) => only(py, study)?,
    };
    let vibration = Vibration::new(output, excitation);
    match given.get_item(2) {
        Ok(name) => Ok(vibration.measure(measure(py, &name.extract::<String>()?)?)),
        Err(_) => Ok(vibration),
    }
}

/// The first excitation, if all have one frequency.
fn only(py: Python<'_>, study: &eigentol::Study<Interpreted>) -> PyResult<Excitation<Interpreted>> {
    let of = study.description();
    let harmonics = names::harmonics(of);
    match harmonics.len() {
        0 => {
            let mechanism = of.name.clone();
            Err(raise(py, Error::NoExcitation { mechanism }))
        }
        1 => Ok(Excitation::new(0)),
        _ => {
            let firsts: Vec<&str> = harmonics.iter().map(|harmonic| harmonic[0]).collect();
            let message = format!(
                "the excitations have several frequencies: say under which the output vibrates, {}",
                firsts.join(" or ")
            );
            Err(invalid(py, message))
        }
    }
}

/// Looks up how a vibration is measured.
pub(crate) fn measure(py: Python<'_>, name: &str) -> PyResult<Measure> {
    let words = [
        ("displacement", Measure::Displacement),
        ("velocity", Measure::Velocity),
        ("acceleration", Measure::Acceleration),
    ];
    word(py, "measure", name, &words)
}

/// The range of the input whose name is item `first` of the given tuple.
pub(crate) fn range(study: &eigentol::Study<Interpreted>, given: &Bound<'_, PyTuple>, first: usize) -> PyResult<Range> {
    let name = given.get_item(first)?.extract::<String>()?;
    let (index, unit) = List::Inputs.find(given.py(), study.description(), &name)?;
    let low = number(&given.get_item(first + 1)?, &unit, &name)?;
    let high = number(&given.get_item(first + 2)?, &unit, &name)?;
    Ok(Range::new(eigentol::Input::new(index), low, high))
}

#[pymethods]
impl Study {
    /// A response as a function of arrays of designs.
    ///
    /// `what` and what follows: "frequency", "natural_frequency" (rad/s), "damping_ratio" or "growth" (1/s) and the
    /// number of a mode, from 0; "output" and its name; "vibration" and the name of an output, for its amplitude (0 to
    /// peak) under the excitations, and perhaps the name of one of these, needed where they have several frequencies,
    /// and "velocity" or "acceleration"; "greatest" and the name of an input, a low and a high value, and the same, for
    /// the greatest amplitude in that range, or "peak", for the value of the input at its highest peak; "critical" and
    /// the name of an input, a low and a high value, between which the equilibrium loses its stiffness; "resonance" and
    /// the number of a mode, an input, a low and a high value, and an order (1), or "flutter" and the same without it.
    /// `variables` names the design variables that vary, in order; all unless given.
    #[pyo3(signature = (what, *of, variables=None))]
    fn response(
        slf: &Bound<'_, Self>,
        py: Python<'_>,
        what: &str,
        of: &Bound<'_, PyTuple>,
        variables: Option<Vec<String>>,
    ) -> PyResult<Response> {
        let wanted = wanted(&slf.get().inner, what, of)?;
        let description = slf.get().inner.description();
        let variables = match variables {
            None => (0..description.design.len()).collect(),
            Some(names) => {
                let index_of = |name: &String| {
                    let handle = List::Design.find(py, description, name)?;
                    Ok(handle.0)
                };
                names.iter().map(index_of).collect::<PyResult<_>>()?
            }
        };
        let nominal = slf.get().ask(py, |study| {
            let (state, modes) = (study.equilibrium()?, study.modes()?);
            // Inconsistent settings are rejected here.
            Responses::new(study.mechanism(), &state, &modes, vec![wanted])?;
            Ok((state, modes))
        })?;
        let study = slf.clone().unbind();
        let arguments = of.clone().unbind();
        let of: Vec<String> = of.iter().map(|quantity| Ok(quantity.str()?.to_string())).collect::<PyResult<_>>()?;
        Ok(Response {
            mechanism: slf.get().inner.mechanism().clone(),
            given: (study, what.to_owned(), arguments),
            nominal: Arc::new(nominal),
            wanted,
            variables,
            text: format!("{what} {} of {}", of.join(", "), description.name),
        })
    }
}

impl Response {
    /// Evaluates each design; `x` holds the variables.
    fn evaluate<R: Send>(
        &self,
        py: Python<'_>,
        designs: &[Vec<f64>],
        question: impl Fn(&Responses<'_>, &mut Workspace, &[f64]) -> Result<R, Error> + Send + Sync,
    ) -> PyResult<Vec<R>> {
        let run = || {
            let (equilibrium, modes) = &*self.nominal;
            let responses = Responses::new(&self.mechanism, equilibrium, modes, vec![self.wanted])?;
            let mut room = responses.workspace();
            let mut design = equilibrium.design.to_vec();
            let each = designs.iter().map(|values| {
                for (variable, value) in self.variables.iter().zip(values) {
                    design[*variable] = *value;
                }
                question(&responses, &mut room, &design)
            });
            each.collect::<Result<Vec<R>, Error>>()
        };
        py.detach(run).map_err(|error| raise(py, error))
    }

    /// The designs of an array, and whether it is a single one.
    fn designs(&self, x: &Bound<'_, PyAny>) -> PyResult<(Vec<Vec<f64>>, bool)> {
        let columns = self.variables.len();
        let (designs, single) = match x.extract::<PyArrayLike2<'_, f64, AllowTypeChange>>() {
            Ok(array) => {
                let array = array.as_array();
                let all = array.rows().into_iter().map(|row| row.to_vec()).collect();
                (all, false)
            }
            Err(_) => (vec![numbers(x, "x")?], true),
        };
        match designs.iter().find(|values: &&Vec<f64>| values.len() != columns) {
            None => Ok((designs, single)),
            Some(other) => {
                Err(raise(x.py(), Error::WrongLength { kind: "variables", found: other.len(), expected: columns }))
            }
        }
    }
}

attributes! {
    Response(self, py) {
        /// Names of the variables, in the order of `x`.
        names: Vec<String> = {
            let all = names::design(self.mechanism.description());
            let own = self.variables.iter();
            own.map(|place| all[*place].to_owned()).collect()
        };
        /// Nominal values of the variables, SI, shape (variables,).
        nominal: Array1<'py> = {
            let design = &self.nominal.0.design;
            vector(py, self.variables.iter().map(|place| design[*place]))
        };
    }
}

#[pymethods]
impl Response {
    /// The response at a design, or at each of several, SI.
    fn __call__<'py>(&self, py: Python<'py>, x: &hints::ArrayLike<'py>) -> PyResult<Bound<'py, PyAny>> {
        let (designs, single) = self.designs(x)?;
        let values = self.evaluate(py, &designs, |responses, room, design| {
            let realisation = responses.at(room, design)?;
            Ok(or_nan(realisation.values[0]))
        })?;
        if single {
            return Ok(values[0].into_pyobject(py)?.into_any());
        }
        Ok(vector(py, values).into_any())
    }

    /// Total derivatives by the variables, SI: shape (variables,) for one design, (N, variables) for several.
    fn gradient<'py>(&self, py: Python<'py>, x: &hints::ArrayLike<'py>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        let (designs, single) = self.designs(x)?;
        let values = self.evaluate(py, &designs, |responses, room, design| {
            let realisation = responses.with_gradients(room, design)?;
            let derivative = |index: &usize| match &realisation.gradients[0] {
                Some(gradient) => gradient[*index],
                None => f64::NAN,
            };
            Ok(self.variables.iter().map(derivative).collect::<Vec<f64>>())
        })?;
        let all = rows(py, self.variables.len(), values)?;
        if single {
            return Ok(all.reshape([self.variables.len()])?.to_dyn().clone());
        }
        Ok(all.to_dyn().clone())
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, ())> {
        let (study, what, of) = &self.given;
        let variables = [("variables", self.names(py))].into_py_dict(py)?;
        let first = (study.bind(py).getattr("response")?, what);
        let all = first.into_pyobject(py)?.add(of.bind(py))?;
        let partial = py.import("functools")?.getattr("partial")?;
        Ok((partial.call(all.cast::<PyTuple>()?, Some(&variables))?, ()))
    }

    fn __repr__(&self, py: Python<'_>) -> String {
        format!("Response: {} by {}", self.text, self.names(py).join(", "))
    }
}
