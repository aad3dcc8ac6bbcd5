//! Mechanisms fit into the small stacks of threads, even without optimisation: every question is put to the bicycle, both
//! compiled and interpreted. `large_stacks` puts them to 64 unknowns.

#[path = "stacks/ask.rs"]
mod ask;
#[path = "stacks/questions.rs"]
mod questions;

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use eigentol_interpreter::Interpreted;
use eigentol_tests::wheels::{WhippleBicycle, whipple};

use ask::{BARS, THREAD, ask, everything, few, interpreted};
use questions::{Question, Range, along_an_input, at_one_state, of_chance, of_vibration};

/// Stack size of the main thread on Windows, KiB.
const WINDOWS: usize = 1024;

const BICYCLE: Range =
    Range { sweep: [5.0, 5.1, 5.2], branches: [4.5, 5.5], critical: [5.0, 7.0], crossings: [4.0, 5.0], order: 1.0 };

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
    let sampling = ["monte_carlo", "influence"];
    questions.retain(|(name, _)| sampling.contains(name));
    assert_eq!(questions.len(), sampling.len());
    // On the calling thread.
    ask(&study.threads(1), &BARS, THREAD, &questions);
}

/// The same chain, shaken at its end.
#[test]
fn a_long_chain_vibrates() {
    let shaken = "input f: rad/s; point end: bar15 at [0, 0, -l15]; output tip = position(end).x;
        force shake: harmonic(at: end, force: [1, 0, 0] N, frequency: f); }";
    let chain = damped_chain();
    let chain = chain.trim_end().trim_end_matches('}');
    let study = few(interpreted(&format!("{chain}{shaken}"))).samples(8);
    let frequency = study.find_input("f").expect("declared");
    let range = Range { sweep: [1.0, 1.5, 2.0], crossings: [1.0, 4.0], ..BARS };
    ask(&study.input(frequency, 1.0), &range, WINDOWS, &of_vibration());
}

/// Every question in the sources of `Study` is put here, name by name.
#[test]
fn every_question_is_asked() {
    let names = |questions: Vec<Question<Interpreted>>| -> BTreeSet<String> {
        questions.iter().map(|(name, _)| (*name).to_owned()).collect()
    };
    for (files, asked) in [
        (&["at_point", "beyond_first_order"][..], names(at_one_state())),
        (&["over_input", "events"], names(along_an_input())),
        (&["forced"], names(of_vibration())),
        (&["propagation", "requirements"], names(of_chance())),
    ] {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../runtime/src/study");
        let read = |file: &&str| fs::read_to_string(folder.join(file).with_extension("rs"));
        let sources: Result<String, _> = files.iter().map(read).collect();
        let source = sources.expect("sources");
        let methods = source.split("\n    pub fn ").skip(1);
        let declared: BTreeSet<String> =
            methods.filter_map(|method| method.split(['(', '<']).next().map(str::to_owned)).collect();
        assert_eq!(asked, declared, "{files:?}");
    }
}
