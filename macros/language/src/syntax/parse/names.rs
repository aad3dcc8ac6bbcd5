//! Names that an item declares.

use proc_macro2::Ident;

use super::super::tokens::{Parsed, Tokens};
use super::words::KEYWORDS;
use crate::base::diagnostics::Diagnostic;
use crate::base::span::Extent;

/// Reads the name of an item.
pub(super) fn declared_name(tokens: &mut Tokens) -> Parsed<Ident> {
    if let Some(keyword) = tokens.peek_ident()
        && KEYWORDS.iter().any(|word| keyword == word)
    {
        let message = format!("`{keyword}` cannot be a name: it starts an item");
        return Err(Box::new(Diagnostic::new(&keyword, message)));
    }
    let name = tokens.name("a name")?;
    let mut ahead = *tokens;
    if ahead.sign('-').is_some()
        && let Some(rest) = ahead.ident()
    {
        let message = "a name cannot contain `-`";
        let diagnostic =
            Diagnostic::new(Extent::from(&name).to(&rest), message).with_help(format!("write `{name}_{rest}`"));
        return Err(Box::new(diagnostic));
    }
    Ok(name)
}

/// Reads a colon.
pub(super) fn colon(tokens: &mut Tokens) -> Parsed<Extent> {
    tokens.expect_sign(':', "`:`")
}
