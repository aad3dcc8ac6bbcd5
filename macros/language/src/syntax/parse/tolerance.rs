//! Tolerances: `+/- 3%` and `+0.1 -0.05 mm`, each optionally followed by a law; `one of [1.9, 2.0, 2.1] mm`.

use proc_macro2::{Delimiter, Ident};

use super::super::ast::{
    Deviation, Deviations, Law, LawKind, Limits, Measure, Tolerance, Unit, Value, ValueKind, Values,
};
use super::super::print;
use super::super::tokens::{Parsed, Tokens, helped, mistake_with_help};
use super::value::{digits_and_suffix, list, number, value, value_before};
use super::words::{KEYWORDS, LAWS, suggested_law};
use crate::base::diagnostics::Diagnostic;
use crate::base::span::Extent;
use crate::base::units;

/// Help on how to write a list of possible values.
const VALUES: &str = "write `one of [1.9, 2.0, 2.1] mm`, or `one of [1.9, 2.0] mm weighted [1, 6]`";

/// Words after a number that are not units.
const NO_UNITS: [&str; 9] = {
    let [a, b, c, d, e, f, g] = LAWS;
    [a, b, c, d, e, f, g, "one", "weighted"]
};

/// Help for the token after the readable part, if it looks like a tolerance or its law.
pub(super) fn help(tokens: &Tokens) -> Option<&'static str> {
    if tokens.cursor.literal().is_some() || ['%', '+', '-'].iter().any(|&sign| tokens.peek_sign(sign)) {
        return Some("a tolerance is written `+/- 3%` or, with the upper limit first, `+2% -1%`");
    }
    let mut ahead = *tokens;
    ahead.sign(',');
    LAWS.iter().any(|law| ahead.peek_word(law)).then_some("a law directly follows a tolerance: `+/- 3% uniform`")
}

/// Reads a value up to a tolerance: two signed numbers at its end are limits, not terms of a sum.
pub(super) fn nominal(tokens: &mut Tokens) -> Parsed<Value> {
    tokens.no_units = &NO_UNITS;
    let nominal = value_before(tokens, |tokens| {
        let mut ahead = *tokens;
        tokens.peek_plus_minus() || deviations(&mut ahead).is_some()
    });
    tokens.no_units = &[];
    nominal
}

/// Reads a tolerance if there is one.
pub(super) fn tolerance(tokens: &mut Tokens) -> Parsed<Option<Tolerance>> {
    tokens.no_units = &NO_UNITS;
    let limits = limits(tokens);
    tokens.no_units = &[];
    let Some((limits, extent)) = limits? else {
        return Ok(None);
    };
    if let Limits::Values(_) = limits {
        if let Some(word) = tokens.peek_ident().filter(|word| LAWS.contains(&word.to_string().as_str())) {
            let message = "the list says how they are distributed";
            let help = format!("leave `{word}` away, or give limits in place of the list");
            return mistake_with_help(&word, message, help);
        }
        return Ok(Some(Tolerance { limits, extent, law: None }));
    }
    match &limits {
        Limits::HalfWidth(Value { kind: ValueKind::Number(_, Some(unit)), .. }) => is_no_law(unit)?,
        Limits::Deviations(pair) => {
            if let Measure::Unit(unit) = &pair.lower.measure {
                is_no_law(unit)?;
            }
        }
        _ => {}
    }
    let law = law(tokens)?;
    Ok(Some(Tolerance { limits, extent, law }))
}

fn limits(tokens: &mut Tokens) -> Parsed<Option<(Limits, Extent)>> {
    let is_half_width = tokens.peek_plus_minus();
    if is_half_width {
        for sign in ['+', '/', '-'] {
            tokens.sign(sign);
        }
    }
    let start = tokens.span();
    if !is_half_width && tokens.peek_word("one") {
        let values = values(tokens)?;
        return Ok(Some((Limits::Values(Box::new(values)), Extent::from(start).to(tokens.last))));
    }
    let limits = if is_half_width {
        match percentage(tokens) {
            Some(percent) => Limits::Percent(percent),
            None => Limits::HalfWidth(value(tokens)?),
        }
    } else {
        match deviations(tokens) {
            Some((deviations, None)) => Limits::Deviations(Box::new(deviations)),
            Some((deviations, Some(slash))) => return Err(separated(&deviations, slash)),
            None => return Ok(None),
        }
    };
    Ok(Some((limits, Extent::from(start).to(tokens.last))))
}

/// Reads `one of LIST`, and the frequency of each value.
fn values(tokens: &mut Tokens) -> Parsed<Values> {
    tokens.expect_word("one")?;
    let of = tokens.expect_word("of").and_then(|_| value(tokens));
    let weights = |tokens: &mut Tokens| match tokens.word("weighted") {
        Some(_) => value(tokens).map(Some),
        None => Ok(None),
    };
    let read = of.and_then(|values| {
        let weights = weights(tokens)?;
        Ok(Values { values, weights })
    });
    read.map_err(helped(VALUES))
}

/// Reads a number and `%`. The number may be negative here, so that a later rule can explain the mistake.
fn percentage(tokens: &mut Tokens) -> Option<f64> {
    let mut ahead = *tokens;
    let sign = if ahead.sign('-').is_some() { -1.0 } else { 1.0 };
    let (digits, suffix) = digits_and_suffix(&ahead.literal()?)?;
    let percent = digits.parse::<f64>().ok()?;
    ahead.sign('%')?;
    if !suffix.is_empty() || !percent.is_finite() {
        return None;
    }
    *tokens = ahead;
    Some(sign * percent)
}

/// Reads two signed numbers that only a law or the end of the item may follow, and a `/` that some write between them.
fn deviations(tokens: &mut Tokens) -> Option<(Deviations, Option<Extent>)> {
    let mut ahead = *tokens;
    let upper = deviation(&mut ahead)?;
    let slash = ahead.sign('/');
    let lower = deviation(&mut ahead)?;
    let is_law_or_item = ahead.peek_ident().is_some() || ahead.peek_sign('#');
    if !(is_law_or_item || ahead.peek_sign(';') || ahead.is_empty()) {
        return None;
    }
    *tokens = ahead;
    Some((Deviations { upper, lower }, slash))
}

fn separated(deviations: &Deviations, slash: Extent) -> Box<Diagnostic> {
    let help = format!("write `{}`; a quotient here needs parentheses", print::deviations(deviations));
    let message = "limits are written one after the other, without `/`";
    Box::new(Diagnostic::new(slash, message).with_help(help))
}

fn deviation(tokens: &mut Tokens) -> Option<Deviation> {
    let start = tokens.span();
    let sign = match tokens.sign('+') {
        Some(_) => Some(1.0),
        None => tokens.sign('-').map(|_| -1.0),
    };
    let literal = tokens.literal()?;
    let ValueKind::Number(number, unit) = number(&literal, tokens).ok()?.kind else {
        return None;
    };
    // Drawings write zero without a sign.
    if sign.is_none() && number != 0.0 {
        return None;
    }
    let measure = match unit {
        Some(unit) => Measure::Unit(unit),
        None if tokens.sign('%').is_some() => Measure::Percent,
        None => Measure::Bare,
    };
    Some(Deviation { number: sign.unwrap_or(1.0) * number, measure, extent: Extent::from(start).to(tokens.last) })
}

/// Rejects a misspelt law after a plain number, where it looks like a unit.
fn is_no_law(unit: &Unit) -> Parsed<()> {
    let [factor] = unit.factors.as_slice() else {
        return Ok(());
    };
    let name = &factor.name;
    if units::find(name).is_some() || units::suggestion(name).is_some() {
        return Ok(());
    }
    match suggested_law(name) {
        Some(_) => Err(unknown_law(name, factor.extent)),
        None => Ok(()),
    }
}

fn law(tokens: &mut Tokens) -> Parsed<Option<Law>> {
    let Some(word) = tokens.peek_ident() else {
        return Ok(None);
    };
    let text = word.to_string();
    if KEYWORDS.contains(&text.as_str()) {
        return Ok(None);
    }
    tokens.ident();
    let kind = match text.as_str() {
        "normal" => LawKind::Normal,
        "truncated" => truncated(tokens)?,
        "uniform" => LawKind::Uniform,
        "triangular" => LawKind::Triangular,
        "lognormal" => LawKind::Lognormal,
        "weibull" => LawKind::Weibull,
        "beta" => beta(&word, tokens)?,
        unknown => return Err(unknown_law(unknown, (&word).into())),
    };
    let extent = Extent::from(&word).to(tokens.last);
    if tokens.group(Delimiter::Parenthesis).is_some() {
        let message = "this law has no parameters";
        let help = "the limits say how wide it is";
        let extent = extent.to(tokens.last);
        return mistake_with_help(extent, message, help);
    }
    Ok(Some(Law { kind, extent }))
}

fn truncated(tokens: &mut Tokens) -> Parsed<LawKind> {
    match tokens.word("normal") {
        Some(_) => Ok(LawKind::TruncatedNormal),
        None => tokens.expected("`normal`").map_err(helped("only a normal law is truncated: `truncated normal`")),
    }
}

fn beta(word: &Ident, tokens: &mut Tokens) -> Parsed<LawKind> {
    const SHAPES: &str = "both shapes are given: `beta(2, 3)`";
    let Some((_, mut content, _)) = tokens.group(Delimiter::Parenthesis) else {
        return mistake_with_help(word, "`beta` has two shapes, none is given", SHAPES);
    };
    let shapes = list(&mut content, 0).map_err(helped(SHAPES))?;
    let count = shapes.len();
    match <[Value; 2]>::try_from(shapes) {
        Ok(shapes) => Ok(LawKind::Beta(Box::new(shapes))),
        Err(_) => {
            let message = format!("`beta` has two shapes, not {count}");
            let extent = Extent::from(word).to(tokens.last);
            mistake_with_help(extent, message, SHAPES)
        }
    }
}

fn unknown_law(name: &str, extent: Extent) -> Box<Diagnostic> {
    let per_cent = ["cent", "percent"].contains(&name);
    let help = match suggested_law(name) {
        _ if per_cent => "per cent are written `%`: `+/- 3%`".to_string(),
        Some(law) => format!("did you mean `{law}`?"),
        None => "a law is normal, truncated normal, uniform, triangular, lognormal, weibull or beta(2, 3)".to_string(),
    };
    Box::new(Diagnostic::new(extent, format!("unknown law `{name}`")).with_help(help))
}
