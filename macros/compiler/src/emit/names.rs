//! Names of local variables: given by the derivation, or built from the operation.

use std::collections::BTreeMap;

use crate::algebra::Operator;
use crate::base::names::flattened;
use crate::program::{Instruction, Operand, Operation};

/// Longest name that is built from the names of two operands.
const COMPOUND: usize = 28;

/// The local variable for a name. Rust reads a variable spelt like a constant, a static or a unit struct of the user's
/// module as that item, and such an item may have any name. The trailing underscore avoids collisions: people do not
/// write such names, and no keyword ends like this either.
pub(super) fn local(name: &str) -> String {
    format!("{name}_")
}

/// Hands out names of local variables, each only once.
pub(super) struct Names {
    taken: BTreeMap<String, usize>,
}

impl Names {
    /// Starts with the names that a body must not shadow.
    pub(super) fn new<'a>(reserved: impl IntoIterator<Item = &'a str>) -> Self {
        let taken = reserved.into_iter().map(|name| (name.to_owned(), 1)).collect();
        Self { taken }
    }

    /// The local variable for the wanted name, in lower case and with a number appended if the name is already taken.
    pub(super) fn unique(&mut self, wanted: &str) -> String {
        let base = flattened(&wanted.to_lowercase());
        let count = self.taken.entry(base.clone()).or_insert(0);
        *count += 1;
        if *count == 1 {
            return local(&base);
        }
        let mut number = *count;
        loop {
            let name = format!("{base}_{number}");
            if !self.taken.contains_key(&name) {
                self.taken.insert(base, number);
                self.taken.insert(name.clone(), 1);
                return local(&name);
            }
            number += 1;
        }
    }
}

/// A name for the value of an instruction, built from the names of its operands if these have any.
pub(super) fn wanted(instruction: &Instruction, operand: impl Fn(Operand) -> Option<String>) -> String {
    if let Some(name) = &instruction.name {
        return name.to_string();
    }
    let of = |word: &str, a: Operand| match operand(a) {
        Some(name) if name.len() <= COMPOUND => format!("{word}_{name}"),
        _ => word.to_owned(),
    };
    match instruction.operation {
        Operation::Unary(operator, a) => of(operator.name(), a),
        Operation::Binary(operator, a, b) => match (operator, operand(a), operand(b)) {
            (Operator::Multiply, Some(x), Some(y)) if x == y && x.len() <= COMPOUND => {
                format!("{x}_squared")
            }
            (Operator::Multiply, Some(x), Some(y)) if x.len() + y.len() < COMPOUND => {
                format!("{x}_{y}")
            }
            (Operator::Multiply, None, Some(x)) | (Operator::Multiply, Some(x), None) if x.len() <= COMPOUND => {
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

#[cfg(test)]
mod tests {
    use super::Names;

    #[test]
    fn names_are_given_once() {
        let mut names = Names::new(["q"]);
        let given = ["q", "sum", "Sum", "type", "sum_2"].map(|name| names.unique(name));
        let expected = ["q_2_", "sum_", "sum_2_", "type_", "sum_2_2_"];
        assert_eq!(given, expected);
    }
}
