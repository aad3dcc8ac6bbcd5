//! The items of the module's source, with macros expanded.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use proc_macro2::{TokenStream, TokenTree};
use syn::{Attribute, Expr, ExprLit, Item, ItemConst, ItemMod, ItemType, Lit, LitStr, Meta, UseTree};

use super::macros::{Rule, expanded, rules};

/// The macro that every result shares: what it gives belongs to the base of all results.
const SHARED: &str = "result";

pub(crate) struct Source {
    /// Items outside of functions in the order of files, and whether all results share them.
    pub(crate) items: Vec<(Item, bool)>,
    macros: BTreeMap<String, Vec<Rule>>,
}

impl Source {
    /// All files of a folder.
    pub(crate) fn read(folder: &Path) -> Self {
        let files = files(folder).into_iter().flat_map(|path| {
            let text = fs::read_to_string(&path).expect("a file of the source");
            let file = syn::parse_file(&text);
            file.unwrap_or_else(|error| panic!("{}: {error}", path.display())).items
        });
        let items: Vec<Item> = files.collect();
        let mut source = Self { items: Vec::new(), macros: items.iter().filter_map(definition).collect() };
        for item in items {
            source.add(item, false);
        }
        source
    }

    fn add(&mut self, item: Item, shared: bool) {
        let Item::Macro(call) = item else {
            self.items.push((item, shared));
            return;
        };
        let name = call.mac.path.segments.last().map(|segment| segment.ident.to_string());
        let name = name.unwrap_or_default();
        let Some(rules) = self.macros.get(&name) else {
            return;
        };
        let file = expanded(rules, &call).and_then(syn::parse2::<syn::File>);
        let file = file.unwrap_or_else(|error| panic!("`{name}!`: {error}"));
        for item in file.items {
            self.add(item, shared || name == SHARED);
        }
    }

    /// The module of Python.
    pub(crate) fn module(&self) -> &ItemMod {
        let module = self.items.iter().find_map(|(item, _)| match item {
            Item::Mod(module) if module.attrs.iter().any(|attr| is(attr, "pymodule")) => Some(module),
            _ => None,
        });
        module.expect("a module of Python")
    }

    /// What the module exports, in order: names in Rust.
    pub(crate) fn exported(&self) -> Vec<String> {
        let mut names = Vec::new();
        for item in self.module().content.iter().flat_map(|(_, items)| items) {
            if let Item::Use(own) = item
                && own.attrs.iter().any(|attr| is(attr, "pymodule_export"))
            {
                leaves(&own.tree, &mut names);
            }
        }
        names
    }

    pub(crate) fn aliases(&self) -> impl Iterator<Item = &ItemType> {
        self.items.iter().filter_map(|(item, _)| match item {
            Item::Type(alias) => Some(alias),
            _ => None,
        })
    }

    /// The rows of a table: the texts in each, as they come.
    pub(crate) fn table(&self, name: &str) -> Vec<Vec<String>> {
        let own = |(item, _): &_| match item {
            Item::Const(ItemConst { ident, expr, .. }) if ident == name => Some((**expr).clone()),
            _ => None,
        };
        let table = self.items.iter().find_map(own);
        rows(&table.unwrap_or_else(|| panic!("there is no table `{name}`")))
    }
}

fn rows(table: &Expr) -> Vec<Vec<String>> {
    match table {
        Expr::Array(array) => array.elems.iter().map(texts).collect(),
        Expr::Reference(reference) => rows(&reference.expr),
        other => panic!("this is no table: {other:?}"),
    }
}

fn texts(expression: &Expr) -> Vec<String> {
    match expression {
        Expr::Tuple(tuple) => tuple.elems.iter().flat_map(texts).collect(),
        Expr::Array(array) => array.elems.iter().flat_map(texts).collect(),
        Expr::Reference(reference) => texts(&reference.expr),
        Expr::Lit(ExprLit { lit: Lit::Str(text), .. }) => vec![text.value()],
        Expr::Macro(expression) => vec![joined(expression.mac.tokens.clone())],
        _ => Vec::new(),
    }
}

/// What `stringify!` and `concat!` give.
fn joined(tokens: TokenStream) -> String {
    let each = tokens.into_iter().filter_map(|token| match token {
        TokenTree::Ident(name) => Some(name.to_string()),
        TokenTree::Literal(literal) => syn::parse_str::<LitStr>(&literal.to_string()).ok().map(|x| x.value()),
        _ => None,
    });
    each.collect::<String>().trim_start().to_owned()
}

fn definition(item: &Item) -> Option<(String, Vec<Rule>)> {
    match item {
        Item::Macro(item) => Some((item.ident.as_ref()?.to_string(), rules(item))),
        _ => None,
    }
}

fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).expect("a folder of the source");
    let mut paths: Vec<PathBuf> = entries.flatten().map(|x| x.path()).collect();
    paths.sort();
    let each = paths.into_iter().flat_map(|path| match path.is_dir() {
        true => files(&path),
        false => vec![path],
    });
    each.collect()
}

fn leaves(tree: &UseTree, names: &mut Vec<String>) {
    match tree {
        UseTree::Path(path) => leaves(&path.tree, names),
        UseTree::Name(name) => names.push(name.ident.to_string()),
        UseTree::Group(group) => group.items.iter().for_each(|item| leaves(item, names)),
        UseTree::Rename(_) | UseTree::Glob(_) => panic!("exports are named one by one"),
    }
}

pub(crate) fn is(attribute: &Attribute, name: &str) -> bool {
    attribute.path().is_ident(name)
}

/// The lines of a documentation.
pub(crate) fn docs(attributes: &[Attribute]) -> Vec<String> {
    let line = |attribute: &Attribute| match &attribute.meta {
        Meta::NameValue(name_value) if name_value.path.is_ident("doc") => texts(&name_value.value).pop(),
        _ => None,
    };
    let lines = attributes.iter().filter_map(line);
    let lines = lines.map(|line| line.strip_prefix(' ').unwrap_or(&line).to_owned());
    lines.collect()
}
