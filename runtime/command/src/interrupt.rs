//! Ctrl-C and requests to terminate (SIGTERM): work that can stop soon keeps its results, any other work ends at once.
//!
//! SIGHUP is left alone, so that `nohup` works.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, LazyLock};
use std::time::Duration;
use std::{process, thread};

use crate::failure::Failure;

/// Exit code of an interrupted program: 128 plus the number of SIGINT, whichever signal it was.
pub(crate) const INTERRUPTED: u8 = 130;

static STOP: LazyLock<Arc<AtomicBool>> = LazyLock::new(Arc::default);
static STOPPABLE: AtomicBool = AtomicBool::new(false);
static ANSWERS: AtomicBool = AtomicBool::new(false);
static PRINTS: AtomicBool = AtomicBool::new(false);

/// Time in which stopped work may begin to write what it has.
const GRACE: Duration = Duration::from_millis(700);

/// Makes an interrupt end the program with a message.
pub(crate) fn watch() -> Result<(), Failure> {
    ctrlc::set_handler(interrupted)?;
    #[cfg(unix)]
    {
        let mut requests =
            signal_hook::iterator::Signals::new([signal_hook::consts::SIGTERM]).map_err(ctrlc::Error::System)?;
        std::thread::spawn(move || requests.forever().for_each(|_| interrupted()));
    }
    Ok(())
}

fn interrupted() {
    let again = STOP.swap(true, Ordering::Relaxed);
    if again || answers() || !STOPPABLE.load(Ordering::Relaxed) {
        end();
    }
    thread::spawn(|| {
        thread::sleep(GRACE);
        if !answers() {
            end();
        }
    });
}

fn end() {
    let written = if answers() || PRINTS.load(Ordering::Relaxed) {
        "before the answer was complete"
    } else {
        "nothing was written"
    };
    eprintln!("stopped: {written}");
    process::exit(i32::from(INTERRUPTED));
}

/// From now on the answer is written.
pub(crate) fn answer() {
    ANSWERS.store(true, Ordering::Relaxed);
}

/// Rows of the answer have been printed; more may follow.
pub(crate) fn prints() {
    PRINTS.store(true, Ordering::Relaxed);
}

/// Whether the answer is being written.
pub(crate) fn answers() -> bool {
    ANSWERS.load(Ordering::Relaxed)
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
