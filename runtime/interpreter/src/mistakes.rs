//! Errors in a text and their locations.

use std::path::PathBuf;

use thiserror::Error;

pub use eigentol_compiler::{Mistake, Mistakes};

/// The reason why a mechanism has no refined one.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum RefineError {
    /// It has no beam.
    #[error("`{mechanism}` has no beam, so there are no coordinates to add")]
    NoBeam {
        /// The name of the mechanism.
        mechanism: String,
    },
    /// The declaration is invalid.
    #[error("{0}")]
    Mistakes(#[from] Mistakes),
}

/// The reason why something is not stated in a unit.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum UnitError {
    /// Nothing has this name.
    #[error("no input, design variable, coordinate or output is called `{name}`")]
    Unknown {
        /// The name.
        name: String,
    },
    /// The text is no unit of it.
    #[error("{0}")]
    Mistakes(#[from] Mistakes),
}

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
