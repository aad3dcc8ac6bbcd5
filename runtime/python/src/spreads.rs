//! The effect of tolerances: results of first order, second order, sampling and propagation.

use eigentol::judge::Doubt;
use eigentol::propagation::{self, Estimated, QUANTILES};
use eigentol::second_order::{ModeSecondOrder, SecondOrderSpread};
use eigentol::tolerance::{ModeTolerance, Sample, Spread, Statistics};
use eigentol::{Complex, Quantity};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays::{Array1, Array2, optional, optional_rows, or_nan, rows, vector};
use crate::errors::invalid;
use crate::names;
use crate::results::{quantity, result};

result! {
    /// First-order spread of all modes. `m` is the number of modes; quantities are "frequency" (rad/s),
    /// "natural_frequency" (rad/s), "damping_ratio", "growth" (1/s) and "lambda" (1/s^2). NaN stands where a mode has
    /// none.
    FirstOrder(eigentol::FirstOrder)
}

impl FirstOrder {
    fn each<T>(
        &self,
        py: Python<'_>,
        name: &str,
        of: impl Fn(&Spread) -> T,
    ) -> PyResult<Vec<Option<T>>> {
        let wanted = match name {
            "lambda" => None,
            other => Some(quantity(py, other)?),
        };
        let one = |mode: &ModeTolerance| match wanted {
            None => Some(of(&mode.lambda)),
            Some(quantity) => mode.of(quantity).as_ref().map(&of),
        };
        Ok(self.0.modes.iter().map(one).collect())
    }
}

#[pymethods]
impl FirstOrder {
    /// Names of the design variables, and after them of the inputs that have a tolerance: the columns of gradients and
    /// shares.
    #[getter]
    fn names(&self) -> Vec<&str> {
        names::design(&self.0.description)
    }

    /// Means, shape (m,).
    #[pyo3(signature = (quantity="frequency"))]
    fn mean<'py>(&self, py: Python<'py>, quantity: &str) -> PyResult<Array1<'py>> {
        Ok(optional(py, self.each(py, quantity, |own| own.mean)?))
    }

    /// Standard deviations, shape (m,).
    #[pyo3(signature = (quantity="frequency"))]
    fn sigma<'py>(&self, py: Python<'py>, quantity: &str) -> PyResult<Array1<'py>> {
        Ok(optional(py, self.each(py, quantity, |own| own.sigma)?))
    }

    /// Half-widths of the bands that hold as many standard deviations as the tolerances do, shape (m,).
    #[pyo3(signature = (quantity="frequency"))]
    fn band<'py>(&self, py: Python<'py>, quantity: &str) -> PyResult<Array1<'py>> {
        Ok(optional(py, self.each(py, quantity, |own| own.band)?))
    }

    /// Derivatives per SI unit of each variable, shape (m, variables).
    #[pyo3(signature = (quantity="frequency"))]
    fn gradient<'py>(&self, py: Python<'py>, quantity: &str) -> PyResult<Array2<'py>> {
        let all = self.each(py, quantity, |own| own.by_design.to_vec())?;
        optional_rows(py, self.0.description.design.len(), all)
    }

    /// Shares of the variables in the variance, shape (m, variables).
    #[pyo3(signature = (quantity="frequency"))]
    fn shares<'py>(&self, py: Python<'py>, quantity: &str) -> PyResult<Array2<'py>> {
        let all = self.each(py, quantity, |own| own.variance_shares.to_vec())?;
        optional_rows(py, self.0.description.design.len(), all)
    }

    /// Standard deviations between each mode and the state where its stiffness vanishes, shape (m,); may be infinite.
    #[getter]
    fn distances_to_critical<'py>(&self, py: Python<'py>) -> Array1<'py> {
        vector(py, self.0.modes.iter().map(|own| own.distance_to_critical))
    }

    /// For each mode the doubts that distances raise about its standard deviations: texts, none where they are large.
    /// They do not tell how large an error is; `summary` lets samples decide.
    #[getter]
    fn doubts(&self) -> Vec<Vec<String>> {
        let all = 0..self.0.modes.len();
        all.map(|mode| texts(&self.0.doubts(mode))).collect()
    }

    /// Whether distances leave no doubt about any mode. Where they do, `summary` lets samples decide.
    #[getter]
    fn trusted(&self) -> bool {
        self.0.trusted()
    }
}

result! {
    /// Spread of all modes to second order. `m` is the number of modes; quantities are "frequency" (rad/s),
    /// "natural_frequency" (rad/s) and "damping_ratio". NaN stands where a mode has none.
    SecondOrder(eigentol::second_order::SecondOrder)
}

impl SecondOrder {
    fn each<'py>(
        &self,
        py: Python<'py>,
        name: &str,
        of: impl Fn(&SecondOrderSpread) -> f64,
    ) -> PyResult<Array1<'py>> {
        let spread: fn(&ModeSecondOrder) -> &SecondOrderSpread = match quantity(py, name)? {
            Quantity::Frequency => |own| &own.frequency,
            Quantity::NaturalFrequency => |own| &own.natural_frequency,
            Quantity::DampingRatio => |own| &own.damping_ratio,
            _ => return Err(invalid(py, format!("there is no second order of `{name}`"))),
        };
        let all = self.0.modes.iter();
        Ok(optional(
            py,
            all.map(|mode| mode.as_ref().ok().map(|own| of(spread(own)))),
        ))
    }
}

#[pymethods]
impl SecondOrder {
    /// Means, shape (m,).
    #[pyo3(signature = (quantity="frequency"))]
    fn mean<'py>(&self, py: Python<'py>, quantity: &str) -> PyResult<Array1<'py>> {
        self.each(py, quantity, |own| own.moments.mean)
    }

    /// Standard deviations, shape (m,).
    #[pyo3(signature = (quantity="frequency"))]
    fn sigma<'py>(&self, py: Python<'py>, quantity: &str) -> PyResult<Array1<'py>> {
        self.each(py, quantity, |own| own.moments.sigma)
    }

    /// Skewness, shape (m,).
    #[pyo3(signature = (quantity="frequency"))]
    fn skewness<'py>(&self, py: Python<'py>, quantity: &str) -> PyResult<Array1<'py>> {
        self.each(py, quantity, |own| own.moments.skewness)
    }

    /// For each mode the doubts that distances raise, as those of first order.
    #[getter]
    fn doubts(&self) -> Vec<Vec<String>> {
        self.0.doubts.iter().map(|own| texts(own)).collect()
    }

    /// Why a mode has no second order: a text for each mode, or None.
    #[getter]
    fn failures(&self) -> Vec<Option<String>> {
        let all = self.0.modes.iter();
        all.map(|mode| mode.as_ref().err().map(ToString::to_string))
            .collect()
    }
}

result! {
    /// First order, second order, and for each mode whether its standard deviation can be trusted.
    Summary(eigentol::summary::Summary)
}

#[pymethods]
impl Summary {
    /// The first-order spread.
    #[getter]
    fn first(&self) -> FirstOrder {
        FirstOrder(self.0.first.clone())
    }

    /// The spread to second order.
    #[getter]
    fn second(&self) -> SecondOrder {
        SecondOrder(self.0.second.clone())
    }

    /// Whether every mode is trusted.
    #[getter]
    fn trusted(&self) -> bool {
        self.0.trusted()
    }

    /// For each mode why its standard deviation is in doubt: texts, none where it can be trusted.
    #[getter]
    fn doubts(&self) -> Vec<Vec<String>> {
        self.0.trust.iter().map(|own| texts(&own.doubts)).collect()
    }
}

result! {
    /// Samples of the design, each with its own equilibrium and modes. `m` is the number of modes, `N` that of the
    /// samples; modes are in the order of the nominal ones.
    MonteCarlo(eigentol::MonteCarlo)
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
        Ok(optional(
            py,
            all.iter().map(|own| own.as_ref().and_then(&of)),
        ))
    }

    fn kept(&self, py: Python<'_>) -> PyResult<&[Sample]> {
        self.0.all.as_deref().ok_or_else(|| {
            let message = "the samples were not kept: set keep_samples=True in the study";
            invalid(py, message.to_owned())
        })
    }

    fn of_samples<'py>(
        &self,
        py: Python<'py>,
        of: impl Fn(&Sample) -> &[Option<f64>],
    ) -> PyResult<Array2<'py>> {
        let row = |own| of(own).iter().copied().map(or_nan).collect();
        rows(py, self.0.modes.len(), self.kept(py)?.iter().map(row))
    }
}

#[pymethods]
impl MonteCarlo {
    /// How many samples became what, by name.
    #[getter]
    fn counts<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        counts(py, &self.0.counts)
    }

    /// Number of samples.
    #[getter]
    fn samples(&self) -> usize {
        self.0.samples
    }

    /// Seed of the random numbers.
    #[getter]
    fn seed(&self) -> u64 {
        self.0.seed
    }

    /// Which of the seed's independent sequences.
    #[getter]
    fn stream(&self) -> u64 {
        self.0.stream
    }

    /// Means of "frequency" (rad/s) or "damping_ratio" over the stable samples, shape (m,).
    #[pyo3(signature = (quantity="frequency"))]
    fn mean<'py>(&self, py: Python<'py>, quantity: &str) -> PyResult<Array1<'py>> {
        self.statistics(py, quantity, |own| Some(own.mean))
    }

    /// Standard deviations likewise, shape (m,).
    #[pyo3(signature = (quantity="frequency"))]
    fn sigma<'py>(&self, py: Python<'py>, quantity: &str) -> PyResult<Array1<'py>> {
        self.statistics(py, quantity, |own| own.sigma)
    }

    /// Standard errors of the means, shape (m,); those of the standard deviations are `sigma_error`.
    #[pyo3(signature = (quantity="frequency"))]
    fn standard_error<'py>(&self, py: Python<'py>, quantity: &str) -> PyResult<Array1<'py>> {
        self.statistics(py, quantity, |own| own.standard_error)
    }

    /// Standard errors of the standard deviations, shape (m,), for any distribution.
    #[pyo3(signature = (quantity="frequency"))]
    fn sigma_error<'py>(&self, py: Python<'py>, quantity: &str) -> PyResult<Array1<'py>> {
        self.statistics(py, quantity, |own| own.sigma_error)
    }

    /// How many stable samples lie on another branch of equilibria than the nominal one.
    #[getter]
    fn on_another_branch(&self) -> usize {
        self.0.left_nominal_branch
    }

    /// Design variables of the samples, SI, shape (N, design). The samples have to be kept (`keep_samples=True`).
    #[getter]
    fn designs<'py>(&self, py: Python<'py>) -> PyResult<Array2<'py>> {
        let all = self.kept(py)?.iter().map(|own| own.design.to_vec());
        rows(py, self.0.description.design.len(), all)
    }

    /// Equilibria of the samples, SI, shape (N, n); NaN where there is none.
    #[getter]
    fn coordinates<'py>(&self, py: Python<'py>) -> PyResult<Array2<'py>> {
        let all = self.kept(py)?.iter();
        let all = all.map(|own| own.coordinates.as_ref().map(|own| own.to_vec()));
        optional_rows(py, self.0.description.coordinates.len(), all)
    }

    /// Eigenvalues of the samples, 1/s, complex, shape (N, m); NaN where there is none.
    #[getter]
    fn eigenvalues<'py>(&self, py: Python<'py>) -> PyResult<Array2<'py, Complex>> {
        let none = Complex::new(f64::NAN, f64::NAN);
        let row = |own: &Sample| own.eigenvalues.iter().map(|s| s.unwrap_or(none)).collect();
        rows(py, self.0.modes.len(), self.kept(py)?.iter().map(row))
    }

    /// Frequencies of the samples, rad/s, shape (N, m).
    #[getter]
    fn frequencies<'py>(&self, py: Python<'py>) -> PyResult<Array2<'py>> {
        self.of_samples(py, |own| &own.frequencies)
    }

    /// Damping ratios of the samples, shape (N, m).
    #[getter]
    fn damping_ratios<'py>(&self, py: Python<'py>) -> PyResult<Array2<'py>> {
        self.of_samples(py, |own| &own.damping_ratios)
    }

    /// What became of each sample: "Stable", "Divergent", "Flutter", "NoEquilibrium" ...
    #[getter]
    fn outcomes(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        let all = self.kept(py)?.iter();
        Ok(all.map(|own| format!("{:?}", own.outcome)).collect())
    }
}

fn counts<'py>(py: Python<'py>, own: &eigentol::tolerance::Counts) -> PyResult<Bound<'py, PyDict>> {
    let all = PyDict::new(py);
    for outcome in eigentol::tolerance::Outcome::ALL {
        all.set_item(format!("{outcome:?}"), own.of(outcome))?;
    }
    Ok(all)
}

result! {
    /// First-order spread of the outputs, SI. `o` is the number of outputs; NaN stands where one has no derivatives.
    OutputTolerances(eigentol::tolerance::OutputTolerances)
}

#[pymethods]
impl OutputTolerances {
    /// Values, SI, shape (o,).
    #[getter]
    fn values<'py>(&self, py: Python<'py>) -> Array1<'py> {
        vector(py, self.0.values.clone())
    }

    /// Standard deviations, SI, shape (o,).
    #[getter]
    fn sigma<'py>(&self, py: Python<'py>) -> Array1<'py> {
        let all = self.0.spreads.iter();
        optional(py, all.map(|own| own.as_ref().map(|own| own.sigma)))
    }
}

result! {
    /// Probability that a quantity of a mode lies in a forbidden band.
    ModeMargin(eigentol::second_order::ModeMargin)
}

#[pymethods]
impl ModeMargin {
    /// Probability by the exact distribution of the second-order model.
    #[getter]
    fn probability(&self) -> f64 {
        self.0.margin.corrected.value
    }

    /// Error of that: of the integration, and of the model where designs were solved anew.
    #[getter]
    fn error(&self) -> f64 {
        self.0.margin.corrected.error
    }

    /// Probability to first order.
    #[getter]
    fn first_order(&self) -> f64 {
        self.0.margin.first_order
    }

    /// Probability by designs solved anew, which judges the other two; None where that is too dear.
    #[getter]
    fn solved_anew(&self) -> Option<f64> {
        self.0.judgement.judged().map(|own| own.probability.value)
    }

    /// 95 % interval of that.
    #[getter]
    fn interval(&self) -> Option<(f64, f64)> {
        let interval = self.0.judgement.judged().map(|own| own.interval());
        interval.map(|own| (own.lower, own.upper))
    }

    /// Whether designs solved anew confirm the probability of the second-order model.
    #[getter]
    fn verified(&self) -> bool {
        self.0.verified()
    }

    /// Positions of the other modes that tolerances mix with this one. If there are any, neither model can be relied on.
    #[getter]
    fn mixed_with(&self) -> Vec<usize> {
        self.0.mixed_with.clone()
    }

    /// The band, in the unit of the quantity (rad/s, 1/s).
    #[getter]
    fn band(&self) -> (f64, f64) {
        self.0.margin.band
    }

    /// Standard deviations between the value and the nearest end of the band.
    #[getter]
    fn distance(&self) -> f64 {
        self.0.margin.distance
    }
}

result! {
    /// How tolerances spread responses, SI. `k` is the number of responses; NaN stands where one has no number.
    Propagation(eigentol::propagation::Propagation)
}

impl Propagation {
    fn each<'py>(
        &self,
        py: Python<'py>,
        of: impl Fn(&propagation::ResponseSpread) -> Option<f64>,
    ) -> Array1<'py> {
        let all = self.0.spreads.iter();
        optional(py, all.map(|own| own.as_ref().and_then(&of)))
    }
}

fn texts(doubts: &[Doubt]) -> Vec<String> {
    doubts.iter().map(ToString::to_string).collect()
}

fn value(of: Option<Estimated>) -> Option<f64> {
    of.map(|own| own.value)
}

#[pymethods]
impl Propagation {
    /// For each response the doubts that distances raise about the model: texts; none for samples, which need no model.
    #[getter]
    fn doubts(&self) -> Vec<Vec<String>> {
        self.0.doubts.iter().map(|own| texts(own)).collect()
    }

    /// How it was found, in words.
    #[getter]
    fn method(&self) -> String {
        self.0.method.to_string()
    }

    /// Why it was found that way.
    #[getter]
    fn reason(&self) -> &str {
        &self.0.reason
    }

    /// Values at the nominal design, shape (k,).
    #[getter]
    fn nominal<'py>(&self, py: Python<'py>) -> Array1<'py> {
        self.each(py, |own| own.nominal)
    }

    /// Means, shape (k,).
    #[getter]
    fn mean<'py>(&self, py: Python<'py>) -> Array1<'py> {
        self.each(py, |own| Some(own.mean.value))
    }

    /// Standard deviations, shape (k,).
    #[getter]
    fn sigma<'py>(&self, py: Python<'py>) -> Array1<'py> {
        self.each(py, |own| value(own.sigma))
    }

    /// Errors of the standard deviations by the method's own estimate, shape (k,); NaN where nothing is known.
    #[getter]
    fn sigma_error<'py>(&self, py: Python<'py>) -> Array1<'py> {
        self.each(py, |own| own.sigma?.error)
    }

    /// Skewness, shape (k,).
    #[getter]
    fn skewness<'py>(&self, py: Python<'py>) -> Array1<'py> {
        self.each(py, |own| value(own.skewness))
    }

    /// Quantiles, shape (k, 7), for the probabilities of -3, -2 ... 3 standard deviations of a normal variable.
    #[getter]
    fn quantiles<'py>(&self, py: Python<'py>) -> PyResult<Array2<'py>> {
        let row = |own: &propagation::ResponseSpread| {
            let values: Vec<f64> = own.quantiles.iter().map(|own| own.value).collect();
            (values.len() == QUANTILES.len()).then_some(values)
        };
        let all = self.0.spreads.iter();
        optional_rows(
            py,
            QUANTILES.len(),
            all.map(|own| own.as_ref().and_then(row)),
        )
    }

    /// Covariances of the responses, shape (k, k).
    #[getter]
    fn covariance<'py>(&self, py: Python<'py>) -> PyResult<Array2<'py>> {
        let all = self.0.covariance.iter();
        let all = all.map(|row| row.iter().copied().map(or_nan).collect());
        rows(py, self.0.covariance.column_count(), all)
    }

    /// Shares of the designs that have each response, shape (k,).
    #[getter]
    fn share<'py>(&self, py: Python<'py>) -> Array1<'py> {
        self.each(py, |own| Some(own.share))
    }

    /// Designs that were evaluated.
    #[getter]
    fn evaluations(&self) -> u64 {
        self.0.evaluations
    }

    /// What became of them, by name.
    #[getter]
    fn counts<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        counts(py, &self.0.counts)
    }
}

result! {
    /// Which variables the scatter of responses comes from. `k` is the number of responses; columns are the variables
    /// that vary.
    Influence(eigentol::propagation::Influence)
}

impl Influence {
    fn each<'py>(
        &self,
        py: Python<'py>,
        of: impl Fn(&propagation::VariableInfluence) -> Option<f64>,
    ) -> PyResult<Array2<'py>> {
        let columns = self
            .0
            .responses
            .first()
            .map_or(0, |own| own.variables.len());
        let row = |own: &propagation::ResponseInfluence| {
            own.variables.iter().map(|own| or_nan(of(own))).collect()
        };
        rows(py, columns, self.0.responses.iter().map(row))
    }
}

#[pymethods]
impl Influence {
    /// Names of the variables that vary.
    #[getter]
    fn names(&self) -> Vec<String> {
        let design = &self.0.description.design;
        let variables = self
            .0
            .responses
            .first()
            .map_or(&[][..], |own| &own.variables);
        let all = variables.iter();
        all.map(|own| design[own.variable].name.to_string())
            .collect()
    }

    /// Sobol' indices of first order, shape (k, variables).
    #[getter]
    fn first<'py>(&self, py: Python<'py>) -> PyResult<Array2<'py>> {
        self.each(py, |own| own.first.as_ref().map(|own| own.value))
    }

    /// Total Sobol' indices, shape (k, variables).
    #[getter]
    fn total<'py>(&self, py: Python<'py>) -> PyResult<Array2<'py>> {
        self.each(py, |own| own.total.as_ref().map(|own| own.value))
    }

    /// Correlations (Pearson), shape (k, variables).
    #[getter]
    fn correlation<'py>(&self, py: Python<'py>) -> PyResult<Array2<'py>> {
        self.each(py, |own| own.correlation)
    }

    /// Responses with a variable at its lower limit, all others nominal, SI, shape (k, variables).
    #[getter]
    fn at_low<'py>(&self, py: Python<'py>) -> PyResult<Array2<'py>> {
        self.each(py, |own| own.at_low)
    }

    /// The same at the upper limit.
    #[getter]
    fn at_high<'py>(&self, py: Python<'py>) -> PyResult<Array2<'py>> {
        self.each(py, |own| own.at_high)
    }
}

result! {
    /// The least and the greatest values of responses within the limits, SI. `k` is the number of responses.
    WorstCase(eigentol::propagation::WorstCase)
}

#[pymethods]
impl WorstCase {
    /// Least values, shape (k,); NaN where there is none.
    #[getter]
    fn least<'py>(&self, py: Python<'py>) -> Array1<'py> {
        let all = self.0.responses.iter();
        optional(py, all.map(|own| own.least.as_ref().map(|own| own.value)))
    }

    /// Greatest values, shape (k,); NaN where there is none.
    #[getter]
    fn greatest<'py>(&self, py: Python<'py>) -> Array1<'py> {
        let all = self.0.responses.iter();
        optional(
            py,
            all.map(|own| own.greatest.as_ref().map(|own| own.value)),
        )
    }
}
