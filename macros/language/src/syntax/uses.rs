//! Mistakes in parts: in which instance they are.

use std::collections::BTreeSet;

use proc_macro2::{Span, TokenStream, TokenTree};

use super::ast::{Use, Uses};
use crate::base::diagnostics::{Diagnostics, place};
use crate::base::names::written;
use crate::base::span::Extent;

impl Uses {
    /// Says of each mistake in a part in which instance it is; of several, the first.
    pub fn explain(&self, mistakes: &mut Diagnostics) {
        let mut known = BTreeSet::new();
        let uses = self.0.iter().filter(|of| known.insert(of.part.as_str()));
        let parts: Vec<(&Use, BTreeSet<String>)> = uses
            .map(|of| {
                let mut places = BTreeSet::new();
                enter(of.tokens.clone(), &mut places);
                (of, places)
            })
            .collect();
        mistakes.explain(|span: Span| {
            let place = place(span);
            let mut found = parts.iter().filter(|(_, places)| places.contains(&place));
            let (of, _) = found.next()?;
            // All parts of an included file have one place in a macro.
            found.next().is_none().then(|| (written(&of.name.to_string()).into_owned(), Extent::from(&of.name)))
        });
    }
}

/// The places of all tokens.
fn enter(tokens: TokenStream, places: &mut BTreeSet<String>) {
    for token in tokens {
        places.insert(place(token.span()));
        if let TokenTree::Group(group) = token {
            enter(group.stream(), places);
        }
    }
}
