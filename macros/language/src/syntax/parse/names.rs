//! Names that an item declares, and names that refer to something.

use proc_macro2::{Delimiter, Ident};
use syn::ext::IdentExt as _;

use super::super::scope::{Meaning, Port};
use super::super::tokens::{Parsed, Tokens, mistake, mistake_with_help};
use super::index::{bound, index};
use super::words::KEYWORDS;
use crate::base::diagnostics::Diagnostic;
use crate::base::names::{LINK, joined, written};
use crate::base::span::Extent;

/// Reads the name of an item: `hub`, `link[i + 1]`, or `blade[1].arm` in a declaration without parts.
pub(super) fn declared_name(tokens: &mut Tokens) -> Parsed<Ident> {
    if let Some(keyword) = tokens.peek_ident()
        && KEYWORDS.iter().any(|word| keyword == word)
    {
        let message = format!("`{keyword}` cannot be a name: it starts an item");
        return mistake(&keyword, message);
    }
    let name = tokens.name("a name")?;
    if name.to_string().contains(LINK) {
        let message = format!("a name cannot contain U+{:04X}", u32::from(LINK));
        return mistake(&name, message);
    }
    let mut ahead = *tokens;
    if ahead.sign('-').is_some()
        && let Some(rest) = ahead.ident()
    {
        let message = "a name cannot contain `-`";
        let diagnostic =
            Diagnostic::new(Extent::from(&name).to(&rest), message).with_help(format!("write `{name}_{rest}`"));
        return Err(Box::new(diagnostic));
    }
    let mut path = tokens.scope.whole(&name.to_string());
    loop {
        if let Some(place) = element(tokens)? {
            path = joined(&path, &place.to_string());
        } else if tokens.sign('.').is_some() {
            let Some(name) = tokens.ident() else { return tokens.expected("a name") };
            path = joined(&path, &name.unraw().to_string());
        } else {
            return Ok(Ident::new(&path, Extent::from(&name).to(tokens.last).joined()));
        }
    }
}

/// Reads `[i]`, or the range of an array, of which one element is meant.
fn element(tokens: &mut Tokens) -> Parsed<Option<u32>> {
    let element = tokens.element;
    let Some((_, mut content, _)) = tokens.group(Delimiter::Bracket) else {
        return Ok(None);
    };
    match element {
        Some(element) => {
            tokens.element = None;
            Ok(Some(element))
        }
        None => index(&mut content).map(Some),
    }
}

/// Reads the name of a body, a coordinate or a drive: `hub`, `link[i - 1]`, `blade[1].arm`.
pub(super) fn reference(tokens: &mut Tokens, what: &str) -> Parsed<Ident> {
    meant(tokens, what, |port| {
        port.framed.set(true);
        &port.frame
    })
}

/// Reads a name among values: of a port, its point is meant.
pub(super) fn name_of_value(tokens: &mut Tokens) -> Parsed<Ident> {
    meant(tokens, "a value", |port| &port.point)
}

fn meant(tokens: &mut Tokens, what: &str, of_port: fn(&Port) -> &Ident) -> Parsed<Ident> {
    let first = tokens.name(what)?;
    let (scope, text) = (tokens.scope, first.to_string());
    let mut meaning = scope.find(&text);
    if let Some(port) = scope.ports.iter().find(|port| port.name == text) {
        // A mistake in it is one of where the part is used.
        return Ok(of_port(port).clone());
    }
    let mut path = match text {
        text if meaning.is_some() => scope.whole(&text),
        text if scope.hides(&text) => {
            let message = format!("a part sees only its own names, and `{text}` is declared outside it");
            let help =
                format!("make it a parameter or a port of the part, and write `{text}: {text}` where it is used");
            return mistake_with_help(&first, message, help);
        }
        text => text,
    };
    loop {
        if let Some((_, mut content, _)) = tokens.group(Delimiter::Bracket) {
            path = joined(&path, &index(&mut content)?.to_string());
            continue;
        }
        let Some(of) = meaning.filter(|meaning| !matches!(meaning, Meaning::Item(_))) else { break };
        if tokens.sign('.').is_none() {
            break;
        }
        let Some(name) = tokens.ident() else { return tokens.expected("a name") };
        let name = name.unraw().to_string();
        path = joined(&path, &name);
        meaning = scope.inside(of, &name);
    }
    Ok(Ident::new(&path, Extent::from(&first).to(tokens.last).joined()))
}

/// Reads a name whose indices may be ranges, as written: `blade[..].mass`.
pub(super) fn pattern(tokens: &mut Tokens) -> Parsed<(String, Extent)> {
    let first = tokens.name("a name")?;
    let mut text = written(&tokens.scope.whole(&first.to_string())).into_owned();
    loop {
        if let Some((_, mut content, _)) = tokens.group(Delimiter::Bracket) {
            let bound = |tokens: &mut Tokens| match tokens.is_empty() || tokens.peek_range() {
                true => Ok(String::new()),
                false => Ok::<_, Box<Diagnostic>>(bound(tokens)?.to_string()),
            };
            text.push('[');
            text += &bound(&mut content)?;
            if content.peek_range() {
                content.sign('.');
                content.sign('.');
                text += "..";
                text += &bound(&mut content)?;
            }
            if !content.is_empty() {
                return content.expected("`]` or `..`");
            }
            text.push(']');
        } else if tokens.sign('.').is_some() {
            let Some(name) = tokens.ident() else { return tokens.expected("a name") };
            text.extend([".", &name.unraw().to_string()]);
        } else {
            return Ok((text, Extent::from(&first).to(tokens.last)));
        }
    }
}

/// Skips a name and returns its words without the indices.
pub(super) fn path(tokens: &mut Tokens) -> Vec<(Ident, String)> {
    let mut path = Vec::new();
    while let Some(name) = tokens.ident() {
        path.push((name.clone(), name.unraw().to_string()));
        while tokens.group(Delimiter::Bracket).is_some() {}
        if tokens.sign('.').is_none() {
            break;
        }
    }
    path
}

/// Whether a name, which may have an index, and a colon are next.
pub(super) fn peek_labelled(tokens: &Tokens) -> bool {
    let mut ahead = *tokens;
    !path(&mut ahead).is_empty() && ahead.peek_sign(':')
}

/// Reads a colon.
pub(super) fn colon(tokens: &mut Tokens) -> Parsed<Extent> {
    tokens.expect_sign(':', "`:`")
}
