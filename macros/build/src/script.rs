//! The functions that a build script calls.

use std::path::{Path, PathBuf};
use std::process;

use crate::error::Error;
use crate::source::{Source, rerun_if_changed, write};

/// Compiles the declaration in a file to `OUT_DIR/name.rs`, where `name` is the file's name without its extension.
///
/// On failure, all mistakes are printed with file, line and column, and the build script ends with exit code 1.
pub fn compile(path: impl AsRef<Path>) {
    or_end(try_compile(path));
}

/// Like [`compile`], but returns errors to the caller; on success, returns the path of the written file.
///
/// # Errors
/// All mistakes of the declaration, or the file that cannot be read or written.
pub fn try_compile(path: impl AsRef<Path>) -> Result<PathBuf, Error> {
    rerun_if_changed(path.as_ref());
    let source = Source::read(path.as_ref())?;
    let code = source.output("rs");
    write(&code, &source.compilation.emit_text())?;
    Ok(code)
}

/// Like [`compile`], but also generates a C function for each kernel, declared in `header`.
///
/// The header is written only if its contents change. Its path is relative to the folder of Cargo.toml.
#[cfg(feature = "c")]
pub fn compile_for_c(path: impl AsRef<Path>, header: impl AsRef<Path>) {
    or_end(try_compile_for_c(path, header));
}

/// Like [`compile_for_c`], but returns errors to the caller; on success, returns the path of the written Rust file.
///
/// # Errors
/// All mistakes of the declaration, or the file that cannot be read or written.
#[cfg(feature = "c")]
pub fn try_compile_for_c(path: impl AsRef<Path>, header: impl AsRef<Path>) -> Result<PathBuf, Error> {
    rerun_if_changed(path.as_ref());
    rerun_if_changed(header.as_ref());
    let source = Source::read(path.as_ref())?;
    let Some(interface) = crate::c::Interface::of(&source.compilation) else {
        return Err(unspeakable(source));
    };
    // cbindgen reads only files.
    let functions = source.output("c.rs");
    write(&functions, &interface.items)?;
    write(header.as_ref(), &interface.header(&source.path, &functions)?)?;
    let code = source.output("rs");
    let items = source.compilation.emit_text();
    write(&code, &format!("{items}\n{}", interface.module()))?;
    Ok(code)
}

/// The error for a name that C cannot spell.
#[cfg(feature = "c")]
fn unspeakable(source: Source) -> Error {
    let name = source.compilation.mechanism.name;
    let start = name.span().start();
    Error::Name { path: source.path, line: start.line, column: start.column + 1, name: name.to_string() }
}

fn or_end(result: Result<PathBuf, Error>) {
    if let Err(error) = result {
        for line in error.to_string().lines() {
            println!("cargo::error={line}");
        }
        process::exit(1);
    }
}
