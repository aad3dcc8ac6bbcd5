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
