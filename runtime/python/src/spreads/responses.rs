//! Responses: how tolerances spread them, which variables their scatter comes from, and their limits.

use eigentol::Matrix;
use eigentol::propagation::{
    self, Estimated, Extreme, MissingCorner, QUANTILES, ResponseInfluence, ResponseLimits, ResponseSpread,
    VariableInfluence,
};
use numpy::PyArrayMethods;
use pyo3::prelude::*;

use super::shared::texts;
use crate::arrays::{Array1, Array2, Array3, optional, optional_rows, or_nan, rows, vector};
use crate::results::{attributes, result};

/// Names of responses.
fn responses(all: &[eigentol::response::Response], of: &eigentol::Description) -> Vec<String> {
    all.iter().map(|x| x.name(of)).collect()
}

/// Least and greatest values, a row each.
fn pairs<'py>(py: Python<'py>, all: &[(f64, f64)]) -> PyResult<Array2<'py>> {
    rows(py, 2, all.iter().map(|(low, high)| vec![*low, *high]))
}

result! {
    /// How tolerances spread responses, SI. `k` is the number of responses; NaN stands where one has no number.
    Propagation(eigentol::propagation::Propagation)
}

impl Propagation {
    fn quantile_rows<'py>(&self, py: Python<'py>, of: impl Fn(&propagation::Quantile) -> f64) -> PyResult<Array2<'py>> {
        let row = |response_spread: &ResponseSpread| {
            let all: Vec<f64> = response_spread.quantiles.iter().map(&of).collect();
            (all.len() == QUANTILES.len()).then_some(all)
        };
        let all = self.0.spreads.iter().map(|spread| spread.as_ref().and_then(row));
        optional_rows(py, QUANTILES.len(), all)
    }

    fn each<'py>(&self, py: Python<'py>, of: fn(&ResponseSpread) -> Option<f64>) -> Array1<'py> {
        let all = self.0.spreads.iter();
        optional(py, all.map(|x| x.as_ref().and_then(of)))
    }
}

fn optional_matrix<'py>(py: Python<'py>, of: &Matrix<Option<f64>>) -> PyResult<Array2<'py>> {
    let all = of.iter().map(|row| row.iter().copied().map(or_nan).collect());
    rows(py, of.column_count(), all)
}

fn value(of: Option<Estimated>) -> Option<f64> {
    of.map(|x| x.value)
}

attributes! {
    Propagation(self, py) {
        /// For each response the doubts that distances raise about the model: texts; none for samples, which need no model.
        doubts: Vec<Vec<String>> = self.0.doubts.iter().map(|doubts| texts(doubts)).collect();
        /// How it was found, in words.
        method: String = self.0.method.to_string();
        /// Why it was found that way.
        reason: &str = &self.0.reason;
        /// Values at the nominal design, shape (k,).
        nominal: Array1<'py> = self.each(py, |x| x.nominal);
        /// Means, shape (k,).
        mean: Array1<'py> = self.each(py, |x| Some(x.mean.value));
        /// Standard deviations, shape (k,).
        sigma: Array1<'py> = self.each(py, |x| value(x.sigma));
        /// Errors of the standard deviations by the method's own estimate, shape (k,); NaN where nothing is known.
        sigma_error: Array1<'py> = self.each(py, |x| x.sigma?.error);
        /// Skewness, shape (k,).
        skewness: Array1<'py> = self.each(py, |x| value(x.skewness));
        /// Quantiles, shape (k, 7), for the probabilities of -3, -2 ... 3 standard deviations of a normal variable.
        quantiles: PyResult<Array2<'py>> = self.quantile_rows(py, |quantile| quantile.value);
        /// Covariances of the responses, shape (k, k).
        covariance: PyResult<Array2<'py>> = optional_matrix(py, &self.0.covariance);
        /// Shares of the designs that have each response, shape (k,).
        share: Array1<'py> = self.each(py, |x| Some(x.share));
        /// Designs that were evaluated.
        evaluations: u64 = self.0.evaluations;
        /// Names of the responses.
        names: Vec<String> = responses(&self.0.wanted, &self.0.description);
        /// Errors of the means by the method's own estimate, shape (k,); NaN where nothing is known.
        mean_error: Array1<'py> = self.each(py, |x| x.mean.error);
        /// The same of the skewness, shape (k,).
        skewness_error: Array1<'py> = self.each(py, |x| x.skewness?.error);
        /// The same of the quantiles, shape (k, 7).
        quantile_errors: PyResult<Array2<'py>> = self.quantile_rows(py, |quantile| or_nan(quantile.error));
        /// Probabilities of the quantiles, shape (7,).
        probabilities: Array1<'py> = vector(py, QUANTILES);
        /// Covariances of the responses with the design variables, SI, shape (k, design).
        covariance_with_design: PyResult<Array2<'py>> = optional_matrix(py, &self.0.with_design);
    }
}

result! {
    /// Which variables the scatter of responses comes from. `k` is the number of responses; columns are the variables
    /// that vary.
    Influence(eigentol::propagation::Influence)
}

impl Influence {
    fn columns(&self) -> usize {
        let first = self.0.responses.first();
        first.map_or(0, |x| x.variables.len())
    }

    fn interval<'py>(
        &self,
        py: Python<'py>,
        of: impl Fn(&VariableInfluence) -> Option<&propagation::Estimate>,
    ) -> PyResult<Array3<'py>> {
        let all = self.0.responses.iter().flat_map(|response| &response.variables);
        let ends = all.flat_map(|item| of(item).map_or([f64::NAN; 2], |x| [x.lower, x.upper]));
        vector(py, ends).reshape([self.0.responses.len(), self.columns(), 2])
    }

    fn each<'py>(&self, py: Python<'py>, of: impl Fn(&VariableInfluence) -> Option<f64>) -> PyResult<Array2<'py>> {
        let row = |response_influence: &ResponseInfluence| {
            response_influence.variables.iter().map(|variable| or_nan(of(variable))).collect()
        };
        rows(py, self.columns(), self.0.responses.iter().map(row))
    }
}

attributes! {
    Influence(self, py) {
        /// Names of the variables that vary.
        names: Vec<String> = {
            let design = &self.0.description.design;
            let all = self.0.responses.iter().take(1).flat_map(|response| &response.variables);
            all.map(|x| design[x.variable].name.to_string()).collect()
        };
        /// Sobol' indices of first order, shape (k, variables).
        first: PyResult<Array2<'py>> = self.each(py, |item| item.first.as_ref().map(|x| x.value));
        /// Total Sobol' indices, shape (k, variables).
        total: PyResult<Array2<'py>> = self.each(py, |item| item.total.as_ref().map(|x| x.value));
        /// Correlations (Pearson), shape (k, variables).
        correlation: PyResult<Array2<'py>> = self.each(py, |x| x.correlation);
        /// Responses with a variable at its lower limit, all others nominal, SI, shape (k, variables).
        at_low: PyResult<Array2<'py>> = self.each(py, |x| x.at_low);
        /// The same at the upper limit.
        at_high: PyResult<Array2<'py>> = self.each(py, |x| x.at_high);
        /// Names of the responses: the rows.
        responses: Vec<String> = responses(&self.0.wanted, &self.0.description);
        /// Values at the nominal design, SI, shape (k,).
        nominal: Array1<'py> = optional(py, self.0.responses.iter().map(|response| response.nominal));
        /// Ends of the 95 % intervals of `first`, shape (k, variables, 2).
        first_interval: PyResult<Array3<'py>> = self.interval(py, |x| x.first.as_ref());
        /// Ends of the 95 % intervals of `total`, shape (k, variables, 2).
        total_interval: PyResult<Array3<'py>> = self.interval(py, |x| x.total.as_ref());
        /// Rank correlations (Spearman), shape (k, variables).
        rank_correlation: PyResult<Array2<'py>> = self.each(py, |x| x.rank_correlation);
        /// Standardised regression coefficients, shape (k, variables).
        regression: PyResult<Array2<'py>> = self.each(py, |x| x.regression);
        /// Shares of the variance that the linear fit explains, shape (k,).
        determination: Array1<'py> =
            optional(py, self.0.responses.iter().map(|response| response.determination));
        /// Numbers of evaluations without a value, which are left out, shape (k,).
        missing: Array1<'py, i64> = vector(py, self.0.responses.iter().map(|response| response.missing as i64));
        /// Least and greatest values of all design variables, SI, shape (design, 2).
        limits: PyResult<Array2<'py>> = pairs(py, &self.0.limits);
    }
}

result! {
    /// The least and the greatest values of responses within the limits, SI. `k` is the number of responses.
    WorstCase(eigentol::propagation::WorstCase)
}

impl WorstCase {
    fn values<'py>(&self, py: Python<'py>, of: fn(&ResponseLimits) -> &Option<Extreme>) -> Array1<'py> {
        let all = self.0.responses.iter();
        optional(py, all.map(|response| of(response).as_ref().map(|extreme| extreme.value)))
    }

    fn designs<'py>(&self, py: Python<'py>, of: fn(&ResponseLimits) -> &Option<Extreme>) -> PyResult<Array2<'py>> {
        let all = self.0.responses.iter();
        let all = all.map(|response| {
            let extreme = of(response).as_ref();
            extreme.map(|extreme| extreme.design.to_vec())
        });
        optional_rows(py, self.0.description.design.len(), all)
    }
}

attributes! {
    WorstCase(self, py) {
        /// Least values, shape (k,); NaN where there is none.
        least: Array1<'py> = self.values(py, |x| &x.least);
        /// Greatest values, shape (k,); NaN where there is none.
        greatest: Array1<'py> = self.values(py, |x| &x.greatest);
        /// Names of the responses.
        names: Vec<String> = responses(&self.0.wanted, &self.0.description);
        /// Values at the nominal design, SI, shape (k,).
        nominal: Array1<'py> = optional(py, self.0.responses.iter().map(|response| response.nominal));
        /// Designs of the least values, SI, shape (k, design).
        least_designs: PyResult<Array2<'py>> = self.designs(py, |response| &response.least);
        /// Designs of the greatest values, SI, shape (k, design).
        greatest_designs: PyResult<Array2<'py>> = self.designs(py, |response| &response.greatest);
        /// Whether no design near that of the least and of the greatest value is worse, a pair for each response.
        confirmed: Vec<(bool, bool)> = {
            let sure = |extreme: &Option<Extreme>| extreme.as_ref().is_some_and(|x| x.confirmed);
            self.0.responses.iter().map(|response| (sure(&response.least), sure(&response.greatest))).collect()
        };
        /// For each response the names of the variables in which it is not monotonic.
        turning: Vec<Vec<String>> = {
            let name = |k: &usize| self.0.description.design[*k].name.to_string();
            self.0.responses.iter().map(|response| response.turning.iter().map(name).collect()).collect()
        };
        /// For each response the designs at corners of the limits that lack it, SI, and what became of them.
        missing: Vec<Vec<(Vec<f64>, String)>> = {
            let corner = |missing_corner: &MissingCorner| (missing_corner.design.to_vec(), format!("{:?}", missing_corner.outcome));
            self.0.responses.iter().map(|response| response.missing.iter().map(corner).collect()).collect()
        };
        /// Least and greatest values of all design variables, SI, shape (design, 2).
        limits: PyResult<Array2<'py>> = pairs(py, &self.0.limits);
        /// Number of designs that were evaluated.
        evaluations: usize = self.0.evaluations;
    }
}
