//! Runs a program without compiling it: for tests, and for tools that read mechanisms at run time.

use super::{Kernel, Operand, Operation, Program};

impl Program {
    /// Evaluates a kernel; `None` if there is no kernel of this name. See [`Kernel::evaluate`].
    pub fn evaluate(&self, kernel: &str, arguments: &[&[f64]]) -> Option<Vec<Vec<f64>>> {
        self.kernel(kernel).map(|kernel| kernel.evaluate(arguments))
    }
}

impl Kernel {
    /// Values of the results for the given arguments; arrays are flattened with the first index outermost. Elementary
    /// functions are those of the standard library, so sines and cosines may differ from the runtime's in the last
    /// digit.
    ///
    /// # Panics
    ///
    /// If the number or the lengths of the arguments do not match [`Kernel::parameters`].
    pub fn evaluate(&self, arguments: &[&[f64]]) -> Vec<Vec<f64>> {
        assert_eq!(arguments.len(), self.parameters.len(), "arguments of `{}`", self.name);
        for (argument, parameter) in arguments.iter().zip(&self.parameters) {
            assert_eq!(argument.len(), parameter.entries.len(), "`{}`", parameter.name);
        }
        let mut values: Vec<f64> = Vec::with_capacity(self.instructions.len());
        let read = |values: &[f64], operand| match operand {
            Operand::Constant(value) => value,
            Operand::Parameter(position, entry) => arguments[position][entry],
            Operand::Instruction(index) => values[index],
        };
        for instruction in &self.instructions {
            let value = match instruction.operation {
                Operation::Unary(operator, a) => operator.apply(read(&values, a)),
                Operation::Binary(operator, a, b) => operator.apply(read(&values, a), read(&values, b)),
            };
            values.push(value);
        }
        self.results.iter().map(|array| array.values.iter().map(|&operand| read(&values, operand)).collect()).collect()
    }
}
