//! Errors of drawing and saving figures.

use std::io;
use std::path::PathBuf;

/// Why there is no figure.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The result has nothing that the figure could show.
    #[error("there is nothing to draw: {0}")]
    Nothing(String),
    /// The result has no such mode.
    #[error("there is no mode {number}: the result has {modes}", number = mode + 1)]
    UnknownMode {
        /// Its index, from 0.
        mode: usize,
        /// The number of modes.
        modes: usize,
    },
    /// A probability of the second-order model cannot be computed.
    #[error(transparent)]
    Solver(#[from] eigentol::Error),
    /// The file name has no known extension.
    #[error("`{}`: a figure is saved as {known}", path.display())]
    Ending {
        /// The file.
        path: PathBuf,
        /// The known extensions.
        known: &'static str,
    },
    /// The file cannot be written.
    #[error("cannot write `{}`: {source}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// The error of the operating system.
        source: io::Error,
    },
    /// The figure cannot be drawn.
    #[error("cannot draw the figure: {0}")]
    Drawing(String),
}

impl Error {
    pub(crate) fn nothing(what: impl Into<String>) -> Self {
        Self::Nothing(what.into())
    }
}
