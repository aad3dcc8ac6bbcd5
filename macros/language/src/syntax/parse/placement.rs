//! Placements: `at VECTOR rotated(DIRECTION, ANGLE) ...`.

use proc_macro2::Delimiter;

use super::super::ast::{Placement, Value, ValueKind};
use super::super::tokens::{Parsed, Tokens};
use super::value::value;
use crate::base::span::Extent;

/// Reads a placement if one is next.
pub(super) fn placement(tokens: &mut Tokens) -> Parsed<Option<Placement>> {
    if !tokens.peek_word("at") && !tokens.peek_word("rotated") {
        return Ok(None);
    }
    let keyword = tokens.span().into();
    let offset = match tokens.word("at") {
        Some(_) => Some(place(tokens)?),
        None => None,
    };
    let mut rotations = Vec::new();
    while tokens.word("rotated").is_some() {
        rotations.push(rotation(tokens)?);
    }
    Ok(Some(Placement {
        offset,
        rotations,
        keyword,
    }))
}

/// Reads a vector, `tip`, or a fraction of a beam such as `0.4 length`.
pub(super) fn place(tokens: &mut Tokens) -> Parsed<Value> {
    let mut ahead = *tokens;
    let fraction = ahead
        .literal()
        .and_then(|literal| literal.to_string().parse().ok());
    let Some(fraction) = fraction.filter(|_| ahead.peek_word("length")) else {
        return value(tokens);
    };
    let start = Extent::from(tokens.span());
    tokens.literal();
    let end = tokens.expect_word("length")?;
    Ok(Value::new(ValueKind::Fraction(fraction), start.to(end)))
}

fn rotation(tokens: &mut Tokens) -> Parsed<(Value, Value)> {
    let Some((_, mut content, _)) = tokens.group(Delimiter::Parenthesis) else {
        return tokens.expected("a direction and an angle: `(z, 30 deg)`");
    };
    let axis = value(&mut content)?;
    content.expect_sign(',', "`,` and an angle")?;
    let angle = value(&mut content)?;
    content.sign(',');
    if !content.is_empty() {
        return content.expected("`)`");
    }
    Ok((axis, angle))
}
