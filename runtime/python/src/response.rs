//! A scalar response of the design, as a function of arrays of designs.

use std::sync::Arc;

use eigentol::forced::Measure;
use eigentol::response::{self, Responses, Workspace};
use eigentol::{Equilibrium, Error, Modes};
use eigentol_interpreter::Interpreted;
use numpy::{AllowTypeChange, PyArrayDyn, PyArrayLike2, PyArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{IntoPyDict, PyDict};

use crate::arrays::{Array1, or_nan, rows, vector};
use crate::errors::raise;
use crate::figures::tool;
use crate::hints::Anything;
use crate::results::attributes;
use crate::study::Study;
use crate::values::{List, meaningless, numbers, text, word};
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
    study: Py<Study>,
    nominal: Arc<(Equilibrium, Modes)>,
    wanted: response::Response,
    variables: Vec<usize>,
    text: String,
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

impl Study {
    /// The response that a text names.
    pub(crate) fn wanted(&self, given: &hints::ResponseText<'_>) -> PyResult<response::Response> {
        let wanted = eigentol_interpreter::response(&self.inner, &text(given, "frequency 1")?);
        wanted.map_err(|error| meaningless(given.py(), error))
    }
}

#[pymethods]
impl Study {
    /// A response as a function of arrays of designs.
    ///
    /// `of` is a text as in the shell, modes counted from 1: "frequency 1", "natural_frequency 1" (rad/s), "damping_ratio 1" or
    /// "growth 1" (1/s); the name of an output; "vibration shake", the amplitude (0 to peak) of an output under the
    /// excitations, with "under u" where they have several frequencies, and "as velocity" or "as acceleration";
    /// "vibration major(shake, lift)" or "minor(..)", a semi-axis of the orbit of two outputs; "vibration shake under all", the
    /// sum over all excitations, with "as rms" the root of the mean square;
    /// "vibration shake along speed=0..6000rpm", the greatest amplitude in a range of an input, and "peak shake along
    /// speed=0..6000rpm", the value of the input at its highest peak; "critical speed=0..6000rpm", where the equilibrium
    /// loses its stiffness; "resonance 1 speed=0..6000rpm order 2", where a frequency is 2 (1) times the input; "flutter 1
    /// speed=0..6000rpm", where a mode begins or ceases to grow. `variables` names the design variables that vary, in
    /// order; all unless given.
    #[pyo3(signature = (of, variables=None))]
    fn response(
        slf: &Bound<'_, Self>,
        py: Python<'_>,
        of: &hints::ResponseText<'_>,
        variables: Option<Vec<String>>,
    ) -> PyResult<Response> {
        let wanted = slf.get().wanted(of)?;
        let description = slf.get().inner.description();
        let variables = match variables {
            None => (0..description.design.len()).collect(),
            Some(names) => {
                let index_of = |name: &String| Ok(List::Design.find(py, description, name)?.0);
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
        Ok(Response {
            mechanism: slf.get().inner.mechanism().clone(),
            study,
            text: of.extract()?,
            nominal: Arc::new(nominal),
            wanted,
            variables,
        })
    }
}

#[pymethods]
impl Study {
    /// For OpenMDAO: an `ExplicitComponent` with exact partial derivatives, an input for each of the `variables` and an output for
    /// each of the `responses`, texts as of `response` by name: `study.openmdao({"first": "frequency 1"})`. All is SI; of
    /// `blade[1].mass` the input is `blade_1_mass`. A design without an answer raises `AnalysisError`, from which drivers go back.
    #[pyo3(signature = (responses, variables=None))]
    fn openmdao<'py>(
        slf: &Bound<'py, Self>,
        responses: Responsive<'py>,
        variables: Option<Vec<String>>,
    ) -> PyResult<Anything<'py>> {
        let py = slf.py();
        let all = PyDict::new(py);
        for (name, of) in responses {
            all.set_item(name, Self::response(slf, py, &of, variables.clone())?)?;
        }
        if all.is_empty() {
            return Err(PyValueError::new_err("`responses`: at least one is needed"));
        }
        tool(py, "openmdao")?.call1((all,))
    }
}

/// Texts by name. In Python `Mapping[str, str]`.
type Responsive<'py> = Bound<'py, PyDict>;

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
            designs
                .iter()
                .map(|values| {
                    for (variable, value) in self.variables.iter().zip(values) {
                        design[*variable] = *value;
                    }
                    question(&responses, &mut room, &design)
                })
                .collect::<Result<Vec<R>, Error>>()
        };
        py.detach(run).map_err(|error| raise(py, error))
    }

    /// The designs of an array, and whether it is a single one.
    fn designs(&self, x: &Bound<'_, PyAny>) -> PyResult<(Vec<Vec<f64>>, bool)> {
        let columns = self.variables.len();
        let (designs, single) = match x.extract::<PyArrayLike2<'_, f64, AllowTypeChange>>() {
            Ok(array) => {
                let all = array.as_array().rows().into_iter().map(|row| row.to_vec()).collect();
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
            self.variables.iter().map(|place| all[*place].to_owned()).collect()
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
        let values =
            self.evaluate(py, &designs, |responses, room, design| Ok(or_nan(responses.at(room, design)?.values[0])))?;
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

    /// For JAX: a function of arrays of shape (..., variables), SI, with the exact derivative in both directions (`grad`, `jvp`, `vmap`,
    /// `jit`). Without `jax_enable_x64` JAX rounds to single precision.
    fn jax<'py>(slf: &Bound<'py, Self>) -> PyResult<Anything<'py>> {
        tool(slf.py(), "jax")?.call1((slf,))
    }

    /// For PyTorch: a function of tensors of shape (..., variables), SI, with the exact first derivative.
    fn torch<'py>(slf: &Bound<'py, Self>) -> PyResult<Anything<'py>> {
        tool(slf.py(), "torch")?.call1((slf,))
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, ())> {
        let variables = [("variables", self.names(py))].into_py_dict(py)?;
        let response = self.study.bind(py).getattr("response")?;
        Ok((py.import("functools")?.getattr("partial")?.call((response, &self.text), Some(&variables))?, ()))
    }

    fn __repr__(&self, py: Python<'_>) -> String {
        format!("Response: {} of {} by {}", self.text, self.mechanism.description().name, self.names(py).join(", "))
    }
}
