//! Quotients by the same denominator share its reciprocal.

use super::super::graph::Graph;
use super::super::node::Node;
use super::rebuild::{image, rebuild};
use super::uses::Uses;
use crate::base::ids::ExprId;
use crate::base::operators::Operator;

/// Turns three or more quotients by the same denominator into products with its reciprocal.
pub(in super::super) fn share_reciprocals(graph: &mut Graph, roots: &[ExprId]) -> Vec<ExprId> {
    let uses = Uses::new(graph, roots);
    let nodes = uses.nodes.nodes().iter();
    let denominator = |id: &ExprId| match graph.node(*id) {
        Node::Binary(Operator::Divide, _, b) => Some(b),
        _ => None,
    };
    let mut denominators: Vec<ExprId> = nodes.filter_map(denominator).collect();
    denominators.sort_unstable();
    let shared: Vec<ExprId> =
        denominators.chunk_by(|a, b| a == b).filter(|same| same.len() > 2).map(|same| same[0]).collect();
    if shared.is_empty() {
        return roots.to_vec();
    }
    let one = graph.constant(1.0);
    rebuild(graph, roots, &uses, |graph, id, images| {
        let Node::Binary(Operator::Divide, a, b) = graph.node(id) else {
            return None;
        };
        shared.binary_search(&b).ok()?;
        let reciprocal = graph.div(one, image(images, b));
        Some(graph.mul(image(images, a), reciprocal))
    })
}
