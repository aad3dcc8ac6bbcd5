//! Mistakes in a text, with their positions.

use std::fmt;
use std::path::Path;

use proc_macro2::{LexError, Span, TokenStream};

use crate::base::diagnostics::Diagnostics;
use crate::syntax::nesting::{NAME_PARTS, TOO_LARGE, too_deep};

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
    if let Some((line, column)) = too_deep(text.trim_start_matches(BYTE_ORDER_MARK)) {
        return Err(Mistakes(vec![Mistake {
            line: line + 1,
            column: column + 1,
            end_line: line + 1,
            end_column: column + 2,
            message: TOO_LARGE.to_owned(),
            help: Some(NAME_PARTS.to_owned()),
        }]));
    }
    text.parse().map_err(|error: LexError| {
        let span = error.span();
        let start = span.start();
        let mut lines = text.trim_start_matches(BYTE_ORDER_MARK).lines();
        let line = lines.nth(start.line.saturating_sub(1));
        let sign = line.and_then(|line| line.chars().nth(start.column));
        let (message, help) = unreadable(sign);
        Mistakes(vec![mistake((span, span), message, Some(help))])
    })
}

const BYTE_ORDER_MARK: char = '\u{feff}';

/// Signs used in drawings and word processors, and what to write instead.
const SIGNS: [(&str, &str); 8] = [
    ("±", "+/-"),
    ("°", "deg"),
    ("–—−‒", "-"),
    ("×⋅∙•", "*"),
    ("÷", "/"),
    ("²", "^2"),
    ("³", "^3"),
    ("⁻¹", "^-1"),
];

/// The problem with a text that cannot be split into tokens from this sign on, and how to fix it.
fn unreadable(sign: Option<char>) -> (String, String) {
    let pairs = "brackets and quotes come in pairs".to_owned();
    let Some(sign) = sign else {
        return ("this text ends too early".to_owned(), pairs);
    };
    let instead = SIGNS.iter().find(|(signs, _)| signs.contains(sign));
    match (sign, instead) {
        (_, Some((_, instead))) => (
            format!("`{sign}` has no meaning here"),
            format!("write `{instead}`"),
        ),
        ('(' | '[' | '{', _) => (format!("this `{sign}` is never closed"), pairs),
        (')' | ']' | '}', _) => (format!("this `{sign}` closes nothing"), pairs),
        _ => (format!("`{sign}` has no meaning here"), pairs),
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

pub(crate) fn mistake(
    (first, last): (Span, Span),
    message: String,
    help: Option<String>,
) -> Mistake {
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
