//! The published schema accepts every document: the keywords of JSON Schema that it uses, checked one by one.

use serde_json::Value;

/// What the schema of documents refuses in one.
pub(super) fn refused(document: &Value) -> Vec<String> {
    let schema: Value = serde_json::from_str(eigentol_tables::json::SCHEMA).expect("JSON");
    let mut refused = Vec::new();
    check(&schema, &schema, document, "", &mut refused);
    refused
}

fn check(whole: &Value, schema: &Value, value: &Value, at: &str, refused: &mut Vec<String>) {
    let accepts = |schema: &Value| {
        let mut refused = Vec::new();
        check(whole, schema, value, at, &mut refused);
        refused.is_empty()
    };
    let all = |schema: &Value| schema.as_array().cloned().unwrap_or_default();
    for (keyword, rule) in schema.as_object().expect("a schema") {
        let met = match keyword.as_str() {
            "$ref" => {
                let path = rule.as_str().and_then(|path| path.strip_prefix('#'));
                let target = path.and_then(|path| whole.pointer(path)).expect("a definition");
                check(whole, target, value, at, refused);
                true
            }
            "type" => match rule {
                Value::String(name) => is(value, name),
                names => all(names).iter().any(|name| is(value, name.as_str().expect("a type"))),
            },
            "const" => value == rule,
            "enum" => all(rule).contains(value),
            "required" => all(rule).iter().all(|name| value.get(name.as_str().expect("a name")).is_some()),
            "properties" => {
                for (name, schema) in rule.as_object().expect("properties") {
                    if let Some(value) = value.get(name) {
                        check(whole, schema, value, &format!("{at}/{name}"), refused);
                    }
                }
                true
            }
            "additionalProperties" => {
                for (name, value) in value.as_object().into_iter().flatten() {
                    check(whole, rule, value, &format!("{at}/{name}"), refused);
                }
                true
            }
            "items" => {
                for (k, value) in value.as_array().into_iter().flatten().enumerate() {
                    check(whole, rule, value, &format!("{at}/{k}"), refused);
                }
                true
            }
            "minLength" => value.as_str().is_none_or(|text| text.len() as u64 >= rule.as_u64().expect("a length")),
            "oneOf" => all(rule).iter().filter(|schema| accepts(schema)).count() == 1,
            "anyOf" => all(rule).iter().any(accepts),
            "allOf" => all(rule).iter().all(accepts),
            "if" => {
                let branch = if accepts(rule) { "then" } else { "else" };
                schema.get(branch).is_none_or(accepts)
            }
            "then" | "else" | "$defs" | "$schema" | "title" | "description" | "pattern" | "minimum" => true,
            other => panic!("a keyword that is not checked: {other}"),
        };
        if !met {
            refused.push(format!("{at}: {keyword} {rule}"));
        }
    }
}

fn is(value: &Value, name: &str) -> bool {
    match name {
        "null" => value.is_null(),
        "boolean" => value.is_boolean(),
        "integer" => value.is_i64() || value.is_u64(),
        "number" => value.is_number(),
        "string" => value.is_string(),
        "array" => value.is_array(),
        "object" => value.is_object(),
        other => panic!("no type: {other}"),
    }
}

#[test]
fn the_schema_refuses_what_is_none_of_ours() {
    let document = serde_json::json!({"format": "eigentol", "version": 1, "kind": "equilibria", "result": []});
    let refused = refused(&document);
    assert!(refused.iter().any(|reason| reason.contains("allOf")), "{refused:?}");
    assert!(refused.iter().any(|reason| reason.contains("required")), "{refused:?}");
}
