//! Replaces symbols: the graph above them is rebuilt and simplified on the way.

use super::graph::Graph;
use super::node::Node;
use super::node_map::NodeMap;
use super::reached::Reached;
use crate::base::ids::{ExprId, SymbolId};

/// `roots` with each listed symbol replaced.
pub fn substitute(
    graph: &mut Graph,
    roots: &[ExprId],
    replacements: &[(SymbolId, ExprId)],
) -> Vec<ExprId> {
    let mask = Graph::mask(replacements.iter().map(|(symbol, _)| *symbol));
    let known = graph.len();
    let changing = Reached::dependent(graph, roots, mask);
    let mut image = NodeMap::new(&changing);
    for &id in changing.nodes() {
        let replaced = match graph.node(id) {
            Node::Constant(_) => id,
            Node::Symbol(symbol) => replacements
                .iter()
                .find(|(s, _)| *s == symbol)
                .map_or(id, |(_, replacement)| *replacement),
            Node::Unary(operator, a) => {
                let a = image.get(a).unwrap_or(a);
                graph.unary(operator, a)
            }
            Node::Binary(operator, a, b) => {
                let (a, b) = (image.get(a).unwrap_or(a), image.get(b).unwrap_or(b));
                graph.binary(operator, a, b)
            }
        };
        if replaced.index() >= known
            && let Some(name) = graph.given_name(id).cloned()
        {
            graph.set_name(replaced, || name);
        }
        image.set(id, replaced);
    }
    roots
        .iter()
        .map(|&root| image.get(root).unwrap_or(root))
        .collect()
}
