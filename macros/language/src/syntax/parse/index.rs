//! Indices: whole numbers that are known where the declaration is read, from counters of loops and constants.

use proc_macro2::Delimiter;

use super::super::nesting::{self, DEEPEST};
use super::super::tokens::{Parsed, Tokens, helped};
use crate::base::diagnostics::Diagnostic;
use crate::base::span::Extent;

const INDEX: &str = "an index is made of whole numbers, counters of loops, and constants such as `let N = 5;`";

/// Reads an index to the end of a group.
pub(super) fn index(tokens: &mut Tokens) -> Parsed<u32> {
    let index = bound(tokens)?;
    if !tokens.is_empty() {
        let error = tokens.expected("`]` or an operator");
        return error.map_err(helped(INDEX));
    }
    Ok(index)
}

/// Reads a whole number that is not negative.
pub(super) fn bound(tokens: &mut Tokens) -> Parsed<u32> {
    let start = Extent::from(tokens.span());
    let number = whole(tokens)?;
    u32::try_from(number).map_err(|_| {
        let message = match number {
            ..0 => format!("an index counts from 0, and this is {number}"),
            _ => format!("{number} is too large for an index"),
        };
        Box::new(Diagnostic::new(start.to(tokens.last), message).with_help(INDEX))
    })
}

/// Reads a sum of whole numbers.
pub(super) fn whole(tokens: &mut Tokens) -> Parsed<i64> {
    sum(tokens, 0)
}

fn sum(tokens: &mut Tokens, depth: u32) -> Parsed<i64> {
    let start = Extent::from(tokens.span());
    let mut sum = product(tokens, depth)?;
    loop {
        let next = if tokens.sign('+').is_some() {
            sum.checked_add(product(tokens, depth)?)
        } else if tokens.sign('-').is_some() {
            sum.checked_sub(product(tokens, depth)?)
        } else {
            return Ok(sum);
        };
        sum = known(next, start.to(tokens.last))?;
    }
}

fn product(tokens: &mut Tokens, depth: u32) -> Parsed<i64> {
    let start = Extent::from(tokens.span());
    let mut product = factor(tokens, depth)?;
    loop {
        let next = if tokens.sign('*').is_some() {
            product.checked_mul(factor(tokens, depth)?)
        } else if tokens.sign('/').is_some() {
            let divisor = factor(tokens, depth)?;
            product.checked_div(divisor).filter(|quotient| quotient * divisor == product)
        } else if tokens.sign('%').is_some() {
            product.checked_rem_euclid(factor(tokens, depth)?)
        } else {
            return Ok(product);
        };
        product = known(next, start.to(tokens.last))?;
    }
}

fn factor(tokens: &mut Tokens, depth: u32) -> Parsed<i64> {
    let start = Extent::from(tokens.span());
    if depth > DEEPEST {
        return Err(Box::new(nesting::too_large(start)));
    }
    if tokens.sign('-').is_some() {
        let number = factor(tokens, depth + 1)?;
        return known(number.checked_neg(), start.to(tokens.last));
    }
    if let Some((_, mut content, _)) = tokens.fragment().or_else(|| tokens.group(Delimiter::Parenthesis)) {
        let number = sum(&mut content, depth + 1)?;
        return if content.is_empty() { Ok(number) } else { content.expected("`)` or an operator") };
    }
    if let Some(literal) = tokens.literal() {
        return known(literal.to_string().parse().ok(), start);
    }
    if tokens.peek_ident().is_none() {
        let error = tokens.expected("a whole number");
        return error.map_err(helped(INDEX));
    }
    let name = tokens.name("a whole number")?.to_string();
    let scope = tokens.scope;
    let counter = scope.counter(&name).map(i64::from);
    known(counter.or_else(|| scope.number(&scope.whole(&name))), start)
}

fn known(number: Option<i64>, at: Extent) -> Parsed<i64> {
    let message = "this is not a whole number that is known here";
    number.ok_or_else(|| Box::new(Diagnostic::new(at, message).with_help(INDEX)))
}
