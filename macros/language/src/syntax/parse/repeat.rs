//! What is written once and stands for several: arrays, loops and sums over them.

use std::ops::Range;

use proc_macro2::Delimiter;

use super::super::ast::Value;
use super::super::scope::Scope;
use super::super::tokens::{Parsed, Tokens, mistake, mistake_with_help};
use super::index::bound;
use crate::base::span::Extent;

/// Most elements of an array and most rounds of a loop.
const LONGEST: u32 = 10_000;

/// Reads `A..B`, which does not contain `B`.
pub(super) fn range(tokens: &mut Tokens) -> Parsed<Range<u32>> {
    let start = tokens.span();
    let first = bound(tokens)?;
    for _ in 0..2 {
        tokens.expect_sign('.', "a range such as `0..4`")?;
    }
    let end = bound(tokens)?;
    let extent = Extent::from(start).to(tokens.last);
    match end.checked_sub(first) {
        Some(0..=LONGEST) => Ok(first..end),
        Some(length) => {
            let message = format!("this range has {length} numbers; {LONGEST} are the most");
            mistake(extent, message)
        }
        None => mistake(extent, "this range ends before it starts"),
    }
}

/// The range of an item that declares an array, `body link[0..4]: ...`.
pub(super) fn elements(tokens: &Tokens) -> Parsed<Option<Range<u32>>> {
    let mut ahead = *tokens;
    ahead.ident();
    if ahead.ident().is_none() {
        return Ok(None);
    }
    let Some((_, mut content, _)) = ahead.group(Delimiter::Bracket) else {
        return Ok(None);
    };
    let mut inside = content;
    while !inside.is_empty() && !inside.peek_range() {
        inside.skip();
    }
    if inside.is_empty() {
        return Ok(None);
    }
    let range = range(&mut content)?;
    if !content.is_empty() {
        return content.expected("`]`");
    }
    Ok(Some(range))
}

/// Reads `for i in A..B`, and returns the scope of each round.
pub(super) fn rounds<'a>(tokens: &mut Tokens<'a>) -> Parsed<Vec<Scope<'a>>> {
    tokens.expect_word("for")?;
    let counter = tokens.name("a counter such as `i`")?;
    let name = counter.to_string();
    if tokens.scope.find(&name).is_some() || tokens.scope.counter(&name).is_some() {
        let message = format!("`{name}` is declared already");
        return mistake_with_help(&counter, message, "give the counter a name of its own");
    }
    tokens.expect_word("in")?;
    let range = range(tokens)?;
    tokens.scope.spend(range.len(), &counter)?;
    let scope = |k| {
        let mut scope = tokens.scope.clone();
        scope.counters.push((name.clone(), k));
        scope
    };
    Ok(range.map(scope).collect())
}

/// Reads the terms of `sum(for i in 0..4: ...)` to the end of the parentheses.
pub(super) fn terms<'a>(
    tokens: &mut Tokens<'a>,
    read: impl Fn(&mut Tokens<'_>) -> Parsed<Value>,
) -> Parsed<Vec<Value>> {
    let scopes = rounds(tokens)?;
    tokens.expect_sign(':', "`:` and the terms")?;
    let term = |scope: &Scope<'_>| {
        let mut content = tokens.within(scope);
        let term = read(&mut content)?;
        if content.is_empty() { Ok(term) } else { content.expected("`)` or an operator") }
    };
    scopes.iter().map(term).collect()
}
