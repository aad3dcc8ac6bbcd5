//! Results along an input.

use eigentol::sweep::Searched;
use eigentol::{Complex, Error, Mode};
use pyo3::prelude::*;

use super::{Described, Equilibrium, Modes, attributes, result};
use crate::arrays::{Array1, Array2, NONE, optional_rows, rows, vector};

result! {
    /// States along an input. `k` is their number, `n` that of the unknowns; a column of an array over modes is one
    /// motion.
    Sweep(eigentol::sweep::Sweep), crate::results::typed
}

impl Sweep {
    fn labels(&self) -> usize {
        let modes = self.0.points.iter().filter_map(|point| point.modes.as_ref().ok());
        modes.flat_map(|x| x.modes.iter().map(|mode| mode.label + 1)).max().unwrap_or(0)
    }

    fn by_label<'py, T: numpy::Element + Copy>(
        &self,
        py: Python<'py>,
        none: T,
        of: impl Fn(&Mode) -> Option<T>,
    ) -> PyResult<Array2<'py, T>> {
        let labels = self.labels();
        let row = |sweep_point: &eigentol::sweep::SweepPoint| {
            let mut row = vec![none; labels];
            for mode in sweep_point.modes.iter().flat_map(|mode| &mode.modes) {
                row[mode.label] = of(mode).unwrap_or(none);
            }
            row
        };
        rows(py, labels, self.0.points.iter().map(row))
    }
}

fn message<T>(answer: &Result<T, Error>) -> Option<String> {
    answer.as_ref().err().map(ToString::to_string)
}

attributes! {
    Sweep(self, py) {
        /// Eigenvalues, 1/s, complex, shape (k, motions); NaN where a motion was not found.
        eigenvalues: PyResult<Array2<'py, Complex>> = self.by_label(py, NONE, |mode| Some(mode.s));
        /// Frequencies, rad/s, shape (k, motions); NaN where a motion does not oscillate.
        frequencies: PyResult<Array2<'py>> = self.by_label(py, f64::NAN, Mode::frequency);
        /// Damping ratios, shape (k, motions).
        damping_ratios: PyResult<Array2<'py>> = self.by_label(py, f64::NAN, Mode::damping_ratio);
        /// Values of the input at which the stable equilibrium loses its stiffness, SI.
        critical: Array1<'py> = vector(py, self.0.critical.iter().map(|x| x.value));
        /// What happens at each of these, in words.
        critical_kinds: Vec<String> =
            self.0.critical.iter().map(|critical| critical.kind.to_string()).collect();
        /// Values of the input at which an oscillation begins or ceases to grow, SI.
        flutter_onsets: Array1<'py> = vector(py, self.0.flutter_onsets.iter().map(|flutter_onset| flutter_onset.value));
        /// The modes at each value, or None.
        modes: Vec<Option<Modes>> =
            self.0.points.iter().map(|point| point.modes.clone().ok().map(Modes)).collect();
    }
}

/// Ends and resolution.
fn searched(of: Option<&Searched>) -> Option<(f64, f64, f64)> {
    of.map(|x| (x.low, x.high, x.resolution))
}

fn unsearched(of: Option<&Searched>) -> Vec<(f64, f64)> {
    let unresolved = of.iter().flat_map(|x| &x.unresolved);
    let gaps = of.iter().flat_map(|x| &x.gaps);
    unresolved.map(|x| (x.from, x.to)).chain(gaps.map(|gap| (gap.from, gap.to))).collect()
}

attributes! {
    Sweep(self, py) {
        /// Values of the input, SI, shape (k,).
        values: Array1<'py> = vector(py, self.0.points.iter().map(|point| point.value));
        /// Unknowns of the equilibria, shape (k, n); NaN where there is none.
        coordinates: PyResult<Array2<'py>> = {
            let all = self.0.points.iter().map(|point| point.equilibrium.as_ref().ok());
            let all = all.map(|item| item.map(|x| x.coordinates.to_vec()));
            optional_rows(py, self.0.description.coordinates.len(), all)
        };
        /// Why there is no equilibrium, or there are no modes, at each value: a text, or None where there are both.
        failures: Vec<Option<String>> =
            self.0.points.iter()
                .map(|point| message(&point.equilibrium).or_else(|| message(&point.modes))).collect();
        /// The equilibrium at each value, or None.
        equilibria: Vec<Option<Equilibrium>> =
            self.0.points.iter().map(|point| point.equilibrium.clone().ok().map(Equilibrium)).collect();
        /// The range that was searched for events, SI: its ends, and how close two of them may be; or None.
        searched: Option<(f64, f64, f64)> = searched(self.0.searched.as_ref());
        /// Stretches of it, SI, in which something may have been missed.
        unsearched: Vec<(f64, f64)> = unsearched(self.0.searched.as_ref());
        /// Number of values that were not reached.
        unreached: usize = self.0.unreached;
        /// Name of the input.
        input: String = self.0.description.inputs[self.0.input.index()].name.to_string();
    }
}

#[pymethods]
impl Sweep {
    fn __len__(&self) -> usize {
        self.0.points.len()
    }
}
