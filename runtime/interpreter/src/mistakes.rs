//! Errors in a text and their locations.

use std::path::PathBuf;

use thiserror::Error;

pub use eigentol_compiler::{Mistake, Mistakes};

/// The reason why a file gave no mechanism.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ReadError {
    /// The file cannot be read.
    #[error("cannot read {}: {source}", .path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// The cause.
        source: std::io::Error,
    },
    /// The declaration is invalid.
    #[error("{}", .mistakes.of_file(.path))]
    Mistakes {
        /// The file.
        path: PathBuf,
        /// The mistakes in it.
        mistakes: Mistakes,
    },
}
