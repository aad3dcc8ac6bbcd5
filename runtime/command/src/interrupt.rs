//! Ctrl-C: work that can stop half-way does, any other ends at once.

use std::process;
use std::sync::atomic::{AtomicBool, Ordering};

use crate::failure::Failure;

/// Exit code of a program that SIGINT has ended: 128 and the number of the signal.
pub(crate) const INTERRUPTED: u8 = 130;

static WANTED: AtomicBool = AtomicBool::new(false);

/// From now on Ctrl-C is remembered; the second one ends the program.
pub(crate) fn watch() -> Result<(), Failure> {
    ctrlc::set_handler(|| {
        if WANTED.swap(true, Ordering::Relaxed) {
            process::exit(i32::from(INTERRUPTED));
        }
    })?;
    Ok(())
}

/// Whether Ctrl-C was pressed.
pub(crate) fn wanted() -> bool {
    WANTED.load(Ordering::Relaxed)
}
