//! The statements of a method.

use std::fmt::Write;

use crate::algebra::Unary;
use crate::program::{Kernel, Operand, Operation};

use super::expression::Text;
use super::names::{Names, local, wanted};
use super::sines::{Group, groups};

/// Number of statements per block. A long chain of plain `let`s nests one scope per statement, which rustc cannot
/// handle beyond a few thousand; longer bodies declare the names of each block at once and then assign them.
const BLOCK: usize = 256;

/// Maximum number of operations that an unnamed value used once may contain to be written inline where it is used.
const INLINE: usize = 6;

/// Names that the emitter itself uses around the statements.
const RESERVED: [&str; 8] = ["zero", "result", "value", "volume", "margin", "smaller", "least", "known"];

/// A method body: statements, and the text of every operand that the results refer to.
pub(super) struct Body<'a> {
    kernel: &'a Kernel,
    /// For each instruction, the places where its value is stored as soon as it is known.
    places: Vec<Vec<String>>,
    texts: Vec<Option<Text>>,
    entries: Vec<Vec<String>>,
    statements: Vec<Statement>,
}

enum Statement {
    /// Local variables, the pattern that binds them, and its value.
    Let(Vec<String>, String, String),
    /// A place in a result, and its value.
    Store(String, String),
}

impl<'a> Body<'a> {
    /// Writes the statements of a kernel.
    pub(super) fn new(kernel: &'a Kernel) -> Self {
        Self::storing(kernel, vec![Vec::new(); kernel.instructions.len()])
    }

    /// Writes the statements of a kernel; after each instruction, its value is stored at the places given for it.
    pub(super) fn storing(kernel: &'a Kernel, places: Vec<Vec<String>>) -> Self {
        let mut names = Names::new(kernel.parameters.iter().map(|p| p.name).chain(RESERVED));
        let mut this = Self {
            kernel,
            places,
            texts: vec![None; kernel.instructions.len()],
            entries: Vec::new(),
            statements: Vec::new(),
        };
        this.load_parameters(&mut names);
        this.compute(&mut names);
        this
    }

    /// The text of an operand.
    pub(super) fn text(&self, operand: Operand) -> Text {
        match operand {
            Operand::Constant(value) => Text::constant(value),
            Operand::Parameter(position, entry) => Text::atom(self.entries[position][entry].clone()),
            Operand::Instruction(index) => self.texts[index].clone().expect("operands come before their users"),
        }
    }

    /// The statements as text.
    pub(super) fn statements(&self) -> String {
        let mut text = String::new();
        let plain = self.statements.len() <= BLOCK;
        let keyword = if plain { "let " } else { "" };
        for block in self.statements.chunks(BLOCK) {
            let names: Vec<&str> = block
                .iter()
                .flat_map(|statement| match statement {
                    Statement::Let(names, ..) => names.as_slice(),
                    Statement::Store(..) => &[],
                })
                .map(String::as_str)
                .collect();
            if !plain && !names.is_empty() {
                let _ = writeln!(text, "let ({},);", names.join(", "));
            }
            for statement in block {
                let _ = match statement {
                    Statement::Let(_, pattern, value) => {
                        writeln!(text, "{keyword}{pattern} = {value};")
                    }
                    Statement::Store(target, value) => writeln!(text, "{target} = {value};"),
                };
            }
        }
        text
    }

    fn load_parameters(&mut self, names: &mut Names) {
        let used = self.used_entries();
        for (parameter, used) in self.kernel.parameters.iter().zip(used) {
            let mut entries = Vec::new();
            for (entry, wanted) in parameter.entries.iter().enumerate() {
                if parameter.scalar {
                    entries.push(local(parameter.name));
                    continue;
                }
                if !used[entry] {
                    entries.push(String::new());
                    continue;
                }
                let name = names.unique(wanted);
                let value = format!("{}[{entry}]", local(parameter.name));
                self.let_one(&name, value);
                entries.push(name);
            }
            self.entries.push(entries);
        }
    }

    fn used_entries(&self) -> Vec<Vec<bool>> {
        let mut used: Vec<Vec<bool>> = self.kernel.parameters.iter().map(|p| vec![false; p.entries.len()]).collect();
        let operands = self.kernel.instructions.iter().flat_map(|i| i.operation.operands());
        let results = self.kernel.results.iter().flat_map(|array| array.values.iter().copied());
        for operand in operands.chain(results) {
            if let Operand::Parameter(position, entry) = operand {
                used[position][entry] = true;
            }
        }
        used
    }

    fn compute(&mut self, names: &mut Names) {
        let instructions = &self.kernel.instructions;
        let uses = self.uses();
        let (groups, membership) = groups(self.kernel);
        let mut size = vec![1; instructions.len()];
        for (index, instruction) in instructions.iter().enumerate() {
            if let Some(group) = membership[index] {
                if groups[group].last == index {
                    self.sines(&groups[group], names);
                }
                continue;
            }
            let (text, operations) = match instruction.operation {
                Operation::Unary(operator, a) => (Text::unary(operator, &self.text(a)), self.size(&size, a)),
                Operation::Binary(operator, a, b) => {
                    (Text::binary(operator, &self.text(a), &self.text(b)), self.size(&size, a) + self.size(&size, b))
                }
            };
            let sign = matches!(instruction.operation, Operation::Unary(Unary::Negate, _));
            let least = if self.places[index].is_empty() { operations < INLINE } else { true };
            let inline = sign || (uses[index] == 1 && instruction.name.is_none() && least);
            if inline {
                size[index] = operations + usize::from(!sign);
                self.texts[index] = Some(text);
                self.store(index);
                continue;
            }
            size[index] = 0;
            let wanted = wanted(instruction, |operand| self.name(operand));
            let name = names.unique(&wanted);
            self.let_one(&name, text.text);
            self.texts[index] = Some(Text::atom(name));
            self.store(index);
        }
    }

    /// Stores a value at its places in the results.
    fn store(&mut self, index: usize) {
        for target in std::mem::take(&mut self.places[index]) {
            let value = self.text(Operand::Instruction(index)).text;
            self.statements.push(Statement::Store(target, value));
        }
    }

    /// How often each value is written. A sign passes its count on to its operand, because signs are never stored.
    fn uses(&self) -> Vec<usize> {
        let mut uses = vec![0; self.kernel.instructions.len()];
        for array in &self.kernel.results {
            for value in &array.values {
                if let Operand::Instruction(index) = *value {
                    uses[index] += 1;
                }
            }
        }
        for (index, instruction) in self.kernel.instructions.iter().enumerate().rev() {
            let sign = matches!(instruction.operation, Operation::Unary(Unary::Negate, _));
            let count = if sign { uses[index] } else { 1 };
            for operand in instruction.operation.operands() {
                if let Operand::Instruction(operand) = operand {
                    uses[operand] += count;
                }
            }
        }
        uses
    }

    /// The sines and cosines of a group in one statement.
    fn sines(&mut self, group: &Group, names: &mut Names) {
        let mut named = Vec::new();
        let (mut patterns, mut angles) = (Vec::new(), Vec::new());
        for &(angle, functions) in &group.angles {
            let pattern = functions.map(|index| {
                let Some(index) = index else {
                    return "_".to_owned();
                };
                let instruction = &self.kernel.instructions[index];
                let name = names.unique(&wanted(instruction, |operand| self.name(operand)));
                named.push((index, name.clone()));
                name
            });
            patterns.push(format!("({})", pattern.join(", ")));
            angles.push(self.text(angle));
        }
        let (pattern, value) = match (&patterns[..], &angles[..]) {
            ([pattern], [angle]) => (pattern.clone(), Text::sin_cos(angle)),
            _ => (format!("[{}]", patterns.join(", ")), Text::sin_cos_all(&angles)),
        };
        let variables = named.iter().map(|(_, name)| name.clone()).collect();
        self.statements.push(Statement::Let(variables, pattern, value.text));
        for (index, name) in named {
            self.texts[index] = Some(Text::atom(name));
            self.store(index);
        }
    }

    fn let_one(&mut self, name: &str, value: String) {
        let name = name.to_owned();
        self.statements.push(Statement::Let(vec![name.clone()], name, value));
    }

    fn size(&self, size: &[usize], operand: Operand) -> usize {
        match operand {
            Operand::Instruction(index) => size[index],
            _ => 0,
        }
    }

    /// The name of a stored value.
    fn name(&self, operand: Operand) -> Option<String> {
        if let Operand::Constant(_) = operand {
            return None;
        }
        let text = self.text(operand).text;
        let is_word = text.bytes().all(|b| b.is_ascii_alphanumeric() || b == b'_');
        Some(text.strip_suffix('_').filter(|_| is_word)?.to_owned())
    }
}
