//! Checks that the compiler accepts the declarations on the reference page.

use eigentol_compiler::compile;
use eigentol_compiler::mechanics::Limits;

use super::common::read;

/// The code blocks of a page, with their fence languages.
fn code_blocks(page: &str) -> Vec<(&str, &str)> {
    let mut blocks = Vec::new();
    for (index, part) in page.split("```").enumerate() {
        if index % 2 == 1 {
            blocks.push(part.split_once('\n').expect("a fence ends its line"));
        }
    }
    blocks
}

#[test]
fn the_reference_page_is_right() {
    let page = include_str!("../../../../macros/REFERENCE.md");
    let mut declarations = 0;
    for (language, text) in code_blocks(page) {
        if language == "text" {
            read(&format!("mechanism Fragment {{ {text} }}"));
            continue;
        }
        if language == "csv" {
            continue;
        }
        let (_, inside) = text.split_once("mechanism! {").expect("a declaration");
        let (declaration, _) = inside.rsplit_once('}').expect("a closing brace");
        let tokens = declaration.parse().expect("tokens");
        compile(tokens, Limits::default()).unwrap_or_else(|errors| panic!("{errors}"));
        declarations += 1;
    }
    assert_eq!(declarations, 6);
}
