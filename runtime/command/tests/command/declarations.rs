//! The declarations in the files match those in the Rust examples.

use std::fs;

use syn::visit::{self, Visit};

use crate::program::examples;

/// The tokens of every `mechanism!` in a file.
#[derive(Default)]
struct Declarations(Vec<String>);

impl Visit<'_> for Declarations {
    fn visit_macro(&mut self, own: &syn::Macro) {
        if own.path.is_ident("mechanism") {
            self.0.push(own.tokens.to_string());
        }
        visit::visit_macro(self, own);
    }
}

fn of_example(name: &str) -> Vec<String> {
    let text = fs::read_to_string(examples().join(name).with_extension("rs")).unwrap();
    let mut declarations = Declarations::default();
    declarations.visit_file(&syn::parse_file(&text).unwrap());
    declarations.0
}

fn of_file(name: &str) -> String {
    let text = fs::read_to_string(examples().join(name).with_extension("mechanism")).unwrap();
    text.parse::<proc_macro2::TokenStream>().unwrap().to_string()
}

#[test]
fn files_declare_what_the_examples_declare() {
    for (example, files) in [
        ("rotating_pendulum", &["rotating_pendulum"][..]),
        ("rotating_double_pendulum", &["rotating_double_pendulum", "independent_bars"]),
        ("jeffcott_rotor", &["jeffcott_rotor"]),
        ("whipple_bicycle", &["whipple_bicycle"]),
        ("practice/rotor_bearings", &["rotor_bearings"]),
    ] {
        let files: Vec<String> = files.iter().map(|file| of_file(file)).collect();
        assert_eq!(of_example(example), files, "{example}");
    }
}
