//! Errors of reading and writing files.

use std::io;

/// Why a table could not be written or read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The file cannot be written: the disk is full, the folder does not exist, or the reader of a pipe has gone.
    #[error("cannot write: {0}")]
    Write(#[source] io::Error),
    /// The file cannot be read.
    #[error("cannot read: {0}")]
    Read(#[source] io::Error),
    /// The file is malformed.
    #[error("line {line}: {reason}")]
    Malformed {
        /// The line, counted from 1.
        line: u64,
        /// What is wrong with it.
        reason: String,
    },
    /// The columns of a table have different lengths.
    #[error("table `{table}`: column `{column}` has {found} rows where the first column has {expected}")]
    Lengths {
        /// The table.
        table: String,
        /// The heading of the column.
        column: String,
        /// Its number of rows.
        found: usize,
        /// The number of rows of the first column.
        expected: usize,
    },
    /// The file was not written by this library.
    #[error("this is not a document of eigentol: it has no `\"format\": \"eigentol\"` with a version and a kind")]
    Foreign,
    /// The document has another version.
    #[error(
        "the document is of version {found}, written by {by}; this program reads version {expected}: write it again with this program, or read it with the one that wrote it"
    )]
    Version {
        /// Its version.
        found: String,
        /// The program that wrote it.
        by: String,
        /// The version that can be read.
        expected: u64,
    },
    /// The document holds a different kind of result.
    #[error("the document holds `{found}`, not `{expected}`")]
    Kind {
        /// The kind found.
        found: String,
        /// The kind expected.
        expected: &'static str,
    },
    /// Parquet was left out of this build.
    #[error("this program was built without Parquet files: build it with the feature `parquet`")]
    NoParquet,
    /// The content is inconsistent.
    #[error("the document is damaged: {0}")]
    Content(String),
    /// The columns of the rows differ from those already in the file.
    #[error("these rows have the columns {found}, those before them {expected}: write them to a file of their own")]
    OtherColumns {
        /// Headings of the new rows.
        found: String,
        /// Headings of the file.
        expected: String,
    },
}
