//! The schema of documents names every kind of result; `UPDATE_SCHEMA=1` lets the test write them.

use std::collections::BTreeSet;
use std::path::Path;
use std::{env, fs};

use super::types::sources;

/// What stands around the kinds in the schema.
const AROUND: [&str; 2] = ["    \"kind\": {\n      \"enum\": [\n", "\n      ]"];

#[test]
fn the_schema_names_every_kind() {
    let runtime = Path::new(env!("CARGO_MANIFEST_DIR")).join("../runtime");
    let path = runtime.join("tables/eigentol.schema.json");
    let schema = fs::read_to_string(&path).expect("a schema");
    let mut declared = BTreeSet::new();
    let mut files = Vec::new();
    sources(&runtime, &mut files);
    for file in &files {
        let text = fs::read_to_string(file).expect("text");
        let lines = text.lines().map(str::trim);
        let kinds = lines.filter_map(|line| line.strip_prefix("const KIND: &'static str = \""));
        let kinds = kinds.filter_map(|rest| rest.strip_suffix("\";"));
        declared.extend(kinds.map(str::to_owned));
    }
    assert!(declared.len() > 40);
    let (before, rest) = schema.split_once(AROUND[0]).expect("kinds");
    let (_, after) = rest.split_once(AROUND[1]).expect("their end");
    let kinds: Vec<String> = declared.into_iter().map(|kind: String| format!("        \"{kind}\"")).collect();
    let kinds = kinds.join(",\n");
    let written = [before, AROUND[0], kinds.as_str(), AROUND[1], after].concat();
    if env::var_os("UPDATE_SCHEMA").is_some() {
        fs::write(&path, &written).expect("the schema is written");
    }
    assert!(schema == written, "`UPDATE_SCHEMA=1 cargo test -p eigentol-tests --test answers kinds` writes the kinds");
}
