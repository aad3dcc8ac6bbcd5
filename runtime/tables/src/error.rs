//! What can go wrong with a file.

use std::io;

/// Why a table was not written or read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The file cannot be written: the disk is full, the folder does not exist, the reader of a pipe has gone.
    #[error("cannot write: {0}")]
    Write(#[source] io::Error),
    /// The file cannot be read.
    #[error("cannot read: {0}")]
    Read(#[source] io::Error),
    /// The file is not what it should be.
    #[error("line {line}: {reason}")]
    Malformed {
        /// The line, counted from 1.
        line: u64,
        /// What is wrong with it.
        reason: String,
    },
    /// Columns of one table have different lengths.
    #[error(
        "table `{table}`: column `{column}` has {found} rows where the first column has {expected}"
    )]
    Lengths {
        /// The table.
        table: String,
        /// The heading of the column.
        column: String,
        /// Its rows.
        found: usize,
        /// Those of the first column.
        expected: usize,
    },
    /// The file is not one of ours.
    #[error(
        "this is no document of eigentol: it has no `\"format\": \"eigentol\"` with a version and a kind"
    )]
    Foreign,
    /// The document is of another version.
    #[error(
        "the document is of version {found}, written by {by}; this program reads version {expected}: write it again with this program, or read it with the one that wrote it"
    )]
    Version {
        /// Its version.
        found: String,
        /// What wrote it.
        by: String,
        /// The version that can be read.
        expected: u64,
    },
    /// The document holds another result.
    #[error("the document holds `{found}`, not `{expected}`")]
    Kind {
        /// What it holds.
        found: String,
        /// What was to be read.
        expected: &'static str,
    },
    /// The content does not make sense.
    #[error("the document is damaged: {0}")]
    Content(String),
    /// Rows of one kind follow rows of another in one file.
    #[error(
        "these rows have the columns {found}, those before them {expected}: write them to a file of their own"
    )]
    OtherColumns {
        /// Headings of the rows that came.
        found: String,
        /// Headings of the file.
        expected: String,
    },
}
