//! The effect of tolerances: results of first order, second order, sampling and propagation.

use std::collections::BTreeMap;

use eigentol::judge::{Doubt, Judgement};
use eigentol::propagation::{self, Estimated, Extreme, MissingCorner, QUANTILES};
use eigentol::second_order::{MarginDerivatives, ModeSecondOrder, SecondOrderSpread};
use eigentol::summary::{Advice, Check, Trust};
use eigentol::tolerance::{ModeTolerance, Sample, Spread, Statistics};
use eigentol::{Complex, Matrix, Quantity, Vector};
use numpy::PyArrayMethods;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays::{Array1, Array2, Array3, optional, optional_rows, or_nan, rows, vector};
use crate::clusters::Clusters;
use crate::errors::invalid;
use crate::names;
use crate::results::{attributes, family, quantity, result};

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

attributes! {
    FirstOrder(self, py) {
        /// Names of the design variables, and after them of the inputs that have a tolerance: the columns of gradients and
        /// shares.
        names: Vec<&str> = names::design(&self.0.description);
        /// Standard deviations between each mode and the state where its stiffness vanishes, shape (m,); may be infinite.
        distances_to_critical: Array1<'py> =
            vector(py, self.0.modes.iter().map(|own| own.distance_to_critical));
        /// For each mode the doubts that distances raise about its standard deviations: texts, none where they are large.
        /// They do not tell how large an error is; `summary` lets samples decide.
        doubts: Vec<Vec<String>> =
            (0..self.0.modes.len()).map(|mode| texts(&self.0.doubts(mode))).collect();
        /// Whether distances leave no doubt about any mode. Where they do, `summary` lets samples decide.
        trusted: bool = self.0.trusted();
        /// The same of each mode, shape (m,).
        trusted_modes: Array1<'py, bool> = {
            let all = 0..self.0.modes.len();
            vector(py, all.map(|mode| self.0.doubts(mode).is_empty()))
        };
        /// Least of `distances_to_critical`.
        distance_to_critical: f64 = self.0.distance_to_critical;
        /// Standard deviations between the growth of each mode and zero, shape (m,); may be infinite.
        distances_to_instability: Array1<'py> =
            vector(py, self.0.modes.iter().map(|own| own.distance_to_instability));
        /// Standard deviations between the eigenvalue of each mode and the nearest one, shape (m,); may be infinite.
        distances_to_neighbour: Array1<'py> =
            vector(py, self.0.modes.iter().map(|own| own.distance_to_neighbour));
        /// Whether each mode is one of a cluster of nearly equal eigenvalues, shape (m,).
        clustered: Array1<'py, bool> = vector(py, self.0.modes.iter().map(|own| own.clustered));
        /// What each mode does, in words.
        behaviours: Vec<String> =
            self.0.modes.iter().map(|own| own.behaviour.to_string()).collect();
        /// Standard deviations that a tolerance and a band stand for.
        sigma_level: f64 = self.0.sigma_level;
        /// Whether any variable has a tolerance.
        varies: bool = self.0.varies;
        /// "undamped" or "general".
        family: &'static str = family(self.0.family);
    }
}

attributes! {
    FirstOrder(self, py, quantity) {
        /// Means, shape (m,).
        mean: Array1<'py> = Ok(optional(py, self.each(py, quantity, |own| own.mean)?));
        /// Standard deviations, shape (m,).
        sigma: Array1<'py> = Ok(optional(py, self.each(py, quantity, |own| own.sigma)?));
        /// Half-widths of the bands that hold as many standard deviations as the tolerances do, shape (m,).
        band: Array1<'py> = Ok(optional(py, self.each(py, quantity, |own| own.band)?));
        /// Derivatives per SI unit of each variable, shape (m, variables).
        gradient: Array2<'py> = {
            let all = self.each(py, quantity, |own| own.by_design.to_vec())?;
            optional_rows(py, self.0.description.design.len(), all)
        };
        /// Shares of the variables in the variance, shape (m, variables).
        shares: Array2<'py> = {
            let all = self.each(py, quantity, |own| own.variance_shares.to_vec())?;
            optional_rows(py, self.0.description.design.len(), all)
        };
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

attributes! {
    SecondOrder(self, py) {
        /// For each mode the doubts that distances raise, as those of first order.
        doubts: Vec<Vec<String>> = self.0.doubts.iter().map(|own| texts(own)).collect();
        /// Why a mode has no second order: a text for each mode, or None.
        failures: Vec<Option<String>> =
            self.0.modes.iter().map(|mode| mode.as_ref().err().map(ToString::to_string)).collect();
        /// Standard deviations that a tolerance stands for.
        sigma_level: f64 = self.0.sigma_level;
        /// Whether any variable has a tolerance.
        varies: bool = self.0.varies;
    }
}

attributes! {
    SecondOrder(self, py, quantity) {
        /// Means, shape (m,).
        mean: Array1<'py> = self.each(py, quantity, |own| own.moments.mean);
        /// Standard deviations, shape (m,).
        sigma: Array1<'py> = self.each(py, quantity, |own| own.moments.sigma);
        /// Skewness, shape (m,).
        skewness: Array1<'py> = self.each(py, quantity, |own| own.moments.skewness);
        /// Excess kurtosis, shape (m,).
        excess_kurtosis: Array1<'py> = self.each(py, quantity, |own| own.moments.excess_kurtosis);
        /// Shifts of the means by curvature, shape (m,).
        mean_shift: Array1<'py> = self.each(py, quantity, |own| own.moments.mean_shift);
        /// Standard deviations to first order, shape (m,).
        first_order_sigma: Array1<'py> =
            self.each(py, quantity, |own| own.moments.first_order_sigma);
        /// Part of the standard deviations that curvature adds (its square is added to that of first order), shape (m,).
        curvature_sigma: Array1<'py> = self.each(py, quantity, |own| own.moments.curvature_sigma);
        /// Relative errors of the standard deviations to first order by this model, shape (m,).
        first_order_error: Array1<'py> =
            self.each(py, quantity, |own| own.nonlinearity.sigma_error());
    }
}

result! {
    /// First order, second order, and for each mode whether its standard deviation can be trusted.
    Summary(eigentol::summary::Summary)
}

attributes! {
    Summary(self, py) {
        /// The first-order spread.
        first: FirstOrder = FirstOrder(self.0.first.clone());
        /// The spread to second order.
        second: SecondOrder = SecondOrder(self.0.second.clone());
        /// Whether every mode is trusted.
        trusted: bool = self.0.trusted();
        /// For each mode why its standard deviation is in doubt: texts, none where it can be trusted.
        doubts: Vec<Vec<String>> = self.0.trust.iter().map(|own| texts(&own.doubts)).collect();
        /// Whether each mode is trusted, shape (m,).
        trusted_modes: Array1<'py, bool> = vector(py, self.0.trust.iter().map(Trust::trusted));
        /// What to use for each mode: "first order", "second order", "cluster" or "samples".
        use_instead: Vec<&'static str> = {
            let word = |own: &Trust| match own.advice {
                Advice::FirstOrder => "first order",
                Advice::SecondOrder => "second order",
                Advice::Cluster => "cluster",
                _ => "samples",
            };
            self.0.trust.iter().map(word).collect()
        };
        /// The modes that tolerances bring together.
        clusters: Clusters = Clusters(self.0.clusters.clone());
        /// Number of samples that judged; None where none were needed or they are too dear.
        samples: Option<usize> = self.0.sampled().map(|own| own.samples);
        /// How probable each outcome is by the samples, by name: 95 % interval.
        outcomes: BTreeMap<String, (f64, f64)> = {
            let all = self.0.sampled().into_iter().flat_map(|own| &own.outcomes);
            all.map(|(own, chance)| (format!("{own:?}"), (chance.lower, chance.upper))).collect()
        };
        /// How probable it is that a design settles on another branch: 95 % interval; None where it was not looked for.
        on_another_branch: Option<(f64, f64)> = {
            let chance = self.0.sampled()?.other_branch?;
            Some((chance.lower, chance.upper))
        };
    }
}

impl Summary {
    fn checks<'py>(
        &self,
        py: Python<'py>,
        name: &str,
        of: impl Fn(&Check) -> Option<f64>,
    ) -> PyResult<Array1<'py>> {
        let wanted = quantity(py, name)?;
        let all = self.0.trust.iter();
        Ok(optional(py, all.map(|own| own.check(wanted).and_then(&of))))
    }
}

attributes! {
    Summary(self, py, quantity) {
        /// Means of a quantity over the samples that judged, shape (m,); NaN where there are none.
        sampled_mean: Array1<'py> = self.checks(py, quantity, |own| Some(own.mean));
        /// Standard deviations likewise, shape (m,).
        sampled_sigma: Array1<'py> = self.checks(py, quantity, |own| Some(own.sigma.value));
        /// Standard errors of these, shape (m,).
        sampled_sigma_error: Array1<'py> =
            self.checks(py, quantity, |own| Some(own.sigma.standard_error));
        /// Relative errors of the standard deviations to first order by the same samples, shape (m,).
        first_order_error: Array1<'py> =
            self.checks(py, quantity, |own| own.first_order_error.map(|own| own.value));
        /// Relative errors of those to second order, shape (m,).
        second_order_error: Array1<'py> =
            self.checks(py, quantity, |own| own.second_order_error.map(|own| own.value));
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

attributes! {
    MonteCarlo(self, py) {
        /// How many samples became what, by name.
        counts: PyResult<Bound<'py, PyDict>> = counts(py, &self.0.counts);
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
            let all = self.kept(py)?.iter().map(|own| own.design.to_vec());
            rows(py, self.0.description.design.len(), all)
        };
        /// Equilibria of the samples, SI, shape (N, n); NaN where there is none.
        coordinates: PyResult<Array2<'py>> = {
            let all = self.kept(py)?.iter();
            let all = all.map(|own| own.coordinates.as_ref().map(|own| own.to_vec()));
            optional_rows(py, self.0.description.coordinates.len(), all)
        };
        /// Eigenvalues of the samples, 1/s, complex, shape (N, m); NaN where there is none.
        eigenvalues: PyResult<Array2<'py, Complex>> = {
            let none = Complex::new(f64::NAN, f64::NAN);
            let row = |own: &Sample| own.eigenvalues.iter().map(|s| s.unwrap_or(none)).collect();
            rows(py, self.0.modes.len(), self.kept(py)?.iter().map(row))
        };
        /// Frequencies of the samples, rad/s, shape (N, m).
        frequencies: PyResult<Array2<'py>> = self.of_samples(py, |own| &own.frequencies);
        /// Damping ratios of the samples, shape (N, m).
        damping_ratios: PyResult<Array2<'py>> = self.of_samples(py, |own| &own.damping_ratios);
        /// What became of each sample: "Stable", "Divergent", "Flutter", "NoEquilibrium" ...
        outcomes: PyResult<Vec<String>> = {
            let all = self.kept(py)?.iter();
            Ok(all.map(|own| format!("{:?}", own.outcome)).collect())
        };
        /// Number of samples that were asked for: more than `samples` if the run was stopped or is a part.
        planned: usize = self.0.planned;
        /// First sample and the one behind the last of each range that is done.
        ranges: Vec<(u64, u64)> = self.0.ranges.iter().map(|own| (own.start, own.end)).collect();
        /// Whether samples were solved side by side in vectors.
        side_by_side: bool = self.0.side_by_side;
        /// Whether some nominal modes have equal eigenvalues, and are told apart by their order only.
        clustered: bool = self.0.clustered;
        /// Whether any variable has a tolerance.
        varies: bool = self.0.varies;
        /// "undamped" or "general".
        family: &'static str = family(self.0.family);
    }
}

attributes! {
    MonteCarlo(self, py, quantity) {
        /// Means of "frequency" (rad/s) or "damping_ratio" over the stable samples, shape (m,).
        mean: Array1<'py> = self.statistics(py, quantity, |own| Some(own.mean));
        /// Standard deviations likewise, shape (m,).
        sigma: Array1<'py> = self.statistics(py, quantity, |own| own.sigma);
        /// Standard errors of the means, shape (m,); those of the standard deviations are `sigma_error`.
        standard_error: Array1<'py> = self.statistics(py, quantity, |own| own.standard_error);
        /// Standard errors of the standard deviations, shape (m,), for any distribution.
        sigma_error: Array1<'py> = self.statistics(py, quantity, |own| own.sigma_error);
        /// Number of samples in which each mode has the quantity, shape (m,).
        count: Array1<'py> = self.statistics(py, quantity, |own| Some(own.count as f64));
        /// Skewness, shape (m,).
        skewness: Array1<'py> = self.statistics(py, quantity, |own| own.skewness);
        /// Standard errors of the skewness of normal values, shape (m,).
        skewness_error: Array1<'py> = self.statistics(py, quantity, |own| own.skewness_error);
        /// Excess kurtosis, shape (m,).
        excess_kurtosis: Array1<'py> = self.statistics(py, quantity, |own| own.excess_kurtosis);
        /// Standard errors of the kurtosis of normal values, shape (m,).
        kurtosis_error: Array1<'py> = self.statistics(py, quantity, |own| own.kurtosis_error);
        /// Least values, shape (m,).
        least: Array1<'py> = self.statistics(py, quantity, |own| Some(own.min));
        /// Greatest values, shape (m,).
        greatest: Array1<'py> = self.statistics(py, quantity, |own| Some(own.max));
    }
}

#[pymethods]
impl MonteCarlo {
    /// Quantiles of "frequency" (rad/s) or "damping_ratio" over the stable samples for a probability between 0 and 1,
    /// shape (m,).
    #[pyo3(signature = (probability, quantity="frequency"))]
    fn quantile<'py>(
        &self,
        py: Python<'py>,
        probability: f64,
        quantity: &str,
    ) -> PyResult<Array1<'py>> {
        if !(0.0..=1.0).contains(&probability) {
            let message = format!("`probability` is {probability}: give one between 0 and 1");
            return Err(invalid(py, message));
        }
        let value = |own: &Statistics| Some(own.quantile(probability).ok()?.value);
        self.statistics(py, quantity, value)
    }
}

pub(crate) fn counts<'py>(
    py: Python<'py>,
    own: &eigentol::tolerance::Counts,
) -> PyResult<Bound<'py, PyDict>> {
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

impl OutputTolerances {
    fn each<T>(&self, of: impl Fn(&Spread) -> T) -> impl Iterator<Item = Option<T>> {
        self.0.spreads.iter().map(move |own| own.as_ref().map(&of))
    }
}

attributes! {
    OutputTolerances(self, py) {
        /// Values, SI, shape (o,).
        values: Array1<'py> = vector(py, self.0.values.clone());
        /// Names of the outputs.
        names: Vec<&str> = names::outputs(&self.0.description);
        /// Names of the design variables, and after them of the inputs that have a tolerance: the columns of gradients
        /// and shares.
        variables: Vec<&str> = names::design(&self.0.description);
        /// Means, SI, shape (o,).
        mean: Array1<'py> = optional(py, self.each(|own| own.mean));
        /// Standard deviations, SI, shape (o,).
        sigma: Array1<'py> = optional(py, self.each(|own| own.sigma));
        /// Half-widths of the bands that hold as many standard deviations as the tolerances do, SI, shape (o,).
        band: Array1<'py> = optional(py, self.each(|own| own.band));
        /// Derivatives per SI unit of each variable, shape (o, variables).
        gradient: PyResult<Array2<'py>> =
            optional_rows(py, self.variables(py).len(), self.each(|own| own.by_design.to_vec()));
        /// Shares of the variables in the variance, shape (o, variables).
        shares: PyResult<Array2<'py>> = {
            let all = self.each(|own| own.variance_shares.to_vec());
            optional_rows(py, self.variables(py).len(), all)
        };
        /// Standard deviations that a tolerance stands for.
        sigma_level: f64 = self.0.sigma_level;
        /// Whether any variable has a tolerance.
        varies: bool = self.0.varies;
    }
}

result! {
    /// Probability that a quantity of a mode lies in a forbidden band.
    ModeMargin(eigentol::second_order::ModeMargin)
}

impl ModeMargin {
    fn slopes<'py>(
        &self,
        py: Python<'py>,
        of: impl Fn(&MarginDerivatives) -> &Vector,
    ) -> Array1<'py> {
        let own = self.0.margin.derivatives.as_ref().map(|own| &of(own)[..]);
        slopes(py, self.0.description.design.len(), own)
    }
}

attributes! {
    ModeMargin(self, py) {
        /// Probability by the exact distribution of the second-order model.
        probability: f64 = self.0.margin.corrected.value;
        /// Error of that: of the integration, and of the model where designs were solved anew.
        error: f64 = self.0.margin.corrected.error;
        /// Probability to first order.
        first_order: f64 = self.0.margin.first_order;
        /// Probability by designs solved anew, which judges the other two; None where that is too dear.
        solved_anew: Option<f64> = self.0.judgement.judged().map(|own| own.probability.value);
        /// 95 % interval of that.
        interval: Option<(f64, f64)> =
            self.0.judgement.judged().map(|own| own.interval()).map(|own| (own.lower, own.upper));
        /// Whether designs solved anew confirm the probability of the second-order model.
        verified: bool = self.0.verified();
        /// Positions of the other modes that tolerances mix with this one. If there are any, neither model can be relied on.
        mixed_with: Vec<usize> = self.0.mixed_with.clone();
        /// The band, in the unit of the quantity (rad/s, 1/s).
        band: (f64, f64) = self.0.margin.band;
        /// Standard deviations between the value and the nearest end of the band.
        distance: f64 = self.0.margin.distance;
        /// Position of the mode, from 0.
        mode: usize = self.0.mode;
        /// Name of the quantity, as `margin` takes it.
        quantity: String = self.0.quantity.to_string().replace(' ', "_");
        /// Its nominal value, rad/s or 1/s.
        value: f64 = self.0.margin.value;
        /// Its standard deviation to first order.
        sigma: f64 = self.0.margin.sigma;
        /// Error of the model alone; None where no designs were solved anew.
        model_error: Option<f64> = self.0.margin.corrected.model_error;
        /// What the designs solved anew say, by name; under "open" why there are none.
        judgement: PyResult<Bound<'py, PyDict>> = judgement(py, &self.0.judgement);
        /// Derivatives of the probability to first order by inputs, shape (inputs,); NaN where there are none.
        by_input: Array1<'py> =
            slopes(py, self.0.description.inputs.len(), self.0.by_input.as_deref());
        /// The same by nominal values of design variables, shape (design,).
        by_design: Array1<'py> = self.slopes(py, |own| &own.by_design);
        /// The same by half-widths of their tolerances, shape (design,).
        by_half_width: Array1<'py> = self.slopes(py, |own| &own.by_half_width);
    }
}

result! {
    /// How tolerances spread responses, SI. `k` is the number of responses; NaN stands where one has no number.
    Propagation(eigentol::propagation::Propagation)
}

impl Propagation {
    fn quantile_rows<'py>(
        &self,
        py: Python<'py>,
        of: impl Fn(&propagation::Quantile) -> f64,
    ) -> PyResult<Array2<'py>> {
        let row = |own: &propagation::ResponseSpread| {
            let all: Vec<f64> = own.quantiles.iter().map(&of).collect();
            (all.len() == QUANTILES.len()).then_some(all)
        };
        let all = self.0.spreads.iter().map(|own| own.as_ref().and_then(row));
        optional_rows(py, QUANTILES.len(), all)
    }

    fn each<'py>(
        &self,
        py: Python<'py>,
        of: impl Fn(&propagation::ResponseSpread) -> Option<f64>,
    ) -> Array1<'py> {
        let all = self.0.spreads.iter();
        optional(py, all.map(|own| own.as_ref().and_then(&of)))
    }
}

/// Names of responses.
fn responses(all: &[eigentol::response::Response], of: &eigentol::Description) -> Vec<String> {
    all.iter().map(|own| own.name(of)).collect()
}

fn optional_matrix<'py>(py: Python<'py>, of: &Matrix<Option<f64>>) -> PyResult<Array2<'py>> {
    let all = of
        .iter()
        .map(|row| row.iter().copied().map(or_nan).collect());
    rows(py, of.column_count(), all)
}

fn pairs<'py>(py: Python<'py>, all: &[(f64, f64)]) -> PyResult<Array2<'py>> {
    rows(py, 2, all.iter().map(|(low, high)| vec![*low, *high]))
}

/// Derivatives, or as many NaN.
fn slopes<'py>(py: Python<'py>, count: usize, own: Option<&[f64]>) -> Array1<'py> {
    vector(
        py,
        own.map_or_else(|| vec![f64::NAN; count], <[f64]>::to_vec),
    )
}

/// What designs solved anew say.
pub(crate) fn judgement<'py>(py: Python<'py>, own: &Judgement) -> PyResult<Bound<'py, PyDict>> {
    let all = PyDict::new(py);
    match own {
        Judgement::Judged(own) => {
            let (interval, estimate) = (own.interval(), own.probability);
            all.set_item("probability", estimate.value)?;
            all.set_item("standard_error", estimate.standard_error)?;
            all.set_item("interval", (interval.lower, interval.upper))?;
            all.set_item("untold", own.untold.value)?;
            all.set_item("unseen", own.unseen)?;
            all.set_item("settled", own.settled)?;
            all.set_item("lines", own.lines)?;
            all.set_item("designs", own.designs)?;
        }
        Judgement::Open(reason) => all.set_item("open", reason.to_string())?,
        _ => {}
    }
    Ok(all)
}

fn texts(doubts: &[Doubt]) -> Vec<String> {
    doubts.iter().map(ToString::to_string).collect()
}

fn value(of: Option<Estimated>) -> Option<f64> {
    of.map(|own| own.value)
}

attributes! {
    Propagation(self, py) {
        /// For each response the doubts that distances raise about the model: texts; none for samples, which need no model.
        doubts: Vec<Vec<String>> = self.0.doubts.iter().map(|own| texts(own)).collect();
        /// How it was found, in words.
        method: String = self.0.method.to_string();
        /// Why it was found that way.
        reason: &str = &self.0.reason;
        /// Values at the nominal design, shape (k,).
        nominal: Array1<'py> = self.each(py, |own| own.nominal);
        /// Means, shape (k,).
        mean: Array1<'py> = self.each(py, |own| Some(own.mean.value));
        /// Standard deviations, shape (k,).
        sigma: Array1<'py> = self.each(py, |own| value(own.sigma));
        /// Errors of the standard deviations by the method's own estimate, shape (k,); NaN where nothing is known.
        sigma_error: Array1<'py> = self.each(py, |own| own.sigma?.error);
        /// Skewness, shape (k,).
        skewness: Array1<'py> = self.each(py, |own| value(own.skewness));
        /// Quantiles, shape (k, 7), for the probabilities of -3, -2 ... 3 standard deviations of a normal variable.
        quantiles: PyResult<Array2<'py>> = self.quantile_rows(py, |own| own.value);
        /// Covariances of the responses, shape (k, k).
        covariance: PyResult<Array2<'py>> = optional_matrix(py, &self.0.covariance);
        /// Shares of the designs that have each response, shape (k,).
        share: Array1<'py> = self.each(py, |own| Some(own.share));
        /// Designs that were evaluated.
        evaluations: u64 = self.0.evaluations;
        /// What became of them, by name.
        counts: PyResult<Bound<'py, PyDict>> = counts(py, &self.0.counts);
        /// Names of the responses.
        names: Vec<String> = responses(&self.0.wanted, &self.0.description);
        /// Errors of the means by the method's own estimate, shape (k,); NaN where nothing is known.
        mean_error: Array1<'py> = self.each(py, |own| own.mean.error);
        /// The same of the skewness, shape (k,).
        skewness_error: Array1<'py> = self.each(py, |own| own.skewness?.error);
        /// The same of the quantiles, shape (k, 7).
        quantile_errors: PyResult<Array2<'py>> = self.quantile_rows(py, |own| or_nan(own.error));
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
    fn interval<'py>(
        &self,
        py: Python<'py>,
        of: impl Fn(&propagation::VariableInfluence) -> Option<&propagation::Estimate>,
    ) -> PyResult<Array3<'py>> {
        let all = self
            .0
            .responses
            .iter()
            .flat_map(|own| &own.variables)
            .flat_map(|own| of(own).map_or([f64::NAN; 2], |own| [own.lower, own.upper]));
        let columns = self
            .0
            .responses
            .first()
            .map_or(0, |own| own.variables.len());
        vector(py, all).reshape([self.0.responses.len(), columns, 2])
    }

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

attributes! {
    Influence(self, py) {
        /// Names of the variables that vary.
        names: Vec<String> = {
            let design = &self.0.description.design;
            let variables = self
                .0
                .responses
                .first()
                .map_or(&[][..], |own| &own.variables);
            let all = variables.iter();
            all.map(|own| design[own.variable].name.to_string())
                .collect()
        };
        /// Sobol' indices of first order, shape (k, variables).
        first: PyResult<Array2<'py>> = self.each(py, |own| own.first.as_ref().map(|own| own.value));
        /// Total Sobol' indices, shape (k, variables).
        total: PyResult<Array2<'py>> = self.each(py, |own| own.total.as_ref().map(|own| own.value));
        /// Correlations (Pearson), shape (k, variables).
        correlation: PyResult<Array2<'py>> = self.each(py, |own| own.correlation);
        /// Responses with a variable at its lower limit, all others nominal, SI, shape (k, variables).
        at_low: PyResult<Array2<'py>> = self.each(py, |own| own.at_low);
        /// The same at the upper limit.
        at_high: PyResult<Array2<'py>> = self.each(py, |own| own.at_high);
        /// Names of the responses: the rows.
        responses: Vec<String> = responses(&self.0.wanted, &self.0.description);
        /// Values at the nominal design, SI, shape (k,).
        nominal: Array1<'py> = optional(py, self.0.responses.iter().map(|own| own.nominal));
        /// Ends of the 95 % intervals of `first`, shape (k, variables, 2).
        first_interval: PyResult<Array3<'py>> = self.interval(py, |own| own.first.as_ref());
        /// Ends of the 95 % intervals of `total`, shape (k, variables, 2).
        total_interval: PyResult<Array3<'py>> = self.interval(py, |own| own.total.as_ref());
        /// Rank correlations (Spearman), shape (k, variables).
        rank_correlation: PyResult<Array2<'py>> = self.each(py, |own| own.rank_correlation);
        /// Standardised regression coefficients, shape (k, variables).
        regression: PyResult<Array2<'py>> = self.each(py, |own| own.regression);
        /// Shares of the variance that the linear fit explains, shape (k,).
        determination: Array1<'py> =
            optional(py, self.0.responses.iter().map(|own| own.determination));
        /// Numbers of evaluations without a value, which are left out, shape (k,).
        missing: Array1<'py, i64> = vector(py, self.0.responses.iter().map(|own| own.missing as i64));
        /// Least and greatest values of all design variables, SI, shape (design, 2).
        limits: PyResult<Array2<'py>> = pairs(py, &self.0.limits);
        /// What became of the designs, by name.
        counts: PyResult<Bound<'py, PyDict>> = counts(py, &self.0.counts);
    }
}

result! {
    /// The least and the greatest values of responses within the limits, SI. `k` is the number of responses.
    WorstCase(eigentol::propagation::WorstCase)
}

impl WorstCase {
    fn designs<'py>(
        &self,
        py: Python<'py>,
        of: impl Fn(&propagation::ResponseLimits) -> Option<&Extreme>,
    ) -> PyResult<Array2<'py>> {
        let all = self
            .0
            .responses
            .iter()
            .map(|own| of(own).map(|own| own.design.to_vec()));
        optional_rows(py, self.0.description.design.len(), all)
    }
}

attributes! {
    WorstCase(self, py) {
        /// Least values, shape (k,); NaN where there is none.
        least: Array1<'py> = {
            let all = self.0.responses.iter();
            optional(py, all.map(|own| own.least.as_ref().map(|own| own.value)))
        };
        /// Greatest values, shape (k,); NaN where there is none.
        greatest: Array1<'py> = {
            let all = self.0.responses.iter();
            optional(
                py,
                all.map(|own| own.greatest.as_ref().map(|own| own.value)),
            )
        };
        /// Names of the responses.
        names: Vec<String> = responses(&self.0.wanted, &self.0.description);
        /// Values at the nominal design, SI, shape (k,).
        nominal: Array1<'py> = optional(py, self.0.responses.iter().map(|own| own.nominal));
        /// Designs of the least values, SI, shape (k, design).
        least_designs: PyResult<Array2<'py>> = self.designs(py, |own| own.least.as_ref());
        /// Designs of the greatest values, SI, shape (k, design).
        greatest_designs: PyResult<Array2<'py>> = self.designs(py, |own| own.greatest.as_ref());
        /// Whether no design near that of the least and of the greatest value is worse, a pair for each response.
        confirmed: Vec<(bool, bool)> = {
            let sure = |own: &Option<Extreme>| own.as_ref().is_some_and(|own| own.confirmed);
            self.0.responses.iter().map(|own| (sure(&own.least), sure(&own.greatest))).collect()
        };
        /// For each response the names of the variables in which it is not monotonic.
        turning: Vec<Vec<String>> = {
            let name = |k: &usize| self.0.description.design[*k].name.to_string();
            self.0.responses.iter().map(|own| own.turning.iter().map(name).collect()).collect()
        };
        /// For each response the designs at corners of the limits that lack it, SI, and what became of them.
        missing: Vec<Vec<(Vec<f64>, String)>> = {
            let corner = |own: &MissingCorner| (own.design.to_vec(), format!("{:?}", own.outcome));
            self.0.responses.iter().map(|own| own.missing.iter().map(corner).collect()).collect()
        };
        /// Least and greatest values of all design variables, SI, shape (design, 2).
        limits: PyResult<Array2<'py>> = pairs(py, &self.0.limits);
        /// Number of designs that were evaluated.
        evaluations: usize = self.0.evaluations;
    }
}
