//! Ctrl-C and requests to terminate (SIGTERM): interruptible work keeps its results, any other work ends at once.
//!
//! SIGHUP is left alone, so that `nohup` works.

use std::process;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, LazyLock};

use crate::failure::Failure;

/// Exit code of an interrupted program: 128 plus the number of SIGINT, whichever signal it was.
pub(crate) const INTERRUPTED: u8 = 130;

static STOP: LazyLock<Arc<AtomicBool>> = LazyLock::new(Arc::default);
static STOPPABLE: AtomicBool = AtomicBool::new(false);

/// Makes an interrupt end the program with a message.
pub(crate) fn watch() -> Result<(), Failure> {
    ctrlc::set_handler(interrupted)?;
    #[cfg(unix)]
    {
        let mut requests = signal_hook::iterator::Signals::new([signal_hook::consts::SIGTERM])
            .map_err(ctrlc::Error::System)?;
        std::thread::spawn(move || requests.forever().for_each(|_| interrupted()));
    }
    Ok(())
}

fn interrupted() {
    let again = STOP.swap(true, Ordering::Relaxed);
    if again || !STOPPABLE.load(Ordering::Relaxed) {
        eprintln!("stopped: nothing was written");
        process::exit(i32::from(INTERRUPTED));
    }
}

/// Makes the first interrupt set this flag and the second end the program.
pub(crate) fn stop() -> Arc<AtomicBool> {
    STOPPABLE.store(true, Ordering::Relaxed);
    Arc::clone(&STOP)
}

/// Whether an interrupt has set the flag.
pub(crate) fn stopped() -> bool {
    STOP.load(Ordering::Relaxed)
}
