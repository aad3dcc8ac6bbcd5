//! Parts: found before anything else is read, and read once for each instance, under its name.

use std::iter;
use std::rc::Rc;

use proc_macro2::{Delimiter, Ident};

use super::super::ast::{Body, ItemKind, Joint, JointClause, NamedCall, Placement, Point, Stated, Term, Use, Value};
use super::super::print;
use super::super::scope::{Meaning, Names, Part, Parts, Port, Scope, Turned};
use super::super::tokens::{Parsed, Tokens, helped, mistake, mistake_with_help};
use super::index::whole;
use super::names::{colon, declared_name, path, reference};
use super::placement::placement;
use super::unit;
use super::value::value;
use super::{Read, items, names_of_item, skip_item};
use crate::base::diagnostics::{Diagnostic, Diagnostics, listed};
use crate::base::names::{LINK, written};
use crate::base::nearest::nearest;

const USE: &str = "write `use left: Bearing(stiffness: k) with seat: ground, journal: shaft at 0.2 length;`";
const PART: &str = "write `part Bearing(stiffness: N/m) { port seat; port journal; ... }`";

/// Deepest that parts may stand in each other: small enough for the stack of a debug build.
const DEEPEST: usize = 32;

/// Words before braces with items.
pub(super) const BLOCKS: [&str; 3] = ["for", "part", "cyclic"];

/// Shows every item, also in loops, by its keyword and what follows.
fn each_item<'a>(mut tokens: Tokens<'a>, see: &mut dyn FnMut(&Ident, Tokens<'a>)) {
    while !tokens.is_empty() {
        let start = tokens;
        if tokens.sign('#').is_some() {
            tokens.group(Delimiter::Bracket);
            continue;
        }
        let Some(keyword) = tokens.ident() else {
            tokens.skip();
            continue;
        };
        see(&keyword, tokens);
        if BLOCKS.iter().any(|word| keyword == word) {
            if let Some(content) = block(&mut tokens).filter(|_| keyword != "part") {
                each_item(content, see);
            }
        } else {
            tokens = start;
            skip_item(&mut tokens);
        }
    }
}

/// Whether a part is next; the word may also be a name.
pub(super) fn peek(tokens: &Tokens<'_>) -> bool {
    let mut ahead = *tokens;
    let is_part = ahead.word("part").is_some() && ahead.ident().is_some();
    is_part && [Delimiter::Parenthesis, Delimiter::Brace].into_iter().any(|sign| ahead.group(sign).is_some())
}

/// Words that start items of a mechanism but not of a part, and why.
const WHOLE: [&str; 3] = ["gravity", "kernels", "every"];

/// Skips a port, and refuses what cannot stand in a part or only there.
pub(super) fn port(tokens: &mut Tokens<'_>) -> Parsed<bool> {
    let mut ahead = *tokens;
    let keyword = ahead.ident();
    let is_part = !tokens.scope.part.is_empty();
    if let Some(keyword) = keyword.filter(|keyword| is_part && WHOLE.iter().any(|word| keyword == word)) {
        let message = format!("`{keyword}` is for the whole mechanism, and cannot stand in a part");
        return mistake(&keyword, message);
    }
    if !tokens.peek_word("port") || ahead.ident().is_none() || ahead.peek_sign(':') {
        return Ok(false);
    }
    if !is_part {
        let message = "only a part has ports";
        return mistake_with_help(tokens.span(), message, PART);
    }
    if ahead.sign(';').is_none() {
        return ahead.expected("`;`");
    }
    *tokens = ahead;
    Ok(true)
}

/// An item as the instance has it: a design variable that the use gives is a constant.
pub(super) fn given(kind: ItemKind, scope: &Scope<'_>) -> ItemKind {
    let ItemKind::Design(design) = &kind else { return kind };
    let name = design.name.to_string();
    let of = |given: &str| name.strip_prefix(given).is_some_and(|rest| rest.is_empty() || rest.starts_with(LINK));
    match scope.given.iter().find(|(given, _)| of(given)) {
        Some((_, value)) => ItemKind::Let(Stated { name: design.name.clone(), unit: None, value: value.clone() }),
        None => kind,
    }
}

/// Skips to the end of the next braces, which it returns; not past a semicolon.
pub(super) fn block<'a>(tokens: &mut Tokens<'a>) -> Option<Tokens<'a>> {
    while !tokens.is_empty() && tokens.sign(';').is_none() {
        if let Some((_, content, _)) = tokens.group(Delimiter::Brace) {
            return Some(content);
        }
        tokens.skip();
    }
    None
}

/// The names that items declare.
pub(super) fn names(tokens: Tokens<'_>) -> Names {
    let mut names = Names::default();
    each_item(tokens, &mut |keyword, mut tokens| {
        if BLOCKS.iter().any(|word| keyword == word) {
            return;
        }
        let word = keyword.to_string();
        if word == "use" {
            let path = path(&mut tokens);
            if let Some(part) = tokens.sign(':').and_then(|_| tokens.ident()) {
                names.declare(&path, Meaning::Instance(part.to_string()));
            }
            return;
        }
        for path in names_of_item(keyword, tokens) {
            names.declare(&path, Meaning::Item(word.clone()));
        }
    });
    names
}

/// Finds the parts among items.
pub(super) fn find<'a>(tokens: Tokens<'a>, parts: &mut Parts<'a>, diagnostics: &mut Diagnostics) {
    each_item(tokens, &mut |keyword, mut tokens| {
        if keyword != "part" {
            return;
        }
        match part(&mut tokens) {
            Ok(part) => {
                let name = part.name.clone();
                if parts.0.insert(name.to_string(), part).is_some() {
                    diagnostics.error(&name, format!("the part `{name}` is declared twice"));
                }
            }
            Err(error) => diagnostics.push(*error),
        }
    });
}

fn part<'a>(tokens: &mut Tokens<'a>) -> Parsed<Part<'a>> {
    let help = helped(PART);
    let name = tokens.name("the part's name").map_err(help)?;
    let mut parameters = Vec::new();
    if let Some((_, mut content, _)) = tokens.group(Delimiter::Parenthesis) {
        while !content.is_empty() {
            let name = content.name("a parameter").map_err(help)?;
            colon(&mut content).map_err(help)?;
            parameters.push((name, unit::declared(&mut content)?));
            if !content.is_empty() {
                content.expect_sign(',', "`,`")?;
            }
        }
    }
    let Some((_, content, end)) = tokens.group(Delimiter::Brace) else {
        return tokens.expected("`{`").map_err(help);
    };
    let mut names = names(content);
    for (parameter, _) in &parameters {
        names.declare(&[(parameter.clone(), parameter.to_string())], Meaning::Item("parameter".to_owned()));
    }
    let tokens = content.cursor.token_stream();
    Ok(Part { name, parameters, names, content: (content.cursor, end), tokens })
}

/// The constants among items that are whole numbers, by their whole names.
pub(super) fn numbers(tokens: Tokens<'_>, scope: &mut Scope<'_>) {
    each_item(tokens, &mut |keyword, tokens| {
        if keyword == "let" {
            let read = |tokens: &mut Tokens<'_>| {
                let name = declared_name(tokens).ok()?;
                tokens.sign('=')?;
                let number = whole(tokens).ok()?;
                tokens.peek_sign(';').then(|| (name.to_string(), number))
            };
            let number = read(&mut tokens.within(scope));
            scope.numbers.extend(number);
        }
    });
}

/// Reads `use NAME: PART(NAME: VALUE, ...) with PORT: FRAME ..., ...;` and the items of the part.
pub(super) fn use_part(tokens: &mut Tokens<'_>, read: &mut Read<'_>) -> Parsed<()> {
    let help = |error: Box<Diagnostic>| match error.help {
        Some(_) => error,
        None => Box::new(error.with_help(USE)),
    };
    let around = tokens.scope;
    tokens.expect_word("use")?;
    let mut instance = declared_name(tokens)?;
    if let Some(turned) = &around.turned {
        instance = member(turned, &instance)?;
    }
    colon(tokens).map_err(help)?;
    let word = tokens.name("a part").map_err(help)?;
    let (name, part) = known_part(around, &word)?;
    let arguments = arguments(tokens, part).map_err(help)?;
    around.spend(1, &instance)?;
    let mut scope = Scope::of_instance(instance.to_string(), name, &part.names, around);
    let mut added = Vec::new();
    for (name, unit) in &part.parameters {
        let Some(Given { name: given, value, number }) = arguments.iter().find(|given| given.name == *name) else {
            let message = format!("`{instance}` lacks its `{name}`");
            let help = format!("`{word}` has the parameter `{name}: {}`", print::unit(unit));
            return mistake_with_help(&instance, message, help);
        };
        let name = Ident::new(&scope.whole(&name.to_string()), given.span());
        scope.numbers.extend(number.map(|number| (name.to_string(), number)));
        added.push(ItemKind::Let(Stated { name, unit: Some(unit.clone()), value: value.clone() }));
    }
    let Ports { points, bodies } = ports(tokens, part, &instance, &mut scope).map_err(help)?;
    added.extend(points);
    if tokens.sign(';').is_none() {
        return tokens.expected("`;`").map_err(help);
    }
    scope.given = arguments.into_iter().map(|given| (scope.whole(&given.name.to_string()), given.value)).collect();
    read.uses.push(Use { name: instance, part: name.to_owned(), tokens: part.tokens.clone() });
    for item in added {
        read.add(Vec::new(), item);
    }
    let ports = scope.ports.clone();
    items(part.content, scope, read);
    for item in bodies.into_iter().filter(|(port, _)| ports[*port].framed.get()).flat_map(|(_, items)| items) {
        read.add(Vec::new(), item);
    }
    Ok(())
}

/// The name of an instance of a ring with its index.
fn member(turned: &Turned, name: &Ident) -> Parsed<Ident> {
    if *name == turned.ring {
        return Ok(Ident::new(&turned.instance, name.span()));
    }
    let message = format!("`{}` is not the name of the ring", written(&name.to_string()));
    let help = format!("write `use {}: ...`", written(&turned.ring));
    mistake_with_help(name, message, help)
}

/// The part of a name, which must not be one that is being read.
fn known_part<'a>(around: &'a Scope<'a>, word: &Ident) -> Parsed<(&'a str, &'a Part<'a>)> {
    let name = word.to_string();
    let parts = around.parts.map(|parts| &parts.0);
    let Some((name, part)) = parts.and_then(|parts| parts.get_key_value(&name)) else {
        let error = Diagnostic::new(word, format!("unknown part `{word}`"));
        let near = nearest(&name, parts.into_iter().flatten().map(|(known, _)| known.as_str()));
        return Err(Box::new(match near {
            Some(near) => error.with_help(format!("did you mean `{near}`?")),
            None => error.with_help(PART),
        }));
    };
    let chain = iter::successors(Some(around), |scope| scope.user).map(|scope| scope.part);
    let mut circle: Vec<&str> = chain.take_while(|part| !part.is_empty()).collect();
    if circle.contains(&name.as_str()) {
        circle.reverse();
        circle.push(name);
        let message = format!("a part cannot contain itself: `{}`", circle.join("` uses `"));
        return mistake(word, message);
    }
    if circle.len() == DEEPEST {
        let message = format!("parts stand in parts more than {DEEPEST} deep here");
        return mistake(word, message);
    }
    Ok((name, part))
}

/// An argument of a part.
struct Given {
    name: Ident,
    value: Value,
    /// Its value if it is a whole number.
    number: Option<i64>,
}

/// Reads `(NAME: VALUE, ...)`: parameters, and design variables that the use gives.
fn arguments(tokens: &mut Tokens<'_>, part: &Part<'_>) -> Parsed<Vec<Given>> {
    let mut arguments: Vec<Given> = Vec::new();
    let Some((_, mut content, _)) = tokens.group(Delimiter::Parenthesis) else {
        return Ok(arguments);
    };
    while !content.is_empty() {
        let name = content.name("an argument")?;
        colon(&mut content)?;
        let text = name.to_string();
        let given = |keyword: &str| keyword == "parameter" || keyword == "design";
        if !part.names.0.get(&text).is_some_and(|of| matches!(of, Meaning::Item(keyword) if given(keyword))) {
            let known = part.names.0.iter().filter(|(_, of)| matches!(of, Meaning::Item(keyword) if given(keyword)));
            let known: Vec<String> = known.map(|(name, _)| format!("`{name}`")).collect();
            let message = format!("`{}` has no parameter and no design variable `{name}`", part.name);
            let help = match &known[..] {
                [] => "it has none at all".to_owned(),
                known => format!("it has {}", listed(known)),
            };
            return mistake_with_help(&name, message, help);
        }
        if arguments.iter().any(|other| other.name == name) {
            return mistake(&name, format!("`{name}` is given twice"));
        }
        let ends = |tokens: &Tokens<'_>| tokens.is_empty() || tokens.peek_sign(',');
        let mut ahead = content;
        let number = whole(&mut ahead).ok().filter(|_| ends(&ahead));
        arguments.push(Given { name, value: value(&mut content)?, number });
        if !content.is_empty() {
            content.expect_sign(',', "`,` or an operator")?;
        }
    }
    Ok(arguments)
}

/// What the ports of an instance add to it: their points, and for a joint the bodies of those that are placed, by their
/// numbers.
struct Ports {
    points: Vec<ItemKind>,
    bodies: Vec<(usize, [ItemKind; 2])>,
}

/// Reads `with PORT: FRAME PLACEMENT, ...`, and enters each port.
fn ports(tokens: &mut Tokens<'_>, part: &Part<'_>, instance: &Ident, scope: &mut Scope<'_>) -> Parsed<Ports> {
    let is_port = |of: &Meaning| matches!(of, Meaning::Item(keyword) if keyword == "port");
    let known: Vec<String> = part.names.0.iter().filter(|(_, of)| is_port(of)).map(|(name, _)| name.clone()).collect();
    let (mut points, mut bodies, mut seen) = (Vec::new(), Vec::new(), Vec::new());
    if tokens.word("with").is_some() {
        loop {
            let port = tokens.name("a port")?;
            colon(tokens)?;
            let name = port.to_string();
            if !known.contains(&name) || seen.contains(&name) {
                let twice = if seen.contains(&name) { "is placed twice" } else { "is no port" };
                let all: Vec<String> = known.iter().map(|name| format!("`{name}`")).collect();
                let message = format!("`{name}` {twice}; the ports of `{}` are {}", part.name, listed(&all));
                return mistake(&port, message);
            }
            let passed_on =
                tokens.peek_ident().and_then(|given| tokens.scope.ports.iter().find(|port| given == port.name));
            let frame = reference(tokens, "a body or `ground`")?;
            let mut placement = placement(tokens)?;
            let mut frame = frame;
            if let Some(turned) = &tokens.scope.turned {
                let around =
                    Placement { offset: None, rotations: vec![turned.rotation.clone()], keyword: port.span().into() };
                let carrier = Ident::new(&format!("{}_around", scope.whole(&name)), port.span());
                match placement {
                    None => placement = Some(around),
                    Some(_) => {
                        let carried = fixed(carrier.clone(), frame, around);
                        points.extend(carried);
                        frame = carrier;
                    }
                }
            }
            let word = |text: &str| Ident::new(text, port.span());
            let own = scope.whole(&name);
            let (frame, point) = match &placement {
                None if passed_on.is_some() => (frame, passed_on.map_or_else(|| word(&own), |port| port.point.clone())),
                None if tokens.scope.is_no_frame(&frame.to_string()) => (frame.clone(), frame),
                None => (frame, word(&own)),
                Some(placement) => {
                    let body = word(&format!("{own}_frame"));
                    bodies.push((scope.ports.len(), fixed(body.clone(), frame.clone(), placement.clone())));
                    let point = Point { name: word(&own), frame, placement: Some(placement.clone()) };
                    points.push(ItemKind::Point(point));
                    (body, word(&own))
                }
            };
            if placement.is_none() && point == own {
                points.push(ItemKind::Point(Point { name: point.clone(), frame: frame.clone(), placement: None }));
            }
            scope.ports.push(Port { name: name.clone(), frame, point, framed: Rc::default() });
            seen.push(name);
            if tokens.sign(',').is_none() {
                break;
            }
        }
    }
    match known.iter().find(|name| !seen.contains(name)) {
        None => Ok(Ports { points, bodies }),
        Some(port) => {
            let message = format!("`{instance}` lacks a place for its port `{port}`");
            mistake_with_help(instance, message, format!("write `with {port}: FRAME`"))
        }
    }
}

/// A massless body, fixed at a place of a frame.
fn fixed(name: Ident, from: Ident, placement: Placement) -> [ItemKind; 2] {
    let word = |text: &str| Ident::new(text, name.span());
    let shape = NamedCall { word: word("massless"), arguments: None };
    let terms = vec![Term { hole: false, shape, placement: None }];
    let joint = Joint {
        name: word(&format!("{name}_joint")),
        kind: word("fixed"),
        arguments: None,
        from,
        from_station: None,
        to: name.clone(),
        clauses: vec![JointClause::Placement { placement, on: None }],
    };
    [ItemKind::Body(Body { name, terms, spinning: None }), ItemKind::Joint(joint)]
}
