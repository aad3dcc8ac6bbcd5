//! Probabilities of meeting requirements.

use eigentol::Input;
use eigentol::requirement::{self, DesignPoint, LimitReliability};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};

use crate::arrays::{Array1, Array2, optional, optional_rows, vector};
use crate::names;
use crate::response::wanted;
use crate::results::{attributes, result};
use crate::spreads::judgement;
use crate::study::Study;
use crate::values::{List, not_finite};
use requirement::Requirement as Limit;

/// Parses one requirement: "stable", or a response with a low and a high end, None for an open end; "outside" before
/// the ends for a forbidden band, "away" before an input and a fraction for a band around it.
fn requirement(
    study: &eigentol::Study<eigentol_interpreter::Interpreted>,
    given: &Requirement<'_>,
) -> PyResult<requirement::Requirement> {
    if given.extract::<String>().is_ok_and(|word| word == "stable") {
        return Ok(requirement::Requirement::Stable);
    }
    if let Some((response, input, fraction, order)) = around(given) {
        let (index, _) = List::Inputs.find(given.py(), study.description(), &input)?;
        return Ok(requirement::Requirement::Away {
            response: response_of(study, &response)?,
            input: Input::new(index),
            order,
            fraction,
        });
    }
    let (response, low, high, outside) = ends(given)?;
    for end in [low, high].into_iter().flatten() {
        if end.is_nan() {
            return Err(not_finite(given.py(), "end of a requirement", end));
        }
    }
    let response = response_of(study, &response)?;
    let (low, high) = (low.unwrap_or(f64::NEG_INFINITY), high.unwrap_or(f64::INFINITY));
    Ok(match outside {
        true => requirement::Requirement::Outside { response, low, high },
        false => requirement::Requirement::Within { response, low, high },
    })
}

fn response_of(
    study: &eigentol::Study<eigentol_interpreter::Interpreted>,
    given: &Bound<'_, PyTuple>,
) -> PyResult<eigentol::response::Response> {
    let what = given.get_item(0)?.extract::<String>()?;
    wanted(study, &what, &given.get_slice(1, given.len()))
}

/// "stable"; a response with a low and a high end; a forbidden band; a band around an input.
///
/// In Python `Literal["stable"] | tuple[tuple[Any, ...], float | None, float | None] | tuple[Literal["outside"],
/// tuple[Any, ...], float, float] | tuple[Literal["away"], tuple[Any, ...], str, float] | tuple[Literal["away"],
/// tuple[Any, ...], str, float, float]`.
pub(crate) type Requirement<'py> = Bound<'py, PyAny>;

type Ends<'py> = (Bound<'py, PyTuple>, Option<f64>, Option<f64>, bool);

/// Response, input, fraction and order of a band to stay away from.
fn around<'py>(given: &Bound<'py, PyAny>) -> Option<(Bound<'py, PyTuple>, String, f64, f64)> {
    let with_order = given.extract::<(String, _, _, _, f64)>();
    let all = with_order.or_else(|_| {
        let (word, response, input, fraction) = given.extract()?;
        Ok::<_, PyErr>((word, response, input, fraction, 1.0))
    });
    let (word, response, input, fraction, order) = all.ok()?;
    (word == "away").then_some((response, input, fraction, order))
}

/// Response, low and high end, and whether it must stay outside.
fn ends<'py>(given: &Bound<'py, PyAny>) -> PyResult<Ends<'py>> {
    if let Ok((response, low, high)) = given.extract() {
        return Ok((response, low, high, false));
    }
    let read = given.extract::<(String, Bound<'py, PyTuple>, f64, f64)>();
    match read {
        Ok((word, response, low, high)) if word == "outside" => Ok((response, Some(low), Some(high), true)),
        _ => Err(PyTypeError::new_err(
            "a requirement is \"stable\", or a response, a low and a high end: ((\"frequency\", 0), 3.0, None), or a \
             forbidden band: (\"outside\", (\"frequency\", 0), 3.0, 4.0), or one around an input: (\"away\", \
             (\"frequency\", 0), \"speed\", 0.1)",
        )),
    }
}

#[pymethods]
impl Study {
    /// Chances of meeting requirements, by sampling. Each is "stable", or a response as `propagate` takes it with a low
    /// and a high end, None for no end: `(("frequency", 0), 3.9, None)`, or a forbidden band:
    /// `("outside", ("frequency", 0), 3.0, 4.0)`, or one within a fraction of a multiple (1) of an input:
    /// `("away", ("frequency", 0), "speed", 0.1, 2.0)`; frequencies are in rad/s. Of `start` and `stop` only the samples
    /// `start` to below `stop` are taken; numbers of samples of parts add up to those of the whole. Ctrl-C ends it.
    #[pyo3(signature = (requirements, start=None, stop=None))]
    fn chances(
        &self,
        py: Python<'_>,
        requirements: Vec<Requirement<'_>>,
        start: Option<u64>,
        stop: Option<u64>,
    ) -> PyResult<Chances> {
        let wanted = self.requirements(&requirements)?;
        let answer = self.ask_stoppably(py, |study| {
            let sampling = study.sampling();
            let range = start.unwrap_or(0)..stop.unwrap_or(sampling.samples as u64);
            study.chances_by(&wanted, &sampling.range(Some(range)))
        });
        answer.map(Chances)
    }
}

/// Analyses of requirements, given as `chances` takes them.
macro_rules! of_requirements {
    ($($(#[$doc:meta])* $question:ident -> $result:ident;)*) => {
        #[pymethods]
        impl Study {
            $(
                $(#[$doc])*
                fn $question(
                    &self,
                    py: Python<'_>,
                    requirements: Vec<Requirement<'_>>,
                ) -> PyResult<$result> {
                    let wanted = self.requirements(&requirements)?;
                    let found = self.ask_stoppably(py, |study| study.$question(&wanted));
                    found.map($result)
                }
            )*
        }
    };
}

of_requirements! {
    /// How probable it is that each requirement, and that any, is failed, with nothing to choose: by design points, lines
    /// of designs, or samples; requirements as `chances` takes them.
    probability -> Probabilities;
    /// Reliability by way of design points (FORM), judged by designs solved anew; requirements as `chances` takes them.
    reliability -> Reliability;
}

impl Study {
    pub(crate) fn requirements(&self, given: &[Requirement<'_>]) -> PyResult<Vec<requirement::Requirement>> {
        let one = |given| requirement(&self.inner, given);
        given.iter().map(one).collect()
    }
}

result! {
    /// Probabilities of failing requirements. `k` is their number. No model is behind them: every design is solved anew.
    Probabilities(requirement::Probabilities)
}

/// In Python `Literal["design point", "lines", "samples"]`.
type FoundBy = str;

fn found_by(method: requirement::EstimatedBy) -> &'static FoundBy {
    match method {
        requirement::EstimatedBy::DesignPoint => "design point",
        requirement::EstimatedBy::Lines => "lines",
        _ => "samples",
    }
}

attributes! {
    Probabilities(self, py) {
        /// Probability of failing each requirement, shape (k,).
        failure: Array1<'py> = vector(py, self.0.each.iter().map(|x| x.value));
        /// Lower ends of their 95 % intervals, shape (k,).
        lower: Array1<'py> = vector(py, self.0.each.iter().map(|x| x.interval.lower));
        /// Upper ends, shape (k,).
        upper: Array1<'py> = vector(py, self.0.each.iter().map(|x| x.interval.upper));
        /// Probabilities that a design lacks the response needed to tell, shape (k,).
        untold: Array1<'py> = vector(py, self.0.each.iter().map(|x| x.untold));
        /// How each was found: "design point", "lines" or "samples".
        found_by: Vec<&'static FoundBy> = self.0.each.iter().map(|x| found_by(x.by)).collect();
        /// Probability of failing any requirement.
        any_failure: f64 = self.0.any.value;
        /// Its 95 % interval.
        any_interval: (f64, f64) = (self.0.any.interval.lower, self.0.any.interval.upper);
        /// The design points, or None: what changes the probabilities.
        reliability: Option<Reliability> = self.0.reliability.clone().map(Reliability);
        /// The requirements, in words.
        names: Vec<String> =
            self.0.wanted.iter().map(|name| name.text(&self.0.description)).collect();
        /// Numbers of designs that were solved for each, shape (k,).
        designs: Array1<'py, i64> = vector(py, self.0.each.iter().map(|x| x.designs as i64));
        /// Probability that a design lacks a response needed to tell of any.
        any_untold: f64 = self.0.any.untold;
        /// How `any_failure` was found.
        any_found_by: &'static FoundBy = found_by(self.0.any.by);
        /// Number of designs that were solved for it.
        any_designs: u64 = self.0.any.designs;
        /// The samples, or None where none were drawn.
        chances: Option<Chances> = self.0.chances.clone().map(Chances);
    }
}

result! {
    /// Chances of meeting requirements. `k` is their number.
    Chances(requirement::Chances)
}

/// 95 % interval (Clopper and Pearson).
fn interval(tally: &requirement::Tally) -> Option<(f64, f64)> {
    let interval = tally.clopper_pearson(0.95).ok()?;
    Some((interval.lower, interval.upper))
}

attributes! {
    Chances(self, py) {
        /// Share of the samples that fail each requirement, shape (k,).
        failure: Array1<'py> = vector(py, self.0.each.iter().map(requirement::Tally::failure));
        /// Number of samples.
        samples: usize = self.0.all.samples();
        /// How many samples meet each requirement, shape (k,).
        met: Array1<'py, i64> = vector(py, self.0.each.iter().map(|x| x.met as i64));
        /// Share of the samples that meet all requirements.
        all_met: f64 = self.0.all.yield_of();
        /// Lower ends of the 95 % intervals of `failure`, shape (k,).
        lower: Array1<'py> = optional(py, self.0.each.iter().map(|x| Some(interval(x)?.0)));
        /// Upper ends, shape (k,).
        upper: Array1<'py> = optional(py, self.0.each.iter().map(|x| Some(interval(x)?.1)));
        /// How many samples fail each requirement, shape (k,).
        failed: Array1<'py, i64> = vector(py, self.0.each.iter().map(|x| x.failed as i64));
        /// How many samples lack the response needed to tell, shape (k,).
        untold: Array1<'py, i64> = vector(py, self.0.each.iter().map(|x| x.untold as i64));
        /// Share of the samples that fail any requirement.
        any_failure: f64 = self.0.all.failure();
        /// Its 95 % interval.
        any_interval: Option<(f64, f64)> = interval(&self.0.all);
        /// How many samples meet all requirements, fail one, lack the response needed to tell.
        all_counts: (usize, usize, usize) = (self.0.all.met, self.0.all.failed, self.0.all.untold);
        /// Number of samples that were asked for.
        planned: usize = self.0.planned;
    }
}

result! {
    /// Reliability of a design. `l` is the number of limits that requirements put to responses.
    Reliability(requirement::Reliability)
}

impl Reliability {
    fn each<'py>(&self, py: Python<'py>, of: fn(&LimitReliability) -> Option<f64>) -> Array1<'py> {
        optional(py, self.0.limits.iter().map(of))
    }

    /// Numbers of the most probable design point of each limit, a row each.
    fn points<'py>(&self, py: Python<'py>, of: fn(&DesignPoint) -> Vec<f64>) -> PyResult<Array2<'py>> {
        let points = self.0.limits.iter().map(|limit| limit.design_points.as_ref());
        let first = points.map(|point| point.ok()?.first().map(&of));
        optional_rows(py, self.0.description.design.len(), first)
    }
}

attributes! {
    Reliability(self, py) {
        /// Probability to first order that each limit is passed, shape (l,); NaN without a design point.
        failure: Array1<'py> = self.each(py, LimitReliability::probability);
        /// Reliability index of each limit, shape (l,); NaN without a design point.
        beta: Array1<'py> = self.each(py, LimitReliability::beta);
        /// Probability that each limit is passed by designs solved anew, which judges the design points, shape (l,); NaN
        /// where that was not done.
        solved_anew: Array1<'py> =
            self.each(py, |limit| Some(limit.judgement.judged()?.probability.value));
        /// Half-widths of their 95 % intervals, shape (l,).
        error: Array1<'py> = self.each(py, |limit| {
            let interval = limit.judgement.judged()?.interval();
            Some(0.5 * (interval.upper - interval.lower))
        });
        /// Whether designs solved anew confirm the probability to first order of each limit, within 10 %.
        verified: Vec<bool> =
            self.0.limits.iter().map(LimitReliability::verified).collect();
        /// Probability that any requirement is failed, by designs solved anew; None where that was not done.
        any_failure: Option<f64> = self.0.judgement.judged().map(|x| x.probability.value);
        /// The limits: the position of the requirement, and the name of the response.
        limits: Vec<(usize, String)> = {
            let name = |limit_reliability: &LimitReliability| Some(limit_reliability.limit.response()?.name(&self.0.description));
            let all = self.0.limits.iter();
            all.map(|x| (x.requirement, name(x).unwrap_or_default())).collect()
        };
        /// Where each response fails: "below", "above" or "between", and the ends, SI; "around", and order and fraction.
        edges: Vec<(&'static str, Vec<f64>)> = {
            let all = self.0.limits.iter();
            all.map(|item| match item.limit {
                Limit::Within { low, .. } if low.is_finite() => ("below", vec![low]),
                Limit::Within { high, .. } => ("above", vec![high]),
                Limit::Outside { low, high, .. } => ("between", vec![low, high]),
                Limit::Away { order, fraction, .. } => ("around", vec![order, fraction]),
                _ => ("", Vec::new()),
            })
            .collect()
        };
        /// Names of the design variables, and after them of the inputs that have a tolerance.
        names: Vec<&str> = names::design(&self.0.description);
        /// The most probable design that fails for each limit, SI, shape (l, variables); NaN without one.
        design_points: PyResult<Array2<'py>> = self.points(py, |point| point.design.to_vec());
        /// Shares of the variables in each `beta`, shape (l, variables).
        importance: PyResult<Array2<'py>> = self.points(py, |point| point.importance.to_vec());
        /// Derivatives of each `beta` by nominal values, per SI unit, shape (l, variables).
        beta_by_nominal: PyResult<Array2<'py>> =
            self.points(py, |point| point.by_nominal.iter().map(|slope| slope.beta).collect());
        /// The same by half-widths of tolerances, shape (l, variables).
        beta_by_half_width: PyResult<Array2<'py>> =
            self.points(py, |point| point.by_half_width.iter().map(|slope| slope.beta).collect());
        /// Number of design points of each limit, shape (l,).
        point_counts: Array1<'py, i64> = {
            let points = self.0.limits.iter().map(|limit| limit.design_points.as_ref());
            vector(py, points.map(|x| x.map_or(0, |point| point.len() as i64)))
        };
        /// Whether no design within reach passes the limit, shape (l,).
        out_of_reach: Array1<'py, bool> =
            vector(py, self.0.limits.iter().map(LimitReliability::out_of_reach));
        /// Why a limit has no design point: a text for each limit, or None.
        failures: Vec<Option<String>> =
            self.0.limits.iter()
                .map(|limit| Some(limit.design_points.as_ref().err()?.to_string())).collect();
        /// What the designs solved anew say of each limit, by name; under "open" why there are none.
        judgements: PyResult<Vec<Bound<'py, PyDict>>> =
            self.0.limits.iter().map(|limit| judgement(py, &limit.judgement)).collect();
        /// The same of failing any requirement, those without a limit included.
        any_judgement: PyResult<Bound<'py, PyDict>> = judgement(py, &self.0.judgement);
        /// Whether designs solved anew confirm the probability to first order of every limit.
        any_verified: bool = self.0.verified();
        /// Positions of the requirements without a limit, such as `"stable"`.
        left_out: Vec<usize> = self.0.left_out.clone();
    }
}
