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

/// What is wrong with the brackets of a text, at a line and a character, from 0: the first that is nested too deeply
/// for the lexer and the parser, which descend into brackets on the stack; and the first without a partner, which the
/// lexer notices only where the text around it ends, or a comment or string without an end. Comments and strings do
/// not count.
#[cfg(feature = "locations")]
pub(crate) fn brackets(text: &str) -> (Option<Place>, Option<(Place, String)>) {
    let (mut too_deep, mut unpaired) = (None, None);
    let mut lacks = |at, sign: &str, what| {
        unpaired.get_or_insert_with(|| (at, format!("this `{sign}` {what}")));
    };
    let (mut open, mut line, mut column) = (Vec::<(Place, &str)>::new(), 0, 0);
    let mut rest = text;
    while let Some(sign) = rest.chars().next() {
        let length = passed_over(rest).unwrap_or(sign.len_utf8());
        let (here, text) = ((line, column), &rest[..sign.len_utf8()]);
        if length > rest.len() {
            let start = if sign == '"' { text } else { "/*" };
            lacks(here, start, NEVER_CLOSED);
        } else if "([{".contains(sign) {
            if open.len() == DEEPEST_TEXT as usize {
                too_deep.get_or_insert(here);
            }
            open.push((here, text));
        } else if ")]}".contains(sign) {
            let partner = |opening: &str| ["()", "[]", "{}"].contains(&&*format!("{opening}{sign}"));
            match open.pop() {
                Some((_, opening)) if partner(opening) => {}
                Some((at, opening)) if open.iter().any(|x| partner(x.1)) => {
                    lacks(at, opening, NEVER_CLOSED);
                }
                _ => lacks(here, text, "closes nothing"),
            }
        }
        let length = length.min(rest.len());
        for passed in rest[..length].chars() {
            (line, column) = match passed {
                '\n' => (line + 1, 0),
                _ => (line, column + 1),
            };
        }
        rest = &rest[length..];
    }
    if let Some((at, opening)) = open.pop() {
        lacks(at, opening, NEVER_CLOSED);
    }
    (too_deep, unpaired)
}

/// A line and a character.
#[cfg(feature = "locations")]
type Place = (usize, usize);

#[cfg(feature = "locations")]
const NEVER_CLOSED: &str = "is never closed";

/// The length of the comment or string at the start of a text; more than that of the text if it is not closed.
#[cfg(feature = "locations")]
fn passed_over(text: &str) -> Option<usize> {
    if text.starts_with("//") {
        return Some(text.find('\n').unwrap_or(text.len()));
    }
    let up_to = |position: Option<usize>| Some(position.unwrap_or(text.len() + 1));
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
    use super::{DEEPEST_TEXT, brackets};

    fn too_deep(text: &str) -> Option<(usize, usize)> {
        brackets(text).0
    }

    #[test]
    fn what_has_no_partner_is_found_where_it_stands() {
        for (text, expected) in [
            ("{ (a) [b] }", None),
            ("{ disk(a;\n}", Some(((0, 6), "this `(` is never closed"))),
            ("{ disk(a));\n}", Some(((0, 9), "this `)` closes nothing"))),
            ("{ a;", Some(((0, 0), "this `{` is never closed"))),
            ("{ }\n /* a }", Some(((1, 1), "this `/*` is never closed"))),
            ("{ \"a }", Some(((0, 2), "this `\"` is never closed"))),
            ("{ ([a) }", Some(((0, 3), "this `[` is never closed"))),
            ("// ( \n", None),
        ] {
            let expected = expected.map(|(at, what)| (at, what.to_owned()));
            assert_eq!(brackets(text).1, expected, "{text}");
        }
    }

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
        assert_eq!(too_deep(&format!("/* x */ // y\n\"\\\\\"{open}(")), Some((1, many + 4)));
    }
}
