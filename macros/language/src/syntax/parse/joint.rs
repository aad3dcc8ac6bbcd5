//! Joints: a kind with its axes, two frames, placements, drives and other clauses.

use proc_macro2::Delimiter;

use super::super::ast::{Coast, Drive, ItemKind, Joint, JointArgument, JointClause, Shake};
use super::super::tokens::{Parsed, Tokens, helped};
use super::body::named_call;
use super::names::{colon, declared_name, path, peek_labelled, reference};
use super::placement::{place, placement};
use super::value::value;
use super::words::DECIMAL_POINT;

/// Reads a joint after its keyword.
pub(super) fn joint(tokens: &mut Tokens) -> Parsed<ItemKind> {
    let name = declared_name(tokens)?;
    colon(tokens)?;
    let kind = tokens.name("a joint such as `revolute(z)`")?;
    let arguments = match tokens.group(Delimiter::Parenthesis) {
        Some((_, mut content, _)) => Some(arguments(&mut content)?),
        None => None,
    };
    tokens.expect_word("from")?;
    let from = reference(tokens, "a body or `ground`")?;
    let from_station = match tokens.word("at") {
        Some(_) => Some(place(tokens)?),
        None => None,
    };
    tokens.expect_word("to")?;
    let to = reference(tokens, "a body or `ground`")?;
    let mut clauses = Vec::new();
    loop {
        let decimal = tokens.peek_decimal_comma();
        let comma = tokens.sign(',').is_some();
        match clause(tokens)? {
            Some(clause) => clauses.push(clause),
            None if comma => {
                let error = tokens.expected("`at`, `rotated`, `driven`, `coasting`, `shaken` or `cut`");
                return error.map_err(|error| if decimal { Box::new(error.with_help(DECIMAL_POINT)) } else { error });
            }
            None => break,
        }
    }
    Ok(ItemKind::Joint(Joint { name, kind, arguments, from, from_station, to, clauses }))
}

/// Reads values, each with or without a name, to the end of a group.
fn arguments(tokens: &mut Tokens) -> Parsed<Vec<JointArgument>> {
    let mut arguments = Vec::new();
    while !tokens.is_empty() {
        let name = match peek_labelled(tokens) {
            // The lead of a screw is no coordinate.
            true if tokens.peek_word("lead") => tokens.ident(),
            true => Some(declared_name(tokens)?),
            false => None,
        };
        if name.is_some() {
            colon(tokens)?;
        }
        let value = value(tokens)?;
        arguments.push(JointArgument { name, value });
        if !tokens.is_empty() {
            tokens.expect_sign(',', "`,` or an operator")?;
        }
    }
    Ok(arguments)
}

/// The words that begin a clause.
const CLAUSES: [&str; 6] = ["at", "rotated", "driven", "coasting", "shaken", "cut"];
const COASTS: &str =
    "the equations of motion determine how fast it coasts; where nothing does, `steady spin = omega;` declares it";

fn clause(tokens: &mut Tokens) -> Parsed<Option<JointClause>> {
    if let Some(placement) = placement(tokens)? {
        let on = match tokens.word("on") {
            Some(_) => Some(reference(tokens, "a body or `ground`")?),
            None => None,
        };
        return Ok(Some(JointClause::Placement { placement, on }));
    }
    let mut ahead = *tokens;
    let is_named =
        !path(&mut ahead).is_empty() && ["driven", "coasting", "shaken"].iter().any(|word| ahead.peek_word(word));
    let coordinate = if is_named { Some(reference(tokens, "a coordinate")?) } else { None };
    if let Some(keyword) = tokens.word("coasting") {
        let known = |tokens: &Tokens| CLAUSES.iter().any(|word| tokens.peek_word(word));
        let mut ahead = *tokens;
        let next = ahead.ident();
        let ends = tokens.is_empty() || tokens.peek_sign(',') || tokens.peek_sign(';');
        if !(ends || known(tokens) || next.is_some() && known(&ahead)) {
            let error = tokens.expected("`,` or `;`");
            return error.map_err(helped(COASTS));
        }
        let coast = Coast { coordinate, keyword };
        return Ok(Some(JointClause::Coast(coast)));
    }
    if tokens.peek_word("shaken") {
        let call = named_call(tokens, "`shaken`")?;
        return Ok(Some(JointClause::Shake(Shake { coordinate, call })));
    }
    if let Some(keyword) = tokens.word("cut") {
        return Ok(Some(JointClause::Cut(keyword)));
    }
    let Some(keyword) = tokens.word("driven") else {
        return Ok(None);
    };
    if !tokens.peek_word("at") {
        let error = tokens.expected("`at`");
        return error.map_err(helped("write `driven at omega`"));
    }
    tokens.expect_word("at")?;
    let speed = value(tokens)?;
    Ok(Some(JointClause::Drive(Drive { coordinate, keyword, speed })))
}
