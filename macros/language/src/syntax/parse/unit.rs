//! Units: `rad/s`, `kg*m^2`, `N/(m*s)`, `1/s`. After a number the unit takes precedence: it continues as long as unit
//! names follow.

use proc_macro2::{Delimiter, Ident, Span};

use super::super::ast::{Unit, UnitFactor};
use super::super::print;
use super::super::tokens::{Parsed, Tokens, mistake};
use super::words::KEYWORDS;
use crate::base::diagnostics::Diagnostic;
use crate::base::span::Extent;
use crate::base::units;

/// Words of the grammar that may follow a value and are therefore not units.
const FOLLOWING: [&str; 11] =
    ["along", "at", "on", "of", "rotated", "driven", "coasting", "shaken", "cut", "from", "to"];

/// Whether a factor's name may be misspelt or must be known.
#[derive(Clone, Copy, PartialEq)]
enum Names {
    Any,
    Known,
}

/// The unit of an input, where nothing else may appear.
pub(super) fn declared(tokens: &mut Tokens) -> Parsed<Unit> {
    let start = tokens.span();
    let mut factors = Vec::new();
    if one(tokens) {
        if !tokens.peek_sign('/') {
            return Ok(unit(factors, start, tokens));
        }
    } else if !factor(tokens, 1, Names::Any, &mut factors)? {
        return tokens.expected("a unit such as `rad/s`");
    }
    rest(tokens, Names::Any, &mut factors)?;
    let unit = unit(factors, start, tokens);
    ends(tokens, &unit)?;
    Ok(unit)
}

/// The unit after a number, if there is one. `suffix` is the first name of the unit if it is glued to the number.
pub(super) fn after_number(tokens: &mut Tokens, suffix: &str) -> Parsed<Option<Unit>> {
    let mut factors = Vec::new();
    let start = if suffix.is_empty() { tokens.span() } else { tokens.last };
    if suffix.is_empty() {
        let mut ahead = *tokens;
        if one(&mut ahead) && ahead.peek_sign('/') {
            *tokens = ahead;
        } else if !starts(tokens) || !factor(tokens, 1, Names::Any, &mut factors)? {
            return Ok(None);
        }
    } else {
        let exponent = exponent(tokens)?;
        factors.push(UnitFactor { name: suffix.to_string(), extent: start.into(), exponent });
    }
    rest(tokens, Names::Known, &mut factors)?;
    let unit = unit(factors, start, tokens);
    ends(tokens, &unit)?;
    Ok(Some(unit))
}

/// Rejects a unit next to a unit, where a multiplication sign is missing. After a drive, the name of a coordinate may
/// follow.
fn ends(tokens: &Tokens, unit: &Unit) -> Parsed<()> {
    let mut ahead = *tokens;
    let Some(name) = ahead.ident() else {
        return Ok(());
    };
    let is_coordinate = ["driven", "coasting"].iter().any(|word| ahead.peek_word(word));
    if is_coordinate || units::find(&name.to_string()).is_none() {
        return Ok(());
    }
    missing_sign(unit, &name)
}

/// The mistake of a unit beside a unit.
pub(super) fn missing_sign<T>(unit: &Unit, name: &Ident) -> Parsed<T> {
    let diagnostic =
        Diagnostic::new(name, "units are multiplied by `*`").with_help(format!("write `{}*{name}`", print::unit(unit)));
    Err(Box::new(diagnostic))
}

fn unit(factors: Vec<UnitFactor>, start: Span, tokens: &Tokens) -> Unit {
    Unit { factors, extent: Extent::from(start).to(tokens.last) }
}

/// Whether a unit starts here: a word that follows a number is its unit, known or not, unless the grammar continues
/// with it.
fn starts(tokens: &Tokens) -> bool {
    tokens.peek_ident().is_some_and(|ident| {
        let word = ident.to_string();
        let is_word_of = |words: &[&str]| words.contains(&word.as_str());
        !is_word_of(&FOLLOWING) && !is_word_of(&KEYWORDS) && !is_word_of(tokens.no_units)
    })
}

/// Reads a plain `1`.
fn one(tokens: &mut Tokens) -> bool {
    let mut ahead = *tokens;
    let is_one = ahead.literal().is_some_and(|one| one.to_string() == "1");
    if is_one {
        *tokens = ahead;
    }
    is_one
}

/// Reads `* a / b ...` while units follow.
fn rest(tokens: &mut Tokens, names: Names, factors: &mut Vec<UnitFactor>) -> Parsed<()> {
    loop {
        let mut ahead = *tokens;
        let sign = if ahead.sign('*').is_some() {
            1
        } else if ahead.sign('/').is_some() {
            -1
        } else {
            return Ok(());
        };
        if factor(&mut ahead, sign, names, factors)? || group(&mut ahead, sign, names, factors)? {
            *tokens = ahead;
        } else if names == Names::Known {
            return Ok(());
        } else {
            return ahead.expected("a unit");
        }
    }
}

/// Reads one named unit with its exponent.
fn factor(tokens: &mut Tokens, sign: i32, names: Names, factors: &mut Vec<UnitFactor>) -> Parsed<bool> {
    let Some(name) = tokens.peek_ident() else {
        return Ok(false);
    };
    let text = name.to_string();
    if names == Names::Known && units::find(&text).is_none() {
        return Ok(false);
    }
    tokens.ident();
    factors.push(UnitFactor { exponent: sign * exponent(tokens)?, name: text, extent: (&name).into() });
    Ok(true)
}

/// Reads `(a*b)` in a unit. After a number, parentheses belong to the unit only if they contain nothing but units.
fn group(tokens: &mut Tokens, sign: i32, names: Names, factors: &mut Vec<UnitFactor>) -> Parsed<bool> {
    let mut ahead = *tokens;
    let Some((_, mut content, _)) = ahead.group(Delimiter::Parenthesis) else {
        return Ok(false);
    };
    let mut inner = Vec::new();
    let read = factor(&mut content, 1, names, &mut inner)?;
    if read {
        rest(&mut content, names, &mut inner)?;
    }
    if !read || !content.is_empty() {
        return match names {
            Names::Known => Ok(false),
            Names::Any => content.expected("a unit"),
        };
    }
    factors.extend(inner.into_iter().map(|factor| UnitFactor { exponent: sign * factor.exponent, ..factor }));
    *tokens = ahead;
    Ok(true)
}

/// Reads `^2` or `^-2`; a power that is not a number belongs to the expression, not to the unit.
fn exponent(tokens: &mut Tokens) -> Parsed<i32> {
    let mut ahead = *tokens;
    if ahead.sign('^').is_none() {
        return Ok(1);
    }
    let sign = if ahead.sign('-').is_some() { -1 } else { 1 };
    let Some(literal) = ahead.literal() else {
        return Ok(1);
    };
    let whole = literal.to_string().parse::<i32>().unwrap_or(0);
    if !(1..=100).contains(&whole) {
        let message = "a unit's exponent must be a whole number from 1 to 100 or from -1 to -100";
        return mistake(literal.span(), message);
    }
    *tokens = ahead;
    Ok(sign * whole)
}
