//! Names of local variables: those the derivation gave, or made from what is computed.

use std::collections::BTreeMap;

use crate::algebra::{Operator, Unary};
use crate::program::{Instruction, Operand, Operation};

/// Longest name that is built from the names of two operands.
const COMPOUND: usize = 28;

/// Words in lower case that are no names.
const KEYWORDS: [&str; 52] = [
    "_", "abstract", "as", "async", "await", "become", "box", "break", "const", "continue",
    "crate", "do", "dyn", "else", "enum", "extern", "false", "final", "fn", "for", "gen", "if",
    "impl", "in", "let", "loop", "macro", "match", "mod", "move", "mut", "override", "priv", "pub",
    "ref", "return", "self", "static", "struct", "super", "trait", "true", "try", "type", "typeof",
    "unsafe", "unsized", "use", "virtual", "where", "while", "yield",
];

/// Hands out names, each once.
pub(super) struct Names {
    taken: BTreeMap<String, usize>,
}

impl Names {
    /// Starts with the names that a body must not shadow.
    pub(super) fn new<'a>(reserved: impl IntoIterator<Item = &'a str>) -> Self {
        let taken = reserved
            .into_iter()
            .map(|name| (name.to_owned(), 1))
            .collect();
        Self { taken }
    }

    /// `wanted`, with a number behind it when it is taken already. In lower case: a local spelt like a constant or a unit
    /// struct of the user's module would be a pattern that means that item.
    pub(super) fn unique(&mut self, wanted: &str) -> String {
        let wanted = wanted.trim_start_matches("r#").to_lowercase();
        let base = if KEYWORDS.contains(&wanted.as_str()) {
            format!("{wanted}_value")
        } else {
            wanted
        };
        let count = self.taken.entry(base.clone()).or_insert(0);
        *count += 1;
        if *count == 1 {
            return base;
        }
        let mut number = *count;
        loop {
            let name = format!("{base}_{number}");
            if !self.taken.contains_key(&name) {
                self.taken.insert(base, number);
                self.taken.insert(name.clone(), 1);
                return name;
            }
            number += 1;
        }
    }
}

/// What to call the value of an instruction whose operands have the given names, if they have any.
pub(super) fn wanted(
    instruction: &Instruction,
    operand: impl Fn(Operand) -> Option<String>,
) -> String {
    if let Some(name) = &instruction.name {
        return name.clone();
    }
    let of = |word: &str, a: Operand| match operand(a) {
        Some(name) if name.len() <= COMPOUND => format!("{word}_{name}"),
        _ => word.to_owned(),
    };
    match instruction.operation {
        Operation::Unary(operator, a) => of(function_name(operator), a),
        Operation::Binary(operator, a, b) => match (operator, operand(a), operand(b)) {
            (Operator::Multiply, Some(x), Some(y)) if x == y && x.len() <= COMPOUND => {
                format!("{x}_squared")
            }
            (Operator::Multiply, Some(x), Some(y)) if x.len() + y.len() < COMPOUND => {
                format!("{x}_{y}")
            }
            (Operator::Multiply, None, Some(x)) | (Operator::Multiply, Some(x), None)
                if x.len() <= COMPOUND =>
            {
                format!("scaled_{x}")
            }
            (Operator::Divide, Some(x), Some(y)) if x.len() + y.len() < COMPOUND => {
                format!("{x}_per_{y}")
            }
            (Operator::Divide, _, Some(x)) if x.len() <= COMPOUND => format!("inverse_{x}"),
            (Operator::Add, ..) => "sum".to_owned(),
            (Operator::Subtract, ..) => "difference".to_owned(),
            (Operator::Multiply, ..) => "product".to_owned(),
            (Operator::Divide, ..) => "ratio".to_owned(),
            (Operator::Power, ..) => "power".to_owned(),
            (Operator::Atan2, ..) => "angle".to_owned(),
        },
    }
}

fn function_name(operator: Unary) -> &'static str {
    match operator {
        Unary::Negate => "minus",
        Unary::Sqrt => "sqrt",
        Unary::Sin => "sin",
        Unary::Cos => "cos",
        Unary::Tan => "tan",
        Unary::Asin => "asin",
        Unary::Acos => "acos",
        Unary::Exp => "exp",
        Unary::Ln => "ln",
        Unary::PowerInteger(_) => "power",
    }
}

#[cfg(test)]
mod tests {
    use super::{KEYWORDS, Names};

    /// Of the words of Rust only `gen`, of edition 2024, is an identifier to syn.
    #[test]
    fn keywords_are_what_syn_refuses() {
        let refused = |word: &str| syn::parse_str::<syn::Ident>(word).is_err();
        for word in KEYWORDS {
            assert!(refused(word) || word == "gen", "{word}");
        }
        for word in ["theta", "union", "default", "raw", "auto", "sum"] {
            assert!(!refused(word) && !KEYWORDS.contains(&word), "{word}");
        }
    }

    #[test]
    fn names_are_given_once() {
        let mut names = Names::new(["q"]);
        let given = ["q", "sum", "Sum", "r#type", "type", "sum_2"].map(|name| names.unique(name));
        let expected = [
            "q_2",
            "sum",
            "sum_2",
            "type_value",
            "type_value_2",
            "sum_2_2",
        ];
        assert_eq!(given, expected);
    }
}
