//! Questions put to a mechanism, each on a small stack.

use eigentol::kernels::{BatchKernels, CurvatureKernels, PictureKernels};
use eigentol::{Policy, Study};
use eigentol_interpreter::Interpreted;

use super::questions::{Question, Range, along_an_input, at_one_state, of_chance, of_vibration};

/// Stack size of Rust threads, KiB.
pub(crate) const THREAD: usize = 2048;

pub(crate) const BARS: Range =
    Range { sweep: [0.0, 0.05, 0.1], branches: [0.0, 0.01], critical: [0.4, 0.6], crossings: [0.2, 0.5], order: 1.0 };
/// Puts each question in a separate thread.
pub(crate) fn ask<M>(study: &Study<M>, range: &Range, stack: usize, questions: &[Question<M>])
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

pub(crate) fn few<M: BatchKernels + CurvatureKernels + PictureKernels>(machine: M) -> Study<M> {
    Study::new(machine).threads(2).samples(2).steps(2)
}

pub(crate) fn everything<M: BatchKernels + CurvatureKernels + PictureKernels + Clone>() -> Vec<Question<M>> {
    let mut questions = at_one_state();
    questions.extend(of_chance());
    questions.extend(along_an_input());
    questions.extend(of_vibration());
    questions
}

pub(crate) fn interpreted(declaration: &str) -> Interpreted {
    Interpreted::from_text(declaration).expect("a declaration")
}
