//! Names of files in quotes, and tokens from elsewhere.

use proc_macro2::{Group, Literal, Span, TokenStream, TokenTree};

pub(crate) const BYTE_ORDER_MARK: char = '\u{feff}';

/// The text of a file, without the mark that spreadsheets and editors put before it.
pub fn without_mark(text: String) -> String {
    text.strip_prefix(BYTE_ORDER_MARK).map(str::to_owned).unwrap_or(text)
}

/// How the names of files end that are read: tables and matrices.
pub(crate) const DATA: [&str; 2] = ["csv", "mtx"];

/// The text in quotes.
pub(crate) fn quoted(literal: &Literal) -> Option<String> {
    match syn::Lit::new(literal.clone()) {
        syn::Lit::Str(text) => Some(text.value()),
        _ => None,
    }
}

/// The name of a file among values.
pub(crate) fn file_name(literal: &Literal) -> Option<String> {
    quoted(literal).filter(|name| ending(name).is_some() && !name.contains(char::is_whitespace))
}

/// How the name of a file ends, in small letters.
pub(crate) fn ending(name: &str) -> Option<String> {
    let (_, ending) = name.rsplit_once('.')?;
    let is_word = ending.starts_with(|letter: char| letter.is_ascii_alphabetic());
    (is_word && ending.len() <= 4).then(|| ending.to_ascii_lowercase())
}

/// Tokens at another place.
pub(crate) fn placed(tokens: TokenStream, at: Span) -> TokenStream {
    let place = |mut token: TokenTree| {
        if let TokenTree::Group(group) = &token {
            token = Group::new(group.delimiter(), placed(group.stream(), at)).into();
        }
        token.set_span(at);
        token
    };
    tokens.into_iter().map(place).collect()
}
