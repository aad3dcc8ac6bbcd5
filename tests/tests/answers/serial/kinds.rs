//! The schema of documents names every kind of result.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use super::types::sources;

#[test]
fn the_schema_names_every_kind() {
    let runtime = Path::new(env!("CARGO_MANIFEST_DIR")).join("../runtime");
    let schema = fs::read_to_string(runtime.join("tables/eigentol.schema.json")).expect("a schema");
    let schema: serde_json::Value = serde_json::from_str(&schema).expect("JSON");
    let listed = schema["properties"]["kind"]["enum"].as_array().expect("a list");
    let listed = listed.iter().filter_map(|kind| kind.as_str());
    let listed: BTreeSet<String> = listed.map(str::to_owned).collect();
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
    assert_eq!(listed, declared);
}
