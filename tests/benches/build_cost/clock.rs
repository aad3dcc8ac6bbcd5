//! Processor time, which other work on the machine lengthens less than it does wall time.

use std::fs;
use std::time::{Duration, Instant};

/// Ticks per second of the times in `/proc`, the same on every Linux.
const TICKS: f64 = 100.0;

/// Seconds that child processes take; of the processor on Linux, of the wall elsewhere.
pub(crate) struct Children {
    start: Instant,
    used: Option<f64>,
}

impl Children {
    pub(crate) fn start() -> Self {
        Self {
            start: Instant::now(),
            used: used_by_children(),
        }
    }

    pub(crate) fn seconds(&self) -> f64 {
        match (self.used, used_by_children()) {
            (Some(before), Some(after)) => after - before,
            _ => self.start.elapsed().as_secs_f64(),
        }
    }
}

/// User and system time of all children that have ended and were waited for, and of theirs.
fn used_by_children() -> Option<f64> {
    let text = fs::read_to_string("/proc/self/stat").ok()?;
    // The name of the program, in parentheses, may hold anything; behind it the state is the third field.
    let (_, fields) = text.rsplit_once(')')?;
    let mut times = fields.split_whitespace().skip(13);
    let mut ticks = || times.next()?.parse::<f64>().ok();
    Some((ticks()? + ticks()?) / TICKS)
}

/// Milliseconds of a duration.
pub(crate) fn milliseconds(duration: Duration) -> f64 {
    duration.as_secs_f64() * 1e3
}
