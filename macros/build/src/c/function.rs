//! One kernel as text.

use std::fmt::Write;

use eigentol_compiler::Compilation;

use super::Names;

/// Numbers of unknowns, inputs, design variables, outputs and excitations.
#[derive(Clone, Copy)]
pub(super) struct Sizes {
    coordinates: usize,
    inputs: usize,
    design: usize,
    outputs: usize,
    excitations: usize,
}

/// The length of an array along one of its indices.
#[derive(Clone, Copy)]
pub(super) enum Size {
    /// Unknowns.
    N,
    /// Inputs.
    U,
    /// Design variables.
    P,
    /// Outputs.
    O,
    /// Excitations.
    E,
    /// A fixed number.
    Exactly(usize),
}

impl Sizes {
    pub(super) fn of(compilation: &Compilation) -> Self {
        let mechanism = &compilation.mechanism;
        Self {
            coordinates: compilation.functions.unknowns.len(),
            inputs: mechanism.inputs.len(),
            design: mechanism.design.len(),
            outputs: mechanism.outputs.len(),
            excitations: mechanism.excitations.len(),
        }
    }

    fn number(self, size: Size) -> usize {
        match size {
            Size::N => self.coordinates,
            Size::U => self.inputs,
            Size::P => self.design,
            Size::O => self.outputs,
            Size::E => self.excitations,
            Size::Exactly(number) => number,
        }
    }
}

/// An argument of a C function.
#[derive(Clone, Copy)]
pub(super) enum Argument {
    /// An array.
    Array(&'static str, Size),
    /// A number.
    Number(&'static str),
}

/// A result of a C function.
#[derive(Clone, Copy)]
pub(super) struct Answer {
    pub(super) name: &'static str,
    pub(super) shape: &'static [Size],
    /// The part of the kernel's `result` as a slice of numbers; for a list of matrices, one slice per matrix.
    pub(super) part: Part,
}

/// The location of a part of a kernel's `result`.
#[derive(Clone, Copy)]
pub(super) enum Part {
    /// An expression for a slice.
    Slice(&'static str),
    /// A list of records of matrices, and the field to take from each.
    Matrices(&'static str, &'static str),
}

/// A kernel.
pub(super) struct Function {
    pub(super) name: &'static str,
    pub(super) about: &'static str,
    pub(super) arguments: Vec<Argument>,
    pub(super) answers: Vec<Answer>,
}

impl Function {
    /// A function for C, documented.
    pub(super) fn text(&self, names: &Names, sizes: Sizes) -> String {
        let Names { rust, prefix, .. } = names;
        let name = self.name;
        let mut text = String::new();
        for line in self.about.lines() {
            let _ = writeln!(text, "/// {line}");
        }
        let [reads, writes] = self.lengths(sizes);
        let _ = writeln!(text, "///\n/// Reads {reads}.\n/// Writes {writes}.");
        let _ = writeln!(
            text,
            "#[unsafe(no_mangle)]\npub unsafe extern \"C\" fn {prefix}_{name}({}) -> i32 {{",
            self.parameters()
        );
        let _ = writeln!(
            text,
            "    let null = first_null(&[{}]);\n    if null != 0 {{\n        return null;\n    }}",
            self.places(sizes)
        );
        let _ = writeln!(
            text,
            "    // SAFETY: nothing is null, and the caller vouches for the lengths.\n    unsafe {{\n        \
             let result = ::eigentol::Mechanism::{name}(&super::{rust}{});",
            self.passed()
        );
        for answer in &self.answers {
            text += &answer.stored();
        }
        text += "    }\n    0\n}\n\n";
        text
    }

    fn parameters(&self) -> String {
        let arguments = self.arguments.iter().map(|argument| match argument {
            Argument::Array(name, _) => format!("{name}: *const f64"),
            Argument::Number(name) => format!("{name}: f64"),
        });
        let answers = self.answers.iter();
        let answers = answers.map(|answer| format!("{}: *mut f64", answer.name));
        arguments.chain(answers).collect::<Vec<_>>().join(", ")
    }

    /// Position, pointer and length of every array.
    fn places(&self, sizes: Sizes) -> String {
        let arguments = self.arguments.iter().map(|argument| match argument {
            Argument::Array(name, size) => Some(format!("{name}, {}", sizes.number(*size))),
            Argument::Number(_) => None,
        });
        let answers = self.answers.iter().map(|answer| {
            let entries: usize = answer.shape.iter().map(|&size| sizes.number(size)).product();
            Some(format!("{}.cast_const(), {entries}", answer.name))
        });
        arguments
            .chain(answers)
            .enumerate()
            .filter_map(|(k, array)| Some(format!("({}, {})", k + 1, array?)))
            .collect::<Vec<_>>()
            .join(", ")
    }

    fn passed(&self) -> String {
        let passed = self.arguments.iter().map(|argument| match argument {
            Argument::Array(name, _) => format!(", &read({name})"),
            Argument::Number(name) => format!(", {name}"),
        });
        passed.collect()
    }

    /// The length of each array, as text for the C documentation.
    fn lengths(&self, sizes: Sizes) -> [String; 2] {
        let arguments = self.arguments.iter().map(|argument| match argument {
            Argument::Array(name, size) => format!("`{name}[{}]`", sizes.number(*size)),
            Argument::Number(name) => format!("`{name}`"),
        });
        let answers = self.answers.iter().map(|answer| {
            let shape = answer.shape.iter();
            let shape: String = shape.map(|&size| format!("[{}]", sizes.number(size))).collect();
            format!("`{}{shape}`", answer.name)
        });
        let (arguments, answers): (Vec<_>, Vec<_>) = (arguments.collect(), answers.collect());
        [arguments, answers].map(|list| list.join(", "))
    }
}

impl Answer {
    fn stored(&self) -> String {
        let name = self.name;
        match self.part {
            Part::Slice(slice) => format!("        write({slice}, {name});\n"),
            Part::Matrices(list, field) => format!(
                "        for (k, matrices) in result.{list}.iter().enumerate() {{\n            \
                 let matrix = matrices.{field}.as_flattened();\n            \
                 write(matrix, {name}.add(k * matrix.len()));\n        }}\n"
            ),
        }
    }
}
