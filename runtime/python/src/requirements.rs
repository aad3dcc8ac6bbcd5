//! Probabilities of meeting requirements.

use eigentol::{Input, requirement};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use crate::response::wanted;
use crate::results::Answer;
use crate::study::Study;
use crate::values::{List, not_finite};

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
    ) -> PyResult<Answer> {
        let wanted = self.requirements(&requirements)?;
        let answer = self.ask_stoppably(py, |study| {
            let sampling = study.sampling();
            let range = start.unwrap_or(0)..stop.unwrap_or(sampling.samples as u64);
            study.chances_by(&wanted, &sampling.range(Some(range)))
        });
        answer.map(Answer::new)
    }
}

/// Analyses of requirements, given as `chances` takes them.
macro_rules! of_requirements {
    ($($(#[$doc:meta])* $question:ident;)*) => {
        #[pymethods]
        impl Study {
            $(
                $(#[$doc])*
                fn $question(
                    &self,
                    py: Python<'_>,
                    requirements: Vec<Requirement<'_>>,
                ) -> PyResult<Answer> {
                    let wanted = self.requirements(&requirements)?;
                    let found = self.ask_stoppably(py, |study| study.$question(&wanted));
                    found.map(Answer::new)
                }
            )*
        }
    };
}

of_requirements! {
    /// How probable it is that each requirement, and that any, is failed, with nothing to choose: by design points, lines
    /// of designs, or samples; requirements as `chances` takes them.
    probability;
    /// Reliability by way of design points (FORM and SORM), judged by designs solved anew; requirements as `chances`
    /// takes them.
    reliability;
}

impl Study {
    pub(crate) fn requirements(&self, given: &[Requirement<'_>]) -> PyResult<Vec<requirement::Requirement>> {
        let one = |given| requirement(&self.inner, given);
        given.iter().map(one).collect()
    }
}
