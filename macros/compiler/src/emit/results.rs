//! What a method returns: one variable, set to zero first, whose entries are stored as soon as they are known. Entries kept
//! to the end would have to be held somewhere until then, and copied.

use std::fmt::Write;

use crate::program::{Kernel, Operand};

use super::body::Body;
use super::contract::{Form, Sizes};

/// The parts of a result.
pub(super) struct Results<'a> {
    kernel: &'a Kernel,
    form: Form,
    /// Its type.
    pub(super) kind: String,
    /// Its value before anything is stored.
    pub(super) zero: String,
}

/// Lists of [`Form::Partials`].
const BY: [&str; 3] = ["by_coordinate", "by_input", "by_design"];

impl<'a> Results<'a> {
    pub(super) fn new(kernel: &'a Kernel, form: Form, sizes: Sizes) -> Self {
        let filled = |entry: &str| -> Vec<String> {
            let of = |shape: &Vec<usize>| nested(entry, shape);
            kernel.results.iter().map(|a| of(&a.shape)).collect()
        };
        let (types, zeros) = (filled("T"), filled("zero"));
        let fields = |zeros: &[String]| -> String {
            let field = |(array, zero): (&crate::program::Array, &String)| {
                format!("{}: {zero}", array.name)
            };
            let fields: Vec<String> = kernel.results.iter().zip(zeros).map(field).collect();
            fields.join(", ")
        };
        let (kind, zero) = match form {
            Form::Single => (types[0].clone(), zeros[0].clone()),
            Form::Tuple => (
                format!("({})", types.join(", ")),
                format!("({})", zeros.join(", ")),
            ),
            Form::Record(name, generics) => {
                let generics: String = generics(sizes)
                    .iter()
                    .fold("T".to_owned(), |list, n| format!("{list}, {n}"));
                (
                    format!("::eigentol::{name}<{generics}>"),
                    format!("::eigentol::{name} {{ {} }}", fields(&zeros)),
                )
            }
            Form::Partials => {
                let mut lists = String::new();
                for (by, arrays) in BY.iter().zip(kernel.results.chunks(3)) {
                    let matrix = |array: &crate::program::Array| {
                        format!("{}: {}", array.name, nested("zero", &array.shape[1..]))
                    };
                    let matrices: Vec<String> = arrays.iter().map(matrix).collect();
                    let _ = write!(
                        lists,
                        "{by}: [::eigentol::Linear {{ {} }}; {}], ",
                        matrices.join(", "),
                        arrays[0].shape[0]
                    );
                }
                (
                    format!(
                        "::eigentol::LinearPartials<T, {}, {}, {}>",
                        sizes.coordinates, sizes.inputs, sizes.design
                    ),
                    format!("::eigentol::LinearPartials {{ {lists} }}"),
                )
            }
        };
        Self {
            kernel,
            form,
            kind,
            zero,
        }
    }

    /// The places of each instruction's value.
    pub(super) fn places(&self) -> Vec<Vec<String>> {
        let mut places = vec![Vec::new(); self.kernel.instructions.len()];
        for (array, result) in self.kernel.results.iter().enumerate() {
            for (entry, &value) in result.values.iter().enumerate() {
                if let Operand::Instruction(index) = value {
                    places[index].push(self.place(array, entry));
                }
            }
        }
        places
    }

    /// Statements for entries that nothing computes: numbers other than zero, and arguments.
    pub(super) fn rest(&self, body: &Body) -> String {
        let mut text = String::new();
        for (array, result) in self.kernel.results.iter().enumerate() {
            for (entry, &value) in result.values.iter().enumerate() {
                let known = match value {
                    Operand::Constant(value) => value.to_bits() == 0,
                    Operand::Parameter(..) => false,
                    Operand::Instruction(_) => true,
                };
                if !known {
                    let place = self.place(array, entry);
                    let _ = writeln!(text, "{place} = {};", body.text(value).text);
                }
            }
        }
        text
    }

    /// `result.mass[1][0]`.
    fn place(&self, array: usize, entry: usize) -> String {
        let result = &self.kernel.results[array];
        let mut indices = indices(&result.shape, entry).into_iter();
        let mut place = match self.form {
            Form::Single => "result".to_owned(),
            Form::Tuple => format!("result.{array}"),
            Form::Record(..) => format!("result.{}", result.name),
            Form::Partials => {
                let which = indices.next().unwrap_or(0);
                format!("result.{}[{which}].{}", BY[array / 3], result.name)
            }
        };
        for index in indices {
            let _ = write!(place, "[{index}]");
        }
        place
    }
}

/// `[[T; 3]; 2]` of `T` and shape 2, 3.
fn nested(entry: &str, shape: &[usize]) -> String {
    shape
        .iter()
        .rev()
        .fold(entry.to_owned(), |inner, n| format!("[{inner}; {n}]"))
}

/// Indices of an entry of a flattened array, outermost first.
fn indices(shape: &[usize], entry: usize) -> Vec<usize> {
    let mut rest = entry;
    let mut indices: Vec<usize> = shape
        .iter()
        .rev()
        .map(|&length| {
            let index = rest % length;
            rest /= length;
            index
        })
        .collect();
    indices.reverse();
    indices
}
