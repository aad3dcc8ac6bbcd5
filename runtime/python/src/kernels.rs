//! The kernels of a mechanism as functions of arrays.

use eigentol::kernels::{Kernels, MotionKernels};
use eigentol::{Error, motion};
use pyo3::prelude::*;

use crate::arrays::{self, Array1, Array2, Array3};
use crate::errors::raise;
use crate::mechanism::Mechanism;
use crate::values::List;

type Given<'a, 'py> = Option<&'a Bound<'py, PyAny>>;

impl Mechanism {
    fn point(&self, py: Python<'_>, [q, u, b]: [Given<'_, '_>; 3]) -> PyResult<[Vec<f64>; 3]> {
        let of = self.inner.description();
        Ok([
            List::Coordinates.read(py, of, q)?,
            List::Inputs.read(py, of, u)?,
            List::Design.read(py, of, b)?,
        ])
    }

    fn kernels(&self) -> &dyn Kernels {
        &self.inner
    }

    fn size(&self) -> usize {
        self.inner.description().coordinates.len()
    }

    /// Rejects kernel results evaluated outside their domain.
    fn finite<'a>(
        &self,
        py: Python<'_>,
        q: &[f64],
        mut all: impl Iterator<Item = &'a [f64]>,
    ) -> PyResult<()> {
        if all.all(|values| values.iter().all(|value| value.is_finite())) {
            return Ok(());
        }
        let error = Error::OutsideDomain {
            mechanism: self.inner.description().name.clone(),
            what: "a kernel",
            coordinates: q.to_vec(),
        };
        Err(raise(py, error))
    }
}

/// Derivatives with respect to unknowns, inputs and design variables.
type ByVariable<'py> = (Array3<'py>, Array3<'py>, Array3<'py>);

/// Arguments, all SI: `q` the unknowns (n), `inputs`, `design`, each a list in the order of the names, or a dictionary
/// by name.
#[pymethods]
impl Mechanism {
    /// Residual of the equations of motion at rest, N or N m, shape (n,). It is zero at an equilibrium.
    #[pyo3(signature = (q, inputs=None, design=None))]
    fn residual<'py>(
        &self,
        py: Python<'py>,
        q: Given<'_, 'py>,
        inputs: Given<'_, 'py>,
        design: Given<'_, 'py>,
    ) -> PyResult<Array1<'py>> {
        let [q, u, b] = self.point(py, [q, inputs, design])?;
        let found = py.detach(|| self.kernels().residual(&q, &u, &b));
        self.finite(py, &q, [&found[..]].into_iter())?;
        Ok(arrays::vector(py, found))
    }

    /// Mhat, Chat and Khat about the state `q`: three arrays of shape (n, n), SI.
    #[pyo3(signature = (q, inputs=None, design=None))]
    fn linear<'py>(
        &self,
        py: Python<'py>,
        q: Given<'_, 'py>,
        inputs: Given<'_, 'py>,
        design: Given<'_, 'py>,
    ) -> PyResult<(Array2<'py>, Array2<'py>, Array2<'py>)> {
        let [q, u, b] = self.point(py, [q, inputs, design])?;
        let found = py.detach(|| self.kernels().linear(&q, &u, &b));
        let all = [&found.mass, &found.damping, &found.stiffness];
        self.finite(py, &q, all.into_iter().map(|own| own.as_flattened()))?;
        Ok((
            arrays::matrix(py, &found.mass)?,
            arrays::matrix(py, &found.damping)?,
            arrays::matrix(py, &found.stiffness)?,
        ))
    }

    /// Explicit derivatives of Mhat, Chat and Khat, SI: for each matrix three arrays, by unknown, by input, by design
    /// variable, of shape (variables, n, n).
    #[pyo3(signature = (q, inputs=None, design=None))]
    fn linear_partials<'py>(
        &self,
        py: Python<'py>,
        q: Given<'_, 'py>,
        inputs: Given<'_, 'py>,
        design: Given<'_, 'py>,
    ) -> PyResult<(ByVariable<'py>, ByVariable<'py>, ByVariable<'py>)> {
        let [q, u, b] = self.point(py, [q, inputs, design])?;
        let found = py.detach(|| self.kernels().linear_partials(&q, &u, &b));
        let lists = [&found.by_coordinate, &found.by_input, &found.by_design];
        let every = lists.into_iter().flatten();
        let every = every.flat_map(|own| [&own.mass, &own.damping, &own.stiffness]);
        self.finite(py, &q, every.map(|own| own.as_flattened()))?;
        let n = self.size();
        let of = |matrix: fn(&eigentol::kernels::Linear) -> &eigentol::Matrix| {
            let by = |list: &[eigentol::kernels::Linear]| {
                arrays::matrices(py, n, list.iter().map(matrix))
            };
            PyResult::Ok((by(lists[0])?, by(lists[1])?, by(lists[2])?))
        };
        Ok((
            of(|own| &own.mass)?,
            of(|own| &own.damping)?,
            of(|own| &own.stiffness)?,
        ))
    }

    /// Explicit derivatives of the residual at rest by inputs, shape (n, inputs), and by design variables, shape (n,
    /// design), SI.
    #[pyo3(signature = (q, inputs=None, design=None))]
    fn residual_partials<'py>(
        &self,
        py: Python<'py>,
        q: Given<'_, 'py>,
        inputs: Given<'_, 'py>,
        design: Given<'_, 'py>,
    ) -> PyResult<(Array2<'py>, Array2<'py>)> {
        let [q, u, b] = self.point(py, [q, inputs, design])?;
        let (by_input, by_design) = py.detach(|| self.kernels().residual_partials(&q, &u, &b));
        let all = [&by_input, &by_design];
        self.finite(py, &q, all.into_iter().map(|own| own.as_flattened()))?;
        Ok((
            arrays::matrix(py, &by_input)?,
            arrays::matrix(py, &by_design)?,
        ))
    }

    /// The declared outputs at the state `q`, SI, shape (outputs,).
    #[pyo3(signature = (q, inputs=None, design=None))]
    fn output_values<'py>(
        &self,
        py: Python<'py>,
        q: Given<'_, 'py>,
        inputs: Given<'_, 'py>,
        design: Given<'_, 'py>,
    ) -> PyResult<Array1<'py>> {
        let [q, u, b] = self.point(py, [q, inputs, design])?;
        let found = py.detach(|| self.kernels().outputs(&q, &u, &b));
        self.finite(py, &q, [&found[..]].into_iter())?;
        Ok(arrays::vector(py, found))
    }

    /// Mass matrix and forces of the full nonlinear motion, `M qddot = Q`: shapes (n, n) and (n,), SI. `velocity` is
    /// qdot.
    #[pyo3(signature = (velocity, q, inputs=None, design=None))]
    fn mass_and_forces<'py>(
        &self,
        py: Python<'py>,
        velocity: &Bound<'py, PyAny>,
        q: Given<'_, 'py>,
        inputs: Given<'_, 'py>,
        design: Given<'_, 'py>,
    ) -> PyResult<(Array2<'py>, Array1<'py>)> {
        let [q, u, b] = self.point(py, [q, inputs, design])?;
        let velocity = List::Coordinates.read(py, self.inner.description(), Some(velocity))?;
        let kernels: &dyn MotionKernels = &self.inner;
        let (mass, forces) = py.detach(|| kernels.motion(&velocity, &q, &u, &b));
        self.finite(py, &q, [mass.as_flattened(), &forces[..]].into_iter())?;
        Ok((arrays::matrix(py, &mass)?, arrays::vector(py, forces)))
    }

    /// Accelerations of the full nonlinear motion, shape (n,), rad/s^2 or m/s^2; in the places of speeds their rates,
    /// in those of constraints the reactions. `velocity` is qdot.
    ///
    /// `Mechanism.motion` gives a right-hand side that integrators call.
    #[pyo3(signature = (velocity, q, inputs=None, design=None))]
    fn accelerations<'py>(
        &self,
        py: Python<'py>,
        velocity: &Bound<'py, PyAny>,
        q: Given<'_, 'py>,
        inputs: Given<'_, 'py>,
        design: Given<'_, 'py>,
    ) -> PyResult<Array1<'py>> {
        let [q, u, b] = self.point(py, [q, inputs, design])?;
        let velocity = List::Coordinates.read(py, self.inner.description(), Some(velocity))?;
        let found = py.detach(|| motion::accelerations(&self.inner, &velocity, &q, &u, &b));
        let found = found.map_err(|error| raise(py, error))?;
        Ok(arrays::vector(py, found))
    }
}
