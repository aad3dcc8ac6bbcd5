//! Expansion of the macros of the module (`macro_rules!`), as the compiler does it.

use std::collections::{BTreeMap, BTreeSet};

use proc_macro2::{Delimiter, Group, TokenStream, TokenTree};
use quote::ToTokens;
use syn::ext::IdentExt;
use syn::parse::discouraged::Speculative;
use syn::parse::{ParseStream, Parser};
use syn::{Expr, Ident, ItemMacro, Lit, Meta, Type};

/// One rule of a macro.
pub(crate) struct Rule {
    pattern: Vec<Pattern>,
    body: TokenStream,
}

enum Pattern {
    Token(String),
    Group(Delimiter, Vec<Pattern>),
    Fragment { name: String, kind: String },
    Repeated(Repetition),
}

struct Repetition {
    pattern: Vec<Pattern>,
    separator: Option<String>,
    at_most_once: bool,
}

/// What a variable of a macro stands for.
#[derive(Clone)]
enum Value {
    One(TokenStream),
    Many(Vec<Value>),
}

type Values = BTreeMap<String, Value>;

/// The rules of a definition.
pub(crate) fn rules(definition: &ItemMacro) -> Vec<Rule> {
    let tokens: Vec<TokenTree> = definition.mac.tokens.clone().into_iter().collect();
    let rule = |parts: &[TokenTree]| match parts {
        [TokenTree::Group(pattern), _, _, TokenTree::Group(body), ..] => {
            Rule { pattern: patterns(pattern.stream()), body: body.stream() }
        }
        _ => panic!("a rule: {parts:?}"),
    };
    // Pattern, `=>`, body, `;`
    tokens.chunks(5).map(rule).collect()
}

/// What a call of the macro stands for.
pub(crate) fn expanded(rules: &[Rule], call: &ItemMacro) -> syn::Result<TokenStream> {
    let mut failure = None;
    for rule in rules {
        let read = |input: ParseStream<'_>| {
            let mut values = Values::new();
            read(&rule.pattern, input, &mut values)?;
            Ok(values)
        };
        match read.parse2(call.mac.tokens.clone()) {
            Ok(values) => return Ok(written(rule.body.clone(), &values)),
            Err(error) => failure = Some(error),
        }
    }
    Err(failure.expect("a macro has rules"))
}

fn patterns(tokens: TokenStream) -> Vec<Pattern> {
    let mut tokens = tokens.into_iter().peekable();
    let mut all = Vec::new();
    while let Some(token) = tokens.next() {
        all.push(match token {
            TokenTree::Punct(dollar) if dollar.as_char() == '$' => match tokens.next() {
                Some(TokenTree::Group(repeated)) => {
                    let (separator, at_most_once) = repetition(&mut tokens);
                    Pattern::Repeated(Repetition { pattern: patterns(repeated.stream()), separator, at_most_once })
                }
                name => {
                    let kind = tokens.nth(1);
                    let (name, kind) = (name.expect("a name"), kind.expect("a kind"));
                    Pattern::Fragment { name: name.to_string(), kind: kind.to_string() }
                }
            },
            TokenTree::Group(group) => Pattern::Group(group.delimiter(), patterns(group.stream())),
            other => Pattern::Token(other.to_string()),
        });
    }
    all
}

/// The separator behind `$( )`, and whether it ends in `?`.
fn repetition(tokens: &mut impl Iterator<Item = TokenTree>) -> (Option<String>, bool) {
    let mut separator = None;
    for token in tokens {
        match token.to_string().as_str() {
            "*" | "+" => return (separator, false),
            "?" => return (separator, true),
            other => separator = Some(other.to_owned()),
        }
    }
    panic!("a repetition without `*`, `+` or `?`");
}

fn read(pattern: &[Pattern], input: ParseStream<'_>, values: &mut Values) -> syn::Result<()> {
    for part in pattern {
        match part {
            Pattern::Token(token) => this(token, input)?,
            Pattern::Group(delimiter, inner) => {
                let group: Group = input.parse()?;
                if group.delimiter() != *delimiter {
                    return Err(input.error("another bracket"));
                }
                let within = |input: ParseStream<'_>| read(inner, input, values);
                within.parse2(group.stream())?;
            }
            Pattern::Fragment { name, kind } => {
                let tokens = fragment(kind, input)?;
                values.insert(name.clone(), Value::One(tokens));
            }
            Pattern::Repeated(repetition) => repeated(repetition, input, values)?,
        }
    }
    Ok(())
}

fn this(token: &str, input: ParseStream<'_>) -> syn::Result<()> {
    let token_tree: TokenTree = input.parse()?;
    match token_tree.to_string() == token {
        true => Ok(()),
        false => Err(syn::Error::new(token_tree.span(), format!("not `{token}`"))),
    }
}

fn fragment(kind: &str, input: ParseStream<'_>) -> syn::Result<TokenStream> {
    Ok(match kind {
        "ident" => input.call(Ident::parse_any)?.to_token_stream(),
        "ty" => input.parse::<Type>()?.to_token_stream(),
        "expr" => input.parse::<Expr>()?.to_token_stream(),
        "meta" => input.parse::<Meta>()?.to_token_stream(),
        "literal" => input.parse::<Lit>()?.to_token_stream(),
        "tt" => input.parse::<TokenTree>()?.to_token_stream(),
        other => panic!("fragments `{other}` are not known here"),
    })
}

fn repeated(repetition: &Repetition, input: ParseStream<'_>, values: &mut Values) -> syn::Result<()> {
    let mut rounds: Vec<Values> = Vec::new();
    let most = if repetition.at_most_once { 1 } else { usize::MAX };
    while !input.is_empty() && rounds.len() < most {
        let (fork, mut round) = (input.fork(), Values::new());
        let separated = match &repetition.separator {
            Some(separator) if !rounds.is_empty() => this(separator, &fork),
            _ => Ok(()),
        };
        if separated.and_then(|()| read(&repetition.pattern, &fork, &mut round)).is_err() {
            break;
        }
        input.advance_to(&fork);
        rounds.push(round);
    }
    for name in variables(&repetition.pattern) {
        let all = rounds.iter().map(|round| round[name].clone()).collect();
        values.insert(name.to_owned(), Value::Many(all));
    }
    Ok(())
}

fn variables(pattern: &[Pattern]) -> Vec<&str> {
    let each = pattern.iter().flat_map(|part| match part {
        Pattern::Token(_) => Vec::new(),
        Pattern::Group(_, inner) => variables(inner),
        Pattern::Fragment { name, .. } => vec![name.as_str()],
        Pattern::Repeated(repeated) => variables(&repeated.pattern),
    });
    each.collect()
}

fn written(body: TokenStream, values: &Values) -> TokenStream {
    let mut tokens = body.into_iter();
    let mut out = TokenStream::new();
    while let Some(token) = tokens.next() {
        match token {
            TokenTree::Punct(dollar) if dollar.as_char() == '$' => match tokens.next() {
                Some(TokenTree::Group(group)) => {
                    let (separator, _) = repetition(&mut tokens);
                    out.extend(rounds(&group, separator.as_deref(), values));
                }
                Some(TokenTree::Ident(name)) => match values.get(&name.to_string()) {
                    Some(Value::One(tokens)) => out.extend(tokens.clone()),
                    _ => out.extend(name.to_token_stream()),
                },
                other => panic!("`$` before {other:?}"),
            },
            TokenTree::Group(group) => {
                let inner = written(group.stream(), values);
                out.extend([TokenTree::Group(Group::new(group.delimiter(), inner))]);
            }
            other => out.extend([other]),
        }
    }
    out
}

fn rounds(group: &Group, separator: Option<&str>, values: &Values) -> TokenStream {
    let names = named(group.stream());
    let lists = values.iter().filter_map(|(name, value)| match value {
        Value::Many(all) if names.contains(name) => Some((name, all)),
        _ => None,
    });
    let lists: Vec<(&String, &Vec<Value>)> = lists.collect();
    let count = lists.first().map_or(0, |(_, all)| all.len());
    let mut out = TokenStream::new();
    for k in 0..count {
        if let Some(separator) = separator.filter(|_| k > 0) {
            out.extend(separator.parse::<TokenStream>().expect("a separator"));
        }
        let mut values = values.clone();
        values.extend(lists.iter().map(|(name, all)| ((*name).clone(), all[k].clone())));
        out.extend(written(group.stream(), &values));
    }
    out
}

/// The names in a body, at any depth.
fn named(body: TokenStream) -> BTreeSet<String> {
    let of = |token| match token {
        TokenTree::Group(group) => named(group.stream()),
        other => BTreeSet::from([other.to_string()]),
    };
    body.into_iter().flat_map(of).collect()
}
