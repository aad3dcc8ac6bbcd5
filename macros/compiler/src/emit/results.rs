//! The result of a method, assembled at the end or, if it consists of many matrices, stored entry by entry.
//!
//! Entries that are assembled at the end must be held somewhere and copied; a variable that they are stored into must
//! first be set to zero. Measured with 600 entries, both take the same time; with 5000 entries of a chain of eight
//! bars, storing takes half the time. A fifth of that is the zeros, which a caller who reuses the variable need not
//! write again. However, rustc needs a quarter of a millisecond to check each storing statement, so only partial
//! derivatives are stored: they are generated for small mechanisms.

use std::fmt::Write;

use crate::program::{Array, Kernel, Operand};

use super::body::Body;
use super::form::Form;
use super::signature::call;

/// The parts of a result.
pub(super) struct Results<'a> {
    kernel: &'a Kernel,
    form: Form,
    at_once: bool,
}

/// Maximum number of entries of a result that is assembled at the end.
const MOST_AT_ONCE: usize = 4096;

/// Lists of [`Form::Partials`].
const BY: [&str; 3] = ["by_coordinate", "by_input", "by_design"];

impl<'a> Results<'a> {
    pub(super) fn new(kernel: &'a Kernel, form: Form) -> Self {
        let entries: usize = kernel.results.iter().map(|array| array.values.len()).sum();
        Self { kernel, form, at_once: entries <= MOST_AT_ONCE || !matches!(form, Form::Partials) }
    }

    /// The type of the result.
    pub(super) fn kind(&self) -> String {
        let arrays = self.kernel.results.iter();
        let types: Vec<String> = arrays.map(|array| filled("T", &array.shape)).collect();
        match self.form {
            Form::Single => types[0].clone(),
            Form::Tuple => format!("({})", types.join(", ")),
            Form::Record(name, generics) => {
                format!("::eigentol::{name}<{}>", types[..generics].join(", "))
            }
            Form::Partials => {
                let lists: Vec<String> = self
                    .kernel
                    .results
                    .chunks(3)
                    .map(|arrays| {
                        let (count, shape) = (arrays[0].shape[0], &arrays[0].shape[1..]);
                        format!("[::eigentol::Linear<{}>; {count}]", filled("T", shape))
                    })
                    .collect();
                format!("::eigentol::LinearPartials<{}>", lists.join(", "))
            }
        }
    }

    /// The statements that compute the result, followed by the result.
    pub(super) fn body(&self) -> String {
        if self.at_once {
            let body = Body::new(self.kernel);
            return format!("{}{}", body.statements(), self.literal(&body));
        }
        let into = format!("{}_into_inlined", self.kernel.name);
        format!(
            "let zero_ = T::constant(0.0);\nlet mut result_ = {};\n{};\nresult_",
            self.zero(),
            call(self.kernel, &into, "&mut result_")
        )
    }

    /// The statements that store every entry that can be nonzero into `result`; `None` if the result is assembled at
    /// the end.
    pub(super) fn stores(&self) -> Option<String> {
        let body = (!self.at_once).then(|| Body::storing(self.kernel, self.places()))?;
        Some(format!("{}{}", body.statements(), self.rest(&body)))
    }

    /// The whole result as a literal.
    fn literal(&self, body: &Body) -> String {
        let array = |array: &Array| literal(body, &array.shape, &array.values);
        self.put_together(array, |arrays| {
            let count = arrays[0].shape[0];
            let matrices = (0..count).map(|k| {
                fields(arrays, |array| {
                    let size = array.values.len() / count;
                    let values = &array.values[k * size..(k + 1) * size];
                    literal(body, &array.shape[1..], values)
                })
            });
            let matrices: Vec<String> = matrices.map(|m| format!("::eigentol::Linear {m}")).collect();
            format!("[{}]", matrices.join(", "))
        })
    }

    /// The whole result with all entries equal to `zero`.
    fn zero(&self) -> String {
        let array = |array: &Array| filled("zero_", &array.shape);
        self.put_together(array, |arrays| {
            let matrix = fields(arrays, |array| filled("zero_", &array.shape[1..]));
            format!("[::eigentol::Linear {matrix}; {}]", arrays[0].shape[0])
        })
    }

    /// The result, assembled from the text of its arrays or of its lists of matrices.
    fn put_together(&self, array: impl Fn(&Array) -> String, list: impl Fn(&[Array]) -> String) -> String {
        let results = &self.kernel.results;
        match self.form {
            Form::Single => array(&results[0]),
            Form::Tuple => {
                let arrays: Vec<String> = results.iter().map(array).collect();
                format!("({})", arrays.join(", "))
            }
            Form::Record(name, _) => format!("::eigentol::{name} {}", fields(results, array)),
            Form::Partials => {
                let lists: Vec<String> =
                    BY.iter().zip(results.chunks(3)).map(|(by, arrays)| format!("{by}: {}", list(arrays))).collect();
                format!("::eigentol::LinearPartials {{ {} }}", lists.join(", "))
            }
        }
    }

    /// For each instruction, the places of its value in the result.
    fn places(&self) -> Vec<Vec<String>> {
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

    /// Statements for entries that no instruction computes: nonzero numbers, and arguments.
    fn rest(&self, body: &Body) -> String {
        let mut text = String::new();
        for (array, result) in self.kernel.results.iter().enumerate() {
            for (entry, &value) in result.values.iter().enumerate() {
                let known = match value {
                    Operand::Constant(value) => value.to_bits() == 0,
                    Operand::Parameter(..) => false,
                    Operand::Instruction(_) => true,
                };
                if !known {
                    let target = self.place(array, entry);
                    let _ = writeln!(text, "{target} = {};", body.text(value).text);
                }
            }
        }
        text
    }

    /// `result.by_design[2].mass[1][0]`.
    fn place(&self, array: usize, entry: usize) -> String {
        let result = &self.kernel.results[array];
        let mut indices = indices(&result.shape, entry).into_iter();
        let which = indices.next().unwrap_or(0);
        let mut text = format!("result_.{}[{which}].{}", BY[array / 3], result.name);
        for index in indices {
            let _ = write!(text, "[{index}]");
        }
        text
    }
}

/// `{ mass: .., damping: .. }`.
fn fields(arrays: &[Array], value: impl Fn(&Array) -> String) -> String {
    let fields: Vec<String> = arrays.iter().map(|array| format!("{}: {}", array.name, value(array))).collect();
    format!("{{ {} }}", fields.join(", "))
}

/// `[[a, b], [c, d]]`.
fn literal(body: &Body, shape: &[usize], values: &[Operand]) -> String {
    let Some((&length, inner)) = shape.split_first() else {
        return body.text(values[0]).text;
    };
    let size = values.len().checked_div(length).unwrap_or(0);
    let entries: Vec<String> = (0..length).map(|k| literal(body, inner, &values[k * size..(k + 1) * size])).collect();
    format!("[{}]", entries.join(", "))
}

/// `[[T; 3]; 2]` of `T` and shape 2, 3.
fn filled(entry: &str, shape: &[usize]) -> String {
    shape.iter().rev().fold(entry.to_owned(), |inner, n| format!("[{inner}; {n}]"))
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
