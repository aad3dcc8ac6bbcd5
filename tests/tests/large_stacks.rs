//! Large mechanisms fit into the small stacks of threads, even without optimisation: every question is put to a mechanism
//! with 64 unknowns and 64 design variables, both compiled and interpreted. It takes long to build: only `.ci/thorough`
//! does.
#![recursion_limit = "256"]

#[path = "stacks/ask.rs"]
mod ask;
#[path = "stacks/bars.rs"]
mod bars;
#[path = "stacks/questions.rs"]
mod questions;

use eigentol::kernels::{BatchKernels, CurvatureKernels, PictureKernels};

use ask::{BARS, THREAD, ask, everything, few, interpreted};
use bars::Bars;

/// Questions that take many seconds for 64 unknowns with 64 variables.
const SLOW: [&str; 5] = ["second_order", "summary", "summary_within", "flutter_onsets", "flutter_onset_tolerances"];
/// Questions that search along an input or between limits, some seconds each.
const SEARCHES: [&str; 3] = ["worst_case", "crossings", "crossing_tolerances"];
/// Thousands of states: put only to the bicycle. They call the same code as other questions.
const LONG: [&str; 4] = ["propagate", "influence", "reliability", "allocation"];

/// Whether a question takes less than a second.
fn quick(name: &str) -> bool {
    ![&SLOW[..], &SEARCHES, &LONG].concat().contains(&name)
}

/// Puts to the bars the questions whose names `wanted` accepts.
fn ask_bars<M>(bars: M, wanted: fn(&str) -> bool)
where
    M: BatchKernels + CurvatureKernels + PictureKernels + Clone + Send + 'static,
{
    let mut questions = everything();
    questions.retain(|(name, _)| wanted(name));
    ask(&few(bars), &BARS, THREAD, &questions);
}

#[test]
fn bars_compiled() {
    ask_bars(Bars, quick);
}

#[test]
fn bars_interpreted() {
    ask_bars(interpreted(bars::DECLARATION), quick);
}

#[test]
#[ignore = "a minute without optimisation"]
fn bars_and_searches() {
    ask_bars(Bars, |name| SEARCHES.contains(&name));
    ask_bars(interpreted(bars::DECLARATION), |name| SEARCHES.contains(&name));
}

#[test]
#[ignore = "a minute without optimisation"]
fn bars_and_slow_questions() {
    ask_bars(Bars, |name| SLOW.contains(&name));
    ask_bars(interpreted(bars::DECLARATION), |name| SLOW.contains(&name));
}
