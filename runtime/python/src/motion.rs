//! The nonlinear motion as a function for integrators.

use eigentol::{Description, Error, Role, motion};
use eigentol_interpreter::Interpreted;
use pyo3::prelude::*;

use crate::arrays::{Array1, vector};
use crate::errors::{invalid, raise};
use crate::hints;
use crate::mechanism::Mechanism;
use crate::results::attributes;
use crate::values::{List, numbers};

/// The nonlinear motion at fixed inputs and design: `motion(t, y)` returns dy/dt, as `scipy.integrate.solve_ivp` wants
/// it.
///
/// `y` holds the coordinates (rad or m), after them their rates (rad/s or m/s), after these the speeds that are
/// unknowns: `names` says which. Reactions of constraints are not part of it.
#[pyclass(frozen, module = "eigentol")]
pub(crate) struct Motion {
    mechanism: Py<Mechanism>,
    inputs: Vec<f64>,
    design: Vec<f64>,
}

impl Motion {
    pub(crate) fn new(mechanism: Py<Mechanism>, inputs: Vec<f64>, design: Vec<f64>) -> Self {
        Self { mechanism, inputs, design }
    }

    fn inner(&self) -> &Interpreted {
        &self.mechanism.get().inner
    }

    fn description(&self) -> &Description {
        self.inner().description()
    }

    fn count(&self, role: Role) -> usize {
        self.description().coordinates.iter().filter(|x| x.role == role).count()
    }

    fn rates(&self, y: &[f64]) -> Result<Vec<f64>, Error> {
        let (positions, speeds) = (self.count(Role::Position), self.count(Role::Speed));
        let expected = 2 * positions + speeds;
        if y.len() != expected {
            return Err(Error::WrongLength { kind: "values of a state of motion", found: y.len(), expected });
        }
        let n = self.description().coordinates.len();
        let (mut q, mut velocity) = (vec![0.0; n], vec![0.0; n]);
        q[..positions].copy_from_slice(&y[..positions]);
        velocity[..positions].copy_from_slice(&y[positions..2 * positions]);
        q[positions..positions + speeds].copy_from_slice(&y[2 * positions..]);
        let (u, b) = (&self.inputs, &self.design);
        let vector = motion::accelerations(self.inner(), &velocity, &q, u, b)?;
        let rates = &y[positions..2 * positions];
        Ok([rates, &vector[..positions + speeds]].concat())
    }
}

#[pymethods]
impl Mechanism {
    /// The nonlinear motion at these inputs and this design, for `scipy.integrate.solve_ivp`.
    ///
    /// Both are SI or texts with units, in a dictionary by name or in a list; unless given, inputs are zero and the
    /// design is nominal.
    #[pyo3(signature = (inputs=None, design=None))]
    fn motion(
        slf: &Bound<'_, Self>,
        inputs: Option<&hints::Numbers<'_>>,
        design: Option<&hints::Numbers<'_>>,
    ) -> PyResult<Motion> {
        let (py, of) = (slf.py(), slf.get().inner.description());
        let inputs = List::Inputs.read(py, of, inputs)?;
        let design = List::Design.read(py, of, design)?;
        Ok(Motion::new(slf.clone().unbind(), inputs, design))
    }
}

attributes! {
    Motion(self, py) {
        /// Names of the entries of `y`; a rate is marked by a prime: "theta", "theta'".
        names: Vec<String> = {
            let of = |role: Role| {
                self.description().coordinates.iter().filter(move |x| x.role == role)
            };
            let positions = of(Role::Position).map(|x| x.name.to_string());
            let rates = of(Role::Position).map(|x| format!("{}'", x.name));
            let speeds = of(Role::Speed).map(|x| x.name.to_string());
            positions.chain(rates).chain(speeds).collect()
        };
    }
}

#[pymethods]
impl Motion {
    /// dy/dt at the state `y`, the same shape. `t` does not matter: inputs are constant.
    fn __call__<'py>(&self, py: Python<'py>, t: f64, y: &hints::ArrayLike<'py>) -> PyResult<Array1<'py>> {
        let _ = t;
        let y = numbers(y, "y")?;
        match py.detach(|| self.rates(&y)) {
            Ok(rates) => Ok(vector(py, rates)),
            Err(error) => Err(raise(py, error)),
        }
    }

    /// A state `y` from coordinates and speeds, and from rates, by name; zero unless given. SI or texts with units;
    /// rates are SI.
    #[pyo3(signature = (coordinates=None, rates=None))]
    fn state<'py>(
        &self,
        py: Python<'py>,
        coordinates: Option<&hints::Numbers<'py>>,
        rates: Option<&hints::Numbers<'py>>,
    ) -> PyResult<Array1<'py>> {
        let of = self.description();
        let (positions, speeds) = (self.count(Role::Position), self.count(Role::Speed));
        let q = List::Coordinates.read(py, of, coordinates)?;
        let velocity = List::Coordinates.read(py, of, rates)?;
        if let Some(k) = (positions..velocity.len()).find(|&k| velocity[k] != 0.0) {
            let name = &of.coordinates[k].name;
            let message = format!("`{name}` has no rate here: give a speed among the coordinates");
            return Err(invalid(py, message));
        }
        let y = [&q[..positions], &velocity[..positions]];
        Ok(vector(py, [&y.concat()[..], &q[positions..positions + speeds]].concat()))
    }

    #[expect(clippy::type_complexity, reason = "what Python asks for")]
    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, (Vec<f64>, Vec<f64>))> {
        let motion = self.mechanism.bind(py).getattr("motion")?;
        Ok((motion, (self.inputs.clone(), self.design.clone())))
    }

    fn __repr__(&self, py: Python<'_>) -> String {
        let of = &self.description().name;
        format!("Motion of {of}, y = [{}]", self.names(py).join(", "))
    }
}
