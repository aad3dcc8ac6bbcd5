//! A mistake in a file of any language, in the form that is drawn.

use std::path::PathBuf;

use eigentol_compiler::matrix_market;

/// What is wrong, where, and how to fix it. Lines and characters count from 1.
#[derive(Clone, Debug)]
pub(crate) struct Mistake {
    pub(crate) start: (usize, usize),
    /// One past the last character.
    pub(crate) end: (usize, usize),
    pub(crate) message: String,
    pub(crate) help: Option<String>,
    /// The included file that it is in.
    pub(crate) file: Option<PathBuf>,
}

impl Mistake {
    /// At a byte of a text.
    pub(crate) fn at(text: &str, byte: usize, message: String) -> Self {
        let before = text.get(..byte).unwrap_or_default();
        let column = before.chars().rev().take_while(|letter| *letter != '\n').count() + 1;
        let line = before.matches('\n').count() + 1;
        Self { start: (line, column), end: (line, column + 1), message, help: None, file: None }
    }
}

impl From<&eigentol_interpreter::Mistake> for Mistake {
    fn from(mistake: &eigentol_interpreter::Mistake) -> Self {
        Self {
            start: (mistake.line, mistake.column),
            end: (mistake.end_line, mistake.end_column),
            message: mistake.message.clone(),
            help: mistake.help.clone(),
            file: mistake.file.clone(),
        }
    }
}

impl From<matrix_market::Mistake> for Mistake {
    fn from(matrix_market::Mistake { line, column, message }: matrix_market::Mistake) -> Self {
        Self { start: (line, column), end: (line, column + 1), message, help: None, file: None }
    }
}

impl From<&eigentol_urdf::Mistake> for Mistake {
    fn from(mistake: &eigentol_urdf::Mistake) -> Self {
        let (line, column) = (mistake.line as usize, mistake.column as usize);
        Self {
            start: (line, column),
            end: (line, column + 1),
            message: mistake.reason.to_string(),
            help: Some(mistake.reason.help()),
            file: None,
        }
    }
}
