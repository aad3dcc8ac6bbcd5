//! Positions in the user's source: every message points at tokens that the user typed.

use proc_macro2::{Ident, Span};

/// A run of tokens. Stable compilers cannot join two spans into one, so both ends are kept.
///
/// Two extents are always equal: position does not distinguish declarations, so that trees can be compared.
#[derive(Clone, Copy, Debug)]
pub struct Extent {
    /// The first token.
    pub first: Span,
    /// The last token.
    pub last: Span,
}

impl Extent {
    /// One span for the run, as far as the compiler can join its ends.
    pub fn joined(self) -> Span {
        self.first.join(self.last).unwrap_or(self.first)
    }

    /// From the start of one run to the end of another.
    pub fn to(self, end: impl Into<Extent>) -> Self {
        Self { first: self.first, last: end.into().last }
    }
}

impl PartialEq for Extent {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Eq for Extent {}

impl From<Span> for Extent {
    fn from(span: Span) -> Self {
        Self { first: span, last: span }
    }
}

impl From<&Ident> for Extent {
    fn from(ident: &Ident) -> Self {
        ident.span().into()
    }
}
