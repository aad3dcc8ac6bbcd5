//! Large mechanisms fit into the small stacks that threads have, without optimisation too: every question, to a mechanism with 64
//! unknowns and 64 design variables and to the bicycle, compiled and interpreted.
#![recursion_limit = "256"]

#[path = "stacks/bars.rs"]
mod bars;
#[path = "stacks/questions.rs"]
mod questions;

use eigentol::Study;
use eigentol::kernels::BatchKernels;
use eigentol_interpreter::Interpreted;
use eigentol_tests::wheels::{WhippleBicycle, whipple};

use bars::Bars;
use questions::{Question, Range, along_an_input, at_one_state, of_what_is_solved};

/// Of the stack that threads of Rust have, KiB, and the main thread of Windows.
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

/// Asks each question in a thread of its own.
fn ask<M>(study: &Study<M>, range: &Range, stack: usize, questions: &[Question<M>])
where
    M: BatchKernels + Clone + Send + 'static,
{
    for &(name, question) in questions {
        let (study, range) = (study.clone(), *range);
        let thread = std::thread::Builder::new().stack_size(stack << 10);
        let thread = thread.name(name.to_owned());
        let asked = thread.spawn(move || { let t = std::time::Instant::now(); question(&study, &range); eprintln!("{name} {:?}", t.elapsed()) });
        asked.expect("a thread").join().expect("no panic");
    }
}

fn few<M: BatchKernels>(machine: M) -> Study<M> {
    Study::new(machine).threads(2).samples(2).steps(2)
}

fn ask_everything<M>(study: &Study<M>, range: &Range, stack: usize)
where
    M: BatchKernels + Clone + Send + 'static,
{
    ask(study, range, stack, &at_one_state());
    ask(study, range, stack, &of_what_is_solved());
    ask(study, range, stack, &along_an_input());
}

fn interpreted(declaration: &str) -> Interpreted {
    Interpreted::from_text(declaration).expect("a declaration")
}

#[test]
fn bars_compiled() {
    ask_everything(&few(Bars), &BARS, THREAD);
}

#[test]
fn bars_interpreted() {
    ask_everything(&few(interpreted(bars::DECLARATION)), &BARS, THREAD);
}

#[test]
fn bicycle_compiled() {
    let study = few(WhippleBicycle).input(WhippleBicycle::v, 5.0);
    ask_everything(&study, &BICYCLE, WINDOWS);
}

#[test]
fn bicycle_interpreted() {
    let machine = interpreted(whipple::DECLARATION);
    let speed = machine.input("v").expect("declared");
    ask_everything(&few(machine).input(speed, 5.0), &BICYCLE, WINDOWS);
}
