//! What is wrong with a text, and where.

use std::path::PathBuf;

use thiserror::Error;

pub use eigentol_compiler::{Mistake, Mistakes};

/// Why a file gave no mechanism.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ReadError {
    /// It cannot be read.
    #[error("cannot read {}: {source}", .path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// What it declares is no mechanism.
    #[error("{}", .mistakes.of_file(.path))]
    Mistakes {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        mistakes: Mistakes,
    },
}
