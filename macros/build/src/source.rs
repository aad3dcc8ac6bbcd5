//! A declaration in a file.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};

use eigentol_compiler::mechanics::Limits;
use eigentol_compiler::{Compilation, compile_text, with_included};

use crate::error::Error;

/// A declaration and the destination of its code.
pub(crate) struct Source {
    /// The file as the user named it.
    pub(crate) path: PathBuf,
    /// The declaration at every stage.
    pub(crate) compilation: Compilation,
    /// The output folder that cargo provides for a build script.
    directory: PathBuf,
}

impl Source {
    pub(crate) fn read(path: &Path) -> Result<Self, Error> {
        let path = path.to_owned();
        let directory = env::var_os("OUT_DIR").ok_or(Error::NoDirectory)?.into();
        if path.file_stem().is_none() {
            return Err(Error::NoFile(path));
        }
        let text = match fs::read_to_string(&path) {
            Ok(text) => text,
            Err(source) => return Err(Error::Read { path, source }),
        };
        let read = with_included(&text, &path);
        match read.and_then(|(text, files)| Ok((compile_text(&text, Limits::default())?, files))) {
            Ok((compilation, files)) => {
                files.iter().for_each(|file| rerun_if_changed(file));
                Ok(Self { path, compilation, directory })
            }
            Err(mistakes) => Err(Error::Mistakes { path, mistakes }),
        }
    }

    /// The path of an output file for this declaration.
    pub(crate) fn output(&self, extension: &str) -> PathBuf {
        let name = self.path.file_stem().unwrap_or_default();
        self.directory.join(name).with_extension(extension)
    }
}

pub(crate) fn rerun_if_changed(path: &Path) {
    println!("cargo::rerun-if-changed={}", path.display());
}

/// Writes a file and creates its folders, unless it already has this content: unchanged files need no rebuild.
pub(crate) fn write(path: &Path, text: &str) -> Result<(), Error> {
    if fs::read_to_string(path).is_ok_and(|there| there == text) {
        return Ok(());
    }
    let folder = path.parent().map_or(Ok(()), fs::create_dir_all);
    folder.and_then(|()| fs::write(path, text)).map_err(|source| Error::Write { path: path.to_owned(), source })
}
