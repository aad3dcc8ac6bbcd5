//! Values: sums, products, powers, calls and vectors, with the usual precedence.

use proc_macro2::{Delimiter, Literal};
use syn::ext::IdentExt as _;

use super::super::ast::{Binary, Operator, Value, ValueKind};
use super::super::nesting::{self, DEEPEST};
use super::super::tokens::{Parsed, Tokens, helped, mistake};
use super::names::name_of_value;
use super::repeat::terms;
use super::unit::{self, missing_sign};
use super::words::{GRADE, KEYWORDS};
use crate::base::diagnostics::Diagnostic;
use crate::base::quoted::file_name;
use crate::base::span::Extent;

/// Maximum height of the resulting tree, to which a long sum adds one level per term.
const HIGHEST: u16 = 256;

/// Most characters of a number; the least 64-bit number has some 330 without an exponent, and reading takes time that
/// grows with the square.
const LONGEST: usize = 400;

/// Reads a value.
pub(super) fn value(tokens: &mut Tokens) -> Parsed<Value> {
    sum(tokens, 0)
}

/// Reads a value that stops before the terms for which `ends` returns true.
pub(super) fn value_before(tokens: &mut Tokens, ends: fn(&Tokens) -> bool) -> Parsed<Value> {
    chain(tokens, 0, &TERMS, product, ends)
}

/// Reads values separated by commas to the end of a group.
pub(super) fn list(tokens: &mut Tokens, depth: u32) -> Parsed<Vec<Value>> {
    let mut values = Vec::new();
    while !tokens.is_empty() {
        values.push(sum(tokens, depth)?);
        if !tokens.is_empty() {
            tokens.expect_sign(',', "`,` or an operator")?;
        }
    }
    Ok(values)
}

const TERMS: [Operator; 2] = [Operator::Add, Operator::Subtract];
const FACTORS: [Operator; 2] = [Operator::Multiply, Operator::Divide];

/// Reads a sum, which ends before a tolerance and before the next shape of a body.
fn sum(tokens: &mut Tokens, depth: u32) -> Parsed<Value> {
    let ends = |tokens: &Tokens| tokens.peek_plus_minus() || tokens.peek_shape();
    chain(tokens, depth, &TERMS, product, ends)
}

fn product(tokens: &mut Tokens, depth: u32) -> Parsed<Value> {
    chain(tokens, depth, &FACTORS, signed, |_| false)
}

/// Reads operands joined by operators of one precedence, grouped from the left.
fn chain(
    tokens: &mut Tokens,
    depth: u32,
    operators: &[Operator],
    operand: fn(&mut Tokens, u32) -> Parsed<Value>,
    ends: fn(&Tokens) -> bool,
) -> Parsed<Value> {
    let mut left = operand(tokens, depth)?;
    while !ends(tokens) {
        let read = operators.iter().find_map(|&operator| Some((operator, tokens.sign(operator.sign())?)));
        let Some((operator, sign)) = read else {
            break;
        };
        let right = operand(tokens, depth)?;
        left = binary(operator, sign, left, right)?;
    }
    Ok(left)
}

/// Reads an optional sign: `-a^b` is `-(a^b)`.
fn signed(tokens: &mut Tokens, depth: u32) -> Parsed<Value> {
    let Some(sign) = tokens.sign('-') else {
        return power(tokens, depth);
    };
    let operand = nested(tokens, depth, sign, signed)?;
    let extent = sign.to(operand.extent);
    built(ValueKind::Negate(Box::new(operand)), extent)
}

/// Reads a power: `a^b^c` is `a^(b^c)`.
fn power(tokens: &mut Tokens, depth: u32) -> Parsed<Value> {
    let base = component(tokens, depth)?;
    let Some(sign) = tokens.sign('^') else {
        return Ok(base);
    };
    let exponent = nested(tokens, depth, sign, signed)?;
    binary(Operator::Power, sign, base, exponent)
}

fn component(tokens: &mut Tokens, depth: u32) -> Parsed<Value> {
    let mut value = primary(tokens, depth)?;
    while !tokens.peek_range()
        && let Some(point) = tokens.sign('.')
    {
        match (&value.kind, tokens.peek_ident()) {
            (ValueKind::Number(_, None), _) => return digits_missing(point),
            (ValueKind::Number(_, Some(unit)), Some(name)) => return missing_sign(unit, &name),
            _ => {}
        }
        let Some(axis) = tokens.ident() else {
            let error = tokens.expected("a component: `x`, `y` or `z`");
            return match tokens.literal() {
                Some(_) => error.map_err(helped(GRADE)),
                None => error,
            };
        };
        let extent = value.extent.to(&axis);
        value = built(ValueKind::Component(Box::new(value), axis), extent)?;
    }
    Ok(value)
}

fn primary(tokens: &mut Tokens, depth: u32) -> Parsed<Value> {
    let start = tokens.span();
    let grouped = tokens.fragment();
    if grouped.is_none()
        && let Some(literal) = tokens.literal()
    {
        return match file_name(&literal) {
            Some(name) => built(ValueKind::File(name), literal.span()),
            None => number(&literal, tokens),
        };
    }
    let grouped = grouped.or_else(|| tokens.group(Delimiter::Parenthesis));
    if let Some((open, mut content, close)) = grouped {
        let inner = nested(&mut content, depth, open.into(), sum)?;
        if !content.is_empty() {
            return content.expected("`)` or an operator");
        }
        let extent = Extent::from(open).to(close);
        return built(ValueKind::Parenthesised(Box::new(inner)), extent);
    }
    if let Some((open, mut content, _)) = tokens.group(Delimiter::Bracket) {
        let components = nested(&mut content, depth, open.into(), list)?;
        let unit = unit::after_number(tokens, "")?;
        let extent = Extent::from(start).to(tokens.last);
        return built(ValueKind::Vector(components, unit), extent);
    }
    let follows_value = tokens.peek_ident().is_some_and(|ident| {
        let word = ident.unraw().to_string();
        !KEYWORDS.contains(&word.as_str())
    });
    if !follows_value {
        let mut ahead = *tokens;
        if let Some(point) = ahead.sign('.')
            && ahead.literal().is_some()
        {
            return digits_missing(point);
        }
        let error = tokens.expected("a value");
        return if tokens.peek_sign('*') { error.map_err(helped("a power is written `x^2`")) } else { error };
    }
    if let Some(axis) = hidden_axis(tokens) {
        let components =
            [0, 1, 2].map(|k| Value::new(ValueKind::Number(f64::from(u8::from(k == axis)), None), tokens.last));
        return built(ValueKind::Vector(components.into(), None), Extent::from(start).to(tokens.last));
    }
    let name = name_of_value(tokens)?;
    let extent = Extent::from(start).to(tokens.last);
    if let Some((_, mut content, _)) = tokens.group(Delimiter::Parenthesis) {
        let extent = Extent::from(start).to(tokens.last);
        if name == "sum" && content.peek_word("for") {
            return total(
                nested(&mut content, depth, start.into(), |tokens, depth| terms(tokens, |tokens| sum(tokens, depth)))?,
                extent,
            );
        }
        let arguments = nested(&mut content, depth, start.into(), list)?;
        return built(ValueKind::Call(name, arguments), extent);
    }
    match tokens.scope.counter(&name.to_string()) {
        Some(counter) => built(ValueKind::Number(counter.into(), None), extent),
        None => built(ValueKind::Name(name), extent),
    }
}

/// Terms in parentheses, joined from the left; zero if there are none.
fn total(terms: Vec<Value>, extent: Extent) -> Parsed<Value> {
    let mut total = None;
    for term in terms {
        // A term may be a sum itself.
        let term = built(ValueKind::Parenthesised(Box::new(term)), extent)?;
        total = Some(match total {
            None => term,
            Some(before) => binary(Operator::Add, extent, before, term)?,
        });
    }
    let total = match total {
        Some(total) => total,
        None => built(ValueKind::Number(0.0, None), extent)?,
    };
    built(ValueKind::Parenthesised(Box::new(total)), extent)
}

/// Reads the unit after a number, and returns the number with it.
pub(super) fn number(literal: &Literal, tokens: &mut Tokens) -> Parsed<Value> {
    let span = literal.span();
    let length = literal.to_string().len();
    if length > LONGEST {
        let message = format!("this number has {length} characters; {LONGEST} are the most");
        return mistake(span, message);
    }
    let (digits, suffix) = digits_and_suffix(literal).ok_or_else(|| {
        let message = format!("expected a number, found `{literal}`");
        let help = "nothing stands in quotes but the names of files";
        Box::new(Diagnostic::new(span, message).with_help(help))
    })?;
    // A string of digits can overflow to infinity, but never fails or becomes NaN.
    let value = digits.parse::<f64>().unwrap_or(f64::INFINITY);
    let has_digit =
        digits.split(['e', 'E']).next().is_some_and(|mantissa| mantissa.contains(|digit| ('1'..='9').contains(&digit)));
    if value.is_infinite() || (value == 0.0 && has_digit) {
        let message = format!("`{literal}` is outside the range of a 64-bit number");
        return mistake(span, message);
    }
    let unit = unit::after_number(tokens, &suffix)?;
    let extent = Extent::from(span).to(tokens.last);
    built(ValueKind::Number(value, unit), extent)
}

/// Splits `3.5kg`; `None` if the literal is not a number.
pub(super) fn digits_and_suffix(literal: &Literal) -> Option<(String, String)> {
    match syn::Lit::new(literal.clone()) {
        syn::Lit::Int(int) => Some((int.base10_digits().into(), int.suffix().into())),
        syn::Lit::Float(float) => Some((float.base10_digits().into(), float.suffix().into())),
        _ => None,
    }
}

fn binary(operator: Operator, sign: Extent, left: Value, right: Value) -> Parsed<Value> {
    let extent = left.extent.to(right.extent);
    let binary = Binary { operator, sign, left, right };
    built(ValueKind::Binary(Box::new(binary)), extent)
}

/// A point with digits on one side only.
fn digits_missing<T>(point: Extent) -> Parsed<T> {
    let diagnostic = Diagnostic::new(point, "digits are missing beside this point")
        .with_help("write digits on both sides of the point: `5.0`, `0.5`");
    Err(Box::new(diagnostic))
}

/// The value, or an error if it makes the tree too high.
fn built(kind: ValueKind, extent: impl Into<Extent>) -> Parsed<Value> {
    let value = Value::new(kind, extent);
    if value.height > HIGHEST {
        return too_large(value.extent);
    }
    Ok(value)
}

/// Reads one level deeper in the nesting.
fn nested<'a, T>(
    tokens: &mut Tokens<'a>,
    depth: u32,
    at: Extent,
    read: impl FnOnce(&mut Tokens<'a>, u32) -> Parsed<T>,
) -> Parsed<T> {
    if depth >= DEEPEST {
        return too_large(at);
    }
    read(tokens, depth + 1)
}

fn too_large<T>(at: Extent) -> Parsed<T> {
    Err(Box::new(nesting::too_large(at)))
}

/// Reads `x`, `y` or `z` in a part whose user calls something else so: there it is an axis.
fn hidden_axis(tokens: &mut Tokens) -> Option<usize> {
    let word = tokens.peek_ident()?.to_string();
    let axis = ["x", "y", "z"].iter().position(|axis| word == *axis)?;
    let scope = tokens.scope;
    let own = scope.find(&word).is_some() || scope.ports.iter().any(|port| port.name == word);
    (!own && scope.hides(&word)).then(|| {
        tokens.skip();
        axis
    })
}
