//! Ctrl-C: work that can stop half-way keeps what it has done, any other ends at once.

use std::process;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, LazyLock};

use crate::failure::Failure;

/// Exit code of a program that SIGINT has ended: 128 and the number of the signal.
pub(crate) const INTERRUPTED: u8 = 130;

static STOP: LazyLock<Arc<AtomicBool>> = LazyLock::new(Arc::default);
static STOPPABLE: AtomicBool = AtomicBool::new(false);

/// From now on Ctrl-C ends the program with a message.
pub(crate) fn watch() -> Result<(), Failure> {
    ctrlc::set_handler(|| {
        let again = STOP.swap(true, Ordering::Relaxed);
        if again || !STOPPABLE.load(Ordering::Relaxed) {
            eprintln!("stopped: nothing was written");
            process::exit(i32::from(INTERRUPTED));
        }
    })?;
    Ok(())
}

/// From now on the first Ctrl-C sets this flag, and the second one ends the program.
pub(crate) fn stop() -> Arc<AtomicBool> {
    STOPPABLE.store(true, Ordering::Relaxed);
    Arc::clone(&STOP)
}

/// Whether Ctrl-C has set the flag.
pub(crate) fn stopped() -> bool {
    STOP.load(Ordering::Relaxed)
}
