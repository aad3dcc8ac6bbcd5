//! Progress reports and early stopping of long computations.

use core::fmt;
use std::sync::atomic::{AtomicBool, Ordering};

use crate::setters;

/// Observes a long computation: receives its progress, and can stop it early with the results so far.
///
/// A study has one too, which all of its long computations obey (`Study::progress`, `Study::stop`).
#[derive(Clone, Copy, Default)]
#[non_exhaustive]
pub struct Watch<'a> {
    /// Called with the number of steps done since the last call, from any thread; steps are samples, values of an
    /// input, points of branches, or choices of tolerances.
    pub progress: Option<&'a (dyn Fn(usize) + Sync)>,
    /// Stops the work soon after it becomes true.
    pub stop: Option<&'a AtomicBool>,
}

impl<'a> Watch<'a> {
    setters!(
        progress: Option<&'a (dyn Fn(usize) + Sync)>,
        stop: Option<&'a AtomicBool>,
    );

    /// Reports that more steps are done.
    #[doc(hidden)]
    pub fn advance(&self, steps: usize) {
        if let Some(progress) = self.progress {
            progress(steps);
        }
    }

    /// Whether the work should stop.
    #[doc(hidden)]
    pub fn stopped(&self) -> bool {
        self.stop.is_some_and(|stop| stop.load(Ordering::Relaxed))
    }
}

impl fmt::Debug for Watch<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Watch").field("progress", &self.progress.is_some()).field("stop", &self.stop).finish()
    }
}
