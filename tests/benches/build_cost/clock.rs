//! Processor time, which is less affected by other load on the machine than wall time.

use std::fs;
use std::time::{Duration, Instant};

/// Ticks per second of the times in `/proc`; the same on every Linux.
const TICKS: f64 = 100.0;

/// Time spent in child processes, in seconds: processor time on Linux, wall time elsewhere.
pub(crate) struct Children {
    start: Instant,
    used: Option<f64>,
}

impl Children {
    pub(crate) fn start() -> Self {
        Self { start: Instant::now(), used: used_by_children() }
    }

    pub(crate) fn seconds(&self) -> f64 {
        match (self.used, used_by_children()) {
            (Some(before), Some(after)) => after - before,
            _ => self.start.elapsed().as_secs_f64(),
        }
    }
}

/// User and system time of all child processes that have ended and been waited for, including their own children.
fn used_by_children() -> Option<f64> {
    let text = fs::read_to_string("/proc/self/stat").ok()?;
    // The program name, in parentheses, may contain anything; the state is the first field after it and the third
    // overall.
    let (_, fields) = text.rsplit_once(')')?;
    let mut times = fields.split_whitespace().skip(13);
    let mut ticks = || times.next()?.parse::<f64>().ok();
    Some((ticks()? + ticks()?) / TICKS)
}

/// Converts a duration to milliseconds.
pub(crate) fn milliseconds(duration: Duration) -> f64 {
    duration.as_secs_f64() * 1e3
}
