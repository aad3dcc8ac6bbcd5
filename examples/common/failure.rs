//! Why an example ends early, and the exit code that tells a script so.

use std::io;
use std::path::PathBuf;

use eigentol_figures::Error;

/// Why a run ended without its full result.
#[derive(Debug, thiserror::Error)]
pub enum Failure {
    /// The command line asks for help or makes no sense; the message is complete.
    #[error("{0}")]
    CommandLine(Box<clap::Error>),
    /// A file or directory of the results cannot be written.
    #[error("cannot write `{}`: {reason}: choose another directory with --out", path.display())]
    Output {
        /// Which one.
        path: PathBuf,
        /// What the system said.
        reason: String,
    },
    /// A question to the library failed as a whole; a single point that fails is reported in the summary instead.
    #[error(transparent)]
    Solver(#[from] eigentol::Error),
    /// There is nothing to draw, or it cannot be drawn.
    #[error(transparent)]
    Figure(Error),
    /// Standard output is closed.
    #[error("cannot write to standard output: {0}")]
    Print(#[from] io::Error),
}

/// A file that cannot be written is one of the results.
impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        match error {
            Error::Write { path, source } => Self::Output {
                path,
                reason: source.to_string(),
            },
            other => Self::Figure(other),
        }
    }
}

impl Failure {
    /// 0 when nothing went wrong (help was asked for, or the reader of a pipe had enough), 2 when the command line or
    /// the output directory is at fault, 1 otherwise.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::CommandLine(error) if !error.use_stderr() => 0,
            Self::Print(error) if error.kind() == io::ErrorKind::BrokenPipe => 0,
            Self::CommandLine(_) | Self::Output { .. } => 2,
            Self::Solver(_) | Self::Figure(_) | Self::Print(_) => 1,
        }
    }
}
