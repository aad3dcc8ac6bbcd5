//! What a build script calls.

use std::path::{Path, PathBuf};
use std::process;

use crate::error::Error;
use crate::source::{Source, write};

/// Compiles the declaration in a file to `OUT_DIR/name.rs`, `name` being that of the file without its extension.
///
/// Where that fails, cargo is told everything that is wrong, each mistake with file, line and column, and the build script
/// ends with exit code 1.
pub fn compile(path: impl AsRef<Path>) {
    or_end(try_compile(path));
}

/// [`compile`] that leaves it to the caller what to do about errors; the file that was written.
///
/// # Errors
/// All mistakes of the declaration, or the file that cannot be read or written.
pub fn try_compile(path: impl AsRef<Path>) -> Result<PathBuf, Error> {
    rerun_if_changed(path.as_ref());
    let source = Source::read(path.as_ref())?;
    let code = source.output("rs");
    write(&code, &source.compilation.emit().to_string())?;
    Ok(code)
}

/// [`compile`] with a function for C for each kernel, declared in `header`.
///
/// The header is written where it does not say that already. Its path is relative to the folder of Cargo.toml.
#[cfg(feature = "c")]
pub fn compile_for_c(path: impl AsRef<Path>, header: impl AsRef<Path>) {
    or_end(try_compile_for_c(path, header));
}

/// [`compile_for_c`] that leaves it to the caller what to do about errors; the Rust file that was written.
///
/// # Errors
/// All mistakes of the declaration, or the file that cannot be read or written.
#[cfg(feature = "c")]
pub fn try_compile_for_c(
    path: impl AsRef<Path>,
    header: impl AsRef<Path>,
) -> Result<PathBuf, Error> {
    rerun_if_changed(path.as_ref());
    rerun_if_changed(header.as_ref());
    let source = Source::read(path.as_ref())?;
    let Some(interface) = crate::c::Interface::of(&source.compilation) else {
        return Err(unspeakable(source));
    };
    // cbindgen reads files only.
    let functions = source.output("c.rs");
    write(&functions, &interface.items)?;
    write(
        header.as_ref(),
        &interface.header(&source.path, &functions)?,
    )?;
    let code = source.output("rs");
    let items = source.compilation.emit();
    write(&code, &format!("{items}\n\n{}", interface.module()))?;
    Ok(code)
}

/// The error for a name that C cannot spell.
#[cfg(feature = "c")]
fn unspeakable(source: Source) -> Error {
    let name = source.compilation.mechanism.name;
    let start = name.span().start();
    Error::Name {
        path: source.path,
        line: start.line,
        column: start.column + 1,
        name: name.to_string(),
    }
}

fn rerun_if_changed(path: &Path) {
    println!("cargo::rerun-if-changed={}", path.display());
}

fn or_end(result: Result<PathBuf, Error>) {
    if let Err(error) = result {
        for line in error.to_string().lines() {
            println!("cargo::error={line}");
        }
        process::exit(1);
    }
}
