//! The modes about an equilibrium.

use eigentol::modes::Family;
use eigentol::{Complex, Mode};
use pyo3::prelude::*;

use super::{Described, attributes, result};
use crate::arrays::{Array1, Array2, optional, rows, vector};
use crate::{hints, names};

result! {
    /// The modes about an equilibrium: undamped ones ascending in frequency, general ones in frequency too, those that
    /// do not oscillate first. `m` is their number, `n` that of the unknowns.
    Modes(eigentol::Modes), crate::results::typed
}

pub(crate) fn family(kind: Family) -> &'static hints::Family {
    match kind {
        Family::Undamped => "undamped",
        Family::General => "general",
    }
}

impl Modes {
    fn each<T>(&self, of: impl Fn(&Mode) -> T) -> impl Iterator<Item = T> {
        self.0.modes.iter().map(of)
    }
}

attributes! {
    Modes(self, py) {
        /// Eigenvalues `s`, 1/s, complex, shape (m,): motions go as exp(s t). Of a conjugate pair the one with positive
        /// imaginary part.
        eigenvalues: Array1<'py, Complex> = vector(py, self.each(|mode| mode.s));
        /// All eigenvalues of the first-order form, 1/s, complex. The oscillating ones stand in ROSS's order: those with a
        /// positive imaginary part, ascending in it, after these their conjugates, again ascending. The real ones follow,
        /// ascending.
        ///
        /// A neutral undamped mode has two that are zero, a divergent one both signs.
        state_space_eigenvalues: Array1<'py, Complex> = {
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
        };
        /// Frequencies `Im s`, rad/s, shape (m,); NaN for a mode that does not oscillate.
        frequencies: Array1<'py> = optional(py, self.each(Mode::frequency));
        /// Natural frequencies `|s|`, rad/s, shape (m,); NaN for a mode that does not oscillate.
        natural_frequencies: Array1<'py> = optional(py, self.each(Mode::natural_frequency));
        /// Damping ratios `-Re s / |s|`, shape (m,); NaN for a neutral mode.
        damping_ratios: Array1<'py> = optional(py, self.each(Mode::damping_ratio));
        /// `-Re s^2`, 1/s^2, shape (m,): of an undamped mode the eigenvalue of `Khat phi = lambda Mhat phi`.
        lambdas: Array1<'py> = vector(py, self.each(|mode| mode.lambda));
        /// Shapes, complex, shape (m, n): row `r` is mode `r`, with `phi^H Mhat phi = 1` where there are no speeds.
        shapes: PyResult<Array2<'py, Complex>> =
            rows(py, self.names(py).len(), self.each(|mode| mode.shape.to_vec()));
        /// Left vectors, complex, shape (m, n).
        left_shapes: PyResult<Array2<'py, Complex>> =
            rows(py, self.names(py).len(), self.each(|mode| mode.left().to_vec()));
        /// Estimated absolute errors of the eigenvalues, 1/s, shape (m,).
        errors: Array1<'py> = vector(py, self.each(|mode| mode.error));
        /// Numbers of the motions: modes with one label along a sweep are one motion.
        labels: Array1<'py, i64> = vector(py, self.each(|mode| mode.label as i64));
        /// What each mode does, in words.
        behaviours: Vec<String> = self.each(|mode| mode.behaviour.to_string()).collect();
        /// Whether no small disturbance grows exponentially; nothing resists a neutral motion, which counts as stable.
        stable: bool = self.0.stable();
        /// Names of the unknowns: the columns of the shapes.
        names: Vec<&str> = names::coordinates(&self.0.description);
        /// What is left of each eigenproblem, relative to its terms, shape (m,).
        residuals: Array1<'py> = vector(py, self.each(|mode| mode.residual));
        /// Condition numbers of the eigenvalues, shape (m,).
        conditions: Array1<'py> = vector(py, self.each(|mode| mode.condition));
        /// For each mode the positions of all that are nearly equal to it, its own among them.
        clusters: Vec<Vec<usize>> = (0..self.0.modes.len()).map(|r| self.0.cluster_of(r)).collect();
        /// Whether undamped modes were asked for of a mechanism that is damped.
        damping_ignored: bool = self.0.damping_ignored;
        /// "undamped" or "general".
        family: &'static hints::Family = family(self.0.family);
    }
}

#[pymethods]
impl Modes {
    fn __len__(&self) -> usize {
        self.0.modes.len()
    }
}
