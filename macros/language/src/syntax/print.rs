//! From the syntax tree to canonical text: one item per line, one spelling for each construct. Parsing the text gives
//! the same tree.

use std::fmt::Write as _;

use quote::ToTokens as _;

use super::ast::{
    Argument, Ast, Body, Deviation, Deviations, Item, ItemKind, Joint, JointArgument, JointClause, LawKind, Limits,
    Measure, NamedCall, Operator, Placement, Stated, Tolerance, Unit, UnitFactor, Value, ValueKind,
};
use crate::base::names::written;

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
    written(&text).into_owned()
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
        syn::Expr::Lit(syn::ExprLit { lit: syn::Lit::Str(text), .. }) if pair.path.is_ident("doc") => {
            Some(text.value())
        }
        _ => None,
    }
}

/// A doc comment, or an attribute if a comment would lose a line break or become `////`.
fn doc_line(doc: &str, indent: &str, text: &mut String) {
    if doc.contains(['\n', '\r']) || doc.starts_with('/') {
        line(text, indent, &format!("#[doc = {doc:?}]"));
    } else {
        line(text, indent, &format!("///{doc}"));
    }
}

fn item(kind: &ItemKind) -> String {
    match kind {
        ItemKind::Input(input) => {
            format!("input {}: {}{}", input.name, unit(&input.unit), tolerance(input.tolerance.as_ref()))
        }
        ItemKind::Design(design) => {
            format!("design {} = {}{}", design.name, value(&design.nominal), tolerance(design.tolerance.as_ref()))
        }
        ItemKind::Let(of) => format!("let {}", stated(of)),
        ItemKind::Curve(curve) => {
            format!("curve {}: {} -> {}", curve.name, value(&curve.arguments), value(&curve.values))
        }
        ItemKind::Steady(named) => format!("steady {} = {}", named.name, value(&named.value)),
        ItemKind::Output(of) => format!("output {}", stated(of)),
        ItemKind::Gravity(gravity) => match &gravity.along {
            Some(along) => format!("gravity {} along {}", value(&gravity.value), value(along)),
            None => format!("gravity {}", value(&gravity.value)),
        },
        ItemKind::Correlated(of) => {
            let names: Vec<&str> = of.names.iter().map(|(name, _)| name.as_str()).collect();
            format!("correlated {}: {}", of.correlation, names.join(", "))
        }
        ItemKind::Cyclic(of) => {
            format!("cyclic {}[{}..{}] about {}", of.name, of.members.start, of.members.end, value(&of.about))
        }
        ItemKind::KernelsOnly(_) => "kernels only".to_string(),
        ItemKind::Body(item) => body(item),
        ItemKind::Force(force) => format!("force {}: {}", force.name, call(&force.law)),
        ItemKind::Unbalance(unbalance) => {
            let mut text = format!("unbalance {}: on {}", unbalance.name, unbalance.on);
            for each in unbalance.call.arguments.iter().flatten() {
                let _ = write!(text, ", {}", argument(each));
            }
            if let Some(at) = &unbalance.at {
                let _ = write!(text, ", at {}", value(at));
            }
            text
        }
        ItemKind::Material(material) => {
            let properties = material.call.arguments.iter().flatten();
            let properties: Vec<String> =
                properties.map(|property| format!("{} {}", property.name, value(&property.value))).collect();
            format!("material {}: {}", material.name, properties.join(", "))
        }
        ItemKind::Every(every) => format!("every {}: {}", every.quantity, call(&every.law)),
        ItemKind::Constraint(constraint) => {
            format!("constraint {}: {}", constraint.name, call(&constraint.law))
        }
        ItemKind::Point(point) => format!("point {}: {}{}", point.name, point.frame, placed(point.placement.as_ref())),
        ItemKind::Joint(item) => joint(item),
    }
}

fn stated(Stated { name, unit: of, value: is }: &Stated) -> String {
    let of = of.as_ref().map_or_else(String::new, |of| format!(": {}", unit(of)));
    format!("{name}{of} = {}", value(is))
}

/// A tolerance, preceded by a space.
pub fn tolerance(tolerance: Option<&Tolerance>) -> String {
    let Some(tolerance) = tolerance else {
        return String::new();
    };
    let mut text = match &tolerance.limits {
        Limits::Percent(percent) => format!(" +/- {percent}%"),
        Limits::HalfWidth(width) => format!(" +/- {}", value(width)),
        Limits::Deviations(both) => format!(" {}", deviations(both)),
        Limits::Values(of) => match &of.weights {
            None => format!(" one of {}", value(&of.values)),
            Some(weights) => format!(" one of {} weighted {}", value(&of.values), value(weights)),
        },
    };
    if let Some(of) = &tolerance.law {
        let _ = write!(text, " {}", law(&of.kind));
    }
    text
}

/// Limits with their signs, the upper one first.
pub fn deviations(deviations: &Deviations) -> String {
    let text = |Deviation { number, measure, .. }: &Deviation| match measure {
        Measure::Bare => format!("{number:+?}"),
        Measure::Percent => format!("{number:+?}%"),
        Measure::Unit(of) => format!("{number:+?} {}", unit(of)),
    };
    format!("{} {}", text(&deviations.upper), text(&deviations.lower))
}

fn law(law: &LawKind) -> String {
    match law {
        LawKind::Normal => "normal".to_string(),
        LawKind::TruncatedNormal => "truncated normal".to_string(),
        LawKind::Uniform => "uniform".to_string(),
        LawKind::Triangular => "triangular".to_string(),
        LawKind::Lognormal => "lognormal".to_string(),
        LawKind::Weibull => "weibull".to_string(),
        LawKind::Beta(shapes) => format!("beta({})", list(shapes.as_slice())),
    }
}

fn body(body: &Body) -> String {
    let mut text = format!("body {}:", body.name);
    for (index, term) in body.terms.iter().enumerate() {
        let sign = match (term.hole, index) {
            (true, 0) => " -",
            (true, _) => " - ",
            (false, 0) => " ",
            (false, _) => " + ",
        };
        let placement = placed(term.placement.as_ref());
        let _ = write!(text, "{sign}{}{placement}", call(&term.shape));
    }
    if let Some(speed) = &body.spinning {
        let _ = write!(text, " spinning at {}", value(speed));
    }
    text
}

fn joint(joint: &Joint) -> String {
    let mut text = format!("joint {}: {}", joint.name, joint.kind);
    if let Some(arguments) = &joint.arguments {
        let arguments: Vec<String> = arguments.iter().map(joint_argument).collect();
        let _ = write!(text, "({})", arguments.join(", "));
    }
    let _ = write!(text, " from {}", joint.from);
    if let Some(station) = &joint.from_station {
        let _ = write!(text, " at {}", value(station));
    }
    let _ = write!(text, " to {}", joint.to);
    for (index, clause) in joint.clauses.iter().enumerate() {
        let is_placement = matches!(clause, JointClause::Placement { .. });
        if index > 0 || !is_placement {
            text.push(',');
        }
        match clause {
            JointClause::Placement { placement, on } => {
                text.push_str(&placed(Some(placement)));
                if let Some(on) = on {
                    let _ = write!(text, " on {on}");
                }
            }
            JointClause::Drive(drive) => {
                if let Some(coordinate) = &drive.coordinate {
                    let _ = write!(text, " {coordinate}");
                }
                let _ = write!(text, " driven at {}", value(&drive.speed));
            }
            JointClause::Coast(coast) => {
                if let Some(coordinate) = &coast.coordinate {
                    let _ = write!(text, " {coordinate}");
                }
                text.push_str(" coasting");
            }
            JointClause::Shake(shake) => {
                if let Some(coordinate) = &shake.coordinate {
                    let _ = write!(text, " {coordinate}");
                }
                let _ = write!(text, " {}", call(&shake.call));
            }
            JointClause::Cut(_) => text.push_str(" cut"),
        }
    }
    text
}

fn joint_argument(argument: &JointArgument) -> String {
    match &argument.name {
        Some(name) => format!("{name}: {}", value(&argument.value)),
        None => value(&argument.value),
    }
}

/// A placement, with a space before each of its words.
fn placed(placement: Option<&Placement>) -> String {
    let mut text = String::new();
    let Some(placement) = placement else {
        return text;
    };
    if let Some(offset) = &placement.offset {
        let _ = write!(text, " at {}", value(offset));
    }
    for (axis, angle) in &placement.rotations {
        let _ = write!(text, " rotated({}, {})", value(axis), value(angle));
    }
    text
}

fn call(call: &NamedCall) -> String {
    let Some(arguments) = &call.arguments else {
        return call.word.to_string();
    };
    let arguments: Vec<String> = arguments.iter().map(argument).collect();
    format!("{}({})", call.word, arguments.join(", "))
}

fn argument(argument: &Argument) -> String {
    let of = match &argument.of {
        Some(of) => format!(" of {of}"),
        None => String::new(),
    };
    format!("{}: {}{of}", argument.name, value(&argument.value))
}

fn list(values: &[Value]) -> String {
    let values: Vec<String> = values.iter().map(value).collect();
    values.join(", ")
}

/// A value; parentheses are nodes of the tree, so none are added.
pub fn value(tree: &Value) -> String {
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
        ValueKind::Sections(calls) => {
            let calls: Vec<String> = calls.iter().map(call).collect();
            calls.join(" to ")
        }
        ValueKind::Fraction(fraction) => format!("{fraction:?} length"),
        ValueKind::Station(station) => format!("station {station}"),
        ValueKind::File(name) => format!("{name:?}"),
        ValueKind::Parenthesised(inner) => format!("({})", value(inner)),
    }
}

/// A unit: `m/s^2`, `kg/(m*s)`, `1/s`, and `1` without factors.
pub fn unit(unit: &Unit) -> String {
    let factors = &unit.factors;
    let above = factors.iter().take_while(|factor| factor.exponent > 0).count();
    let (numerator, rest) = factors.split_at(above);
    let mut text = if numerator.is_empty() { "1".to_string() } else { product(numerator) };
    match rest {
        [] => {}
        [one] => text.push_str(&format!("/{}", product(std::slice::from_ref(one)))),
        several if several.iter().all(|factor| factor.exponent < 0) => {
            text.push_str(&format!("/({})", product(several)));
        }
        // Factors above and below the line alternate; keep the order, which is part of the tree.
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
