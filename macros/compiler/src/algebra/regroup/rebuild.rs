//! Building nodes anew.

use super::super::graph::{Graph, Node};
use super::uses::Uses;
use crate::base::ids::ExprId;

/// Rebuilds the nodes below `roots`; `special` may build a node in its own way from the images of older ones.
pub(super) fn rebuild(
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

/// The product of some factors, from the first to the last.
pub(super) fn product(graph: &mut Graph, factors: &[ExprId]) -> ExprId {
    let one = graph.constant(1.0);
    factors
        .iter()
        .fold(one, |all, &factor| graph.mul(all, factor))
}
