//! The items of a declaration, one function per keyword.

use proc_macro2::{Delimiter, Ident};

use super::super::ast::{
    Argument, Body, Design, Force, Gravity, Input, ItemKind, Joint, JointClause, Named, NamedCall,
    Placement, Point, Tolerance, ToleranceKind,
};
use super::super::tokens::{Parsed, Tokens};
use super::unit;
use super::value::{digits_and_suffix, list, value};
use crate::base::diagnostics::Diagnostic;
use crate::base::nearest::nearest;
use crate::base::span::Extent;

/// The words that start an item.
pub(super) const KEYWORDS: [&str; 9] = [
    "input", "design", "let", "gravity", "body", "joint", "point", "force", "output",
];

/// Reads an item up to its semicolon.
pub(super) fn item(tokens: &mut Tokens) -> Parsed<ItemKind> {
    let Some(keyword) = tokens.peek_ident() else {
        return tokens.expected("an item such as `body` or `joint`");
    };
    let read: fn(&mut Tokens) -> Parsed<ItemKind> = match keyword.to_string().as_str() {
        "input" => input,
        "design" => design,
        "let" => |tokens| named(tokens).map(ItemKind::Let),
        "gravity" => return gravity(tokens),
        "body" => body,
        "joint" => joint,
        "point" => point,
        "force" => force,
        "output" => |tokens| named(tokens).map(ItemKind::Output),
        unknown => {
            let message = format!("unknown item `{unknown}`");
            let diagnostic =
                Diagnostic::new(&keyword, message).with_help(match nearest(unknown, KEYWORDS) {
                    Some(known) => format!("did you mean `{known}`?"),
                    None => format!("an item starts with one of {}", KEYWORDS.join(", ")),
                });
            return Err(Box::new(diagnostic));
        }
    };
    tokens.ident();
    read(tokens)
}

fn declared_name(tokens: &mut Tokens) -> Parsed<Ident> {
    if let Some(keyword) = tokens.peek_ident()
        && KEYWORDS.iter().any(|word| keyword == word)
    {
        let message = format!("`{keyword}` cannot be a name: it starts an item");
        return Err(Box::new(Diagnostic::new(&keyword, message)));
    }
    tokens.name("a name")
}

fn colon(tokens: &mut Tokens) -> Parsed<Extent> {
    tokens.expect_sign(':', "`:`")
}

fn input(tokens: &mut Tokens) -> Parsed<ItemKind> {
    let name = declared_name(tokens)?;
    colon(tokens)?;
    let unit = unit::declared(tokens)?;
    Ok(ItemKind::Input(Input { name, unit }))
}

fn design(tokens: &mut Tokens) -> Parsed<ItemKind> {
    let name = declared_name(tokens)?;
    tokens.expect_sign('=', "`=`")?;
    let nominal = value(tokens)?;
    let tolerance = if tokens.peek_plus_minus() {
        for sign in ['+', '/', '-'] {
            tokens.sign(sign);
        }
        Some(tolerance(tokens)?)
    } else {
        None
    };
    Ok(ItemKind::Design(Design {
        name,
        nominal,
        tolerance,
    }))
}

/// A number and `%`, or a value. A percentage may be negative here, so that a rule can say what is wrong with it.
fn tolerance(tokens: &mut Tokens) -> Parsed<Tolerance> {
    let start = tokens.span();
    let mut ahead = *tokens;
    let sign = if ahead.sign('-').is_some() { -1.0 } else { 1.0 };
    let number = ahead
        .literal()
        .and_then(|literal| digits_and_suffix(&literal))
        .filter(|(_, suffix)| suffix.is_empty())
        .and_then(|(digits, _)| digits.parse::<f64>().ok())
        .filter(|percent| percent.is_finite());
    let kind = match (number, ahead.sign('%')) {
        (Some(percent), Some(_)) => {
            *tokens = ahead;
            ToleranceKind::Relative(sign * percent)
        }
        _ => ToleranceKind::Absolute(value(tokens)?),
    };
    Ok(Tolerance {
        kind,
        extent: Extent::from(start).to(tokens.last),
    })
}

fn named(tokens: &mut Tokens) -> Parsed<Named> {
    let name = declared_name(tokens)?;
    tokens.expect_sign('=', "`=`")?;
    let value = value(tokens)?;
    Ok(Named { name, value })
}

fn gravity(tokens: &mut Tokens) -> Parsed<ItemKind> {
    let keyword = tokens.expect_word("gravity")?;
    let magnitude = value(tokens)?;
    let along = match tokens.word("along") {
        Some(_) => Some(value(tokens)?),
        None => None,
    };
    Ok(ItemKind::Gravity(Gravity {
        keyword,
        value: magnitude,
        along,
    }))
}

fn body(tokens: &mut Tokens) -> Parsed<ItemKind> {
    let name = declared_name(tokens)?;
    colon(tokens)?;
    let shape = named_call(tokens, "a shape such as `rod` or `massless`")?;
    Ok(ItemKind::Body(Body { name, shape }))
}

fn force(tokens: &mut Tokens) -> Parsed<ItemKind> {
    let name = declared_name(tokens)?;
    colon(tokens)?;
    let law = named_call(tokens, "a law such as `spring`")?;
    Ok(ItemKind::Force(Force { name, law }))
}

fn named_call(tokens: &mut Tokens, what: &str) -> Parsed<NamedCall> {
    // No name is declared here, so Rust's keyword `box` will do.
    let Some(word) = tokens.ident() else {
        return tokens.expected(what);
    };
    let Some((_, mut content, _)) = tokens.group(Delimiter::Parenthesis) else {
        return Ok(NamedCall {
            word,
            arguments: None,
        });
    };
    let mut arguments = Vec::new();
    while !content.is_empty() {
        let mut ahead = content;
        let is_named = ahead.ident().is_some() && ahead.sign(':').is_some();
        if !is_named {
            return content.expected("a named argument such as `mass: 3 kg`");
        }
        let name = content.name("an argument")?;
        colon(&mut content)?;
        let value = value(&mut content)?;
        arguments.push(Argument { name, value });
        if !content.is_empty() {
            content.expect_sign(',', "`,` or an operator")?;
        }
    }
    Ok(NamedCall {
        word,
        arguments: Some(arguments),
    })
}

fn joint(tokens: &mut Tokens) -> Parsed<ItemKind> {
    let name = declared_name(tokens)?;
    colon(tokens)?;
    let kind = tokens.name("a joint such as `revolute(z)`")?;
    let arguments = match tokens.group(Delimiter::Parenthesis) {
        Some((_, mut content, _)) => Some(list(&mut content, 0)?),
        None => None,
    };
    tokens.expect_word("from")?;
    let from = tokens.name("a body or `ground`")?;
    tokens.expect_word("to")?;
    let to = tokens.name("a body or `ground`")?;
    let mut clauses = Vec::new();
    loop {
        let comma = tokens.sign(',').is_some();
        match clause(tokens)? {
            Some(clause) => clauses.push(clause),
            None if comma => return tokens.expected("`at`, `rotated` or `driven`"),
            None => break,
        }
    }
    Ok(ItemKind::Joint(Joint {
        name,
        kind,
        arguments,
        from,
        to,
        clauses,
    }))
}

fn clause(tokens: &mut Tokens) -> Parsed<Option<JointClause>> {
    if let Some(keyword) = tokens.word("driven") {
        tokens.expect_word("at")?;
        let speed = value(tokens)?;
        return Ok(Some(JointClause::Drive { keyword, speed }));
    }
    if !tokens.peek_word("at") && !tokens.peek_word("rotated") {
        return Ok(None);
    }
    let keyword = tokens.span().into();
    let offset = match tokens.word("at") {
        Some(_) => Some(value(tokens)?),
        None => None,
    };
    let mut rotations = Vec::new();
    while tokens.word("rotated").is_some() {
        rotations.push(rotation(tokens)?);
    }
    let on = match tokens.word("on") {
        Some(_) => Some(tokens.name("a body or `ground`")?),
        None => None,
    };
    Ok(Some(JointClause::Placement(Placement {
        offset,
        rotations,
        on,
        keyword,
    })))
}

fn rotation(tokens: &mut Tokens) -> Parsed<(super::Value, super::Value)> {
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

fn point(tokens: &mut Tokens) -> Parsed<ItemKind> {
    let name = declared_name(tokens)?;
    colon(tokens)?;
    let frame = tokens.name("a body or `ground`")?;
    let at = match tokens.word("at") {
        Some(_) => Some(value(tokens)?),
        None => None,
    };
    Ok(ItemKind::Point(Point { name, frame, at }))
}
