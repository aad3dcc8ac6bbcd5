//! How deep brackets may be nested: in a value, and in a text that has not been split into tokens yet.

use crate::base::diagnostics::Diagnostic;
use crate::base::span::Extent;

/// Maximum nesting depth of a value: far more than anyone writes, and small enough for the stack of every later stage.
pub(super) const DEEPEST: u32 = 64;

/// The problem with a value that is nested too deeply, and how to fix it.
pub(crate) const TOO_LARGE: &str = "this expression is too large";
pub(crate) const NAME_PARTS: &str = "name parts of it with `let`";

/// The mistake in a value that is nested too deeply.
pub(super) fn too_large(at: Extent) -> Diagnostic {
    Diagnostic::new(at, TOO_LARGE).with_help(NAME_PARTS)
}

/// Maximum nesting depth of a text. Brackets that belong to no value surround those of a value.
#[cfg(feature = "locations")]
const DEEPEST_TEXT: u32 = 2 * DEEPEST;

/// The line and character, from 0, of the first bracket of a text that is nested too deeply for the lexer and the
/// parser, which descend into brackets on the stack. Comments and strings do not count.
#[cfg(feature = "locations")]
pub(crate) fn too_deep(text: &str) -> Option<(usize, usize)> {
    let (mut depth, mut line, mut column) = (0, 0, 0);
    let mut rest = text;
    while let Some(sign) = rest.chars().next() {
        let length = passed_over(rest).unwrap_or(sign.len_utf8());
        match sign {
            '(' | '[' | '{' if depth == DEEPEST_TEXT => return Some((line, column)),
            '(' | '[' | '{' => depth += 1,
            ')' | ']' | '}' => depth = depth.saturating_sub(1),
            _ => {}
        }
        for passed in rest[..length].chars() {
            (line, column) = match passed {
                '\n' => (line + 1, 0),
                _ => (line, column + 1),
            };
        }
        rest = &rest[length..];
    }
    None
}

/// The length of the comment or string at the start of a text, up to the end of the text if it is not closed.
#[cfg(feature = "locations")]
fn passed_over(text: &str) -> Option<usize> {
    let up_to = |position: Option<usize>| Some(position.unwrap_or(text.len()));
    if text.starts_with("//") {
        return up_to(text.find('\n'));
    }
    if let Some(comment) = text.strip_prefix("/*") {
        return up_to(comment.find("*/").map(|at| at + 4));
    }
    let string = text.strip_prefix('"')?;
    let mut is_escaped = false;
    let end = string.find(|sign| {
        let ends = sign == '"' && !is_escaped;
        is_escaped = sign == '\\' && !is_escaped;
        ends
    });
    up_to(end.map(|at| at + 2))
}

#[cfg(all(test, feature = "locations"))]
mod tests {
    use super::{DEEPEST_TEXT, too_deep};

    #[test]
    fn only_brackets_of_the_language_count() {
        let many = DEEPEST_TEXT as usize;
        let open = "(".repeat(many);
        assert_eq!(too_deep(&open), None);
        assert_eq!(too_deep(&format!("{open}[")), Some((0, many)));
        assert_eq!(too_deep(&format!("µ\n {open}{{")), Some((1, many + 1)));
        assert_eq!(too_deep(&"()".repeat(many + 1)), None);
        for passed in [
            format!("// {open}(\n"),
            format!("/* {open}\n( */"),
            format!("\"{open}\\\"(\""),
            format!("\"\\\\\" // ({open}"),
            format!("/* ({open}"),
        ] {
            assert_eq!(too_deep(&passed), None, "{passed}");
            assert_eq!(too_deep(&format!("({passed})")), None, "{passed}");
        }
        assert_eq!(
            too_deep(&format!("/* x */ // y\n\"\\\\\"{open}(")),
            Some((1, many + 4))
        );
    }
}
