//! The text of the stub.

use std::fmt::Write;

use super::classes::{Class, Contents, Kind, Member};
use super::source::{Source, docs};
use super::types::{ARRAYS, is_name, python};

const IMPORTS: &str = "\
from collections.abc import Mapping, Sequence
from os import PathLike
from typing import Any, Literal, TypeAlias, TypedDict, final, type_check_only

import numpy as np
from numpy.typing import ArrayLike, NDArray
from typing_extensions import Self, Unpack

__version__: str
";

/// The base of all results, which is there for type checkers only.
const RESULT: &str = "_Result";

pub(crate) fn stub(source: &Source) -> String {
    let contents = Contents::new(source);
    let module = docs(&source.module().attrs);
    let mut out = documentation(&module, "") + "\n" + IMPORTS + "\n";
    for (_, name, of) in ARRAYS {
        let _ = writeln!(out, "{name}: TypeAlias = NDArray[{of}]");
    }
    out += &aliases(source);
    for function in &contents.functions {
        out += &("\n".to_owned() + &member(function, ""));
    }
    out += &errors(source);
    let shared = Class {
        name: RESULT.to_owned(),
        docs: vec!["What all results have.".to_owned()],
        result: false,
        members: contents.shared,
    };
    out += &class(&shared, "@type_check_only\n");
    for own in &contents.classes {
        out += &class(own, "@final\n");
    }
    out
}

/// Types that have a name of their own: the text in the documentation of an alias, or the keys of a table.
fn aliases(source: &Source) -> String {
    let (mut simple, mut dictionaries) = (String::new(), String::new());
    for alias in source.aliases() {
        let (name, docs) = (alias.ident.to_string(), docs(&alias.attrs));
        let Some(python) = python(&docs) else {
            continue;
        };
        match python.strip_prefix("keys of ") {
            None if is_name(&python) => {}
            None => {
                let _ = writeln!(simple, "{name}: TypeAlias = {python}");
            }
            Some(table) => {
                let _ = write!(dictionaries, "\n@type_check_only\nclass {name}(TypedDict, total=False):\n");
                dictionaries += &documentation(&docs[..1], "    ");
                dictionaries += "\n";
                for row in source.table(table) {
                    let _ = writeln!(dictionaries, "    {}: {}", row[0], row[1]);
                }
            }
        }
    }
    simple + &dictionaries
}

/// The exceptions: name, base besides the first of them, documentation, attributes.
fn errors(source: &Source) -> String {
    let mut out = String::new();
    let mut first = None;
    for row in source.table("KINDS") {
        let [name, base, docs, attributes @ ..] = &row[..] else {
            panic!("name, base and documentation: {row:?}");
        };
        let bases = match (&first, base.as_str()) {
            (None, base) => base.to_owned(),
            (Some(first), "") => String::clone(first),
            (Some(first), base) => format!("{first}, {base}"),
        };
        let _ = write!(out, "\nclass {name}({bases}):\n");
        out += &documentation(std::slice::from_ref(docs), "    ");
        out += if attributes.is_empty() { "" } else { "\n" };
        for attribute in attributes {
            let _ = writeln!(out, "    {attribute}");
        }
        first.get_or_insert_with(|| name.clone());
    }
    out
}

fn class(own: &Class, decorator: &str) -> String {
    let base = if own.result { format!("({RESULT})") } else { String::new() };
    let mut out = format!("\n{decorator}class {}{base}:\n", own.name);
    out += &documentation(&own.docs, "    ");
    for (k, own) in own.members.iter().enumerate() {
        out += if k == 0 { "\n" } else { "" };
        out += &member(own, "    ");
        if own.name == "__eq__" {
            out += "    def __ne__(self, other: object, /) -> bool: ...\n";
        }
    }
    out
}

fn member(own: &Member, indent: &str) -> String {
    let (decorator, first) = match own.kind {
        Kind::Function => ("", None),
        Kind::Property => ("@property", Some("self")),
        Kind::Method => ("", Some("self")),
        Kind::OfClass => ("@classmethod", Some("cls")),
        Kind::New => ("", Some("cls")),
    };
    let mut out = String::new();
    if !decorator.is_empty() {
        let _ = writeln!(out, "{indent}{decorator}");
    }
    let arguments = first.into_iter().chain(own.arguments.iter().map(String::as_str));
    let arguments: Vec<&str> = arguments.collect();
    let (name, returned) = (&own.name, &own.returned);
    let line = format!("{indent}def {name}({}) -> {returned}:", arguments.join(", "));
    match line.len() <= 120 {
        true => out += &line,
        false => {
            let _ = writeln!(out, "{indent}def {name}(");
            for argument in arguments {
                let _ = writeln!(out, "{indent}    {argument},");
            }
            let _ = write!(out, "{indent}) -> {returned}:");
        }
    }
    match own.docs.is_empty() {
        true => out += " ...\n",
        false => out += &("\n".to_owned() + &documentation(&own.docs, &format!("{indent}    "))),
    }
    out
}

/// A docstring.
fn documentation(lines: &[String], indent: &str) -> String {
    let lines: Vec<&str> = lines.iter().map(|line| line.trim_end()).collect();
    let text = lines.join(&format!("\n{indent}"));
    let text: Vec<&str> = text.lines().map(str::trim_end).collect();
    let text = text.join("\n");
    match lines.len() == 1 && !text.ends_with('"') {
        true => format!("{indent}\"\"\"{text}\"\"\"\n"),
        false => format!("{indent}\"\"\"{text}\n{indent}\"\"\"\n"),
    }
}
