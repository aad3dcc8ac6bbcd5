//! The classes and functions of the module.

use std::collections::BTreeMap;

use quote::ToTokens;
use syn::parse::{ParseStream, Parser};
use syn::{
    Attribute, Expr, Fields, FnArg, Ident, ImplItem, ImplItemFn, Item, ItemStruct, Lit, Meta, Pat, ReturnType,
    Signature, Token, Type,
};

use super::source::{Source, docs, is};
use super::types::Types;

/// Methods that every object has.
const OF_OBJECTS: [&str; 5] = ["__repr__", "__reduce__", "__getnewargs__", "__getnewargs_ex__", "_restored"];

pub(crate) struct Class {
    pub(crate) name: String,
    pub(crate) docs: Vec<String>,
    /// Whether it is a result.
    pub(crate) result: bool,
    pub(crate) members: Vec<Member>,
}

pub(crate) struct Member {
    pub(crate) kind: Kind,
    pub(crate) name: String,
    pub(crate) arguments: Vec<String>,
    pub(crate) returned: String,
    pub(crate) docs: Vec<String>,
}

#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Kind {
    Function,
    Property,
    Method,
    OfClass,
    New,
}

/// What a module has.
pub(crate) struct Contents {
    pub(crate) functions: Vec<Member>,
    /// What all results have.
    pub(crate) shared: Vec<Member>,
    pub(crate) classes: Vec<Class>,
}

impl Contents {
    pub(crate) fn new(source: &Source) -> Self {
        let structs = source.items.iter().filter_map(|(item, shared)| match item {
            Item::Struct(item) => Some((item, *shared, options(&item.attrs, "pyclass")?)),
            _ => None,
        });
        let structs: Vec<(&ItemStruct, bool, Options)> = structs.collect();
        let names = structs.iter().map(|(item, _, options)| {
            let rust = item.ident.to_string();
            let python = options.get("name").unwrap_or(&rust).clone();
            (rust, python)
        });
        let names: BTreeMap<String, String> = names.collect();
        let types = Types::new(source, names.clone());
        let class = |name: &String| {
            let found = structs.iter().find(|(x, ..)| x.ident == name);
            let (own, result, options) = found?;
            let mut members = fields(own, options, &types);
            members.extend(methods(source, name, false, &types));
            members.sort_by_key(|member| member.kind != Kind::New);
            Some(Class { name: names[name].clone(), docs: docs(&own.attrs), result: *result, members })
        };
        let result = structs.iter().find(|(_, shared, _)| *shared);
        let result = result.map(|(x, ..)| x.ident.to_string());
        Self {
            functions: functions(source, &types),
            shared: methods(source, &result.unwrap_or_default(), true, &types),
            classes: source.exported().iter().filter_map(class).collect(),
        }
    }
}

/// What an attribute says in brackets: words, and texts by name.
type Options = BTreeMap<String, String>;

fn options(attributes: &[Attribute], name: &str) -> Option<Options> {
    let attribute = attributes.iter().find(|attribute| is(attribute, name))?;
    let mut options = Options::new();
    if let Meta::List(_) = attribute.meta {
        let read = attribute.parse_nested_meta(|meta| {
            let text = match meta.input.peek(Token![=]) {
                true => text(&meta.value()?.parse()?),
                false => String::new(),
            };
            options.insert(meta.path.to_token_stream().to_string(), text);
            Ok(())
        });
        read.unwrap_or_else(|error| panic!("{name}: {error}"));
    }
    Some(options)
}

fn text(lit: &Lit) -> String {
    match lit {
        Lit::Str(text) => text.value(),
        other => other.to_token_stream().to_string(),
    }
}

/// Fields as attributes, and as arguments of a new one.
fn fields(of: &ItemStruct, options: &Options, types: &Types) -> Vec<Member> {
    let Fields::Named(fields) = &of.fields else {
        return Vec::new();
    };
    let fields = fields.named.iter().filter_map(|x| Some((x.ident.as_ref()?, x)));
    let mut members = Vec::new();
    if options.contains_key("new") {
        let arguments = fields.clone();
        let arguments = arguments.map(|(name, x)| format!("{name}: {}", types.argument(&x.ty)));
        members.push(Member {
            kind: Kind::New,
            name: "__new__".to_owned(),
            arguments: arguments.collect(),
            returned: "Self".to_owned(),
            docs: Vec::new(),
        });
    }
    if options.contains_key("get_all") {
        members.extend(fields.map(|(name, item)| Member {
            kind: Kind::Property,
            name: name.to_string(),
            arguments: Vec::new(),
            returned: types.returned(&item.ty),
            docs: docs(&item.attrs),
        }));
    }
    members
}

/// The methods of a class: its own, or those that all results share.
fn methods(source: &Source, class: &str, shared: bool, types: &Types) -> Vec<Member> {
    let blocks = source.items.iter().filter_map(|(item, of_all)| match item {
        Item::Impl(own) if *of_all == shared && own.attrs.iter().any(|attr| is(attr, "pymethods")) => {
            (own.self_ty.to_token_stream().to_string() == class).then_some(own)
        }
        _ => None,
    });
    let functions = blocks.flat_map(|block| &block.items).filter_map(|items| match items {
        ImplItem::Fn(own) if !OF_OBJECTS.contains(&own.sig.ident.to_string().as_str()) => Some(own),
        _ => None,
    });
    functions.map(|function| method(function, types)).collect()
}

fn method(impl_item_fn: &ImplItemFn, types: &Types) -> Member {
    let has = |name: &str| impl_item_fn.attrs.iter().any(|attr| is(attr, name));
    let kind = match () {
        () if has("getter") => Kind::Property,
        () if has("classmethod") => Kind::OfClass,
        () if has("new") => Kind::New,
        () => Kind::Method,
    };
    let mut made = member(kind, &impl_item_fn.attrs, &impl_item_fn.sig, types);
    match made.name.as_str() {
        "new" => "__new__".clone_into(&mut made.name),
        "__getitem__" => made.arguments.push("/".to_owned()),
        // Python compares with anything.
        "__eq__" => made.arguments = vec!["other: object".to_owned(), "/".to_owned()],
        _ => {}
    }
    made
}

fn functions(source: &Source, types: &Types) -> Vec<Member> {
    let all = source.items.iter().filter_map(|(item, _)| match item {
        Item::Fn(own) if own.attrs.iter().any(|attr| is(attr, "pyfunction")) => {
            Some(member(Kind::Function, &own.attrs, &own.sig, types))
        }
        _ => None,
    });
    all.collect()
}

fn member(kind: Kind, attributes: &[Attribute], of: &Signature, types: &Types) -> Member {
    let typed = of.inputs.iter().filter_map(|input| match input {
        FnArg::Typed(typed) => Some((typed.pat.as_ref(), typed.ty.as_ref())),
        FnArg::Receiver(_) => None,
    });
    let typed = typed.filter(|(_, of)| !of.to_token_stream().to_string().starts_with("Python"));
    // A class or an object takes the place of `self`.
    let instead = matches!(kind, Kind::Method | Kind::OfClass | Kind::Property);
    let skipped = usize::from(instead && of.receiver().is_none());
    let typed = typed.skip(skipped).map(|(pattern, of)| match pattern {
        Pat::Ident(ident) => (ident.ident.to_string(), of),
        other => panic!("an argument without a name: {other:?}"),
    });
    let typed: Vec<(String, &Type)> = typed.collect();
    let returned = match &of.output {
        ReturnType::Default => "None".to_owned(),
        ReturnType::Type(_, own) => types.returned(own),
    };
    Member {
        kind,
        name: of.ident.to_string(),
        arguments: arguments(attributes, &typed, types),
        returned,
        docs: docs(attributes),
    }
}

/// The arguments in Python, with defaults.
fn arguments(attributes: &[Attribute], typed: &[(String, &Type)], types: &Types) -> Vec<String> {
    let plain = |(name, of): &(String, &Type)| format!("{name}: {}", types.argument(of));
    let said = attributes.iter().find(|attribute| is(attribute, "pyo3"));
    let Some(Meta::List(said)) = said.map(|said| &said.meta) else {
        return typed.iter().map(plain).collect();
    };
    let one = |input: ParseStream<'_>| -> syn::Result<String> {
        let mut stars = String::new();
        while input.parse::<Option<Token![*]>>()?.is_some() {
            stars.push('*');
        }
        if input.is_empty() || input.peek(Token![,]) {
            return Ok(stars);
        }
        let name = input.parse::<Ident>()?.to_string();
        let of = typed.iter().find(|(x, _)| *x == name);
        let of = types.argument(of.expect("an argument of the function").1);
        if input.parse::<Option<Token![=]>>()?.is_some() {
            let default = default(&input.parse()?);
            return Ok(format!("{name}: {of} = {default}"));
        }
        Ok(match stars.len() {
            0 => format!("{name}: {of}"),
            1 => format!("*{name}: Any"),
            _ => format!("**{name}: Unpack[{}]", of.trim_end_matches(" | None")),
        })
    };
    let all = |input: ParseStream<'_>| {
        input.parse::<Ident>()?;
        input.parse::<Token![=]>()?;
        let inner;
        syn::parenthesized!(inner in input);
        let mut each = Vec::new();
        while !inner.is_empty() {
            each.push(one(&inner)?);
            inner.parse::<Option<Token![,]>>()?;
        }
        Ok(each)
    };
    let read = all.parse2(said.tokens.clone());
    read.unwrap_or_else(|error| panic!("the arguments {}: {error}", said.tokens))
}

fn default(expr: &Expr) -> String {
    match expr {
        Expr::Lit(lit) => lit.lit.to_token_stream().to_string(),
        Expr::Path(path) if path.path.is_ident("None") => "None".to_owned(),
        _ => "...".to_owned(),
    }
}
