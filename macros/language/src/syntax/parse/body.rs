//! Bodies: sums of shapes with named arguments.

use proc_macro2::Delimiter;

use super::super::ast::{Argument, Body, ItemKind, NamedCall, Term, Unit, UnitFactor, Value, ValueKind};
use super::super::tokens::{Parsed, Tokens, helped};
use super::names::{colon, declared_name, reference};
use super::placement::placement;
use super::value::value;
use super::words::DECIMAL_POINT;
use crate::base::span::Extent;

const SHAPE: &str = "a shape such as `rod` or `massless`";

/// Reads a body after its keyword.
pub(super) fn body(tokens: &mut Tokens) -> Parsed<ItemKind> {
    let name = declared_name(tokens)?;
    colon(tokens)?;
    // A leading minus is a mistake that a later rule explains.
    let mut hole = tokens.sign('-').is_some();
    let mut terms = Vec::new();
    loop {
        let shape = named_call(tokens, SHAPE)?;
        let placement = placement(tokens)?;
        terms.push(Term { hole, shape, placement });
        hole = if tokens.sign('+').is_some() {
            false
        } else if tokens.sign('-').is_some() {
            true
        } else {
            let spinning = match tokens.word("spinning") {
                Some(_) => {
                    tokens.expect_word("at")?;
                    Some(value(tokens)?)
                }
                None => None,
            };
            return Ok(ItemKind::Body(Body { name, terms, spinning }));
        };
    }
}

/// Reads a word with named arguments.
pub(super) fn named_call(tokens: &mut Tokens, what: &str) -> Parsed<NamedCall> {
    // No name is declared here, so Rust's keyword `box` is allowed.
    let Some(word) = tokens.ident() else {
        return tokens.expected(what);
    };
    let Some((_, mut content, _)) = tokens.group(Delimiter::Parenthesis) else {
        return Ok(NamedCall { word, arguments: None });
    };
    let mut arguments = Vec::new();
    while !content.is_empty() {
        if !content.peek_named() {
            return content.expected("a named argument such as `mass: 3 kg`");
        }
        arguments.push(argument(&mut content)?);
        if content.peek_decimal_comma() {
            let error = content.expected("a named argument");
            return error.map_err(helped(DECIMAL_POINT));
        }
        if !content.is_empty() {
            content.expect_sign(',', "`,` or an operator")?;
        }
    }
    Ok(NamedCall { word, arguments: Some(arguments) })
}

/// Reads a word that could not be a name.
fn keyword(tokens: &mut Tokens) -> Parsed<Value> {
    let Some(word) = tokens.ident() else {
        return tokens.expected("a word");
    };
    let extent = Extent::from(&word);
    Ok(Value::new(ValueKind::Name(word), extent))
}

/// Reads `SHAPE(...)` or `SHAPE(...) to SHAPE(...)`.
fn sections(tokens: &mut Tokens) -> Parsed<Value> {
    const SECTION: &str = "a cross-section such as `rectangle(width: 8 mm, height: 2 mm)`";
    let start = Extent::from(tokens.span());
    let mut calls = vec![named_call(tokens, SECTION)?];
    while tokens.word("to").is_some() {
        calls.push(named_call(tokens, SECTION)?);
    }
    let extent = start.to(tokens.last);
    Ok(Value::new(ValueKind::Sections(calls), extent))
}

/// Reads a grade of balancing, `G6.3` for 6.3 mm/s, or a value.
fn grade(tokens: &mut Tokens) -> Parsed<Value> {
    let mut ahead = *tokens;
    let start = ahead.span();
    let Some(mut digits) = ahead.ident().and_then(|word| word.to_string().strip_prefix('G').map(str::to_owned)) else {
        return value(tokens);
    };
    if !digits.chars().all(|digit| digit.is_ascii_digit()) {
        return value(tokens);
    }
    if digits.is_empty() || ahead.sign('.').is_some() {
        let Some(literal) = ahead.literal() else {
            return ahead.expected("a grade such as `G6.3`");
        };
        let point = if digits.is_empty() { "" } else { "." };
        digits = format!("{digits}{point}{literal}");
    }
    let Ok(number) = digits.parse() else {
        return tokens.expected("a grade such as `G6.3`");
    };
    let extent = Extent::from(start).to(ahead.last);
    *tokens = ahead;
    let factor = |name: &str, exponent| UnitFactor { name: name.to_owned(), extent, exponent };
    let unit = Unit { factors: vec![factor("mm", 1), factor("s", -1)], extent };
    Ok(Value::new(ValueKind::Number(number, Some(unit)), extent))
}

/// Reads `NAME: VALUE` or `NAME: VALUE of DRIVE`.
pub(super) fn argument(tokens: &mut Tokens) -> Parsed<Argument> {
    let name = tokens.name("an argument")?;
    colon(tokens)?;
    let value = match tokens.peek_call() {
        true if name == "section" => sections(tokens)?,
        // Rust reserves the word, so it cannot be a name.
        _ if name == "grade" => grade(tokens)?,
        _ if name == "shear" && tokens.peek_word("static") => keyword(tokens)?,
        _ => value(tokens)?,
    };
    let of = match tokens.word("of") {
        Some(_) => Some(reference(tokens, "a driven or coasting coordinate")?),
        None => None,
    };
    Ok(Argument { name, value, of })
}
