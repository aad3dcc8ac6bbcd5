//! The file with a declaration.

use std::fs;
use std::io::{self, Read as _};
use std::path::Path;

use eigentol_interpreter::{Interpreted, Mistakes};

use crate::failure::Failure;
use crate::mistake::Mistake;

/// A declaration as it was read.
pub(crate) struct Declaration {
    /// Path as the user wrote it.
    pub(crate) name: String,
    pub(crate) text: String,
}

impl Declaration {
    /// Reads a file, or standard input where the path is `-`.
    pub(crate) fn read(path: &Path) -> Result<Self, Failure> {
        let failure = |source| Failure::read(path, source);
        if path.as_os_str() == "-" {
            let mut text = String::new();
            io::stdin().read_to_string(&mut text).map_err(failure)?;
            let name = "standard input".to_owned();
            return Ok(Self { name, text });
        }
        let text = fs::read_to_string(path).map_err(failure)?;
        let name = path.display().to_string();
        Ok(Self { name, text })
    }

    /// The mechanism that it declares.
    pub(crate) fn mechanism(&self) -> Result<Interpreted, Failure> {
        Interpreted::from_text(&self.text).map_err(|mistakes| self.not_compiled(&mistakes))
    }

    /// The compiler refuses it.
    pub(crate) fn not_compiled(&self, mistakes: &Mistakes) -> Failure {
        self.refused(mistakes.iter().map(Mistake::from).collect())
    }

    pub(crate) fn refused(&self, mistakes: Vec<Mistake>) -> Failure {
        Failure::Declaration {
            name: self.name.clone(),
            text: self.text.clone(),
            mistakes,
        }
    }
}
