//! Runs kernels in any scalar type without rustc: instantiating the generated code for one more scalar would cost
//! minutes.

use eigentol::{Dual, Real};
use eigentol_compiler::algebra::{Operator, Unary};
use eigentol_compiler::program::{Kernel, Operand, Operation};

/// The results of a kernel; arrays are flattened with the first index outermost.
pub fn interpret<T: Real>(kernel: &Kernel, arguments: &[&[T]]) -> Vec<Vec<T>> {
    let mut values: Vec<T> = Vec::with_capacity(kernel.instructions.len());
    let read = |values: &[T], operand| match operand {
        Operand::Constant(value) => T::constant(value),
        Operand::Parameter(position, entry) => arguments[position][entry],
        Operand::Instruction(index) => values[index],
    };
    for instruction in &kernel.instructions {
        let value = match instruction.operation {
            Operation::Unary(operator, a) => unary(operator, read(&values, a)),
            Operation::Binary(operator, a, b) => binary(operator, read(&values, a), read(&values, b)),
        };
        values.push(value);
    }
    let array = |list: &[Operand]| list.iter().map(|&entry| read(&values, entry)).collect();
    kernel.results.iter().map(|result| array(&result.values)).collect()
}

/// Directional derivatives of the results, in the same dual numbers that the runtime uses to differentiate kernels.
pub fn interpret_along(kernel: &Kernel, arguments: &[&[f64]], direction: &[&[f64]]) -> Vec<Vec<f64>> {
    let dual = |(&value, &slope): (&f64, &f64)| Dual { value, slope };
    let moved = |(values, slopes): (&&[f64], &&[f64])| -> Vec<Dual<f64>> {
        assert_eq!(values.len(), slopes.len(), "{}", kernel.name);
        values.iter().zip(*slopes).map(dual).collect()
    };
    let moved: Vec<_> = arguments.iter().zip(direction).map(moved).collect();
    let slices: Vec<&[Dual<f64>]> = moved.iter().map(Vec::as_slice).collect();
    let slopes = |list: &Vec<Dual<f64>>| list.iter().map(|entry| entry.slope).collect();
    interpret(kernel, &slices).iter().map(slopes).collect()
}

fn unary<T: Real>(operator: Unary, a: T) -> T {
    match operator {
        Unary::Negate => -a,
        Unary::Sqrt => a.sqrt(),
        Unary::Sin => a.sin(),
        Unary::Cos => a.cos(),
        Unary::Tan => a.tan(),
        Unary::Asin => a.asin(),
        Unary::Acos => a.acos(),
        Unary::Exp => a.exp(),
        Unary::Ln => a.ln(),
        Unary::PowerInteger(exponent) => a.powi(exponent),
        Unary::Spline(spline, derivative) => a.spline(spline.pieces(), usize::from(derivative)),
    }
}

fn binary<T: Real>(operator: Operator, a: T, b: T) -> T {
    match operator {
        Operator::Add => a + b,
        Operator::Subtract => a - b,
        Operator::Multiply => a * b,
        Operator::Divide => a / b,
        Operator::Power => a.powf(b),
        Operator::Atan2 => a.atan2(b),
    }
}
