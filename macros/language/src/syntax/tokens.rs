//! A token reader that remembers the last token, so that an error can point behind it and parsing can continue
//! afterwards; syn's own stream does not allow this.

use proc_macro2::{Delimiter, Ident, Literal, Span};
use quote::ToTokens as _;
use syn::buffer::Cursor;

use super::scope::Scope;
use crate::base::diagnostics::Diagnostic;
use crate::base::span::Extent;

/// The result of parsing; the error is boxed to keep the success case small.
pub(super) type Parsed<T> = Result<T, Box<Diagnostic>>;

/// A mistake instead of what was to be read.
pub(super) fn mistake<T>(at: impl Into<Extent>, message: impl Into<String>) -> Parsed<T> {
    Err(Box::new(Diagnostic::new(at, message)))
}

/// [`mistake`] with advice on how to fix it.
pub(super) fn mistake_with_help<T>(
    at: impl Into<Extent>,
    message: impl Into<String>,
    help: impl Into<String>,
) -> Parsed<T> {
    Err(Box::new(Diagnostic::new(at, message).with_help(help)))
}

/// Adds advice to a mistake.
pub(super) fn helped(help: &str) -> impl Fn(Box<Diagnostic>) -> Box<Diagnostic> + Copy {
    move |error| Box::new(error.with_help(help))
}

/// A position in a list of tokens.
#[derive(Clone, Copy)]
pub(super) struct Tokens<'a> {
    pub(super) cursor: Cursor<'a>,
    /// The token read last; the opening delimiter at the start of a group.
    pub(super) last: Span,
    /// The closing delimiter, where an error about a missing token points.
    end: Option<Span>,
    /// Words that may follow a number here and are therefore not units.
    pub(super) no_units: &'static [&'static str],
    /// The place in an array of what is declared: the index in place of a range.
    pub(super) element: Option<u32>,
    /// What names mean here.
    pub(super) scope: &'a Scope<'a>,
}

impl<'a> Tokens<'a> {
    /// The whole input of the macro.
    pub(super) fn top(cursor: Cursor<'a>, scope: &'a Scope<'a>) -> Self {
        Self { cursor, last: cursor.span(), end: None, no_units: &[], element: None, scope }
    }

    /// The same tokens in another scope.
    pub(super) fn within<'b>(self, scope: &'b Scope<'b>) -> Tokens<'b>
    where
        'a: 'b,
    {
        Tokens { scope, ..self }
    }

    /// The content of a part, in another scope.
    pub(super) fn content((cursor, end): (Cursor<'a>, Span), scope: &'a Scope<'a>) -> Self {
        Self { end: Some(end), ..Self::top(cursor, scope) }
    }

    /// Whether nothing is left.
    pub(super) fn is_empty(&self) -> bool {
        // An empty group without delimiters, left by a macro, also counts as nothing.
        self.peek_ident().is_none()
            && self.cursor.punct().is_none()
            && self.cursor.literal().is_none()
            && self.cursor.token_tree().is_none()
    }

    /// The next token, or the closing delimiter.
    pub(super) fn span(&self) -> Span {
        if self.cursor.eof() { self.end.unwrap_or(self.last) } else { self.cursor.span() }
    }

    /// An error at the next token, where something else was expected.
    pub(super) fn expected<T>(&self, what: &str) -> Parsed<T> {
        let message = match self.describe_next() {
            Some(text) => format!("expected {what}, found `{text}`"),
            None => format!("expected {what}"),
        };
        mistake(self.span(), message)
    }

    fn describe_next(&self) -> Option<String> {
        let opening = [(Delimiter::Parenthesis, "("), (Delimiter::Bracket, "["), (Delimiter::Brace, "{")];
        for (delimiter, sign) in opening {
            if self.cursor.group(delimiter).is_some() {
                return Some(sign.to_string());
            }
        }
        if let Some((lifetime, _)) = self.cursor.lifetime() {
            return Some(lifetime.to_string());
        }
        let (token, _) = self.cursor.token_tree()?;
        Some(token.to_string())
    }

    pub(super) fn peek_ident(&self) -> Option<Ident> {
        self.cursor.ident().map(|(ident, _)| ident)
    }

    pub(super) fn peek_word(&self, word: &str) -> bool {
        self.peek_ident().is_some_and(|ident| ident == word)
    }

    pub(super) fn peek_sign(&self, sign: char) -> bool {
        self.cursor.punct().is_some_and(|(punct, _)| punct.as_char() == sign)
    }

    /// Whether the next three signs are `+/-`.
    pub(super) fn peek_plus_minus(&self) -> bool {
        let mut copy = *self;
        ['+', '/', '-'].into_iter().all(|sign| copy.sign(sign).is_some())
    }

    /// Whether `->` is next.
    pub(super) fn peek_arrow(&self) -> bool {
        let mut copy = *self;
        copy.sign('-').is_some() && copy.sign('>').is_some()
    }

    /// Whether `..` is next.
    pub(super) fn peek_range(&self) -> bool {
        let mut copy = *self;
        copy.sign('.').is_some() && copy.sign('.').is_some()
    }

    /// Whether a name and a colon are next.
    pub(super) fn peek_named(&self) -> bool {
        let mut ahead = *self;
        ahead.ident().is_some() && ahead.peek_sign(':')
    }

    /// Whether a sign and a shape with named arguments are next: the next term of a body, not of a sum.
    /// Whether a word with parentheses follows.
    pub(super) fn peek_call(&self) -> bool {
        let mut ahead = *self;
        ahead.ident().is_some() && ahead.group(Delimiter::Parenthesis).is_some()
    }

    pub(super) fn peek_shape(&self) -> bool {
        let mut ahead = *self;
        (ahead.sign('+').is_some() || ahead.sign('-').is_some())
            && ahead.ident().is_some()
            && ahead.group(Delimiter::Parenthesis).is_some_and(|(_, content, _)| content.peek_named())
    }

    pub(super) fn ident(&mut self) -> Option<Ident> {
        let (ident, rest) = self.cursor.ident()?;
        self.cursor = rest;
        self.last = ident.span();
        Some(ident)
    }

    pub(super) fn literal(&mut self) -> Option<Literal> {
        let (literal, rest) = self.cursor.literal()?;
        self.cursor = rest;
        self.last = literal.span();
        Some(literal)
    }

    /// Reads `sign` if it is next.
    pub(super) fn sign(&mut self, sign: char) -> Option<Extent> {
        let (punct, rest) = self.cursor.punct()?;
        if punct.as_char() != sign {
            return None;
        }
        self.cursor = rest;
        self.last = punct.span();
        Some(punct.span().into())
    }

    /// Reads `word` if it is next.
    pub(super) fn word(&mut self, word: &str) -> Option<Extent> {
        if !self.peek_word(word) {
            return None;
        }
        self.ident().map(|ident| ident.span().into())
    }

    /// Enters a group if one is next; returns its opening delimiter, its content and its closing delimiter.
    pub(super) fn group(&mut self, delimiter: Delimiter) -> Option<(Span, Tokens<'a>, Span)> {
        let (content, span, rest) = self.cursor.group(delimiter)?;
        self.cursor = rest;
        self.last = span.close();
        let content = Tokens { last: span.open(), ..Tokens::content((content, span.close()), self.scope) };
        Some((span.open(), content, span.close()))
    }

    /// The expansion of a `macro_rules!` fragment such as `$v:expr`, if it is more than one token: it belongs together
    /// although it has no visible parentheses.
    pub(super) fn fragment(&mut self) -> Option<(Span, Tokens<'a>, Span)> {
        let (content, ..) = self.cursor.group(Delimiter::None)?;
        let (_, rest) = content.token_tree()?;
        if rest.eof() { None } else { self.group(Delimiter::None) }
    }

    pub(super) fn expect_sign(&mut self, sign: char, what: &str) -> Parsed<Extent> {
        match self.sign(sign) {
            Some(extent) => Ok(extent),
            None => self.expected(what),
        }
    }

    pub(super) fn expect_word(&mut self, word: &str) -> Parsed<Extent> {
        match self.word(word) {
            Some(extent) => Ok(extent),
            None => self.expected(&format!("`{word}`")),
        }
    }

    /// Whether a comma and a number are next: outside a list, this is a decimal comma.
    pub(super) fn peek_decimal_comma(&self) -> bool {
        let mut ahead = *self;
        ahead.sign(',').is_some() && ahead.literal().is_some()
    }

    /// Reads a name that can be declared or referred to.
    pub(super) fn name(&mut self, what: &str) -> Parsed<Ident> {
        let Some(ident) = self.peek_ident() else {
            return self.expected(what);
        };
        let text = ident.to_string();
        let is_free = syn::parse2::<Ident>(ident.to_token_stream()).is_ok();
        // This keyword of edition 2024 is still a name for syn.
        if !is_free || text.starts_with("r#") || text == "gen" {
            let message = format!("`{text}` cannot be a name: Rust reserves it");
            return mistake(&ident, message);
        }
        self.ident();
        Ok(ident)
    }

    /// Skips one token or group.
    pub(super) fn skip(&mut self) {
        if let Some((token, rest)) = self.cursor.token_tree() {
            self.cursor = rest;
            self.last = token.span();
        }
    }
}
