//! Large mechanisms fit into the small stacks of threads, even without optimisation: every question is put to a
//! mechanism with 64 unknowns and 64 design variables and to the bicycle, both compiled and interpreted.
#![recursion_limit = "256"]

#[path = "stacks/bars.rs"]
mod bars;
#[path = "stacks/questions.rs"]
mod questions;

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use eigentol::kernels::{BatchKernels, CurvatureKernels, PictureKernels};
use eigentol::{Policy, Study};
use eigentol_interpreter::Interpreted;
use eigentol_tests::wheels::{WhippleBicycle, whipple};

use bars::Bars;
use questions::{Question, Range, along_an_input, at_one_state, of_chance};

/// Stack size of Rust threads, KiB, and of the main thread on Windows.
const THREAD: usize = 2048;
const WINDOWS: usize = 1024;

const BARS: Range = Range {
    sweep: [0.0, 0.05, 0.1],
    branches: [0.0, 0.01],
    critical: [0.4, 0.6],
    crossings: [0.2, 0.5],
    order: 1.0,
};
const BICYCLE: Range = Range {
    sweep: [5.0, 5.1, 5.2],
    branches: [4.5, 5.5],
    critical: [5.0, 7.0],
    crossings: [4.0, 5.0],
    order: 1.0,
};

/// Puts each question in a separate thread.
fn ask<M>(study: &Study<M>, range: &Range, stack: usize, questions: &[Question<M>])
where
    M: BatchKernels + CurvatureKernels + PictureKernels + Clone + Send + 'static,
{
    for &(name, question) in questions {
        // The setting makes it solve its equilibrium again.
        let (study, range) = (study.clone().policy(Policy::Stable), *range);
        let thread = std::thread::Builder::new().stack_size(stack << 10);
        let thread = thread.name(name.to_owned());
        let asked = thread.spawn(move || question(&study, &range));
        asked.expect("a thread").join().expect("no panic");
    }
}

fn few<M: BatchKernels + CurvatureKernels + PictureKernels>(machine: M) -> Study<M> {
    Study::new(machine).threads(2).samples(2).steps(2)
}

fn everything<M: BatchKernels + CurvatureKernels + PictureKernels>() -> Vec<Question<M>> {
    let mut questions = at_one_state();
    questions.extend(of_chance());
    questions.extend(along_an_input());
    questions
}

/// Questions that take many seconds for 64 unknowns with 64 variables.
const SLOW: [&str; 5] = [
    "second_order",
    "summary",
    "summary_within",
    "flutter_onsets",
    "flutter_onset_tolerances",
];
/// Questions that search along an input or between limits, some seconds each.
const SEARCHES: [&str; 3] = ["worst_case", "crossings", "crossing_tolerances"];
/// Thousands of states: put only to the bicycle. They call the same code as other questions.
const LONG: [&str; 6] = [
    "propagate",
    "controlled",
    "influence",
    "reliability",
    "rare_failure",
    "allocation",
];

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

fn interpreted(declaration: &str) -> Interpreted {
    Interpreted::from_text(declaration).expect("a declaration")
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
    ask_bars(interpreted(bars::DECLARATION), |name| {
        SEARCHES.contains(&name)
    });
}

#[test]
#[ignore = "a minute without optimisation"]
fn bars_and_slow_questions() {
    ask_bars(Bars, |name| SLOW.contains(&name));
    ask_bars(interpreted(bars::DECLARATION), |name| SLOW.contains(&name));
}

#[test]
fn bicycle_compiled() {
    let study = few(WhippleBicycle).input(WhippleBicycle::v, 5.0);
    ask(&study, &BICYCLE, WINDOWS, &everything());
}

#[test]
fn bicycle_interpreted() {
    let study = few(interpreted(whipple::DECLARATION));
    let speed = study.find_input("v").expect("declared");
    let study = study.input(speed, 5.0);
    ask(&study, &BICYCLE, WINDOWS, &everything());
}

/// A chain of sixteen bars with damped springs: the most unknowns whose samples are solved in vectors.
fn damped_chain() -> String {
    let bar = |k: usize| {
        let (above, place) = match k {
            0 => ("ground".to_owned(), String::new()),
            _ => (format!("bar{}", k - 1), format!(" at [0, 0, -l{}]", k - 1)),
        };
        format!(
            "design l{k} = {} m +/- 1%; body bar{k}: rod(mass: 3 kg, length: l{k}, along: -z);\n\
             joint turn{k}: revolute(y) from {above} to bar{k}{place};\n\
             force spring{k}: spring(on: turn{k}, stiffness: 9000 N*m/rad);\n\
             force damper{k}: damper(on: turn{k}, damping: 2 N*m*s/rad);\n",
            1.0 - 0.03 * k as f64
        )
    };
    let bars: String = (0..16).map(bar).collect();
    format!("mechanism Chain {{ gravity 9.81 m/s^2 along -z; {bars} }}")
}

#[test]
fn samples_side_by_side() {
    let study = few(interpreted(&damped_chain())).samples(64);
    let run = study.monte_carlo().expect("samples");
    assert!(run.side_by_side && run.counts.stable == 64, "{run}");
    let mut questions = at_one_state();
    questions.extend(of_chance());
    let sampling = ["monte_carlo", "controlled", "influence"];
    questions.retain(|(name, _)| sampling.contains(name));
    assert_eq!(questions.len(), sampling.len());
    // On the calling thread.
    ask(&study.threads(1), &BARS, THREAD, &questions);
}

/// Every question in the sources of `Study` is put here, name by name.
#[test]
fn every_question_is_asked() {
    let names = |questions: Vec<Question<Bars>>| -> BTreeSet<String> {
        questions
            .iter()
            .map(|(name, _)| (*name).to_owned())
            .collect()
    };
    for (files, asked) in [
        (&["at_point"][..], names(at_one_state())),
        (&["over_input", "events"], names(along_an_input())),
        (&["propagation", "requirements"], names(of_chance())),
    ] {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../runtime/src/study");
        let read = |file: &&str| fs::read_to_string(folder.join(file).with_extension("rs"));
        let sources: Result<String, _> = files.iter().map(read).collect();
        let source = sources.expect("sources");
        let methods = source.split("\n    pub fn ").skip(1);
        let declared: BTreeSet<String> = methods
            .filter_map(|method| method.split(['(', '<']).next().map(str::to_owned))
            .collect();
        assert_eq!(asked, declared, "{files:?}");
    }
}
