//! What standard error shows of long work: a bar of its steps, or how long it has taken; hidden if that is not a terminal.

use std::ops::Deref;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::{Duration, Instant};

use eigentol::Study;
use eigentol_interpreter::Interpreted;
use indicatif::{ProgressBar, ProgressStyle};

use crate::interrupt;

/// Time without a bar after which it is said that work goes on.
const PATIENCE: Duration = Duration::from_secs(2);
/// Time between two looks of a clock.
const TICK: Duration = Duration::from_millis(200);

/// Number of bars in sight.
static BARS: AtomicUsize = AtomicUsize::new(0);

/// A bar that leaves with its end.
pub(crate) struct Bar(ProgressBar);

impl Deref for Bar {
    type Target = ProgressBar;

    fn deref(&self) -> &ProgressBar {
        &self.0
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        self.0.finish_and_clear();
        BARS.fetch_sub(1, Ordering::Relaxed);
    }
}

/// What is shown of an unknown number of steps.
const COUNTER: &str = "{pos} {msg}  {elapsed}";

/// A bar with this number of steps, or a step counter if the number is unknown.
pub(crate) fn bar(what: &'static str, steps: Option<u64>) -> Bar {
    let (bar, template) = match steps {
        Some(steps) => (ProgressBar::new(steps), "{msg} {bar:40} {percent:>3} %  {elapsed}, {eta} left"),
        None => (ProgressBar::no_length(), COUNTER),
    };
    BARS.fetch_add(1, Ordering::Relaxed);
    Bar(started(bar.with_message(what), template))
}

fn started(bar: ProgressBar, template: &str) -> ProgressBar {
    restyle(&bar, template);
    bar.tick();
    bar.enable_steady_tick(TICK);
    bar
}

fn restyle(bar: &ProgressBar, template: &str) {
    if let Ok(style) = ProgressStyle::with_template(template) {
        bar.set_style(style);
    }
}

/// A study that shows its steps on a bar, and that Ctrl-C ends with the work done so far.
pub(crate) fn watched(study: Study<Interpreted>, bar: &Bar) -> Study<Interpreted> {
    let bar = bar.0.clone();
    study
        .progress(move |steps| {
            bar.inc(steps as u64);
            // What follows the last step takes its time too.
            if bar.length() == Some(bar.position()) {
                restyle(&bar, COUNTER);
            }
        })
        .stop(interrupt::stop())
}

/// Runs work; where no bar is in sight for some time, says how long it has taken.
pub(crate) fn clocked<T>(work: impl FnOnce() -> T) -> T {
    let (done, wait) = mpsc::channel::<()>();
    let clock = thread::spawn(move || {
        let (mut since, mut shown) = (Instant::now(), None);
        while wait.recv_timeout(TICK) == Err(RecvTimeoutError::Timeout) {
            if BARS.load(Ordering::Relaxed) > 0 || interrupt::answers() {
                (since, shown) = (Instant::now(), None);
            } else if shown.is_none() && since.elapsed() > PATIENCE {
                let spinner = ProgressBar::new_spinner().with_elapsed(since.elapsed());
                shown = Some(Spinner(started(spinner, "{spinner} working  {elapsed}")));
            }
        }
    });
    let result = work();
    drop(done);
    // A clock that failed has nothing to add.
    let _ = clock.join();
    result
}

/// A clock that leaves with its end.
struct Spinner(ProgressBar);

impl Drop for Spinner {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}
