//! Results as JSON documents, readable from any language and restored bit for bit.
//!
//! ```json
//! {
//!   "format": "eigentol",
//!   "version": 1,
//!   "by": "eigentol-tables 0.1.0",
//!   "kind": "modes",
//!   "mechanism": "Pendulum",
//!   "inputs": {"speed": {"value": 3000.0, "unit": "rpm"}},
//!   "notes": ["Gyroscopic forces (Chat) of this mechanism are ignored: undamped modes."],
//!   "tables": [
//!     {"name": "modes", "columns": [
//!       {"name": "mode", "unit": "", "kind": "whole", "values": [1, 2]},
//!       {"name": "frequency", "unit": "rad/s", "kind": "numbers", "values": [2.5, null]}
//!     ]}
//!   ],
//!   "lengths": "5d41402abc4b2a76",
//!   "description": {"name": "Pendulum", "...": "names and units of coordinates, inputs, design variables and outputs"},
//!   "result": {"...": "every field of the result, SI"}
//! }
//! ```
//!
//! - `format` and `version` come first. An unknown version is rejected with its number; within a version, fields may be
//!   added but none changes.
//! - The schema of all documents ([JSON Schema](https://json-schema.org), draft 2020-12) is the file
//!   `eigentol.schema.json` of this crate, [`SCHEMA`].
//! - `inputs` is the operating point in declared units, without any varied input.
//! - `notes` are the sentences of the text that the tables do not say.
//! - `tables` is meant for people and other programs ([`Answer::tables`]): columns of equal length, each of the
//!   `kind` `numbers`, `whole`, `texts` or `flags`, in declared units; missing values are `null`.
//! - `result` is the complete result in SI, with the field names of the Rust type, so that [`read`] restores it
//!   exactly. Complex numbers are `[real, imaginary]`, matrices are lists of rows, and infinities are the strings
//!   `"Infinity"` and `"-Infinity"`. A `description` of `null` inside the result means the description of the document.
//! - `lengths` is a hexadecimal hash of the lengths of all lists in `description` and `result`; [`read`] uses it to
//!   reject documents whose lists no longer match. Other programs can ignore it.
//!
//! # Storage
//!
//! The feature `serde` writes results in SI, in the words of their types, and reads the same bits back;
//! `runtime/tables` makes documents of them that add names, units, sentences and tables. A new result derives serde's
//! traits, uses `serial::exact` for numbers that may be infinite, and implements [`Answer`];
//! `tests/tests/answers/serial.rs` finds any type that cannot be written.
//!
//! # List lengths are hashed
//!
//! A document stores a hash of its list lengths. Reading fails if the lists no longer match, because reports use one
//! list to index another.

use std::collections::BTreeMap;
use std::io::{Read, Write};

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use eigentol_contract::Input;
use eigentol_results::numbers::as_written;

use crate::check::check;
use crate::{Answer, Error, Table};

/// Format name that identifies a document.
const FORMAT: &str = "eigentol";
/// The document version that is written and read.
pub const VERSION: u64 = 1;

/// The JSON Schema (draft 2020-12) of all documents of this version.
pub const SCHEMA: &str = include_str!("../eigentol.schema.json");

#[derive(Serialize)]
struct Written<'a> {
    format: &'a str,
    version: u64,
    by: &'a str,
    kind: &'a str,
    mechanism: Option<&'a str>,
    inputs: BTreeMap<&'a str, Quantity<'a>>,
    notes: Vec<String>,
    tables: Vec<Table>,
    lengths: String,
    description: Value,
    result: Value,
}

#[derive(Serialize)]
struct Quantity<'a> {
    value: f64,
    unit: &'a str,
}

#[derive(Deserialize)]
struct Whole {
    lengths: String,
    description: Value,
    result: Value,
}

/// Writes a document.
///
/// # Errors
/// [`Error::Write`].
pub fn write<A: Answer + Serialize>(answer: &A, mut file: impl Write) -> Result<(), Error> {
    let subject = answer.subject();
    let description = match subject {
        Some(subject) => value(&**subject.description)?,
        None => Value::Null,
    };
    let mut result = value(answer)?;
    leave_out(&mut result, &description);
    let inputs = subject
        .iter()
        .flat_map(|item| {
            let each = item.description.inputs.iter().zip(item.inputs).enumerate();
            let varied = item.varied.map(Input::index);
            each.filter(move |(k, _)| Some(*k) != varied)
        })
        .map(|(_, (info, &value))| {
            let value = as_written(value, &info.unit);
            let unit = &*info.unit.symbol;
            (&*info.name, Quantity { value, unit })
        });
    let document = Written {
        format: FORMAT,
        version: VERSION,
        by: concat!("eigentol-tables ", env!("CARGO_PKG_VERSION")),
        kind: A::KIND,
        mechanism: subject.map(|subject| &*subject.description.name),
        inputs: inputs.collect(),
        notes: answer.findings().notes().map(str::to_owned).collect(),
        tables: answer.tables(),
        lengths: lengths(&description, &result),
        description,
        result,
    };
    serde_json::to_writer(&mut file, &document).map_err(|error| Error::Write(error.into()))?;
    file.write_all(b"\n").map_err(Error::Write)?;
    file.flush().map_err(Error::Write)
}

/// Returns the document as text.
///
/// # Errors
/// None known.
pub fn to_string<A: Answer + Serialize>(answer: &A) -> Result<String, Error> {
    let mut text = Vec::new();
    write(answer, &mut text)?;
    Ok(String::from_utf8_lossy(&text).into_owned())
}

/// Reads the result of a document back, bit for bit.
///
/// # Errors
/// [`Error::Read`]; [`Error::Malformed`] for a file that is truncated or not JSON; [`Error::Foreign`] for JSON from
/// other programs; [`Error::Version`] for a document of another version; [`Error::Kind`] for a different kind of
/// result; [`Error::Content`].
pub fn read<A: Answer + DeserializeOwned>(file: impl Read) -> Result<A, Error> {
    let document: Value = serde_json::from_reader(file).map_err(reading)?;
    let kind = kind(&document)?;
    if kind != A::KIND {
        return Err(Error::Kind { found: kind.to_owned(), expected: A::KIND });
    }
    let Whole { lengths: written, description, mut result } = serde_json::from_value(document).map_err(content)?;
    if written != lengths(&description, &result) {
        return Err(Error::Content("its lists have not the lengths with which they were written".to_owned()));
    }
    put_back(&mut result, &description);
    serde_json::from_value(result).map_err(content)
}

/// Reads the tables of a document, whatever result it holds.
///
/// # Errors
/// The same as [`read`], except [`Error::Kind`].
pub fn read_tables(file: impl Read) -> Result<Vec<Table>, Error> {
    let mut document: Value = serde_json::from_reader(file).map_err(reading)?;
    kind(&document)?;
    let tables = document.get_mut("tables").map(Value::take);
    let tables: Vec<Table> = serde_json::from_value(tables.unwrap_or_default()).map_err(content)?;
    tables.iter().try_for_each(check)?;
    Ok(tables)
}

/// Checks format and version, and returns the kind of the document.
fn kind(document: &Value) -> Result<&str, Error> {
    if document.get("format").and_then(Value::as_str) != Some(FORMAT) {
        return Err(Error::Foreign);
    }
    let version = document.get("version").and_then(Value::as_u64);
    if version != Some(VERSION) {
        let word = |field: &str| document.get(field).map(ToString::to_string);
        return Err(Error::Version {
            found: word("version").unwrap_or_else(|| "none".to_owned()),
            by: word("by").unwrap_or_else(|| "an unknown program".to_owned()),
            expected: VERSION,
        });
    }
    document.get("kind").and_then(Value::as_str).ok_or(Error::Foreign)
}

/// Hash (FNV-1a) of the lengths of all lists in order, as text.
fn lengths(description: &Value, result: &Value) -> String {
    fn add(hash: &mut u64, bytes: &[u8]) {
        for byte in bytes {
            *hash = (*hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }

    fn walk(hash: &mut u64, value: &Value) {
        match value {
            Value::Array(all) => {
                add(hash, &(all.len() as u64).to_le_bytes());
                all.iter().for_each(|x| walk(hash, x));
            }
            Value::Object(fields) => {
                // Sorted, because other programs may reorder fields.
                let fields: BTreeMap<&String, &Value> = fields.iter().collect();
                for (name, value) in fields {
                    add(hash, name.as_bytes());
                    walk(hash, value);
                }
            }
            _ => {}
        }
    }

    let mut hash = 0xcbf2_9ce4_8422_2325;
    walk(&mut hash, description);
    walk(&mut hash, result);
    format!("{hash:016x}")
}

/// Replaces repeated descriptions by `null`: every state and set of modes carries one, but the document stores it once.
fn leave_out(value: &mut Value, description: &Value) {
    match value {
        Value::Array(all) => all.iter_mut().for_each(|x| leave_out(x, description)),
        Value::Object(fields) => {
            for (name, value) in fields {
                if name == "description" && value == description {
                    *value = Value::Null;
                } else {
                    leave_out(value, description);
                }
            }
        }
        _ => {}
    }
}

fn put_back(value: &mut Value, description: &Value) {
    match value {
        Value::Array(all) => all.iter_mut().for_each(|x| put_back(x, description)),
        Value::Object(fields) => {
            for (name, value) in fields {
                if name == "description" && value.is_null() {
                    *value = description.clone();
                } else {
                    put_back(value, description);
                }
            }
        }
        _ => {}
    }
}

fn value<T: Serialize + ?Sized>(of: &T) -> Result<Value, Error> {
    serde_json::to_value(of).map_err(|error| Error::Write(error.into()))
}

fn reading(error: serde_json::Error) -> Error {
    if error.is_io() {
        return Error::Read(error.into());
    }
    let reason = if error.is_eof() { "the file is cut off".to_owned() } else { error.to_string() };
    Error::Malformed { line: error.line() as u64, reason }
}

fn content(error: serde_json::Error) -> Error {
    Error::Content(error.to_string())
}
