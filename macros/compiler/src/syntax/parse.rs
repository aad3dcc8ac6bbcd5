//! Tokens to tree. A syntax error ends its item, not the declaration: reading goes on after the next semicolon.

mod body;
mod item;
mod joint;
mod placement;
mod unit;
mod value;

use proc_macro2::{Delimiter, TokenStream};
use syn::buffer::TokenBuffer;
use syn::parse::Parser as _;

use super::ast::{Ast, Item, ItemKind};
use super::tokens::{Parsed, Tokens};
use crate::base::diagnostics::{Diagnostic, Diagnostics};
use crate::base::span::Extent;

/// Reads a declaration.
pub fn parse(tokens: TokenStream) -> Result<Ast, Diagnostics> {
    let buffer = TokenBuffer::new2(tokens);
    let mut tokens = Tokens::top(buffer.begin());
    let mut diagnostics = Diagnostics::new();
    match declaration(&mut tokens, &mut diagnostics) {
        Ok(ast) => diagnostics.into_result(ast),
        Err(diagnostic) => {
            diagnostics.push(*diagnostic);
            Err(diagnostics)
        }
    }
}

fn declaration(tokens: &mut Tokens, diagnostics: &mut Diagnostics) -> Parsed<Ast> {
    let mut head = TokenStream::new();
    while !tokens.is_empty() && !tokens.peek_word("mechanism") {
        match tokens.cursor.token_tree() {
            // An item where the declaration should start: nothing further on is worth reporting.
            Some((proc_macro2::TokenTree::Ident(ident), _)) if ident != "pub" => break,
            Some((token, _)) => head.extend([token]),
            None => break,
        }
        tokens.skip();
    }
    if tokens.word("mechanism").is_none() {
        return match tokens.expected::<Ast>("`mechanism NAME { ... }`") {
            Err(diagnostic) => Err(Box::new(
                diagnostic.with_help("declare it as `pub mechanism Pendulum { ... }`"),
            )),
            ok => ok,
        };
    }
    let (attributes, visibility) = attributes_and_visibility
        .parse2(head)
        .map_err(|error| Box::new(Diagnostic::new(error.span(), error.to_string())))?;
    let name = tokens.name("the mechanism's name")?;
    let Some((_, mut content, _)) = tokens.group(Delimiter::Brace) else {
        return tokens.expected("`{`");
    };
    if !tokens.is_empty() {
        let error = tokens.expected::<()>("nothing after the mechanism");
        diagnostics.extend(error.err().map(|diagnostic| {
            diagnostic.with_help("declare every mechanism in a `mechanism!` of its own")
        }));
    }
    let items = items(&mut content, diagnostics);
    Ok(Ast {
        attributes,
        visibility,
        name,
        items,
    })
}

fn attributes_and_visibility(
    input: syn::parse::ParseStream<'_>,
) -> syn::Result<(Vec<syn::Attribute>, syn::Visibility)> {
    Ok((input.call(syn::Attribute::parse_outer)?, input.parse()?))
}

fn items(tokens: &mut Tokens, diagnostics: &mut Diagnostics) -> Vec<Item> {
    let mut items = Vec::new();
    while !tokens.is_empty() {
        // A stray semicolon does no harm.
        if tokens.sign(';').is_some() {
            continue;
        }
        match item(tokens, diagnostics) {
            Ok(item) => items.push(item),
            Err(diagnostic) => {
                diagnostics.push(*diagnostic);
                skip_item(tokens);
            }
        }
    }
    items
}

fn item(tokens: &mut Tokens, diagnostics: &mut Diagnostics) -> Parsed<Item> {
    let docs = docs(tokens)?;
    let kind = item::item(tokens)?;
    if tokens.sign(';').is_none() {
        if tokens.is_empty() || starts_item(tokens) {
            // The item itself is whole: go on with the next.
            diagnostics.error(tokens.last, "expected `;` after this");
        } else {
            return tokens.expected("`;`").map_err(|error| match kind {
                ItemKind::Design(_) if tokens.peek_sign('%') => {
                    Box::new(error.with_help("a tolerance is written `+/- 3%`"))
                }
                ItemKind::Constraint(_) if tokens.peek_word("from") => Box::new(
                    error.with_help("what connects two bodies is a `joint`; it may close a loop"),
                ),
                _ => error,
            });
        }
    }
    Ok(Item { docs, kind })
}

/// Doc comments; other attributes mean nothing inside a declaration.
fn docs(tokens: &mut Tokens) -> Parsed<Vec<String>> {
    let mut docs = Vec::new();
    while let Some(sign) = tokens.sign('#') {
        let Some((_, mut content, close)) = tokens.group(Delimiter::Bracket) else {
            return tokens.expected("a doc comment");
        };
        let text = content
            .word("doc")
            .and_then(|_| content.sign('='))
            .and_then(|_| content.literal())
            .and_then(|literal| match syn::Lit::new(literal) {
                syn::Lit::Str(text) => Some(text.value()),
                _ => None,
            });
        match text {
            Some(text) => docs.push(text),
            None => {
                return Err(Box::new(Diagnostic::new(
                    sign.to(Extent::from(close)),
                    "only doc comments may stand before an item",
                )));
            }
        }
    }
    Ok(docs)
}

/// Skips the rest of a wrong item: past the next semicolon, or to what is clearly the next item.
fn skip_item(tokens: &mut Tokens) {
    let mut first = true;
    while !tokens.is_empty() {
        if tokens.sign(';').is_some() {
            return;
        }
        if !first && starts_item(tokens) {
            return;
        }
        first = false;
        tokens.skip();
    }
}

/// A keyword and a name and `:` or `=` follow, or a doc comment.
fn starts_item(tokens: &Tokens) -> bool {
    let mut ahead = *tokens;
    if ahead.sign('#').is_some() {
        return ahead.group(Delimiter::Bracket).is_some();
    }
    let Some(word) = ahead.ident() else {
        return false;
    };
    if word == "gravity" {
        return true;
    }
    item::KEYWORDS.contains(&word.to_string().as_str())
        && ahead.ident().is_some()
        && (ahead.peek_sign(':') || ahead.peek_sign('='))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::syntax::ast::{Value, ValueKind};
    use crate::syntax::print::print;

    /// The canonical text of a value.
    fn value(text: &str) -> String {
        let source = format!("mechanism M {{ let a = {text}; }}");
        let ast = parse(source.parse().unwrap()).unwrap_or_else(|errors| panic!("{errors}"));
        let printed = print(&ast);
        let (_, after) = printed.split_once(" = ").unwrap();
        after.split(';').next().unwrap().to_string()
    }

    #[test]
    fn after_a_number_the_unit_wins() {
        assert_eq!(value("3kg*m/s^2"), "3.0 kg*m/s^2");
        assert_eq!(value("3 kg * m / 2"), "3.0 kg*m / 2.0");
        assert_eq!(value("3 kg * l"), "3.0 kg * l");
        assert_eq!(value("3 * kg"), "3.0 * kg");
        assert_eq!(value("5 1/s"), "5.0 1/s");
        assert_eq!(value("2 N/(m*s)"), "2.0 N/(m*s)");
        assert_eq!(value("2 N/(m*l)"), "2.0 N / (m * l)");
        assert_eq!(value("[1, 2, 3] mm + b"), "[1.0, 2.0, 3.0] mm + b");
        assert_eq!(value("1 m^-2"), "1.0 1/m^2");
        assert_eq!(value("1 m/s*kg/N"), "1.0 m/s*kg/N");
        assert_eq!(value("1 1/m/s"), "1.0 1/(m*s)");
    }

    #[test]
    fn operators_group_as_in_mathematics() {
        fn grouped(value: &Value) -> String {
            match &value.kind {
                ValueKind::Name(name) => name.to_string(),
                ValueKind::Negate(of) => format!("(-{})", grouped(of)),
                ValueKind::Component(of, axis) => format!("({}.{axis})", grouped(of)),
                ValueKind::Binary(binary) => {
                    let sign = binary.operator.sign();
                    format!(
                        "({}{sign}{})",
                        grouped(&binary.left),
                        grouped(&binary.right)
                    )
                }
                other => panic!("{other:?}"),
            }
        }
        let tree = |text: &str| {
            let source = format!("mechanism M {{ let a = {text}; }}");
            let ast = parse(source.parse().unwrap()).unwrap_or_else(|errors| panic!("{errors}"));
            match &ast.items[0].kind {
                ItemKind::Let(named) => grouped(&named.value),
                other => panic!("{other:?}"),
            }
        };
        assert_eq!(tree("a - b - c"), "((a-b)-c)");
        assert_eq!(tree("a - b * c / d"), "(a-((b*c)/d))");
        assert_eq!(tree("-a^b"), "(-(a^b))");
        assert_eq!(tree("a^-b^c"), "(a^(-(b^c)))");
        assert_eq!(tree("a * -b"), "(a*(-b))");
        assert_eq!(tree("-v.x^n"), "(-((v.x)^n))");
    }
}
