//! Regroups sums and products to need fewer operations: common factors are taken out of sums, products that share a pair
//! of factors share its product, and quotients by the same denominator share its reciprocal.
//!
//! # Sums and products are regrouped
//!
//! Before a kernel is lowered, common factors are taken out of sums, and products with a pair of factors in common
//! share its product (`algebra/regroup.rs`). Each kernel is regrouped by itself, and only if that makes it cheaper.

mod products;
mod rebuild;
mod reciprocals;
mod sums;
mod uses;

use products::share_products;
pub(super) use reciprocals::share_reciprocals;
use sums::factor_sums;

use super::count::cost;
use super::function::Function;
use super::graph::Graph;
use crate::base::census::taken;
use crate::base::ids::ExprId;

/// The same functions with fewer divisions, and with sums and products regrouped where that needs fewer operations. Results
/// that several of the functions return are computed in the same way by all of them, so they agree to the last bit.
pub fn regrouped(graph: &mut Graph, functions: &[Function]) -> Vec<Function> {
    let roots: Vec<ExprId> = functions.iter().flat_map(Function::roots).collect();
    let roots = share_reciprocals(graph, &roots);
    let mut values = regroup(graph, &roots).into_iter();
    let mut functions = functions.to_vec();
    for array in functions.iter_mut().flat_map(|function| &mut function.results) {
        array.values = values.by_ref().take(array.values.len()).collect();
    }
    functions
}

/// `roots` regrouped, or unchanged if that is no cheaper. Values change by rounding only.
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
    if smaller { shared } else { roots.to_vec() }
}
