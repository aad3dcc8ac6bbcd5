//! Probabilities of meeting requirements.

use eigentol::requirement::{self, Requirement, SamplingSettings};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyString, PyTuple};

use crate::arrays::{Array1, optional, vector};
use crate::response::wanted;
use crate::results::result;
use crate::study::Study;
use crate::values::not_finite;

/// Parses one requirement: "stable", or a response with a low and a high end, None for an open end; "outside" before
/// the ends for a forbidden band.
fn requirement(
    study: &eigentol::Study<eigentol_interpreter::Interpreted>,
    given: &Bound<'_, PyAny>,
) -> PyResult<Requirement> {
    if given
        .cast::<PyString>()
        .is_ok_and(|word| word.to_cow().is_ok_and(|word| word == "stable"))
    {
        return Ok(Requirement::Stable);
    }
    let (response, low, high, outside) = ends(given)?;
    for end in [low, high].into_iter().flatten() {
        if end.is_nan() {
            return Err(not_finite(given.py(), "end of a requirement", end));
        }
    }
    let what = response.get_item(0)?.extract::<String>()?;
    let of = response.get_slice(1, response.len());
    let response = wanted(study, &what, &of)?;
    let (low, high) = (
        low.unwrap_or(f64::NEG_INFINITY),
        high.unwrap_or(f64::INFINITY),
    );
    Ok(match outside {
        true => Requirement::Outside {
            response,
            low,
            high,
        },
        false => Requirement::Within {
            response,
            low,
            high,
        },
    })
}

type Ends<'py> = (Bound<'py, PyTuple>, Option<f64>, Option<f64>, bool);

/// Response, low and high end, and whether it must stay outside.
fn ends<'py>(given: &Bound<'py, PyAny>) -> PyResult<Ends<'py>> {
    if let Ok((response, low, high)) = given.extract() {
        return Ok((response, low, high, false));
    }
    let read = given.extract::<(String, Bound<'py, PyTuple>, f64, f64)>();
    match read {
        Ok((word, response, low, high)) if word == "outside" => {
            Ok((response, Some(low), Some(high), true))
        }
        _ => Err(PyTypeError::new_err(
            "a requirement is \"stable\", or a response, a low and a high end: ((\"frequency\", 0), 3.0, None), or a \
             forbidden band: (\"outside\", (\"frequency\", 0), 3.0, 4.0)",
        )),
    }
}

#[pymethods]
impl Study {
    /// Chances of meeting requirements, by sampling. Each is "stable", or a response as `propagate` takes it with a low
    /// and a high end, None for no end: `(("frequency", 0), 3.9, None)`, or a forbidden band:
    /// `("outside", ("frequency", 0), 3.0, 4.0)`; frequencies are in rad/s. Of `start` and `stop` only the samples
    /// `start` to below `stop` are taken; numbers of samples of parts add up to those of the whole. Ctrl-C ends it.
    #[pyo3(signature = (requirements, start=None, stop=None))]
    fn chances(
        &self,
        py: Python<'_>,
        requirements: Vec<Bound<'_, PyAny>>,
        start: Option<u64>,
        stop: Option<u64>,
    ) -> PyResult<Chances> {
        let wanted = self.requirements(&requirements)?;
        let found = self.ask_stoppably(py, |study| {
            let sampling = study.sampling();
            let range = start.unwrap_or(0)..stop.unwrap_or(sampling.samples as u64);
            study.chances_by(&wanted, &sampling.range(Some(range)))
        });
        found.map(Chances)
    }

    /// How probable it is that each requirement, and that any, is failed, with nothing to choose: by design points, lines
    /// of designs, or samples; requirements as `chances` takes them.
    fn probability(
        &self,
        py: Python<'_>,
        requirements: Vec<Bound<'_, PyAny>>,
    ) -> PyResult<Probabilities> {
        let wanted = self.requirements(&requirements)?;
        self.ask_stoppably(py, |study| study.probability(&wanted))
            .map(Probabilities)
    }

    /// Reliability by way of design points (FORM and SORM), judged by designs solved anew; requirements as `chances`
    /// takes them.
    fn reliability(
        &self,
        py: Python<'_>,
        requirements: Vec<Bound<'_, PyAny>>,
    ) -> PyResult<Reliability> {
        let wanted = self.requirements(&requirements)?;
        self.ask_stoppably(py, |study| study.reliability(&wanted))
            .map(Reliability)
    }

    /// A small probability of failing any requirement, by importance sampling about the design points; requirements as
    /// `chances` takes them.
    fn rare_failure(
        &self,
        py: Python<'_>,
        requirements: Vec<Bound<'_, PyAny>>,
    ) -> PyResult<RareFailure> {
        let wanted = self.requirements(&requirements)?;
        let settings = SamplingSettings::default();
        self.ask_stoppably(py, |study| study.rare_failure(&wanted, &settings))
            .map(RareFailure)
    }
}

impl Study {
    pub(crate) fn requirements(&self, given: &[Bound<'_, PyAny>]) -> PyResult<Vec<Requirement>> {
        let one = |given| requirement(&self.inner, given);
        given.iter().map(one).collect()
    }
}

result! {
    /// Probabilities of failing requirements. `k` is their number. No model is behind them: every design is solved anew.
    Probabilities(requirement::Probabilities)
}

#[pymethods]
impl Probabilities {
    /// Probability of failing each requirement, shape (k,).
    #[getter]
    fn failure<'py>(&self, py: Python<'py>) -> Array1<'py> {
        vector(py, self.0.each.iter().map(|own| own.value))
    }

    /// Lower ends of their 95 % intervals, shape (k,).
    #[getter]
    fn lower<'py>(&self, py: Python<'py>) -> Array1<'py> {
        vector(py, self.0.each.iter().map(|own| own.interval.lower))
    }

    /// Upper ends, shape (k,).
    #[getter]
    fn upper<'py>(&self, py: Python<'py>) -> Array1<'py> {
        vector(py, self.0.each.iter().map(|own| own.interval.upper))
    }

    /// Probabilities that a design lacks the response needed to tell, shape (k,).
    #[getter]
    fn untold<'py>(&self, py: Python<'py>) -> Array1<'py> {
        vector(py, self.0.each.iter().map(|own| own.untold))
    }

    /// How each was found: "design point", "lines" or "samples".
    #[getter]
    fn found_by(&self) -> Vec<&'static str> {
        let all = self.0.each.iter();
        all.map(|own| match own.by {
            requirement::Found::DesignPoint => "design point",
            requirement::Found::Lines => "lines",
            _ => "samples",
        })
        .collect()
    }

    /// Probability of failing any requirement.
    #[getter]
    fn any_failure(&self) -> f64 {
        self.0.any.value
    }

    /// Its 95 % interval.
    #[getter]
    fn any_interval(&self) -> (f64, f64) {
        (self.0.any.interval.lower, self.0.any.interval.upper)
    }

    /// The design points, or None: what changes the probabilities.
    #[getter]
    fn reliability(&self) -> Option<Reliability> {
        self.0.reliability.clone().map(Reliability)
    }
}

result! {
    /// Chances of meeting requirements. `k` is their number.
    Chances(requirement::Chances)
}

#[pymethods]
impl Chances {
    /// Share of the samples that fail each requirement, shape (k,).
    #[getter]
    fn failure<'py>(&self, py: Python<'py>) -> Array1<'py> {
        vector(py, self.0.each.iter().map(requirement::Tally::failure))
    }

    /// Number of samples.
    #[getter]
    fn samples(&self) -> usize {
        self.0.all.samples()
    }

    /// How many samples meet each requirement, shape (k,).
    #[getter]
    fn met<'py>(&self, py: Python<'py>) -> Array1<'py, i64> {
        vector(py, self.0.each.iter().map(|own| own.met as i64))
    }

    /// Share of the samples that meet all requirements.
    #[getter]
    fn all_met(&self) -> f64 {
        self.0.all.yield_of()
    }
}

result! {
    /// Reliability of a design. `l` is the number of limits that requirements put to responses.
    Reliability(requirement::Reliability)
}

#[pymethods]
impl Reliability {
    /// Probability to first order that each limit is passed, shape (l,); NaN without a design point. Those to second
    /// order stand in the table "design points".
    #[getter]
    fn failure<'py>(&self, py: Python<'py>) -> Array1<'py> {
        let all = self.0.limits.iter();
        optional(py, all.map(requirement::LimitReliability::probability))
    }

    /// Reliability index of each limit, shape (l,); NaN without a design point.
    #[getter]
    fn beta<'py>(&self, py: Python<'py>) -> Array1<'py> {
        let all = self.0.limits.iter();
        optional(py, all.map(requirement::LimitReliability::beta))
    }

    /// Probability that each limit is passed by designs solved anew, which judges the design points, shape (l,); NaN
    /// where that was not done.
    #[getter]
    fn solved_anew<'py>(&self, py: Python<'py>) -> Array1<'py> {
        let judged = self.0.limits.iter().map(|own| own.judgement.judged());
        optional(py, judged.map(|own| own.map(|own| own.probability.value)))
    }

    /// Half-widths of their 95 % intervals, shape (l,).
    #[getter]
    fn error<'py>(&self, py: Python<'py>) -> Array1<'py> {
        let judged = self.0.limits.iter().map(|own| own.judgement.judged());
        let half = |own: &eigentol::judge::Judged| {
            let interval = own.interval();
            0.5 * (interval.upper - interval.lower)
        };
        optional(py, judged.map(|own| own.map(half)))
    }

    /// Whether designs solved anew confirm the probability to first order of each limit, within 10 %.
    #[getter]
    fn verified(&self) -> Vec<bool> {
        let all = self.0.limits.iter();
        all.map(requirement::LimitReliability::verified).collect()
    }

    /// Probability that any limit is passed, to first order; None where it is not known.
    #[getter]
    fn any_failure(&self) -> Option<f64> {
        self.0.system.as_ref().map(|own| own.probability.value)
    }
}

result! {
    /// A small probability of failure.
    RareFailure(requirement::RareFailure)
}

#[pymethods]
impl RareFailure {
    /// Probability that any requirement is failed.
    #[getter]
    fn failure(&self) -> f64 {
        self.0.failure.probability.value
    }

    /// Whether the samples reached their target and lines of designs do not contradict them.
    #[getter]
    fn trusted(&self) -> bool {
        self.0.trusted()
    }

    /// Standard error of `failure`.
    #[getter]
    fn standard_error(&self) -> f64 {
        self.0.failure.probability.standard_error
    }

    /// Positions of the requirements of which some failure has no design point, such as `"stable"`.
    #[getter]
    fn without_design_point(&self) -> Vec<usize> {
        self.0.without_design_point.clone()
    }

    /// Probability that failures of these may have without having been seen, at a confidence of 95 %.
    #[getter]
    fn unseen(&self) -> f64 {
        self.0.unseen
    }
}
