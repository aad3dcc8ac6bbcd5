//! Results along an input.

use eigentol::campbell::CampbellMode;
use eigentol::sweep::Searched;
use eigentol::tolerance::Spread;
use eigentol::{Complex, Error, Mode};
use pyo3::prelude::*;

use super::{Equilibrium, Modes, attributes, result};
use crate::arrays::{Array1, Array2, NONE, optional_rows, or_nan, rows, vector};
use crate::events::{Event, events};

result! {
    /// States along an input. `k` is their number, `n` that of the unknowns; a column of an array over modes is one
    /// motion.
    Sweep(eigentol::sweep::Sweep)
}

impl Sweep {
    fn labels(&self) -> usize {
        let modes = self.0.points.iter().filter_map(|point| point.modes.as_ref().ok());
        let labels = modes.flat_map(|x| x.modes.iter().map(|mode| mode.label + 1));
        labels.max().unwrap_or(0)
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

result! {
    /// A Campbell diagram: every mode against an input, with spreads and crossings. `k` is the number of values; a
    /// column of an array over modes is one motion, in the order of `labels`.
    Campbell(eigentol::Campbell)
}

impl Campbell {
    fn words(&self, of: &dyn Fn(&CampbellMode) -> Option<String>) -> Vec<Vec<Option<String>>> {
        let labels = self.0.labels();
        let row = |campbell_point: &eigentol::campbell::CampbellPoint| {
            let modes = campbell_point.modes.as_ref().map_or(&[][..], Vec::as_slice);
            let mode = |label: &usize| modes.iter().find(|mode| mode.label == *label);
            labels.iter().map(|label| mode(label).and_then(of)).collect()
        };
        self.0.points.iter().map(row).collect()
    }

    fn by_label<'py, T: numpy::Element + Copy>(
        &self,
        py: Python<'py>,
        none: T,
        of: impl Fn(&CampbellMode) -> Option<T>,
    ) -> PyResult<Array2<'py, T>> {
        let labels = self.0.labels();
        let row = |campbell_point: &eigentol::campbell::CampbellPoint| {
            let modes = campbell_point.modes.as_ref().map_or(&[][..], Vec::as_slice);
            let entry = |label: &usize| {
                let mode = modes.iter().find(|mode| mode.label == *label);
                mode.and_then(&of).unwrap_or(none)
            };
            labels.iter().map(entry).collect()
        };
        rows(py, labels.len(), self.0.points.iter().map(row))
    }
}

/// Ends and resolution.
fn searched(of: Option<&Searched>) -> Option<(f64, f64, f64)> {
    of.map(|x| (x.low, x.high, x.resolution))
}

fn unsearched(of: Option<&Searched>) -> Vec<(f64, f64)> {
    let unresolved = of.iter().flat_map(|x| &x.unresolved);
    let gaps = of.iter().flat_map(|x| &x.gaps);
    let ends = unresolved.map(|x| (x.from, x.to));
    ends.chain(gaps.map(|gap| (gap.from, gap.to))).collect()
}

fn sigma(spread: &Option<Spread>) -> Option<f64> {
    spread.as_ref().map(|spread| spread.sigma)
}

attributes! {
    Campbell(self, py) {
        /// Numbers of the motions, one for each column.
        labels: Vec<usize> = self.0.labels();
        /// Eigenvalues, 1/s, complex, shape (k, motions).
        eigenvalues: PyResult<Array2<'py, Complex>> = self.by_label(py, NONE, |mode| Some(mode.s));
        /// Frequencies, rad/s, shape (k, motions); NaN where a motion does not oscillate.
        frequencies: PyResult<Array2<'py>> =
            self.by_label(py, f64::NAN, |mode| mode.behaviour.frequency());
        /// Standard deviations of the frequencies to first order, rad/s, shape (k, motions).
        frequency_sigmas: PyResult<Array2<'py>> =
            self.by_label(py, f64::NAN, |mode| sigma(&mode.frequency));
        /// Means of the damping ratios, shape (k, motions).
        damping_ratios: PyResult<Array2<'py>> = {
            let mean = |mode: &CampbellMode| mode.damping_ratio.as_ref().map(|x| x.mean);
            self.by_label(py, f64::NAN, mean)
        };
        /// Standard deviations of the damping ratios to first order, shape (k, motions).
        damping_ratio_sigmas: PyResult<Array2<'py>> =
            self.by_label(py, f64::NAN, |mode| sigma(&mode.damping_ratio));
        /// Whirl, shape (k, motions): minor over major axis of the orbit, positive along the rotation; NaN where it does
        /// not apply.
        whirls: PyResult<Array2<'py>> = {
            let ratio = |mode: &CampbellMode| mode.whirl?.ratio;
            self.by_label(py, f64::NAN, |mode| Some(or_nan(ratio(mode))))
        };
        /// Where the frequency of a mode that something excites there meets a line, with spreads.
        crossings: Vec<Event> = events(&self.0.crossings);
        /// The other crossings: modes of shafts that no unbalance excites.
        not_excited: Vec<Event> = events(&self.0.not_excited);
        /// Where the stable equilibrium loses its stiffness, with spreads.
        critical: Vec<Event> = events(&self.0.critical);
        /// Where an oscillation begins or ceases to grow, with spreads.
        flutter_onsets: Vec<Event> = events(&self.0.flutter_onsets);
        /// What each motion does, in words, a list for each value; None where it was not found.
        behaviours: Vec<Vec<Option<String>>> = {
            self.words(&|mode| Some(mode.behaviour.to_string()))
        };
        /// The direction of each whirl, in words, a list for each value; None where it does not apply.
        whirl_senses: Vec<Vec<Option<String>>> =
            self.words(&|mode| Some(mode.whirl?.sense()?.to_string()));
        /// The kind of each motion, "lateral", "torsional", "axial" or "mixed", a list for each value; None where
        /// no shaft spins.
        kinds: Vec<Vec<Option<String>>> =
            self.words(&|mode| Some(mode.whirl?.kind.to_string()));
        /// Whether each motion is nearly equal to another, so that its spreads mean nothing, shape (k, motions).
        clustered: PyResult<Array2<'py, bool>> =
            self.by_label(py, false, |mode| Some(mode.clustered));
        /// The lines whose crossings were searched for: multiple of the input, and offset in rad/s.
        orders: Vec<(f64, f64)> = self.0.orders.iter().map(|order| (order.ratio, order.offset)).collect();
    }
}

attributes! {
    Sweep, Campbell(self, py) {
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
    }
}
