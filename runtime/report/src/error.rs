//! What can go wrong with a report.

use std::io;
use std::path::PathBuf;

/// Why a report was not written. What an analysis refuses is no error: the report says it in its place.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The study is set up wrongly: a handle of another mechanism, a value that is not finite, tolerances that make no sense.
    #[error(transparent)]
    Study(#[from] eigentol::Error),
    /// The file cannot be written.
    #[error("cannot write `{}`: {source}", .path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// A number or a text of the report has no form in JSON.
    #[error("cannot write the data of the report: {0}")]
    Data(#[from] serde_json::Error),
}
