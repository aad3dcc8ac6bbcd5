//! Tree to canonical text: one item a line, one way to write each thing. Parsing the text gives the tree back.

use std::fmt::Write as _;

use quote::ToTokens as _;

use super::ast::{
    Ast, Item, ItemKind, Joint, JointClause, NamedCall, Operator, Placement, ToleranceKind, Unit,
    UnitFactor, Value, ValueKind,
};

/// The canonical text of a declaration.
pub fn print(ast: &Ast) -> String {
    let mut text = String::new();
    for attribute in &ast.attributes {
        match documentation(attribute) {
            Some(line) => doc_line(&line, "", &mut text),
            None => line(&mut text, "", &attribute.to_token_stream().to_string()),
        }
    }
    let visibility = ast.visibility.to_token_stream().to_string();
    if !visibility.is_empty() {
        text.push_str(&visibility);
        text.push(' ');
    }
    line(&mut text, "", &format!("mechanism {} {{", ast.name));
    for Item { docs, kind } in &ast.items {
        for doc in docs {
            doc_line(doc, "    ", &mut text);
        }
        line(&mut text, "    ", &format!("{};", item(kind)));
    }
    text.push_str("}\n");
    text
}

fn line(text: &mut String, indent: &str, content: &str) {
    text.push_str(indent);
    text.push_str(content);
    text.push('\n');
}

fn documentation(attribute: &syn::Attribute) -> Option<String> {
    let syn::Meta::NameValue(pair) = &attribute.meta else {
        return None;
    };
    match &pair.value {
        syn::Expr::Lit(syn::ExprLit {
            lit: syn::Lit::Str(text),
            ..
        }) if pair.path.is_ident("doc") => Some(text.value()),
        _ => None,
    }
}

/// A doc comment, or an attribute where a comment would lose a line break or become `////`.
fn doc_line(doc: &str, indent: &str, text: &mut String) {
    if doc.contains(['\n', '\r']) || doc.starts_with('/') {
        line(text, indent, &format!("#[doc = {doc:?}]"));
    } else {
        line(text, indent, &format!("///{doc}"));
    }
}

fn item(kind: &ItemKind) -> String {
    match kind {
        ItemKind::Input(input) => format!("input {}: {}", input.name, unit(&input.unit)),
        ItemKind::Design(design) => {
            let mut text = format!("design {} = {}", design.name, value(&design.nominal));
            match design.tolerance.as_ref().map(|tolerance| &tolerance.kind) {
                Some(ToleranceKind::Relative(percent)) => {
                    let _ = write!(text, " +/- {percent}%");
                }
                Some(ToleranceKind::Absolute(width)) => {
                    let _ = write!(text, " +/- {}", value(width));
                }
                None => {}
            }
            text
        }
        ItemKind::Let(named) => format!("let {} = {}", named.name, value(&named.value)),
        ItemKind::Output(named) => format!("output {} = {}", named.name, value(&named.value)),
        ItemKind::Gravity(gravity) => match &gravity.along {
            Some(along) => format!("gravity {} along {}", value(&gravity.value), value(along)),
            None => format!("gravity {}", value(&gravity.value)),
        },
        ItemKind::Body(body) => format!("body {}: {}", body.name, call(&body.shape)),
        ItemKind::Force(force) => format!("force {}: {}", force.name, call(&force.law)),
        ItemKind::Point(point) => match &point.at {
            Some(at) => format!("point {}: {} at {}", point.name, point.frame, value(at)),
            None => format!("point {}: {}", point.name, point.frame),
        },
        ItemKind::Joint(item) => joint(item),
    }
}

fn joint(joint: &Joint) -> String {
    let mut text = format!("joint {}: {}", joint.name, joint.kind);
    if let Some(arguments) = &joint.arguments {
        let _ = write!(text, "({})", list(arguments));
    }
    let _ = write!(text, " from {} to {}", joint.from, joint.to);
    for (index, clause) in joint.clauses.iter().enumerate() {
        let words = match clause {
            JointClause::Placement(place) => placement(place),
            JointClause::Drive { speed, .. } => format!("driven at {}", value(speed)),
        };
        let comma = if index > 0 || words.starts_with("driven") {
            ","
        } else {
            ""
        };
        let _ = write!(text, "{comma} {words}");
    }
    text
}

fn placement(placement: &Placement) -> String {
    let mut words = Vec::new();
    if let Some(offset) = &placement.offset {
        words.push(format!("at {}", value(offset)));
    }
    for (axis, angle) in &placement.rotations {
        words.push(format!("rotated({}, {})", value(axis), value(angle)));
    }
    if let Some(on) = &placement.on {
        words.push(format!("on {on}"));
    }
    words.join(" ")
}

fn call(call: &NamedCall) -> String {
    let Some(arguments) = &call.arguments else {
        return call.word.to_string();
    };
    let arguments: Vec<String> = arguments
        .iter()
        .map(|argument| format!("{}: {}", argument.name, value(&argument.value)))
        .collect();
    format!("{}({})", call.word, arguments.join(", "))
}

fn list(values: &[Value]) -> String {
    let values: Vec<String> = values.iter().map(value).collect();
    values.join(", ")
}

/// A value; parentheses are nodes of the tree, so none are added.
fn value(tree: &Value) -> String {
    match &tree.kind {
        ValueKind::Number(number, None) => format!("{number:?}"),
        ValueKind::Number(number, Some(of)) => format!("{number:?} {}", unit(of)),
        ValueKind::Name(name) => name.to_string(),
        ValueKind::Vector(components, None) => format!("[{}]", list(components)),
        ValueKind::Vector(components, Some(of)) => format!("[{}] {}", list(components), unit(of)),
        ValueKind::Negate(operand) => format!("-{}", value(operand)),
        ValueKind::Binary(binary) => {
            let (left, right) = (value(&binary.left), value(&binary.right));
            match binary.operator {
                Operator::Power => format!("{left}^{right}"),
                operator => format!("{left} {} {right}", operator.sign()),
            }
        }
        ValueKind::Call(function, arguments) => format!("{function}({})", list(arguments)),
        ValueKind::Component(of, axis) => format!("{}.{axis}", value(of)),
        ValueKind::Parenthesised(inner) => format!("({})", value(inner)),
    }
}

/// A unit: `m/s^2`, `kg/(m*s)`, `1/s`, and `1` without factors.
pub fn unit(unit: &Unit) -> String {
    let factors = &unit.factors;
    let above = factors
        .iter()
        .take_while(|factor| factor.exponent > 0)
        .count();
    let (numerator, rest) = factors.split_at(above);
    let mut text = if numerator.is_empty() {
        "1".to_string()
    } else {
        product(numerator)
    };
    match rest {
        [] => {}
        [one] => text.push_str(&format!("/{}", product(std::slice::from_ref(one)))),
        several if several.iter().all(|factor| factor.exponent < 0) => {
            text.push_str(&format!("/({})", product(several)));
        }
        // Factors above and below the line alternate: the order is part of the tree.
        mixed => {
            for factor in mixed {
                text.push(if factor.exponent < 0 { '/' } else { '*' });
                text.push_str(&product(std::slice::from_ref(factor)));
            }
        }
    }
    text
}

/// Factors without the signs of their exponents.
fn product(factors: &[UnitFactor]) -> String {
    let powers: Vec<String> = factors
        .iter()
        .map(|factor| match factor.exponent.unsigned_abs() {
            1 => factor.name.clone(),
            power => format!("{}^{power}", factor.name),
        })
        .collect();
    powers.join("*")
}
