//! Errors of a build script.

use std::io;
use std::path::PathBuf;

use eigentol_compiler::Mistakes;
use thiserror::Error;

/// Reasons why no code was generated.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Error {
    /// Cargo has not set the output folder.
    #[error("the environment variable OUT_DIR is not set; call this from a build script, which cargo runs with it")]
    NoDirectory,
    /// A path that does not name a file.
    #[error("`{}` is not the path of a file; give that of a declaration, for example `rotor.mechanism`", .0.display())]
    NoFile(PathBuf),
    /// A file cannot be read.
    #[error("cannot read {}: {source}; the path is relative to the folder of Cargo.toml", .path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// The cause.
        source: io::Error,
    },
    /// A file cannot be written.
    #[error("cannot write {}: {source}", .path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// The cause.
        source: io::Error,
    },
    /// The file does not declare a valid mechanism.
    #[error("{}", .mistakes.of_file(.path))]
    Mistakes {
        /// The file.
        path: PathBuf,
        /// All mistakes in the file.
        mistakes: Mistakes,
    },
    /// C cannot spell the name of the mechanism, which precedes the names of its functions.
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
    /// cbindgen did not write a header.
    #[error("no header for {}: {reason}", .path.display())]
    Header {
        /// The declaration.
        path: PathBuf,
        /// The message of cbindgen.
        reason: String,
    },
}
