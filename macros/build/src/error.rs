//! Why a build script fails.

use std::io;
use std::path::PathBuf;

use eigentol_compiler::Mistakes;
use thiserror::Error;

/// Why there is no code.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Error {
    /// Cargo has not said where to.
    #[error(
        "the environment variable OUT_DIR is not set; call this from a build script, which cargo runs with it"
    )]
    NoDirectory,
    /// A path without the name of a file.
    #[error("`{}` is not the path of a file; give that of a declaration, for example `rotor.mechanism`", .0.display())]
    NoFile(PathBuf),
    /// A file cannot be read.
    #[error("cannot read {}: {source}; the path is relative to the folder of Cargo.toml", .path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// A file cannot be written.
    #[error("cannot write {}: {source}", .path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// What the file declares is no mechanism.
    #[error("{}", .mistakes.of_file(.path))]
    Mistakes {
        /// The file.
        path: PathBuf,
        /// Everything that is wrong with it.
        mistakes: Mistakes,
    },
    /// The name of the mechanism, which stands before the names of its functions for C.
    #[error(
        "{}:{line}:{column}: `{name}` cannot be spelt in C\nhelp: a name for C begins with a letter and has letters and digits of ASCII", .path.display()
    )]
    Name {
        /// The declaration.
        path: PathBuf,
        /// Line, from 1.
        line: usize,
        /// Column, from 1.
        column: usize,
        /// The name.
        name: String,
    },
    /// cbindgen wrote no header.
    #[error("no header for {}: {reason}", .path.display())]
    Header {
        /// The declaration.
        path: PathBuf,
        /// What cbindgen says.
        reason: String,
    },
}
