//! The kernels of a mechanism as functions of arrays.

use eigentol::kernels::{Gradient, Kernel, Kernels, Linear, MotionKernels};
use eigentol::{Complex, Error, Matrix, motion};
use numpy::PyArrayMethods;
use pyo3::prelude::*;

use crate::arrays::{self, Array1, Array2, Array3};
use crate::errors::raise;
use crate::hints;
use crate::mechanism::Mechanism;
use crate::values::List;

type Given<'a, 'py> = Option<&'a hints::Numbers<'py>>;

impl Mechanism {
    fn point(&self, py: Python<'_>, [q, u, b]: [Given<'_, '_>; 3]) -> PyResult<[Vec<f64>; 3]> {
        let of = self.inner.description();
        Ok([List::Coordinates.read(py, of, q)?, List::Inputs.read(py, of, u)?, List::Design.read(py, of, b)?])
    }

    fn kernels(&self) -> &dyn Kernels {
        &self.inner
    }

    fn moving(&self) -> &dyn MotionKernels {
        &self.inner
    }

    /// One number for each unknown.
    fn each(&self, py: Python<'_>, given: Given<'_, '_>) -> PyResult<Vec<f64>> {
        List::Coordinates.read(py, self.inner.description(), given)
    }

    /// Rejects kernel results evaluated outside their domain.
    fn finite<'a>(&self, py: Python<'_>, q: &[f64], mut all: impl Iterator<Item = &'a [f64]>) -> PyResult<()> {
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

    fn three<'py>(&self, py: Python<'py>, q: &[f64], linear: &Linear) -> PyResult<Three<'py>> {
        let all = [&linear.mass, &linear.damping, &linear.stiffness];
        self.finite(py, q, all.into_iter().map(|x| x.as_flattened()))?;
        let [mass, damping, stiffness] = all.map(|x| arrays::matrix(py, x));
        Ok((mass?, damping?, stiffness?))
    }

    fn gradient<'py>(&self, py: Python<'py>, q: &[f64], gradient: Gradient) -> PyResult<Slopes<'py>> {
        let all = [gradient.coordinates, gradient.inputs, gradient.design];
        self.finite(py, q, all.iter().map(|x| &x[..]))?;
        Ok(all.map(|x| arrays::vector(py, x)).into())
    }
}

/// Mhat, Chat, Khat.
type Three<'py> = (Array2<'py>, Array2<'py>, Array2<'py>);

/// Forces, frequencies, direct terms of the outputs.
type Forcing<'py> = (Array2<'py, Complex>, Array1<'py>, Array2<'py, Complex>);

/// Derivatives of a number with respect to unknowns, inputs and design variables.
type Slopes<'py> = (Array1<'py>, Array1<'py>, Array1<'py>);

/// Derivatives of a matrix with respect to them.
type ByVariable<'py> = (Array3<'py>, Array3<'py>, Array3<'py>);

/// Defines kernels: docstring, name, arguments that come before the state (lists of a number for each unknown; a number),
/// and what follows from these and the state.
macro_rules! kernels {
    ($own:ident, $py:ident; $(
        $(#[$doc:meta])*
        $name:ident($($list:ident),* $(; $number:ident)?) -> $type:ty = |$q:ident, $u:ident, $b:ident| $value:expr;
    )+) => {
        /// Arguments, all SI: `q` the unknowns (n), `inputs`, `design`, each a list in the order of the names, or a
        /// dictionary by name.
        #[pymethods]
        impl Mechanism {
            $(
                $(#[$doc])*
                #[allow(clippy::too_many_arguments, reason = "keywords of Python")]
                #[pyo3(signature = ($($list,)* $($number,)? q, inputs=None, design=None))]
                fn $name<'py>(
                    &$own,
                    $py: Python<'py>,
                    $($list: Given<'_, 'py>,)*
                    $($number: f64,)?
                    q: Given<'_, 'py>,
                    inputs: Given<'_, 'py>,
                    design: Given<'_, 'py>,
                ) -> PyResult<$type> {
                    $(let $list = $own.each($py, $list)?;)*
                    let [$q, $u, $b] = $own.point($py, [q, inputs, design])?;
                    $value
                }
            )+
        }
    };
}

kernels! { self, py;
    /// Residual of the equations of motion at rest, N or N m, shape (n,). It is zero at an equilibrium.
    residual() -> Array1<'py> = |q, u, b| {
        let found = py.detach(|| self.kernels().residual(&q, &u, &b));
        self.finite(py, &q, [&found[..]].into_iter())?;
        Ok(arrays::vector(py, found))
    };
    /// Mhat, Chat and Khat about the state `q`: three arrays of shape (n, n), SI.
    linear() -> Three<'py> = |q, u, b| {
        let found = py.detach(|| self.kernels().linear(&q, &u, &b));
        self.three(py, &q, &found)
    };
    /// Explicit derivatives of Mhat, Chat and Khat, SI: for each matrix three arrays, by unknown, by input, by design
    /// variable, of shape (n, n, variables).
    linear_partials() -> (ByVariable<'py>, ByVariable<'py>, ByVariable<'py>) = |q, u, b| {
        let found = py.detach(|| self.kernels().linear_partials(&q, &u, &b));
        let lists = [&found.by_coordinate, &found.by_input, &found.by_design];
        let every = lists.into_iter().flatten();
        self.finite(py, &q, every.flat_map(|x| [&x.mass, &x.damping, &x.stiffness]).map(|x| x.as_flattened()))?;
        let of = |matrix: fn(&Linear) -> &Matrix| {
            let by = |list: &[Linear]| {
                let all: Vec<&Matrix> = list.iter().map(matrix).collect();
                arrays::slopes(py, q.len(), &all)
            };
            PyResult::Ok((by(lists[0])?, by(lists[1])?, by(lists[2])?))
        };
        Ok((of(|x| &x.mass)?, of(|x| &x.damping)?, of(|x| &x.stiffness)?))
    };
    /// Explicit derivatives of the residual at rest by inputs, shape (n, inputs), and by design variables, shape (n,
    /// design), SI.
    residual_partials() -> (Array2<'py>, Array2<'py>) = |q, u, b| {
        let (by_input, by_design) = py.detach(|| self.kernels().residual_partials(&q, &u, &b));
        self.finite(py, &q, [&by_input, &by_design].into_iter().map(|x| x.as_flattened()))?;
        Ok((arrays::matrix(py, &by_input)?, arrays::matrix(py, &by_design)?))
    };
    /// Explicit gradient of `phi^T (Khat - lambda Mhat) phi`, SI, by unknowns, inputs and design variables: arrays of
    /// shapes (n,), (inputs,) and (design,). With `phi^T Mhat phi = 1` that is the one of the `eigenvalue` lambda of an
    /// undamped mode of shape `phi`, (n,), with the equilibrium held.
    mode_gradient(phi; eigenvalue) -> Slopes<'py> = |q, u, b| {
        let found = py.detach(|| self.kernels().mode_gradient(&q, &u, &b, &phi, eigenvalue));
        self.gradient(py, &q, found)
    };
    /// Explicit gradient of `w^T g`, with `g` the residual at rest and `w` of shape (n,), SI, by unknowns, inputs and
    /// design variables: arrays of shapes (n,), (inputs,) and (design,).
    residual_gradient(w) -> Slopes<'py> = |q, u, b| {
        let found = py.detach(|| self.kernels().residual_gradient(&q, &u, &b, &w));
        self.gradient(py, &q, found)
    };
    /// Explicit gradient of `left^T (Mhat acceleration + Chat velocity + Khat position)`, four vectors of shape (n,), SI,
    /// by unknowns, inputs and design variables: arrays of shapes (n,), (inputs,) and (design,).
    pencil_gradient(left, acceleration, velocity, position) -> Slopes<'py> = |q, u, b| {
        let vectors = [&left[..], &acceleration, &velocity, &position];
        let found = py.detach(|| self.kernels().pencil_gradient(&q, &u, &b, vectors));
        self.gradient(py, &q, found)
    };
    /// The declared outputs at the state `q`, SI, shape (outputs,).
    output_values() -> Array1<'py> = |q, u, b| {
        let found = py.detach(|| self.kernels().outputs(&q, &u, &b));
        self.finite(py, &q, [&found[..]].into_iter())?;
        Ok(arrays::vector(py, found))
    };
    /// The harmonic forces of every excitation about the state `q`, SI: with `F = forces[k]`, complex, excitation k acts
    /// on the equations as `Re(F e^{i w t})`, `w = frequencies[k]`, rad/s, which may be negative; `direct[k]`, complex, is
    /// what it adds to the outputs besides their dependence on the motion. Shapes (e, n), (e,) and (e, outputs), with e
    /// the number of excitations.
    forcing() -> Forcing<'py> = |q, u, b| {
        let sizes = self.kernels().sizes();
        let (rows, columns) = (sizes.excitations, [sizes.coordinates, sizes.outputs]);
        let [mut cosine, mut direct_cosine] = columns.map(|count| vec![0.0; rows * count]);
        let [mut sine, mut direct_sine] = columns.map(|count| vec![0.0; rows * count]);
        let mut frequency = vec![0.0; rows];
        py.detach(|| {
            let results: &mut [&mut [f64]] = &mut [
                &mut cosine, &mut frequency, &mut direct_cosine, &mut sine, &mut direct_sine,
            ];
            self.kernels().evaluate(Kernel::Forcing, &[&q, &u, &b], results);
        });
        let all = [&cosine, &frequency, &direct_cosine, &sine, &direct_sine];
        self.finite(py, &q, all.into_iter().map(|x| &x[..]))?;
        let complex = |cosine: &[f64], sine: &[f64], count| {
            let all = cosine.iter().zip(sine).map(|(re, im)| Complex::new(*re, -im));
            arrays::vector(py, all).reshape([rows, count])
        };
        Ok((
            complex(&cosine, &sine, columns[0])?,
            arrays::vector(py, frequency),
            complex(&direct_cosine, &direct_sine, columns[1])?,
        ))
    };
    /// Derivatives of the outputs, as functions of any motion, by qddot, qdot and q, at the state of rest `q`, SI: three
    /// arrays of shape (outputs, n).
    output_motion() -> Three<'py> = |q, u, b| {
        let sizes = self.kernels().sizes();
        let mut all = [(); 3].map(|()| Matrix::zeros(sizes.outputs, sizes.coordinates));
        py.detach(|| {
            let results = &mut all.each_mut().map(Matrix::as_flattened_mut);
            self.kernels().evaluate(Kernel::OutputMotion, &[&q, &u, &b], results);
        });
        self.finite(py, &q, all.iter().map(|x| x.as_flattened()))?;
        let [acceleration, velocity, position] = all.map(|x| arrays::matrix(py, &x));
        Ok((acceleration?, velocity?, position?))
    };
    /// Residual of the equations of the full nonlinear motion, N or N m, shape (n,): the forces that this motion would
    /// need besides those that act. `acceleration` is qddot, `velocity` qdot.
    motion_residual(acceleration, velocity) -> Array1<'py> = |q, u, b| {
        let found =
            py.detach(|| self.moving().motion_residual(&acceleration, &velocity, &q, &u, &b));
        self.finite(py, &q, [&found[..]].into_iter())?;
        Ok(arrays::vector(py, found))
    };
    /// Derivatives of that residual by qddot, qdot and q: three arrays of shape (n, n), SI.
    motion_linear(acceleration, velocity) -> Three<'py> = |q, u, b| {
        let found = py.detach(|| self.moving().motion_linear(&acceleration, &velocity, &q, &u, &b));
        self.three(py, &q, &found)
    };
    /// Mass matrix and forces of the full nonlinear motion, `M qddot = Q`: shapes (n, n) and (n,), SI. `velocity` is
    /// qdot.
    mass_and_forces(velocity) -> (Array2<'py>, Array1<'py>) = |q, u, b| {
        let (mass, forces) = py.detach(|| self.moving().motion(&velocity, &q, &u, &b));
        self.finite(py, &q, [mass.as_flattened(), &forces[..]].into_iter())?;
        Ok((arrays::matrix(py, &mass)?, arrays::vector(py, forces)))
    };
    /// Accelerations of the full nonlinear motion, shape (n,), rad/s^2 or m/s^2; in the places of speeds their rates,
    /// in those of constraints the reactions. `velocity` is qdot.
    ///
    /// `Mechanism.motion` gives a right-hand side that integrators call.
    accelerations(velocity) -> Array1<'py> = |q, u, b| {
        Ok(arrays::vector(py, py.detach(|| motion::accelerations(&self.inner, &velocity, &q, &u, &b)).map_err(|error| raise(py, error))?))
    };
}
