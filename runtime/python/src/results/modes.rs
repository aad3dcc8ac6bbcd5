//! The modes about an equilibrium.

use eigentol::modes::Family;
use eigentol::{Complex, Mode};
use pyo3::prelude::*;

use super::result;
use crate::arrays::{Array1, Array2, matrix, optional, vector};
use crate::names;

result! {
    /// The modes about an equilibrium: undamped ones ascending in frequency, general ones in `|s|`. `m` is their
    /// number, `n` that of the unknowns.
    Modes(eigentol::Modes)
}

impl Modes {
    fn each<T>(&self, of: impl Fn(&Mode) -> T) -> impl Iterator<Item = T> {
        self.0.modes.iter().map(of)
    }
}

#[pymethods]
impl Modes {
    /// Eigenvalues `s`, 1/s, complex, shape (m,): motions go as exp(s t). Of a conjugate pair the one with positive
    /// imaginary part.
    #[getter]
    fn eigenvalues<'py>(&self, py: Python<'py>) -> Array1<'py, Complex> {
        vector(py, self.each(|mode| mode.s))
    }

    /// All eigenvalues of the first-order form, 1/s, complex. The oscillating ones stand in ROSS's order: those with a
    /// positive imaginary part, ascending in it, after these their conjugates, again ascending. The real ones follow,
    /// ascending.
    ///
    /// A neutral undamped mode has two that are zero, a divergent one both signs.
    #[getter]
    fn state_space_eigenvalues<'py>(&self, py: Python<'py>) -> Array1<'py, Complex> {
        let (mut turning, mut real): (Vec<Complex>, Vec<Complex>) =
            self.each(|mode| mode.s).partition(|s| s.im > 0.0);
        if self.0.family == Family::Undamped {
            let mirrored: Vec<Complex> = real.iter().map(|s| -s).collect();
            real.extend(mirrored);
        }
        turning.sort_by(|a, b| a.im.total_cmp(&b.im));
        real.sort_by(|a, b| a.re.total_cmp(&b.re));
        let conjugates: Vec<Complex> = turning.iter().rev().map(Complex::conj).collect();
        vector(py, [turning, conjugates, real].concat())
    }

    /// Frequencies `Im s`, rad/s, shape (m,); NaN for a mode that does not oscillate.
    #[getter]
    fn frequencies<'py>(&self, py: Python<'py>) -> Array1<'py> {
        optional(py, self.each(Mode::frequency))
    }

    /// Natural frequencies `|s|`, rad/s, shape (m,); NaN for a mode that does not oscillate.
    #[getter]
    fn natural_frequencies<'py>(&self, py: Python<'py>) -> Array1<'py> {
        optional(py, self.each(Mode::natural_frequency))
    }

    /// Damping ratios `-Re s / |s|`, shape (m,); NaN for a neutral mode.
    #[getter]
    fn damping_ratios<'py>(&self, py: Python<'py>) -> Array1<'py> {
        optional(py, self.each(Mode::damping_ratio))
    }

    /// `-Re s^2`, 1/s^2, shape (m,): of an undamped mode the eigenvalue of `Khat phi = lambda Mhat phi`.
    #[getter]
    fn lambdas<'py>(&self, py: Python<'py>) -> Array1<'py> {
        vector(py, self.each(|mode| mode.lambda))
    }

    /// Shapes, complex, shape (n, m): column `r` is mode `r`, with `phi^H Mhat phi = 1` where there are no speeds.
    #[getter]
    fn shapes<'py>(&self, py: Python<'py>) -> PyResult<Array2<'py, Complex>> {
        matrix(py, &self.0.shapes())
    }

    /// Left vectors, complex, shape (n, m).
    #[getter]
    fn left_shapes<'py>(&self, py: Python<'py>) -> PyResult<Array2<'py, Complex>> {
        matrix(py, &self.0.left_shapes())
    }

    /// Estimated absolute errors of the eigenvalues, 1/s, shape (m,).
    #[getter]
    fn errors<'py>(&self, py: Python<'py>) -> Array1<'py> {
        vector(py, self.each(|mode| mode.error))
    }

    /// Numbers of the motions: modes with one label along a sweep are one motion.
    #[getter]
    fn labels<'py>(&self, py: Python<'py>) -> Array1<'py, i64> {
        vector(py, self.each(|mode| mode.label as i64))
    }

    /// What each mode does, in words.
    #[getter]
    fn behaviours(&self) -> Vec<String> {
        self.each(|mode| mode.behaviour.to_string()).collect()
    }

    /// Whether no small disturbance grows exponentially; nothing resists a neutral motion, which counts as stable.
    #[getter]
    fn stable(&self) -> bool {
        self.0.stable()
    }

    /// "undamped" or "general".
    #[getter]
    fn family(&self) -> &str {
        match self.0.family {
            Family::Undamped => "undamped",
            Family::General => "general",
        }
    }

    /// Names of the unknowns: the rows of the shapes.
    #[getter]
    fn names(&self) -> Vec<&str> {
        names::coordinates(&self.0.description)
    }

    fn __len__(&self) -> usize {
        self.0.modes.len()
    }
}
