//! From expressions to instructions.

use crate::algebra::{Function, Graph, Node, Reached};
use crate::base::ids::{ExprId, SymbolId};

use super::schedule::schedule;
use super::{Array, Instruction, Kernel, Operand, Operation, Parameter, Program};

/// Lowers every function.
pub fn lower(graph: &Graph, functions: &[Function]) -> Program {
    let stages = graph.stages();
    let kernels = functions
        .iter()
        .map(|function| {
            let parameters = function
                .parameters
                .iter()
                .map(|parameter| Parameter {
                    name: parameter.name,
                    entries: parameter.symbols.iter().map(|&symbol| graph.symbol_info(symbol).name.clone()).collect(),
                    scalar: parameter.scalar,
                })
                .collect();
            let roots = function.roots();
            let needed = Reached::below(graph, &roots);
            let order = schedule(graph, &needed, &roots);
            let mut lowering = Lowering::new(graph, &needed, function);
            let instructions = order.into_iter().map(|id| lowering.instruction(id, stages[id.index()])).collect();
            let results = function
                .results
                .iter()
                .map(|array| Array {
                    name: array.name,
                    shape: array.shape.clone(),
                    values: array.values.iter().map(|&id| lowering.operand(id)).collect(),
                })
                .collect();
            Kernel { name: function.name, parameters, instructions, results, cost: function.cost(graph) }
        })
        .collect();
    Program { kernels }
}

struct Lowering<'a> {
    graph: &'a Graph,
    needed: &'a Reached,
    symbols: Vec<Option<(usize, usize)>>,
    /// By place among the needed nodes: the number of its instruction, counted from one, or zero if there is none yet.
    done: Vec<u32>,
    count: u32,
}

impl<'a> Lowering<'a> {
    fn new(graph: &'a Graph, needed: &'a Reached, function: &Function) -> Self {
        let mut symbols = vec![None; graph.symbol_count()];
        for (position, parameter) in function.parameters.iter().enumerate() {
            for (entry, symbol) in parameter.symbols.iter().enumerate() {
                symbols[symbol.index()] = Some((position, entry));
            }
        }
        Self { graph, needed, symbols, done: vec![0; needed.len()], count: 0 }
    }

    fn instruction(&mut self, id: ExprId, stage: crate::algebra::Stage) -> Instruction {
        let operation = match self.graph.node(id) {
            Node::Unary(operator, a) => Operation::Unary(operator, self.operand(a)),
            Node::Binary(operator, a, b) => Operation::Binary(operator, self.operand(a), self.operand(b)),
            Node::Constant(_) | Node::Symbol(_) => unreachable!("leaves are operands"),
        };
        self.count += 1;
        if let Some(index) = self.needed.place(id) {
            self.done[index] = self.count;
        }
        Instruction { name: self.graph.given_name(id).cloned(), stage, operation }
    }

    fn operand(&self, id: ExprId) -> Operand {
        match self.graph.node(id) {
            Node::Constant(bits) => Operand::Constant(f64::from_bits(bits)),
            Node::Symbol(symbol) => self.parameter(symbol),
            _ => {
                let index = self.needed.place(id);
                let number = index.and_then(|index| self.done[index].checked_sub(1));
                Operand::Instruction(number.expect("operands come before their users") as usize)
            }
        }
    }

    fn parameter(&self, symbol: SymbolId) -> Operand {
        let (position, entry) =
            self.symbols[symbol.index()].expect("a function takes every symbol that its results depend on");
        Operand::Parameter(position, entry)
    }
}
