//! Why an example ends early, and the exit code that reports it.

use std::io;
use std::path::PathBuf;

use eigentol_figures::Error;

/// Why a run ended without its full result.
#[derive(Debug, thiserror::Error)]
pub enum Failure {
    /// The command line asks for help or is invalid; the message is complete.
    #[error("{0}")]
    CommandLine(Box<clap::Error>),
    /// A file or directory of the results cannot be written.
    #[error("cannot write `{}`: {reason}: choose another directory with --out", path.display())]
    Output {
        /// The file or directory.
        path: PathBuf,
        /// The error of the operating system.
        reason: String,
    },
    /// An analysis failed as a whole; a single point that fails is reported in the summary instead.
    #[error(transparent)]
    Solver(#[from] eigentol::Error),
    /// There is nothing to draw, or it cannot be drawn.
    #[error(transparent)]
    Figure(Error),
    /// Standard output is closed.
    #[error("cannot write to standard output: {0}")]
    Print(#[from] io::Error),
}

/// Any file that cannot be written is a result file.
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
    /// The exit code of the program.
    ///
    /// It is 0 if nothing went wrong (help was requested, or the reader of a pipe has gone), 2 if the command line or
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
