//! The declaration file.

use std::fs;
use std::io::{self, Read as _};
use std::path::Path;

use eigentol_compiler::include::without_mark;
use eigentol_compiler::mechanics::Limits;
use eigentol_compiler::{Compilation, Mistakes, check_text, compile_text, early_stages_of_text, with_included};

use crate::failure::Failure;
use crate::mistake::Mistake;

/// The text of a declaration.
pub(crate) struct Declaration {
    /// Path as the user wrote it.
    pub(crate) name: String,
    pub(crate) text: String,
}

impl Declaration {
    /// Reads a file of any language as it is, or standard input if the path is `-`.
    pub(crate) fn raw(path: &Path) -> Result<Self, Failure> {
        let failure = |source| Failure::read(path, source);
        if path.as_os_str() == "-" {
            let mut text = String::new();
            io::stdin().read_to_string(&mut text).map_err(failure)?;
            let name = "standard input".to_owned();
            return Ok(Self { name, text: without_mark(text) });
        }
        let text = fs::read_to_string(path).map_err(failure)?;
        Ok(Self { name: path.display().to_string(), text: without_mark(text) })
    }

    /// Reads a declaration with the files that it includes, or standard input if the path is `-`.
    pub(crate) fn read(path: &Path) -> Result<Self, Failure> {
        let mut declaration = Self::raw(path)?;
        if path.as_os_str() == "-" {
            return Ok(declaration);
        }
        match with_included(&declaration.text, path) {
            Ok((text, _)) => {
                declaration.text = text;
                Ok(declaration)
            }
            Err(mistakes) => Err(declaration.mistaken(&mistakes)),
        }
    }

    /// The declaration up to its equations, without kernels.
    pub(crate) fn checked(&self) -> Result<Compilation, Failure> {
        check_text(&self.text, Limits::default()).map_err(|mistakes| self.mistaken(&mistakes))
    }

    /// Compiles the declaration.
    pub(crate) fn compiled(&self) -> Result<Compilation, Failure> {
        compile_text(&self.text, Limits::default()).map_err(|mistakes| self.mistaken(&mistakes))
    }

    /// A stage before the equations as text.
    pub(crate) fn early_stage(&self, wanted: &str) -> Result<String, Failure> {
        let stages = early_stages_of_text(&self.text).map_err(|mistakes| self.mistaken(&mistakes))?;
        let mut stages = stages.into_iter().filter(|(stage, _)| *stage == wanted);
        Ok(stages.next().map_or_else(String::new, |(_, text)| text))
    }

    fn mistaken(&self, mistakes: &Mistakes) -> Failure {
        self.refused(mistakes.iter().map(Mistake::from).collect())
    }

    pub(crate) fn refused(&self, mistakes: Vec<Mistake>) -> Failure {
        Failure::Declaration { name: self.name.clone(), text: self.text.clone(), mistakes }
    }
}
