//! What is wrong with a text, and where.

use std::fmt;
use std::path::Path;

use proc_macro2::{LexError, Span};

use crate::base::diagnostics::Diagnostics;

/// One mistake in a declaration.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Mistake {
    /// Line, from 1.
    pub line: usize,
    /// Column of its first character, from 1.
    pub column: usize,
    /// Line of its end.
    pub end_line: usize,
    /// Column behind its last character.
    pub end_column: usize,
    /// What is wrong.
    pub message: String,
    /// What to do.
    pub help: Option<String>,
}

impl fmt::Display for Mistake {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}: {}", self.line, self.column, self.message)?;
        match &self.help {
            Some(help) => write!(f, "\nhelp: {help}"),
            None => Ok(()),
        }
    }
}

/// All mistakes of a declaration, in the order in which they were found; there is at least one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mistakes(Vec<Mistake>);

impl Mistakes {
    /// The mistakes.
    pub fn iter(&self) -> std::slice::Iter<'_, Mistake> {
        self.0.iter()
    }

    /// `file:line:column: message`, for each mistake.
    pub fn of_file(&self, path: &Path) -> String {
        let lines: Vec<String> = self
            .iter()
            .map(|mistake| format!("{}:{mistake}", path.display()))
            .collect();
        lines.join("\n")
    }
}

impl fmt::Display for Mistakes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (k, mistake) in self.0.iter().enumerate() {
            if k > 0 {
                writeln!(f)?;
            }
            mistake.fmt(f)?;
        }
        Ok(())
    }
}

impl std::error::Error for Mistakes {}

impl From<LexError> for Mistakes {
    fn from(error: LexError) -> Self {
        let span = error.span();
        let help = "brackets and quotes come in pairs".to_owned();
        Self(vec![mistake(
            (span, span),
            "this is not a sequence of words, numbers and brackets".to_owned(),
            Some(help),
        )])
    }
}

impl From<Diagnostics> for Mistakes {
    fn from(diagnostics: Diagnostics) -> Self {
        let mistakes = diagnostics.iter().map(|one| {
            let ends = (one.span.first, one.span.last);
            mistake(ends, one.message.clone(), one.help.clone())
        });
        Self(mistakes.collect())
    }
}

fn mistake((first, last): (Span, Span), message: String, help: Option<String>) -> Mistake {
    let (start, end) = (first.start(), last.end());
    Mistake {
        line: start.line,
        column: start.column + 1,
        end_line: end.line,
        end_column: end.column + 1,
        message,
        help,
    }
}
