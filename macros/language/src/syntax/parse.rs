//! From tokens to the syntax tree. A syntax error ends its item, not the declaration: parsing resumes after the next
//! semicolon, and the names of the item are kept.

mod body;
mod cyclic;
mod index;
mod item;
mod joint;
mod names;
mod parts;
mod placement;
mod repeat;
mod tolerance;
mod unit;
mod value;
mod words;

pub(crate) use self::words::GRADE;
#[cfg(test)]
pub(crate) use self::words::INSIDE;

use proc_macro2::{Delimiter, Ident, TokenStream};
use syn::buffer::TokenBuffer;
use syn::parse::Parser as _;

use self::words::{COMMENT, DECIMAL_POINT, KEYWORDS};
use super::ast::{Ast, Item, ItemKind, Unread, Use, Uses, Value};
use super::scope::{Content, Parts, Scope};
use super::tokens::{Parsed, Tokens, helped};
use crate::base::diagnostics::Diagnostics;
use crate::base::names::joined;
use crate::base::quoted::{placed, quoted};
use crate::base::span::Extent;

/// Reads a declaration without syntax errors.
pub fn parse(tokens: TokenStream) -> Result<Ast, Diagnostics> {
    let mut diagnostics = Diagnostics::new();
    match parse_what_can_be_read(tokens, &mut diagnostics) {
        Some(ast) => diagnostics.into_result(ast),
        None => Err(diagnostics),
    }
}

/// Reads as much of a declaration as possible; `None` if there is no mechanism.
pub fn parse_what_can_be_read(tokens: TokenStream, diagnostics: &mut Diagnostics) -> Option<Ast> {
    let buffer = TokenBuffer::new2(tokens);
    let nothing = Scope::default();
    let mut tokens = Tokens::top(buffer.begin(), &nothing);
    match declaration(&mut tokens, diagnostics) {
        Ok(ast) => Some(ast),
        Err(diagnostic) => {
            diagnostics.push(*diagnostic);
            None
        }
    }
}

const ALONE: &str = "a file of its own has the declaration alone, without `use` and without `mechanism! { }` around it";

fn declaration(tokens: &mut Tokens, diagnostics: &mut Diagnostics) -> Parsed<Ast> {
    let start = *tokens;
    let mut head = TokenStream::new();
    while !tokens.is_empty() && !tokens.peek_word("mechanism") {
        if parts::peek(tokens) {
            // What stands before it belongs to it.
            head = TokenStream::new();
            parts::block(tokens);
            continue;
        }
        match tokens.cursor.token_tree() {
            // An item where the declaration should start: nothing after it is worth reporting.
            Some((proc_macro2::TokenTree::Ident(ident), _)) if ident != "pub" => break,
            Some((token, _)) => head.extend([token]),
            None => break,
        }
        tokens.skip();
    }
    if tokens.word("mechanism").is_none() {
        let help = if tokens.peek_word("use") { ALONE } else { "declare it as `pub mechanism Pendulum { ... }`" };
        let expected = tokens.expected::<Ast>("`mechanism NAME { ... }`");
        return expected.map_err(helped(help));
    }
    let (attributes, visibility) = match attributes_and_visibility.parse2(head) {
        Ok(read) => read,
        Err(error) => {
            diagnostics.error(error.span(), error.to_string());
            (Vec::new(), syn::Visibility::Inherited)
        }
    };
    let keyword = tokens.last;
    let name = match tokens.name("the mechanism's name") {
        Ok(name) => name,
        Err(diagnostic) if tokens.peek_sign('!') => {
            return Err(Box::new(diagnostic.with_help(ALONE)));
        }
        // The items in braces can be read anyway.
        Err(diagnostic) => {
            diagnostics.push(*diagnostic);
            if tokens.peek_ident().is_some() {
                tokens.skip();
            }
            Ident::new("mechanism", keyword)
        }
    };
    let Some((_, content, end)) = tokens.group(Delimiter::Brace) else {
        return tokens.expected("`{`");
    };
    let mut files = Vec::new();
    loop {
        if let Some(file) = file(tokens) {
            files.push(file);
            continue;
        }
        let mut ahead = *tokens;
        while ahead.sign('#').is_some() {
            ahead.group(Delimiter::Bracket);
        }
        if !parts::peek(&ahead) {
            break;
        }
        parts::block(tokens);
    }
    if !tokens.is_empty() {
        let error = tokens.expected::<()>("nothing after the mechanism");
        diagnostics.extend(
            error.err().map(|diagnostic| {
                diagnostic.with_help("declare every mechanism in a file or a `mechanism!` of its own")
            }),
        );
    }
    let mut parts = Parts::default();
    parts::find(start, &mut parts, diagnostics);
    parts::find(content, &mut parts, diagnostics);
    let names = parts::names(content);
    let scope = Scope { names: Some(&names), parts: Some(&parts), ..Scope::default() };
    let mut read = Read { items: Vec::new(), unread: Vec::new(), uses: Vec::new(), diagnostics };
    items((content.cursor, end), scope, &mut read);
    let Read { items, unread, uses, .. } = read;
    Ok(Ast { attributes, visibility, name, items, unread, uses: Uses(uses), files })
}

/// A value in a text of its own, all of it at one place of a declaration; `None` if it is none.
pub(crate) fn value_of(text: &str, at: Extent) -> Option<Value> {
    let buffer = TokenBuffer::new2(placed(text.parse().ok()?, at.first));
    let scope = Scope::default();
    let mut tokens = Tokens::top(buffer.begin(), &scope);
    let value = value::value(&mut tokens).ok()?;
    tokens.is_empty().then_some(value)
}

/// A table or a matrix with its text: `file "casing.mtx" "...";`, which follows the declarations that name it.
fn file(tokens: &mut Tokens) -> Option<(String, String)> {
    let mut ahead = *tokens;
    ahead.word("file")?;
    let [name, text] = [ahead.literal()?, ahead.literal()?];
    ahead.sign(';')?;
    *tokens = ahead;
    Some((quoted(&name)?, quoted(&text)?))
}

fn attributes_and_visibility(
    input: syn::parse::ParseStream<'_>,
) -> syn::Result<(Vec<syn::Attribute>, syn::Visibility)> {
    Ok((input.call(syn::Attribute::parse_outer)?, input.parse()?))
}

/// What has been read of a declaration.
struct Read<'a> {
    items: Vec<Item>,
    unread: Vec<Unread>,
    uses: Vec<Use>,
    diagnostics: &'a mut Diagnostics,
}

impl Read<'_> {
    fn add(&mut self, docs: Vec<String>, kind: ItemKind) {
        self.items.push(Item { docs, kind });
    }
}

/// Reads the items of a mechanism or of a part.
fn items(content: Content<'_>, mut scope: Scope<'_>, read: &mut Read<'_>) {
    parts::numbers(Tokens::content(content, &Scope::default()), &mut scope);
    several(&mut Tokens::content(content, &scope), read);
}

/// Reads items to the end of their group.
fn several(tokens: &mut Tokens<'_>, read: &mut Read<'_>) {
    while !tokens.is_empty() {
        // A stray semicolon is harmless.
        if tokens.sign(';').is_some() {
            continue;
        }
        let docs = docs(tokens, read.diagnostics);
        let start = *tokens;
        if let Err(diagnostic) = one(tokens, &docs, read) {
            read.diagnostics.push(*diagnostic);
            *tokens = start;
            if parts::BLOCKS.iter().any(|word| tokens.peek_word(word)) {
                parts::block(tokens);
                continue;
            }
            skip_item(tokens);
            read.unread.push(what_is_known(start));
        }
    }
}

/// Reads an item, or all that a loop, a use or an array stands for.
fn one(tokens: &mut Tokens<'_>, docs: &[String], read: &mut Read<'_>) -> Parsed<()> {
    if tokens.peek_word("for") {
        let scopes = repeat::rounds(tokens)?;
        let Some((_, content, _)) = tokens.group(Delimiter::Brace) else { return tokens.expected("`{`") };
        for scope in &scopes {
            several(&mut content.within(scope), read);
        }
        return Ok(());
    }
    if tokens.peek_word("cyclic") {
        return cyclic::cyclic(tokens, read);
    }
    if parts::peek(tokens) {
        // It has been read before.
        parts::block(tokens);
        return Ok(());
    }
    if parts::port(tokens)? {
        return Ok(());
    }
    let elements = match repeat::elements(tokens)? {
        None => vec![None],
        Some(range) if range.is_empty() => {
            skip_item(tokens);
            return Ok(());
        }
        Some(range) => range.map(Some).collect(),
    };
    let start = *tokens;
    for element in elements {
        *tokens = start;
        tokens.element = element;
        if tokens.peek_word("use") {
            parts::use_part(tokens, read)?;
        } else {
            let kind = item(tokens, read.diagnostics)?;
            tokens.scope.spend(1, start.span())?;
            read.add(docs.to_vec(), parts::given(kind, tokens.scope));
        }
        tokens.element = None;
    }
    Ok(())
}

fn item(tokens: &mut Tokens, diagnostics: &mut Diagnostics) -> Parsed<ItemKind> {
    let kind = item::item(tokens)?;
    if tokens.sign(';').is_none() {
        if tokens.is_empty() || starts_item(tokens) {
            // The item itself is complete: continue with the next.
            diagnostics.error(tokens.last, "expected `;` after this");
        } else {
            return tokens.expected("`;`").map_err(|error| match kind {
                _ if tokens.peek_decimal_comma() => Box::new(error.with_help(DECIMAL_POINT)),
                ItemKind::Design(_) | ItemKind::Input(_) => match tolerance::help(tokens) {
                    Some(help) => Box::new(error.with_help(help)),
                    None => error,
                },
                ItemKind::Constraint(_) if tokens.peek_word("from") => {
                    Box::new(error.with_help("what connects two bodies is a `joint`; it may close a loop"))
                }
                _ => error,
            });
        }
    }
    Ok(kind)
}

/// Reads doc comments; other attributes have no meaning inside a declaration.
fn docs(tokens: &mut Tokens, diagnostics: &mut Diagnostics) -> Vec<String> {
    let mut docs = Vec::new();
    while let Some(sign) = tokens.sign('#') {
        let Some((_, mut content, close)) = tokens.group(Delimiter::Bracket) else {
            let error = tokens.expected::<()>("a doc comment");
            diagnostics.extend(error.err().map(|diagnostic| diagnostic.with_help(COMMENT)));
            if !starts_item(tokens) {
                skip_item(tokens);
            }
            continue;
        };
        let text =
            content.word("doc").and_then(|_| content.sign('=')).and_then(|_| content.literal()).and_then(|literal| {
                match syn::Lit::new(literal) {
                    syn::Lit::Str(text) => Some(text.value()),
                    _ => None,
                }
            });
        match text {
            Some(text) => docs.push(text),
            None => diagnostics.error(sign.to(Extent::from(close)), "only doc comments may stand before an item"),
        }
    }
    docs
}

/// The keyword of an item and the names it declares.
fn what_is_known(mut tokens: Tokens) -> Unread {
    let mut item = Unread { keyword: tokens.ident(), names: Vec::new() };
    if let Some(keyword) = item.keyword.as_ref().filter(|_| !item.is_nameless()) {
        let path = |path: Vec<(Ident, String)>| {
            if let ([(name, _)], "") = (&path[..], tokens.scope.instance.as_str()) {
                return Some(name.clone());
            }
            let whole = path.iter().fold(tokens.scope.instance.clone(), |whole, (_, name)| joined(&whole, name));
            Some(Ident::new(&whole, path.first()?.0.span()))
        };
        item.names = names_of_item(keyword, tokens).into_iter().filter_map(path).collect();
    }
    item
}

/// The names that an item declares, after its keyword: its own, and the named coordinates of a joint.
fn names_of_item(keyword: &Ident, mut tokens: Tokens) -> Vec<Vec<(Ident, String)>> {
    let mut paths = vec![names::path(&mut tokens)];
    // What a person may write in place of an underscore.
    while tokens.sign('-').is_some() {
        paths.push(names::path(&mut tokens));
    }
    if keyword == "joint" && tokens.sign(':').is_some() && tokens.ident().is_some() {
        let mut arguments = tokens.group(Delimiter::Parenthesis);
        while let Some((_, content, _)) = arguments.as_mut().filter(|group| !group.1.is_empty()) {
            if names::peek_labelled(content) {
                paths.push(names::path(content));
            }
            content.skip();
        }
    }
    paths
}

/// Skips the rest of a wrong item: past the next semicolon, or up to the clear start of the next item.
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

/// Whether an item starts: a doc comment, `gravity`, `kernels only`, or a keyword, a name and `:` or `=`.
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
    if word == "kernels" {
        return ahead.peek_word("only");
    }
    if word == "for" || parts::peek(tokens) {
        return true;
    }
    KEYWORDS.contains(&word.to_string().as_str())
        && !names::path(&mut ahead).is_empty()
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
                    format!("({}{sign}{})", grouped(&binary.left), grouped(&binary.right))
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
