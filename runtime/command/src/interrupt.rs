//! Ctrl-C handling: interruptible work keeps its results, any other work ends at once.

use std::process;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, LazyLock};

use crate::failure::Failure;

/// Exit code of a program ended by SIGINT: 128 plus the signal number.
pub(crate) const INTERRUPTED: u8 = 130;

static STOP: LazyLock<Arc<AtomicBool>> = LazyLock::new(Arc::default);
static STOPPABLE: AtomicBool = AtomicBool::new(false);

/// Makes Ctrl-C end the program with a message.
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

/// Makes the first Ctrl-C set this flag and the second end the program.
pub(crate) fn stop() -> Arc<AtomicBool> {
    STOPPABLE.store(true, Ordering::Relaxed);
    Arc::clone(&STOP)
}

/// Whether Ctrl-C has set the flag.
pub(crate) fn stopped() -> bool {
    STOP.load(Ordering::Relaxed)
}
