//! Mistakes in a text, with their positions.

use std::fmt;
use std::path::{Path, PathBuf};

use proc_macro2::{LexError, Span, TokenStream};

use crate::base::diagnostics::Diagnostics;
use crate::base::names::written;
use crate::base::quoted::BYTE_ORDER_MARK;
use crate::syntax::nesting::{NAME_PARTS, TOO_LARGE, brackets};

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
    /// Column after its last character.
    pub end_column: usize,
    /// The problem.
    pub message: String,
    /// How to fix it.
    pub help: Option<String>,
    /// The file that it is in, if the declaration includes that file.
    pub file: Option<PathBuf>,
}

impl fmt::Display for Mistake {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(file) = &self.file {
            write!(f, "{}:", file.display())?;
        }
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

    /// The mistakes in a text, each in the file that it is in, if the text includes others.
    pub fn of(diagnostics: &Diagnostics, text: &str) -> Self {
        let files = starts(text);
        let line = |line| match file_of(&files, line) {
            Some((file, line)) => format!("{file}:{line}"),
            None => line.to_string(),
        };
        let mistakes = diagnostics.iter().map(|one| {
            let ends = (one.span.first, one.span.last);
            let mut mistake = mistake(ends, one.message.clone(), one.help_and_use(line));
            if let Some((file, line)) = file_of(&files, mistake.line) {
                mistake.end_line -= mistake.line - line;
                mistake.line = line;
                mistake.file = Some(file.into());
            }
            mistake
        });
        Self(mistakes.collect())
    }

    /// The same in an included file.
    pub(crate) fn with_file(mut self, file: &Path) -> Self {
        self.0.iter_mut().for_each(|mistake| mistake.file = Some(file.to_owned()));
        self
    }

    /// `file:line:column: message`, for each mistake.
    pub fn of_file(&self, path: &Path) -> String {
        let line = |mistake: &Mistake| {
            let path = mistake.file.as_deref().unwrap_or(path);
            format!("{}:{}", path.display(), Mistake { file: None, ..mistake.clone() })
        };
        let lines: Vec<String> = self.iter().map(line).collect();
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

/// The tokens of a text.
///
/// ```
/// use eigentol_language::mistakes::tokens;
///
/// assert!(tokens("3 kg +/- 5%").is_ok());
/// let error = tokens("3 kg ± 5%").unwrap_err().to_string();
/// assert_eq!(error, "1:6: `±` has no meaning here\nhelp: write `+/-`");
/// ```
///
/// # Errors
/// If the text contains a sign that has no meaning in a declaration, an unpaired bracket or quote, or brackets in
/// brackets beyond any use.
pub fn tokens(text: &str) -> Result<TokenStream, Mistakes> {
    let readable = text.trim_start_matches(BYTE_ORDER_MARK);
    let at = |(line, column): (usize, usize), message: String, help: String| {
        Mistakes(vec![Mistake {
            line: line + 1,
            column: column + 1,
            end_line: line + 1,
            end_column: column + 2,
            message,
            help: Some(help),
            file: None,
        }])
    };
    let (too_deep, unpaired) = brackets(readable);
    if let Some(place) = too_deep {
        return Err(at(place, TOO_LARGE.to_owned(), NAME_PARTS.to_owned()));
    }
    text.parse().map_err(|error: LexError| {
        let start = error.span().start();
        let place = (start.line.saturating_sub(1), start.column);
        let line = readable.lines().nth(place.0);
        let sign = line.and_then(|line| line.chars().nth(place.1));
        let sign = sign.unwrap_or(' ');
        let instead = SIGNS.iter().find(|(signs, _)| signs.contains(sign));
        match (instead, unpaired) {
            (None, Some((place, message))) => at(place, message, PAIRS.to_owned()),
            (instead, _) => {
                let help = instead.map_or(PAIRS.to_owned(), |(_, x)| format!("write `{x}`"));
                at(place, format!("`{sign}` has no meaning here"), help)
            }
        }
    })
}

const PAIRS: &str = "brackets and quotes come in pairs";

/// Signs used in drawings and word processors, and what to write instead.
const SIGNS: [(&str, &str); 8] =
    [("±", "+/-"), ("°", "deg"), ("–—−‒", "-"), ("×⋅∙•", "*"), ("÷", "/"), ("²", "^2"), ("³", "^3"), ("⁻¹", "^-1")];

impl From<Diagnostics> for Mistakes {
    fn from(diagnostics: Diagnostics) -> Self {
        Self::of(&diagnostics, "")
    }
}

/// Text before the name of an included file, on a line of its own before its content.
pub(crate) const START: &str = "// included: ";

/// The included files in a text, each with the line before it.
fn starts(text: &str) -> Vec<(usize, &str)> {
    let lines = text.lines().enumerate();
    lines.filter_map(|(k, line)| Some((k + 1, line.strip_prefix(START)?))).collect()
}

/// The included file that a line of a text is of, and its line there.
fn file_of<'t>(files: &[(usize, &'t str)], line: usize) -> Option<(&'t str, usize)> {
    let (start, file) = files.iter().rev().find(|(start, _)| *start < line)?;
    Some((file, line - start))
}

pub(crate) fn mistake((first, last): (Span, Span), message: String, help: Option<String>) -> Mistake {
    let (start, end) = (first.start(), last.end());
    Mistake {
        line: start.line,
        column: start.column + 1,
        end_line: end.line,
        end_column: end.column + 1,
        message: written(&message).into_owned(),
        help,
        file: None,
    }
}
