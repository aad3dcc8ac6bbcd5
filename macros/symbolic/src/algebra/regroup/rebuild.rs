//! Rebuilding nodes.

use super::super::graph::Graph;
use super::super::node::Node;
use super::super::node_map::NodeMap;
use super::uses::Uses;
use crate::base::ids::ExprId;

/// Rebuilds the nodes below `roots`; `special` may build a node differently, from the images of older ones.
pub(super) fn rebuild(
    graph: &mut Graph,
    roots: &[ExprId],
    uses: &Uses,
    mut special: impl FnMut(&mut Graph, ExprId, &NodeMap) -> Option<ExprId>,
) -> Vec<ExprId> {
    let mut images = NodeMap::new(&uses.nodes);
    for &id in uses.nodes.nodes() {
        let node = graph.node(id);
        let built = match special(graph, id, &images) {
            Some(built) => built,
            None => match node {
                Node::Constant(_) | Node::Symbol(_) => id,
                Node::Unary(operator, a) => match image(&images, a) {
                    same if same == a => id,
                    a => graph.unary(operator, a),
                },
                Node::Binary(operator, a, b) => match (image(&images, a), image(&images, b)) {
                    same if same == (a, b) => id,
                    (a, b) => graph.binary(operator, a, b),
                },
            },
        };
        if built != id
            && let Some(name) = graph.given_name(id).cloned()
        {
            graph.set_name(built, || name);
        }
        images.set(id, built);
    }
    roots.iter().map(|&root| image(&images, root)).collect()
}

/// The rebuilt node of an operand.
pub(super) fn image(images: &NodeMap, id: ExprId) -> ExprId {
    images.get(id).expect("operands are older than their users")
}

/// The product of some factors, from the first to the last.
pub(super) fn product(graph: &mut Graph, factors: &[ExprId]) -> ExprId {
    let one = graph.constant(1.0);
    factors.iter().fold(one, |all, &factor| graph.mul(all, factor))
}
