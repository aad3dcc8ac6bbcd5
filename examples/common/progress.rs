//! A progress bar on standard error while Monte Carlo runs; hidden if that is not a terminal.

use indicatif::{ProgressBar, ProgressStyle};

/// A bar that counts samples.
pub fn bar(samples: usize) -> ProgressBar {
    let bar = ProgressBar::new(samples as u64);
    match ProgressStyle::with_template("Monte Carlo {bar:40} {percent:>3} %  {eta} left") {
        Ok(style) => bar.with_style(style),
        Err(_) => bar,
    }
}
