//! Fewer operations by another grouping of sums and products: factors common to terms are taken out, and products that
//! share pairs of factors share their product.

mod products;
mod sums;

use products::share_products;
use sums::factor_sums;

use super::count::{cost, reachable};
use super::function::Function;
use super::graph::{Graph, Node, Operator};
use crate::base::census::taken;
use crate::base::ids::ExprId;

/// The same results for fewer operations, where sums and products can be grouped so. What several of the functions return
/// is computed alike by all of them, to the last bit.
pub fn regrouped(graph: &mut Graph, functions: &[Function]) -> Vec<Function> {
    let roots: Vec<ExprId> = functions.iter().flat_map(Function::roots).collect();
    let mut values = regroup(graph, &roots).into_iter();
    let mut functions = functions.to_vec();
    let arrays = functions
        .iter_mut()
        .flat_map(|function| &mut function.results);
    for array in arrays {
        array.values = values.by_ref().take(array.values.len()).collect();
    }
    functions
}

/// `roots` regrouped, or as they are where that is no cheaper. Values change by rounding only.
pub fn regroup(graph: &mut Graph, roots: &[ExprId]) -> Vec<ExprId> {
    let factored = factor_sums(graph, roots);
    let shared = share_products(graph, &factored);
    let size = |graph: &Graph, roots: &[ExprId]| {
        let cost = cost(graph, roots);
        cost.operations + cost.functions + cost.negations
    };
    let before = size(graph, roots);
    let smaller = size(graph, &shared) < before;
    taken(|| format!("regroup: smaller {smaller}"));
    match smaller {
        true => shared,
        false => roots.to_vec(),
    }
}

/// How the nodes below some roots are used.
struct Uses {
    order: Vec<ExprId>,
    /// By node: how often it is an operand or a root.
    count: Vec<u32>,
    /// By node: its only use is as an operand of a sum, of a product.
    in_sum: Vec<bool>,
    in_product: Vec<bool>,
}

impl Uses {
    fn new(graph: &Graph, roots: &[ExprId]) -> Self {
        let order = reachable(graph, roots);
        let size = order.last().map_or(0, |last| last.index() + 1);
        let mut this = Self {
            order,
            count: vec![0; size],
            in_sum: vec![false; size],
            in_product: vec![false; size],
        };
        for root in roots {
            this.count[root.index()] += 1;
        }
        for &id in &this.order {
            let node = graph.node(id);
            for operand in operands(node).into_iter().flatten() {
                let k = operand.index();
                this.count[k] += 1;
                if let Node::Binary(operator, ..) = node {
                    this.in_sum[k] = is_sum(operator);
                    this.in_product[k] = operator == Operator::Multiply;
                }
            }
        }
        for k in 0..size {
            this.in_sum[k] &= this.count[k] == 1;
            this.in_product[k] &= this.count[k] == 1;
        }
        this
    }

    /// The factors of a product, through products used nowhere else.
    fn factors(&self, graph: &Graph, id: ExprId, list: &mut Vec<ExprId>) {
        let Node::Binary(Operator::Multiply, a, b) = graph.node(id) else {
            list.push(id);
            return;
        };
        for operand in [a, b] {
            if self.in_product[operand.index()] {
                self.factors(graph, operand, list);
            } else {
                list.push(operand);
            }
        }
    }

    /// The terms of a sum, through sums used nowhere else; `true` for those that are subtracted.
    fn terms(&self, graph: &Graph, id: ExprId, minus: bool, list: &mut Vec<(bool, ExprId)>) {
        let Node::Binary(operator @ (Operator::Add | Operator::Subtract), a, b) = graph.node(id)
        else {
            list.push((minus, id));
            return;
        };
        let signs = [minus, minus ^ (operator == Operator::Subtract)];
        for (operand, minus) in [a, b].into_iter().zip(signs) {
            if self.in_sum[operand.index()] {
                self.terms(graph, operand, minus, list);
            } else {
                list.push((minus, operand));
            }
        }
    }
}

fn operands(node: Node) -> [Option<ExprId>; 2] {
    match node {
        Node::Constant(_) | Node::Symbol(_) => [None, None],
        Node::Unary(_, a) => [Some(a), None],
        Node::Binary(_, a, b) => [Some(a), Some(b)],
    }
}

fn is_sum(operator: Operator) -> bool {
    matches!(operator, Operator::Add | Operator::Subtract)
}

/// Rebuilds the nodes below `roots`; `special` may build a node in its own way from the images of older ones.
fn rebuild(
    graph: &mut Graph,
    roots: &[ExprId],
    uses: &Uses,
    mut special: impl FnMut(&mut Graph, ExprId, &[ExprId]) -> Option<ExprId>,
) -> Vec<ExprId> {
    let mut image: Vec<ExprId> = (0..uses.count.len()).map(ExprId::new).collect();
    for &id in &uses.order {
        let node = graph.node(id);
        let built = match special(graph, id, &image) {
            Some(built) => built,
            None => match node {
                Node::Constant(_) | Node::Symbol(_) => id,
                Node::Unary(operator, a) => graph.unary(operator, image[a.index()]),
                Node::Binary(operator, a, b) => {
                    graph.binary(operator, image[a.index()], image[b.index()])
                }
            },
        };
        if built != id
            && let Some(name) = graph.name(id).map(str::to_owned)
        {
            graph.set_name(built, || name);
        }
        image[id.index()] = built;
    }
    roots.iter().map(|root| image[root.index()]).collect()
}

fn product(graph: &mut Graph, factors: &[ExprId]) -> ExprId {
    let one = graph.constant(1.0);
    factors
        .iter()
        .fold(one, |all, &factor| graph.mul(all, factor))
}
