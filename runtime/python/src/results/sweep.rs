//! Results along an input.

use eigentol::campbell::CampbellMode;
use eigentol::tolerance::Spread;
use eigentol::{Complex, Error, Mode};
use pyo3::prelude::*;

use super::{Equilibrium, Modes, result};
use crate::arrays::{Array1, Array2, or_nan, rows, vector};
use crate::events::{Event, events};

const NONE: Complex = Complex::new(f64::NAN, f64::NAN);

result! {
    /// States along an input. `k` is their number, `n` that of the unknowns; a column of an array over modes is one
    /// motion.
    Sweep(eigentol::sweep::Sweep)
}

impl Sweep {
    fn labels(&self) -> usize {
        let modes = self
            .0
            .points
            .iter()
            .filter_map(|own| own.modes.as_ref().ok());
        let labels = modes.flat_map(|own| own.modes.iter().map(|mode| mode.label + 1));
        labels.max().unwrap_or(0)
    }

    fn by_label<'py, T: numpy::Element + Copy>(
        &self,
        py: Python<'py>,
        none: T,
        of: impl Fn(&Mode) -> Option<T>,
    ) -> PyResult<Array2<'py, T>> {
        let labels = self.labels();
        let row = |own: &eigentol::sweep::SweepPoint| {
            let mut row = vec![none; labels];
            for mode in own.modes.iter().flat_map(|own| &own.modes) {
                row[mode.label] = of(mode).unwrap_or(none);
            }
            row
        };
        rows(py, labels, self.0.points.iter().map(row))
    }
}

fn message<T>(found: &Result<T, Error>) -> Option<String> {
    found.as_ref().err().map(ToString::to_string)
}

#[pymethods]
impl Sweep {
    /// Values of the input, SI, shape (k,).
    #[getter]
    fn values<'py>(&self, py: Python<'py>) -> Array1<'py> {
        vector(py, self.0.points.iter().map(|own| own.value))
    }

    /// Unknowns of the equilibria, shape (k, n); NaN where there is none.
    #[getter]
    fn coordinates<'py>(&self, py: Python<'py>) -> PyResult<Array2<'py>> {
        let n = self.0.description.coordinates.len();
        let row = |own: &eigentol::sweep::SweepPoint| match &own.equilibrium {
            Ok(state) => state.coordinates.to_vec(),
            Err(_) => vec![f64::NAN; n],
        };
        rows(py, n, self.0.points.iter().map(row))
    }

    /// Eigenvalues, 1/s, complex, shape (k, motions); NaN where a motion was not found.
    #[getter]
    fn eigenvalues<'py>(&self, py: Python<'py>) -> PyResult<Array2<'py, Complex>> {
        self.by_label(py, NONE, |mode| Some(mode.s))
    }

    /// Frequencies, rad/s, shape (k, motions); NaN where a motion does not oscillate.
    #[getter]
    fn frequencies<'py>(&self, py: Python<'py>) -> PyResult<Array2<'py>> {
        self.by_label(py, f64::NAN, Mode::frequency)
    }

    /// Damping ratios, shape (k, motions).
    #[getter]
    fn damping_ratios<'py>(&self, py: Python<'py>) -> PyResult<Array2<'py>> {
        self.by_label(py, f64::NAN, Mode::damping_ratio)
    }

    /// Values of the input at which the stable equilibrium loses its stiffness, SI.
    #[getter]
    fn critical<'py>(&self, py: Python<'py>) -> Array1<'py> {
        vector(py, self.0.critical.iter().map(|own| own.value))
    }

    /// Why there is no equilibrium, or there are no modes, at each value: a text, or None where there are both.
    #[getter]
    fn failures(&self) -> Vec<Option<String>> {
        let all = self.0.points.iter();
        all.map(|own| message(&own.equilibrium).or_else(|| message(&own.modes)))
            .collect()
    }

    /// The equilibrium at each value, or None.
    #[getter]
    fn equilibria(&self) -> Vec<Option<Equilibrium>> {
        let all = self.0.points.iter();
        all.map(|own| own.equilibrium.clone().ok().map(Equilibrium))
            .collect()
    }

    /// The modes at each value, or None.
    #[getter]
    fn modes(&self) -> Vec<Option<Modes>> {
        let all = self.0.points.iter();
        all.map(|own| own.modes.clone().ok().map(Modes)).collect()
    }

    fn __len__(&self) -> usize {
        self.0.points.len()
    }
}

result! {
    /// A Campbell diagram: every mode against an input, with spreads and crossings. `k` is the number of values; a
    /// column of an array over modes is one motion, in the order of `labels`.
    Campbell(eigentol::Campbell)
}

impl Campbell {
    fn by_label<'py, T: numpy::Element + Copy>(
        &self,
        py: Python<'py>,
        none: T,
        of: impl Fn(&CampbellMode) -> Option<T>,
    ) -> PyResult<Array2<'py, T>> {
        let labels = self.0.labels();
        let row = |own: &eigentol::campbell::CampbellPoint| {
            let modes = own.modes.as_ref().map_or(&[][..], Vec::as_slice);
            let entry = |label: &usize| {
                let mode = modes.iter().find(|mode| mode.label == *label);
                mode.and_then(&of).unwrap_or(none)
            };
            labels.iter().map(entry).collect()
        };
        rows(py, labels.len(), self.0.points.iter().map(row))
    }
}

fn sigma(spread: &Option<Spread>) -> Option<f64> {
    spread.as_ref().map(|own| own.sigma)
}

#[pymethods]
impl Campbell {
    /// Values of the input, SI, shape (k,).
    #[getter]
    fn values<'py>(&self, py: Python<'py>) -> Array1<'py> {
        vector(py, self.0.points.iter().map(|own| own.value))
    }

    /// Numbers of the motions, one for each column.
    #[getter]
    fn labels(&self) -> Vec<usize> {
        self.0.labels()
    }

    /// Eigenvalues, 1/s, complex, shape (k, motions).
    #[getter]
    fn eigenvalues<'py>(&self, py: Python<'py>) -> PyResult<Array2<'py, Complex>> {
        self.by_label(py, NONE, |mode| Some(mode.s))
    }

    /// Frequencies, rad/s, shape (k, motions); NaN where a motion does not oscillate.
    #[getter]
    fn frequencies<'py>(&self, py: Python<'py>) -> PyResult<Array2<'py>> {
        self.by_label(py, f64::NAN, |mode| mode.behaviour.frequency())
    }

    /// Standard deviations of the frequencies to first order, rad/s, shape (k, motions).
    #[getter]
    fn frequency_sigmas<'py>(&self, py: Python<'py>) -> PyResult<Array2<'py>> {
        self.by_label(py, f64::NAN, |mode| sigma(&mode.frequency))
    }

    /// Means of the damping ratios, shape (k, motions).
    #[getter]
    fn damping_ratios<'py>(&self, py: Python<'py>) -> PyResult<Array2<'py>> {
        let mean = |mode: &CampbellMode| mode.damping_ratio.as_ref().map(|own| own.mean);
        self.by_label(py, f64::NAN, mean)
    }

    /// Standard deviations of the damping ratios to first order, shape (k, motions).
    #[getter]
    fn damping_ratio_sigmas<'py>(&self, py: Python<'py>) -> PyResult<Array2<'py>> {
        self.by_label(py, f64::NAN, |mode| sigma(&mode.damping_ratio))
    }

    /// Whirl, shape (k, motions): minor over major axis of the orbit, positive along the rotation; NaN where it does
    /// not apply.
    #[getter]
    fn whirls<'py>(&self, py: Python<'py>) -> PyResult<Array2<'py>> {
        let ratio = |mode: &CampbellMode| mode.whirl.map(|own| own.ratio);
        self.by_label(py, f64::NAN, |mode| Some(or_nan(ratio(mode))))
    }

    /// Where a frequency meets a line, with spreads.
    #[getter]
    fn crossings(&self) -> Vec<Event> {
        events(&self.0.crossings)
    }

    /// Where the stable equilibrium loses its stiffness, with spreads.
    #[getter]
    fn critical(&self) -> Vec<Event> {
        events(&self.0.critical)
    }

    /// Where an oscillation begins or ceases to grow, with spreads.
    #[getter]
    fn flutter_onsets(&self) -> Vec<Event> {
        events(&self.0.flutter_onsets)
    }

    fn __len__(&self) -> usize {
        self.0.points.len()
    }
}
