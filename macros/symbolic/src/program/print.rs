//! Programs as text, for snapshots.

use std::fmt;

use crate::algebra::{Operator, Unary};

use super::{Kernel, Operand, Operation, Program};

impl fmt::Display for Program {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        for kernel in &self.kernels {
            writeln!(f, "{kernel}")?;
        }
        Ok(())
    }
}

impl fmt::Display for Kernel {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let parameters: Vec<String> =
            self.parameters.iter().map(|p| format!("{}[{}]", p.name, p.entries.join(", "))).collect();
        writeln!(
            f,
            "{}({}): {} operations, {} functions",
            self.name,
            parameters.join(", "),
            self.cost.operations,
            self.cost.functions
        )?;
        let text = |operand: Operand| match operand {
            Operand::Constant(value) => format!("{value}"),
            Operand::Parameter(position, entry) => self.parameters[position].entries[entry].clone(),
            Operand::Instruction(index) => format!("%{index}"),
        };
        for (index, instruction) in self.instructions.iter().enumerate() {
            let value = match instruction.operation {
                Operation::Unary(Unary::Negate, a) => format!("-{}", text(a)),
                Operation::Unary(Unary::PowerInteger(n), a) => format!("{}^{n}", text(a)),
                Operation::Unary(operator @ Unary::Spline(..), a) => {
                    format!("{}({})", operator.name(), text(a))
                }
                Operation::Unary(operator, a) => {
                    format!("{}({})", format!("{operator:?}").to_lowercase(), text(a))
                }
                Operation::Binary(Operator::Atan2, a, b) => {
                    format!("atan2({}, {})", text(a), text(b))
                }
                Operation::Binary(operator, a, b) => {
                    let sign = match operator {
                        Operator::Add => "+",
                        Operator::Subtract => "-",
                        Operator::Multiply => "*",
                        Operator::Divide => "/",
                        Operator::Power | Operator::Atan2 => "^",
                    };
                    format!("{} {sign} {}", text(a), text(b))
                }
            };
            let name = instruction.name.as_deref().unwrap_or("");
            writeln!(f, "  %{index} = {value}  {:?} {name}", instruction.stage)?;
        }
        for array in &self.results {
            let values: Vec<String> = array.values.iter().map(|&v| text(v)).collect();
            writeln!(f, "  {} {:?} = [{}]", array.name, array.shape, values.join(", "))?;
        }
        Ok(())
    }
}
