//! The spread of modes over samples.

use eigentol::tolerance::{Outcome, Sample, Statistics};
use eigentol::{Complex, Quantity};
use pyo3::prelude::*;
use pyo3::types::IntoPyDict;

use super::{Described, attributes, family, quantity, result};
use crate::arrays::{Array1, Array2, optional, optional_rows, or_nan, rows};
use crate::errors::invalid;
use crate::hints;

result! {
    /// Samples of the design, each with its own equilibrium and modes. `m` is the number of modes, `N` that of the
    /// samples; modes are in the order of the nominal ones.
    MonteCarlo(eigentol::MonteCarlo), crate::results::typed
}

impl MonteCarlo {
    fn statistics<'py>(
        &self,
        py: Python<'py>,
        name: &str,
        of: impl Fn(&Statistics) -> Option<f64>,
    ) -> PyResult<Array1<'py>> {
        let all = match quantity(py, name)? {
            Quantity::Frequency => &self.0.modes,
            Quantity::DampingRatio => &self.0.damping_ratios,
            _ => {
                let message = format!("there are no statistics of `{name}`: take the samples");
                return Err(invalid(py, message));
            }
        };
        Ok(optional(py, all.iter().map(|x| x.as_ref().and_then(&of))))
    }

    fn kept(&self, py: Python<'_>) -> PyResult<&[Sample]> {
        self.0
            .all
            .as_deref()
            .ok_or_else(|| invalid(py, "the samples were not kept: set keep_samples=True in the study".to_owned()))
    }

    fn of_samples<'py>(&self, py: Python<'py>, of: impl Fn(&Sample) -> &[Option<f64>]) -> PyResult<Array2<'py>> {
        rows(py, self.0.modes.len(), self.kept(py)?.iter().map(|x| of(x).iter().copied().map(or_nan).collect()))
    }
}

attributes! {
    MonteCarlo(self, py) {
        /// Number of samples.
        samples: usize = self.0.samples;
        /// Seed of the random numbers.
        seed: u64 = self.0.seed;
        /// Which of the seed's independent sequences.
        stream: u64 = self.0.stream;
        /// How many stable samples lie on another branch of equilibria than the nominal one.
        on_another_branch: usize = self.0.left_nominal_branch;
        /// Design variables of the samples, SI, shape (N, design). The samples have to be kept (`keep_samples=True`).
        designs: PyResult<Array2<'py>> = {
            let all = self.kept(py)?.iter().map(|x| x.design.to_vec());
            rows(py, self.0.description.design.len(), all)
        };
        /// Equilibria of the samples, SI, shape (N, n); NaN where there is none.
        coordinates: PyResult<Array2<'py>> = {
            let all = self.kept(py)?.iter();
            let all = all.map(|item| item.coordinates.as_ref().map(|coordinates| coordinates.to_vec()));
            optional_rows(py, self.0.description.coordinates.len(), all)
        };
        /// Eigenvalues of the samples, 1/s, complex, shape (N, m); NaN where there is none.
        eigenvalues: PyResult<Array2<'py, Complex>> = {
            let none = Complex::new(f64::NAN, f64::NAN);
            let row = |sample: &Sample| sample.eigenvalues.iter().map(|s| s.unwrap_or(none)).collect();
            rows(py, self.0.modes.len(), self.kept(py)?.iter().map(row))
        };
        /// Frequencies of the samples, rad/s, shape (N, m).
        frequencies: PyResult<Array2<'py>> = self.of_samples(py, |sample| &sample.frequencies);
        /// Damping ratios of the samples, shape (N, m).
        damping_ratios: PyResult<Array2<'py>> = self.of_samples(py, |sample| &sample.damping_ratios);
        /// What became of each sample: "Stable", "Divergent", "Flutter", "NoEquilibrium" ...
        outcomes: PyResult<Vec<String>> = {
            Ok(self.kept(py)?.iter().map(|x| format!("{:?}", x.outcome)).collect())
        };
        /// Number of samples that were asked for: more than `samples` if the run was stopped or is a part.
        planned: usize = self.0.planned;
        /// First sample and the one behind the last of each range that is done.
        ranges: Vec<(u64, u64)> = self.0.ranges.iter().map(|range| (range.start, range.end)).collect();
        /// Whether samples were solved side by side in vectors.
        side_by_side: bool = self.0.side_by_side;
        /// Whether some nominal modes have equal eigenvalues, and are told apart by their order only.
        clustered: bool = self.0.clustered;
        /// "undamped" or "general".
        family: &'static hints::Family = family(self.0.family);
        /// Whether any variable has a tolerance.
        varies: bool = self.0.varies;
        /// How many designs became what, by name.
        counts: PyResult<hints::Counts<'py>> = {
            Outcome::ALL.into_iter().map(|outcome| (format!("{outcome:?}"), self.0.counts.of(outcome))).into_py_dict(py)
        };
    }
}

attributes! {
    MonteCarlo(self, py, quantity: hints::Quantity = "frequency") {
        /// Means of "frequency" (rad/s) or "damping_ratio" over the stable samples, shape (m,).
        mean: Array1<'py> = self.statistics(py, quantity, |statistics| Some(statistics.mean));
        /// Standard deviations likewise, shape (m,).
        sigma: Array1<'py> = self.statistics(py, quantity, |statistics| statistics.sigma);
        /// Standard errors of the means, shape (m,); those of the standard deviations are `sigma_error`.
        standard_error: Array1<'py> = self.statistics(py, quantity, |statistics| statistics.standard_error);
        /// Standard errors of the standard deviations, shape (m,), for any distribution.
        sigma_error: Array1<'py> = self.statistics(py, quantity, |statistics| statistics.sigma_error);
        /// Number of samples in which each mode has the quantity, shape (m,).
        count: Array1<'py> = self.statistics(py, quantity, |statistics| Some(statistics.count as f64));
        /// Skewness, shape (m,).
        skewness: Array1<'py> = self.statistics(py, quantity, |statistics| statistics.skewness);
        /// Standard errors of the skewness of normal values, shape (m,).
        skewness_error: Array1<'py> = self.statistics(py, quantity, |statistics| statistics.skewness_error);
        /// Excess kurtosis, shape (m,).
        excess_kurtosis: Array1<'py> = self.statistics(py, quantity, |statistics| statistics.excess_kurtosis);
        /// Standard errors of the kurtosis of normal values, shape (m,).
        kurtosis_error: Array1<'py> = self.statistics(py, quantity, |statistics| statistics.kurtosis_error);
        /// Least values, shape (m,).
        least: Array1<'py> = self.statistics(py, quantity, |statistics| Some(statistics.min));
        /// Greatest values, shape (m,).
        greatest: Array1<'py> = self.statistics(py, quantity, |statistics| Some(statistics.max));
    }
}

#[pymethods]
impl MonteCarlo {
    /// Quantiles of "frequency" (rad/s) or "damping_ratio" over the stable samples for a probability between 0 and 1,
    /// shape (m,).
    #[pyo3(signature = (probability, quantity="frequency"))]
    fn quantile<'py>(&self, py: Python<'py>, probability: f64, quantity: &hints::Quantity) -> PyResult<Array1<'py>> {
        if !(0.0..=1.0).contains(&probability) {
            let message = format!("`probability` is {probability}: give one between 0 and 1");
            return Err(invalid(py, message));
        }
        let value = |statistics: &Statistics| Some(statistics.quantile(probability).ok()?.value);
        self.statistics(py, quantity, value)
    }
}
