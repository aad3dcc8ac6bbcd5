//! Placements: `at VECTOR rotated(DIRECTION, ANGLE) ...`.

use proc_macro2::{Delimiter, Ident};

use super::super::ast::{Placement, Value, ValueKind};
use super::super::scope::Meaning;
use super::super::tokens::{Parsed, Tokens};
use super::index::bound;
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
    Ok(Some(Placement { offset, rotations, keyword }))
}

/// Reads a vector, `tip`, a fraction of a beam such as `0.4 length` or `1/3 length`, or a station of a shaft, `station 4`.
pub(super) fn place(tokens: &mut Tokens) -> Parsed<Value> {
    let start = Extent::from(tokens.span());
    let mut ahead = *tokens;
    match fraction(&mut ahead) {
        Some(fraction) if ahead.peek_word("length") => {
            *tokens = ahead;
            let end = tokens.expect_word("length")?;
            Ok(Value::new(ValueKind::Fraction(fraction), start.to(end)))
        }
        _ if tokens.peek_word("station") && !tokens.scope.find("station").is_some_and(is_value) => {
            tokens.expect_word("station")?;
            let station = bound(tokens)?;
            Ok(Value::new(ValueKind::Station(station), start.to(tokens.last)))
        }
        // The end of a beam, although something may have its name.
        _ if tokens.peek_ident().is_some_and(|word| is_end(&word, tokens)) => {
            let word = tokens.name("a place")?;
            Ok(Value::new(ValueKind::Name(word), start))
        }
        _ => value(tokens),
    }
}

/// Whether a name stands for a value.
fn is_value(of: &Meaning) -> bool {
    matches!(of, Meaning::Item(keyword) if keyword == "let" || keyword == "design")
}

fn is_end(word: &Ident, tokens: &Tokens) -> bool {
    (word == "tip" || word == "root") && !tokens.scope.find(&word.to_string()).is_some_and(is_value)
}

fn fraction(tokens: &mut Tokens) -> Option<f64> {
    let sign = if tokens.sign('-').is_some() { -1.0 } else { 1.0 };
    let number = |tokens: &mut Tokens| tokens.literal()?.to_string().parse().ok();
    let above: f64 = number(tokens)?;
    let below = match tokens.sign('/') {
        Some(_) => number(tokens)?,
        None => 1.0,
    };
    Some(sign * above / below)
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
