//! Values of an input at which something happens.

use eigentol::sweep::EventTolerance;
use pyo3::prelude::*;

use crate::arrays::{Array1, vector};
use crate::errors::raise;
use crate::names;
use crate::results::result;

result! {
    /// A value of an input at which something happens, and how tolerances move it, SI.
    Event(EventTolerance)
}

pub(crate) fn events(all: &[EventTolerance]) -> Vec<Event> {
    all.iter().cloned().map(Event).collect()
}

#[pymethods]
impl Event {
    /// The nominal value of the input, SI.
    #[getter]
    fn value(&self) -> f64 {
        self.0.value
    }

    /// Its standard deviation to first order, SI; None where it has no derivative.
    #[getter]
    fn sigma(&self) -> Option<f64> {
        self.0.sigma()
    }

    /// Derivatives per SI unit of each variable, shape (variables,). Raises NoDerivative where there are none.
    #[getter]
    fn gradient<'py>(&self, py: Python<'py>) -> PyResult<Array1<'py>> {
        match &self.0.spread {
            Ok(spread) => Ok(vector(py, spread.by_design.clone())),
            Err(error) => Err(raise(py, error.clone())),
        }
    }

    /// Names of the variables.
    #[getter]
    fn names(&self) -> Vec<&str> {
        names::design(&self.0.description)
    }
}
