//! What several spreads have in common.

use eigentol::judge::{Doubt, Judgement};
use eigentol::tolerance::{Counts, Outcome};
use pyo3::prelude::*;
use pyo3::types::{IntoPyDict, PyDict};

use crate::hints;

/// How many samples became what, by name.
pub(crate) fn counts<'py>(py: Python<'py>, tally: &Counts) -> PyResult<hints::Counts<'py>> {
    let all = Outcome::ALL.into_iter();
    all.map(|outcome| (format!("{outcome:?}"), tally.of(outcome))).into_py_dict(py)
}

/// What designs solved anew say.
pub(crate) fn judgement<'py>(py: Python<'py>, verdict: &Judgement) -> PyResult<Bound<'py, PyDict>> {
    let all = PyDict::new(py);
    match verdict {
        Judgement::Judged(judged) => {
            let (interval, estimate) = (judged.interval(), judged.probability);
            all.set_item("probability", estimate.value)?;
            all.set_item("standard_error", estimate.standard_error)?;
            all.set_item("interval", (interval.lower, interval.upper))?;
            all.set_item("untold", judged.untold.value)?;
            all.set_item("unseen", judged.unseen)?;
            all.set_item("settled", judged.settled)?;
            all.set_item("lines", judged.lines)?;
            all.set_item("designs", judged.designs)?;
        }
        Judgement::Open(reason) => all.set_item("open", reason.to_string())?,
        _ => {}
    }
    Ok(all)
}

pub(super) fn texts(doubts: &[Doubt]) -> Vec<String> {
    doubts.iter().map(ToString::to_string).collect()
}
