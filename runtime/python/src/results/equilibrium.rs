//! Equilibria of a mechanism.

use std::collections::BTreeMap;

use eigentol::Matrix;
use eigentol::equilibrium::AssemblyMode;
use pyo3::prelude::*;

use super::result;
use crate::arrays::{Array1, Array2, matrix, vector};
use crate::names;

result! {
    /// An equilibrium and the linearised mechanism there, SI. `n` is the number of unknowns.
    Equilibrium(eigentol::Equilibrium)
}

#[pymethods]
impl Equilibrium {
    /// Names of the unknowns.
    #[getter]
    fn names(&self) -> Vec<&str> {
        names::coordinates(&self.0.description)
    }

    /// The unknowns: coordinates (rad or m), after them speeds and reactions of constraints (SI), shape (n,).
    #[getter]
    fn coordinates<'py>(&self, py: Python<'py>) -> Array1<'py> {
        vector(py, self.0.coordinates.clone())
    }

    /// The inputs it belongs to, SI, shape (inputs,).
    #[getter]
    fn inputs<'py>(&self, py: Python<'py>) -> Array1<'py> {
        vector(py, self.0.inputs.clone())
    }

    /// The design variables it belongs to, SI, shape (design,).
    #[getter]
    fn design<'py>(&self, py: Python<'py>) -> Array1<'py> {
        vector(py, self.0.design.clone())
    }

    /// Mass matrix Mhat, shape (n, n).
    #[getter]
    fn mass<'py>(&self, py: Python<'py>) -> PyResult<Array2<'py>> {
        matrix(py, &self.0.linear.mass)
    }

    /// Damping and gyroscopic matrix Chat, shape (n, n).
    #[getter]
    fn damping<'py>(&self, py: Python<'py>) -> PyResult<Array2<'py>> {
        matrix(py, &self.0.linear.damping)
    }

    /// Stiffness matrix Khat, shape (n, n).
    #[getter]
    fn stiffness<'py>(&self, py: Python<'py>) -> PyResult<Array2<'py>> {
        matrix(py, &self.0.linear.stiffness)
    }

    /// Remaining residual, N or N m, shape (n,).
    #[getter]
    fn residual<'py>(&self, py: Python<'py>) -> Array1<'py> {
        vector(py, self.0.residual.clone())
    }

    /// Greatest remaining residual, relative to the forces in its own equation.
    #[getter]
    fn relative_residual(&self) -> f64 {
        self.0.relative_residual
    }

    /// What the mechanism would do there, in words.
    #[getter]
    fn stability(&self) -> String {
        self.0.stability.to_string()
    }

    /// Whether no small disturbance grows exponentially; nothing resists a neutral motion, which counts as stable.
    #[getter]
    fn stable(&self) -> bool {
        self.0.stability.holds()
    }

    /// Iterations spent.
    #[getter]
    fn iterations(&self) -> usize {
        self.0.iterations
    }

    /// What to know about how it was found: that it is unstable and stays at the start, what holds it in a family of steady
    /// motions.
    #[getter]
    fn notes(&self) -> Vec<String> {
        self.0.sentences()
    }

    /// The unknowns that hold it in a family of steady motions, with their values, SI.
    #[getter]
    fn held(&self) -> BTreeMap<String, f64> {
        let held = self.0.free.held.iter();
        let name = |unknown: usize| self.0.description.coordinates[unknown].name.to_string();
        held.map(|held| (name(held.unknown), held.value)).collect()
    }

    /// Motions that nothing resists, wherever the mechanism stands, shape (r, n).
    #[getter]
    fn free<'py>(&self, py: Python<'py>) -> PyResult<Array2<'py>> {
        let motions = &self.0.free.motions;
        let columns = self.0.coordinates.len();
        matrix(
            py,
            &Matrix::from_fn(motions.len(), columns, |r, i| motions[r][i]),
        )
    }
}

result! {
    /// How an equilibrium moves with inputs and design variables, SI. `n` is the number of unknowns.
    EquilibriumShift(eigentol::sensitivity::EquilibriumShift)
}

#[pymethods]
impl EquilibriumShift {
    /// Derivatives of the unknowns by inputs, shape (n, inputs).
    #[getter]
    fn by_input<'py>(&self, py: Python<'py>) -> PyResult<Array2<'py>> {
        matrix(py, &self.0.by_input)
    }

    /// Derivatives of the unknowns by design variables, shape (n, design).
    #[getter]
    fn by_design<'py>(&self, py: Python<'py>) -> PyResult<Array2<'py>> {
        matrix(py, &self.0.by_design)
    }
}

result! {
    /// A state that closes the loops of a mechanism, SI. `n` is the number of unknowns.
    Assembly(eigentol::equilibrium::Assembly)
}

#[pymethods]
impl Assembly {
    /// Names of the unknowns.
    #[getter]
    fn names(&self) -> Vec<&str> {
        names::coordinates(&self.0.description)
    }

    /// The unknowns: coordinates (rad or m), after them speeds and reactions of constraints (SI), shape (n,).
    #[getter]
    fn coordinates<'py>(&self, py: Python<'py>) -> Array1<'py> {
        vector(py, self.0.coordinates.clone())
    }

    /// Which unknowns were held at their start values.
    #[getter]
    fn held(&self) -> Vec<bool> {
        self.0.held.clone()
    }

    /// How far each unknown moved from its start value, shape (n,).
    #[getter]
    fn moved<'py>(&self, py: Python<'py>) -> Array1<'py> {
        vector(py, self.0.moved.clone())
    }

    /// Gap left in each constraint, at the place of its reaction, shape (n,): rounding.
    #[getter]
    fn gaps<'py>(&self, py: Python<'py>) -> Array1<'py> {
        vector(py, self.0.gaps.clone())
    }

    /// On which side of the dead centres it is assembled, "positive" or "negative": no motion leads from one to the
    /// other but through a dead centre. None unless as many coordinates are held as the mechanism has degrees of
    /// freedom.
    #[getter]
    fn mode(&self) -> Option<&'static str> {
        self.0.mode.map(|mode| match mode {
            AssemblyMode::Positive => "positive",
            AssemblyMode::Negative => "negative",
        })
    }

    /// How well the constraints determine the coordinates that are not held: 1 at best, 0 at a dead centre.
    #[getter]
    fn margin(&self) -> f64 {
        self.0.margin
    }

    /// Whether it is a dead centre or a singular configuration.
    #[getter]
    fn singular(&self) -> bool {
        self.0.singular
    }
}
