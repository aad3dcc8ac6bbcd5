//! The items of a declaration, one function per keyword.

use proc_macro2::Ident;

use super::super::ast::{
    Argument, Constraint, Correlated, Curve, Design, Every, Force, Gravity, Input, ItemKind, Material, Named,
    NamedCall, Point, Stated, Unbalance,
};
use super::super::print;
use super::super::tokens::{Parsed, Tokens, helped, mistake_with_help};
use super::body::{argument, body, named_call};
use super::joint::joint;
use super::names::{colon, declared_name, pattern, reference};
use super::placement::placement;
use super::tolerance::{nominal, tolerance};
use super::unit;
use super::value::{value, value_before};
use super::words::{COMMENT, instead_of};
use crate::base::diagnostics::Diagnostic;
use crate::base::span::Extent;

/// Reads an item up to its semicolon.
pub(super) fn item(tokens: &mut Tokens) -> Parsed<ItemKind> {
    let Some(keyword) = tokens.peek_ident() else {
        let is_comment = ['%', '!', '/', '\''].iter().any(|&sign| tokens.peek_sign(sign));
        return tokens
            .expected("an item such as `body` or `joint`")
            .map_err(|error| if is_comment { Box::new(error.with_help(COMMENT)) } else { error });
    };
    let read: fn(&mut Tokens) -> Parsed<ItemKind> = match keyword.to_string().as_str() {
        "input" => input,
        "design" => design,
        "let" => |tokens| stated(tokens).map(ItemKind::Let),
        "curve" => curve,
        "gravity" => return gravity(tokens),
        "kernels" => return kernels_only(tokens),
        "body" => body,
        "joint" => joint,
        "point" => point,
        "force" => force,
        "every" => every,
        "unbalance" => return unbalance(tokens),
        "material" => return material(tokens),
        "correlated" => return correlated(tokens),
        "constraint" => constraint,
        "steady" => |tokens| named(tokens).map(ItemKind::Steady),
        "output" => |tokens| stated(tokens).map(ItemKind::Output),
        unknown => {
            let message = format!("unknown item `{unknown}`");
            let diagnostic = Diagnostic::new(&keyword, message).with_help(instead_of(unknown));
            return Err(Box::new(diagnostic));
        }
    };
    tokens.ident();
    read(tokens)
}

fn input(tokens: &mut Tokens) -> Parsed<ItemKind> {
    let name = declared_name(tokens)?;
    has_no_value(tokens, &name, "rad/s")?;
    colon(tokens)?;
    let unit = unit::declared(tokens)?;
    has_no_value(tokens, &name, &print::unit(&unit))?;
    Ok(ItemKind::Input(Input { name, unit, tolerance: tolerance(tokens)? }))
}

/// An operating point belongs to a study, not to the mechanism.
fn has_no_value(tokens: &Tokens, name: &Ident, unit: &str) -> Parsed<()> {
    if !tokens.peek_sign('=') {
        return Ok(());
    }
    let message = format!("`{name}` is an input: its value is chosen at run time");
    let help = format!(
        "write `input {name}: {unit};` and give the value to the study with `.input(...)`, or declare a `design` variable"
    );
    mistake_with_help(tokens.span(), message, help)
}

fn design(tokens: &mut Tokens) -> Parsed<ItemKind> {
    let name = declared_name(tokens)?;
    equals(tokens, &name)?;
    Ok(ItemKind::Design(Design { name, nominal: nominal(tokens)?, tolerance: tolerance(tokens)? }))
}

/// Reads the sign between a name and its value, which says its unit.
fn equals(tokens: &mut Tokens, name: &Ident) -> Parsed<Extent> {
    let read = tokens.expect_sign('=', "`=`");
    read.map_err(|error| {
        if tokens.peek_sign(':') {
            Box::new(error.with_help(format!("write `{name} = ...`: its unit is that of the value")))
        } else {
            error
        }
    })
}

fn named(tokens: &mut Tokens) -> Parsed<Named> {
    let name = declared_name(tokens)?;
    equals(tokens, &name)?;
    let value = value(tokens)?;
    Ok(Named { name, value })
}

fn stated(tokens: &mut Tokens) -> Parsed<Stated> {
    let name = declared_name(tokens)?;
    let unit = match tokens.sign(':') {
        Some(_) => Some(unit::declared(tokens)?),
        None => None,
    };
    equals(tokens, &name)?;
    Ok(Stated { name, unit, value: value(tokens)? })
}

const CURVE: &str = "write `curve stiffness: [1000, 2000, 3000] rpm -> [5, 6, 6.5] MN/m;`";

fn curve(tokens: &mut Tokens) -> Parsed<ItemKind> {
    let help = helped(CURVE);
    let name = declared_name(tokens)?;
    colon(tokens).map_err(help)?;
    let arguments = value_before(tokens, |tokens| tokens.peek_arrow())?;
    if !tokens.peek_arrow() {
        return tokens.expected("`->`").map_err(help);
    }
    tokens.expect_sign('-', "`->`")?;
    tokens.expect_sign('>', "`->`")?;
    let values = value(tokens)?;
    Ok(ItemKind::Curve(Curve { name, arguments, values }))
}

const GRAVITY: &str = "write `gravity 9.81 m/s^2 along -z;`";

fn gravity(tokens: &mut Tokens) -> Parsed<ItemKind> {
    let keyword = tokens.expect_word("gravity")?;
    if tokens.peek_sign('=') {
        return tokens.expected("a value").map_err(helped(GRAVITY));
    }
    let magnitude = value(tokens)?;
    if tokens.peek_sign(',') {
        return tokens.expected("`along`").map_err(helped(GRAVITY));
    }
    let along = match tokens.word("along") {
        Some(_) => Some(value(tokens)?),
        None => None,
    };
    Ok(ItemKind::Gravity(Gravity { keyword, value: magnitude, along }))
}

fn force(tokens: &mut Tokens) -> Parsed<ItemKind> {
    let name = declared_name(tokens)?;
    colon(tokens)?;
    let law = named_call(tokens, "a law such as `spring`")?;
    Ok(ItemKind::Force(Force { name, law }))
}

const EVERY: &str =
    "write `every angle: spring(stiffness: 10 N*m/rad);` or `every displacement: spring(stiffness: 10 N/m);`";

fn every(tokens: &mut Tokens) -> Parsed<ItemKind> {
    let help = helped(EVERY);
    let quantity = tokens.name("`angle` or `displacement`").map_err(help)?;
    colon(tokens).map_err(help)?;
    let law = named_call(tokens, "a law such as `spring`").map_err(help)?;
    Ok(ItemKind::Every(Every { quantity, law }))
}

const UNBALANCE: &str = "write `unbalance u: on disk, amount: 20 g*mm, angle: 30 deg, at [0, 0, 10] mm;`";

fn unbalance(tokens: &mut Tokens) -> Parsed<ItemKind> {
    let help = helped(UNBALANCE);
    let Some(word) = tokens.ident() else {
        return tokens.expected("`unbalance`");
    };
    let name = declared_name(tokens)?;
    colon(tokens).map_err(help)?;
    tokens.expect_word("on").map_err(help)?;
    let on = reference(tokens, "a body").map_err(help)?;
    let (mut arguments, mut at) = (Vec::new(), None);
    while tokens.sign(',').is_some() {
        if at.is_none() && tokens.word("at").is_some() {
            at = Some(value(tokens)?);
        } else if tokens.peek_named() {
            arguments.push(argument(tokens)?);
        } else {
            return tokens.expected("`at` or a named argument such as `amount: 20 g*mm`").map_err(help);
        }
    }
    Ok(ItemKind::Unbalance(Unbalance { name, on, call: NamedCall { word, arguments: Some(arguments) }, at }))
}

const MATERIAL: &str = "write `material steel: density 7850 kg/m^3, modulus 210 GPa, poisson 0.3;`";

fn material(tokens: &mut Tokens) -> Parsed<ItemKind> {
    let help = helped(MATERIAL);
    let Some(word) = tokens.ident() else {
        return tokens.expected("`material`");
    };
    let name = declared_name(tokens)?;
    colon(tokens).map_err(help)?;
    let mut arguments = Vec::new();
    loop {
        let name = tokens.name("a property such as `density`").map_err(help)?;
        let value = value(tokens)?;
        arguments.push(Argument { name, value, of: None });
        if tokens.sign(',').is_none() {
            break;
        }
    }
    Ok(ItemKind::Material(Material { name, call: NamedCall { word, arguments: Some(arguments) } }))
}

const CORRELATED: &str = "write `correlated 0.8: left.k, right.k;` or `correlated 0.8: blade[..].mass;`";

fn correlated(tokens: &mut Tokens) -> Parsed<ItemKind> {
    let help = helped(CORRELATED);
    let keyword = tokens.expect_word("correlated")?;
    let start = tokens.span();
    let sign = if tokens.sign('-').is_some() { -1.0 } else { 1.0 };
    let number = tokens.literal().and_then(|literal| literal.to_string().parse::<f64>().ok());
    let Some(correlation) = number.map(|number| sign * number).filter(|number| number.abs() < 1.0) else {
        let message = "a correlation is a number between -1 and 1";
        return Err(help(Box::new(Diagnostic::new(Extent::from(start).to(tokens.last), message))));
    };
    colon(tokens).map_err(help)?;
    let mut names = Vec::new();
    loop {
        names.push(pattern(tokens).map_err(help)?);
        if tokens.sign(',').is_none() {
            return Ok(ItemKind::Correlated(Correlated { correlation, names, keyword }));
        }
    }
}

fn kernels_only(tokens: &mut Tokens) -> Parsed<ItemKind> {
    let keyword = tokens.expect_word("kernels")?;
    let only = tokens.expect_word("only").map_err(helped("write `kernels only;`"))?;
    Ok(ItemKind::KernelsOnly(keyword.to(only)))
}

fn constraint(tokens: &mut Tokens) -> Parsed<ItemKind> {
    let name = declared_name(tokens)?;
    colon(tokens)?;
    let law = named_call(tokens, "a constraint such as `coincident`")?;
    Ok(ItemKind::Constraint(Constraint { name, law }))
}

fn point(tokens: &mut Tokens) -> Parsed<ItemKind> {
    let name = declared_name(tokens)?;
    colon(tokens)?;
    let frame = reference(tokens, "a body or `ground`")?;
    let placement = placement(tokens)?;
    Ok(ItemKind::Point(Point { name, frame, placement }))
}
