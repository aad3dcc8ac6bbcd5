//! Probabilities of meeting requirements.

use eigentol::requirement;
use pyo3::prelude::*;

use crate::hints::RequirementText;
use crate::results::Answer;
use crate::study::Study;
use crate::values::{meaningless, text};

#[pymethods]
impl Study {
    /// Chances of meeting requirements, by sampling. Each is a text as on paper and in the shell, modes counted from 1: what
    /// `response` takes and a limit, "frequency 1 >= 20 Hz", "angle <= 5 deg", "frequency 1 within 4..5 Hz", "frequency 1
    /// outside 4..5 Hz", "frequency 1 away from 2 speed by 10%", or "stable". Of `start` and `stop` only the samples
    /// `start` to below `stop` are taken; numbers of samples of parts add up to those of the whole. Ctrl-C ends it.
    #[pyo3(signature = (requirements, start=None, stop=None))]
    fn chances(
        &self,
        py: Python<'_>,
        requirements: Vec<RequirementText<'_>>,
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
                    requirements: Vec<RequirementText<'_>>,
                ) -> PyResult<Answer> {
                    let wanted = self.requirements(&requirements)?;
                    self.ask_stoppably(py, |study| study.$question(&wanted)).map(Answer::new)
                }
            )*
        }
    };
}

of_requirements! {
    /// How probable it is that each requirement, and that any, is failed, with nothing to choose: by design points, lines
    /// of designs, or samples; requirements as `chances` takes them.
    probability;
    /// Reliability by way of design points (FORM), judged by designs solved anew; requirements as `chances`
    /// takes them.
    reliability;
}

impl Study {
    pub(crate) fn requirements(&self, given: &[RequirementText<'_>]) -> PyResult<Vec<requirement::Requirement>> {
        let one = |given: &RequirementText<'_>| {
            let wanted = eigentol_interpreter::requirements(&self.inner, &text(given, "frequency 1 >= 20 Hz")?);
            wanted.map_err(|error| meaningless(given.py(), error))
        };
        let each: Vec<Vec<_>> = given.iter().map(one).collect::<PyResult<_>>()?;
        Ok(each.concat())
    }
}
