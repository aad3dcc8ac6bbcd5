//! A progress bar on standard error for long computations; hidden if that is not a terminal.

use eigentol::Study;
use eigentol_interpreter::Interpreted;
use indicatif::{ProgressBar, ProgressStyle};

use crate::interrupt;

/// A bar with this number of steps, or a step counter if the number is unknown.
pub(crate) fn bar(what: &'static str, steps: Option<u64>) -> ProgressBar {
    let (bar, template) = match steps {
        Some(steps) => (
            ProgressBar::new(steps),
            "{msg} {bar:40} {percent:>3} %  {eta} left",
        ),
        None => (ProgressBar::no_length(), "{pos} {msg}  {elapsed}"),
    };
    let bar = bar.with_message(what);
    match ProgressStyle::with_template(template) {
        Ok(style) => bar.with_style(style),
        Err(_) => bar,
    }
}

/// A study that shows its steps on a bar, and that Ctrl-C ends with the work done so far.
pub(crate) fn watched(study: Study<Interpreted>, bar: &ProgressBar) -> Study<Interpreted> {
    let bar = bar.clone();
    study
        .progress(move |steps| bar.inc(steps as u64))
        .stop(interrupt::stop())
}
