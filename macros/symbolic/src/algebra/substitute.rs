//! Replaces symbols: the graph above them is rebuilt and simplified on the way.

use super::graph::Graph;
use super::node::Node;
use super::node_map::NodeMap;
use super::reached::Reached;
use crate::base::ids::{ExprId, SymbolId};

/// `roots` with each listed symbol replaced.
pub fn substitute(graph: &mut Graph, roots: &[ExprId], replacements: &[(SymbolId, ExprId)]) -> Vec<ExprId> {
    let mask = Graph::mask(replacements.iter().map(|(symbol, _)| *symbol));
    let known = graph.len();
    let changing = Reached::dependent_with_slopes(graph, roots, mask);
    let mut image = NodeMap::new(&changing);
    for &id in changing.nodes() {
        let replaced = match graph.node(id) {
            Node::Constant(_) => id,
            Node::Symbol(symbol) => {
                replacements.iter().find(|(s, _)| *s == symbol).map_or(id, |(_, replacement)| *replacement)
            }
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
    for &id in changing.nodes() {
        let new = image.get(id).filter(|new| new.index() >= known);
        if let (Some(new), Some(slopes)) = (new, graph.given_slopes(id)) {
            let replaced = |id: ExprId| image.get(id).unwrap_or(id);
            graph.set_slopes(new, slopes.iter().map(|(by, slope)| (replaced(*by), replaced(*slope))).collect());
        }
    }
    roots.iter().map(|&root| image.get(root).unwrap_or(root)).collect()
}
