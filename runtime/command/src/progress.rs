//! A bar on standard error while something takes long; nothing where that is no terminal.

use eigentol::Study;
use eigentol_interpreter::Interpreted;
use indicatif::{ProgressBar, ProgressStyle};

use crate::interrupt;

/// A bar of so many steps, or a count of steps of which nobody knows how many there will be.
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

/// The study, its steps shown by a bar, and ended by Ctrl-C with what is done.
pub(crate) fn watched(study: Study<Interpreted>, bar: &ProgressBar) -> Study<Interpreted> {
    let own = bar.clone();
    study
        .progress(move |steps| own.inc(steps as u64))
        .stop(interrupt::stop())
}
