//! Errors of writing a report.

use std::io;
use std::path::PathBuf;

/// Why a report was not written. A refusal of an analysis is not an error: the report states it in its place.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The study is set up wrongly: a handle of another mechanism, a non-finite value, inconsistent tolerances.
    #[error(transparent)]
    Study(#[from] eigentol::Error),
    /// The file cannot be written.
    #[error("cannot write `{}`: {source}", .path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// The reason.
        source: io::Error,
    },
    /// A number or text of the report cannot be represented in JSON.
    #[error("cannot write the data of the report: {0}")]
    Data(#[from] serde_json::Error),
}
