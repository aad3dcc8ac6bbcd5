//! An executable kernel: operations on numbered registers.
//!
//! # Interpreted mechanisms
//!
//! `runtime/interpreter` groups equal operations of a kernel into runs (`schedule.rs`) and numbers their values, so
//! that one dispatch serves many operations (`tape.rs`). One tape serves numbers, dual numbers, intervals and processor
//! vectors.

use std::collections::HashMap;

use eigentol::Real;
use eigentol_compiler::algebra::{Operator, Unary};
use eigentol_compiler::program::{Kernel, Operand, Operation};

use crate::schedule::{Code, runs};

/// Numbered storage places for numbers.
pub(crate) trait Registers {
    type Number: Real;
    fn get(&self, register: u32) -> Self::Number;
    fn set(&mut self, register: u32, value: Self::Number);
}

/// Registers of an operation: its result and its operands. A sine has its cosine's register in place of a second
/// operand.
#[derive(Clone, Copy, Debug)]
struct Step {
    to: u32,
    a: u32,
    b: u32,
}

/// Steps of one kind.
#[derive(Clone, Debug)]
struct Run {
    code: Code,
    steps: Vec<Step>,
}

/// A kernel in executable form. Its registers hold constants, arguments and intermediate values; registers of values no
/// longer needed are reused.
#[derive(Clone, Debug)]
pub(crate) struct Tape {
    pub(crate) constants: Vec<f64>,
    /// Number of entries of each argument.
    pub(crate) arguments: Vec<usize>,
    pub(crate) registers: usize,
    runs: Vec<Run>,
    /// Registers of the entries of each result.
    pub(crate) results: Vec<Vec<u32>>,
}

impl Tape {
    pub(crate) fn new(kernel: &Kernel) -> Self {
        let mut allocation = Allocation::new(kernel);
        let runs = runs(kernel);
        let runs = runs
            .iter()
            .map(|run| Run {
                code: run.code,
                steps: run.members.iter().map(|&(index, second)| allocation.step(kernel, index, second)).collect(),
            })
            .collect();
        let results = kernel
            .results
            .iter()
            .map(|array| array.values.iter().map(|&entry| allocation.register(entry)).collect())
            .collect();
        Self {
            constants: allocation.constants,
            arguments: kernel.parameters.iter().map(|parameter| parameter.entries.len()).collect(),
            registers: allocation.next as usize,
            runs,
            results,
        }
    }

    /// Runs the operations; constants and arguments must be in their registers.
    #[inline(always)]
    pub(crate) fn run<R: Registers>(&self, registers: &mut R) {
        for run in &self.runs {
            let steps = run.steps.as_slice();
            match run.code {
                Code::Binary(Operator::Add) => binary(registers, steps, |a, b| a + b),
                Code::Binary(Operator::Subtract) => binary(registers, steps, |a, b| a - b),
                Code::Binary(Operator::Multiply) => binary(registers, steps, |a, b| a * b),
                Code::Binary(Operator::Divide) => binary(registers, steps, |a, b| a / b),
                Code::Binary(Operator::Power) => binary(registers, steps, Real::powf),
                Code::Binary(Operator::Atan2) => binary(registers, steps, Real::atan2),
                Code::SinCos => {
                    for step in steps {
                        let (sine, cosine) = registers.get(step.a).sin_cos();
                        registers.set(step.to, sine);
                        registers.set(step.b, cosine);
                    }
                }
                Code::Unary(Unary::Negate) => unary(registers, steps, |a| -a),
                Code::Unary(Unary::Sqrt) => unary(registers, steps, Real::sqrt),
                Code::Unary(Unary::Sin) => unary(registers, steps, Real::sin),
                Code::Unary(Unary::Cos) => unary(registers, steps, Real::cos),
                Code::Unary(Unary::Tan) => unary(registers, steps, Real::tan),
                Code::Unary(Unary::Asin) => unary(registers, steps, Real::asin),
                Code::Unary(Unary::Acos) => unary(registers, steps, Real::acos),
                Code::Unary(Unary::Exp) => unary(registers, steps, Real::exp),
                Code::Unary(Unary::Ln) => unary(registers, steps, Real::ln),
                Code::Unary(Unary::PowerInteger(exponent)) => unary(
                    registers,
                    steps,
                    #[inline(always)]
                    |a| a.powi(exponent),
                ),
                Code::Unary(Unary::Spline(spline, derivative)) => {
                    let (pieces, order) = (spline.pieces(), usize::from(derivative));
                    unary(
                        registers,
                        steps,
                        #[inline(always)]
                        |a| a.spline(pieces, order),
                    );
                }
            }
        }
    }
}

#[inline(always)]
fn unary<R: Registers>(registers: &mut R, steps: &[Step], f: impl Fn(R::Number) -> R::Number) {
    for step in steps {
        let value = f(registers.get(step.a));
        registers.set(step.to, value);
    }
}

#[inline(always)]
fn binary<R: Registers>(registers: &mut R, steps: &[Step], f: impl Fn(R::Number, R::Number) -> R::Number) {
    for step in steps {
        let value = f(registers.get(step.a), registers.get(step.b));
        registers.set(step.to, value);
    }
}

/// The assignment of values to registers.
struct Allocation {
    constants: Vec<f64>,
    /// Register of each constant, by its bits.
    known: HashMap<u64, u32>,
    /// First register of each argument.
    arguments: Vec<u32>,
    /// Register of each instruction placed so far.
    values: Vec<u32>,
    /// Number of operations and results that still need an instruction's value.
    uses: Vec<usize>,
    free: Vec<u32>,
    next: u32,
}

impl Allocation {
    fn new(kernel: &Kernel) -> Self {
        let mut uses = vec![0; kernel.instructions.len()];
        let mut constants: Vec<f64> = Vec::new();
        let mut known = HashMap::new();
        let operands = kernel.instructions.iter().flat_map(|instruction| instruction.operation.operands());
        let results = kernel.results.iter().flat_map(|array| &array.values);
        for operand in operands.chain(results.copied()) {
            match operand {
                Operand::Instruction(index) => uses[index] += 1,
                Operand::Constant(value) => {
                    known.entry(value.to_bits()).or_insert_with(|| {
                        constants.push(value);
                        constants.len() as u32 - 1
                    });
                }
                Operand::Parameter(..) => {}
            }
        }
        let mut next = constants.len() as u32;
        let arguments = kernel
            .parameters
            .iter()
            .map(|parameter| {
                let first = next;
                next += parameter.entries.len() as u32;
                first
            })
            .collect();
        Self { constants, known, arguments, values: vec![0; kernel.instructions.len()], uses, free: Vec::new(), next }
    }

    fn register(&self, operand: Operand) -> u32 {
        match operand {
            Operand::Constant(value) => self.known[&value.to_bits()],
            Operand::Parameter(argument, entry) => self.arguments[argument] + entry as u32,
            Operand::Instruction(index) => self.values[index],
        }
    }

    /// Places an instruction, and the cosine computed with it.
    fn step(&mut self, kernel: &Kernel, index: usize, second: Option<usize>) -> Step {
        let operation = &kernel.instructions[index].operation;
        let (a, b) = match *operation {
            Operation::Unary(_, a) => (a, None),
            Operation::Binary(_, a, b) => (a, Some(b)),
        };
        let (from_a, from_b) = (self.register(a), b.map(|b| self.register(b)));
        // The angle is read once for both.
        let readers = std::iter::once(operation).chain(second.map(|cosine| &kernel.instructions[cosine].operation));
        for operand in readers.flat_map(Operation::operands) {
            self.release(operand);
        }
        let to = self.place(index);
        let b = match second {
            Some(cosine) => self.place(cosine),
            None => from_b.unwrap_or(from_a),
        };
        Step { to, a: from_a, b }
    }

    fn release(&mut self, operand: Operand) {
        if let Operand::Instruction(index) = operand {
            self.uses[index] -= 1;
            if self.uses[index] == 0 {
                self.free.push(self.values[index]);
            }
        }
    }

    fn place(&mut self, index: usize) -> u32 {
        let register = self.free.pop().unwrap_or_else(|| {
            self.next += 1;
            self.next - 1
        });
        self.values[index] = register;
        if self.uses[index] == 0 {
            // The value is never read.
            self.free.push(register);
        }
        register
    }
}
