//! Products that share a pair of factors share its product.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use rustc_hash::FxHashMap;

use super::super::graph::Graph;
use super::super::node::Node;
use super::super::node_map::NodeMap;
use super::rebuild::{image, product, rebuild};
use super::uses::Uses;
use crate::base::ids::ExprId;
use crate::base::operators::Operator;

/// A factor: the place of a node among those that are rebuilt, or a pair of factors.
type Factor = u32;

/// The products below some roots, and the pairs of factors that represent partial products.
#[derive(Default)]
struct Products {
    /// Each product: its node and its factors in order.
    lists: Vec<(ExprId, Vec<Factor>)>,
    /// The factors that are not nodes: pairs of factors.
    pairs: Vec<(Factor, Factor)>,
    /// For each pair of factors, the products that may contain it.
    users: FxHashMap<(Factor, Factor), Vec<usize>>,
    nodes: usize,
}

impl Products {
    fn new(graph: &Graph, uses: &Uses) -> Self {
        let mut this = Self { nodes: uses.nodes.len(), ..Self::default() };
        for &id in uses.nodes.nodes() {
            let is_product = matches!(graph.node(id), Node::Binary(Operator::Multiply, ..));
            if is_product && !uses.in_product(id) {
                let mut factors = Vec::new();
                uses.factors(graph, id, &mut factors);
                let mut factors: Vec<Factor> =
                    factors.iter().filter_map(|&f| uses.nodes.place(f)).map(|index| index as Factor).collect();
                factors.sort_unstable();
                this.lists.push((id, factors));
            }
        }
        this
    }

    /// Whether a product contains both factors, or the same factor twice if they are equal.
    fn holds(&self, list: usize, (a, b): (Factor, Factor)) -> bool {
        let factors = &self.lists[list].1;
        let count = |wanted: Factor| factors.iter().filter(|&&f| f == wanted).count();
        if a == b { count(a) > 1 } else { count(a) > 0 && count(b) > 0 }
    }

    /// While two products share a pair, turns the most frequently shared pair into one factor.
    fn share(&mut self) {
        let mut held: Vec<((Factor, Factor), usize)> = Vec::new();
        for (list, (_, factors)) in self.lists.iter().enumerate() {
            for (k, &a) in factors.iter().enumerate() {
                for (l, &b) in factors.iter().enumerate().skip(k + 1) {
                    let repeated = factors[..k].contains(&a) || factors[k + 1..l].contains(&b);
                    if !repeated {
                        held.push(((a, b), list));
                    }
                }
            }
        }
        held.sort_unstable();
        let mut heap: BinaryHeap<(usize, Reverse<(Factor, Factor)>)> = BinaryHeap::new();
        for same in held.chunk_by(|(a, _), (b, _)| a == b).filter(|same| same.len() > 1) {
            let pair = same[0].0;
            heap.push((same.len(), Reverse(pair)));
            self.users.insert(pair, same.iter().map(|&(_, list)| list).collect());
        }
        while let Some((count, Reverse(pair))) = heap.pop() {
            let Some(lists) = self.users.remove(&pair) else {
                continue;
            };
            let lists: Vec<usize> = lists.into_iter().filter(|&l| self.holds(l, pair)).collect();
            if lists.len() < 2 {
                continue;
            }
            if lists.len() < count {
                heap.push((lists.len(), Reverse(pair)));
                self.users.insert(pair, lists);
                continue;
            }
            let factor = (self.nodes + self.pairs.len()) as Factor;
            self.pairs.push(pair);
            let mut fresh: Vec<(Factor, Factor)> = Vec::new();
            for &list in &lists {
                let factors = &mut self.lists[list].1;
                for part in [pair.0, pair.1] {
                    if let Some(k) = factors.iter().position(|&f| f == part) {
                        factors.remove(k);
                    }
                }
                let mut others = factors.clone();
                others.dedup();
                factors.push(factor);
                for other in others {
                    let pair = (other, factor);
                    let users = self.users.entry(pair).or_default();
                    if users.last() != Some(&list) {
                        users.push(list);
                    }
                    fresh.push(pair);
                }
            }
            fresh.sort_unstable();
            fresh.dedup();
            for pair in fresh {
                let count = self.users.get(&pair).map_or(0, Vec::len);
                if count > 1 {
                    heap.push((count, Reverse(pair)));
                }
            }
        }
    }

    fn build(&self, graph: &mut Graph, uses: &Uses, factor: Factor, images: &NodeMap) -> ExprId {
        match (factor as usize).checked_sub(self.nodes) {
            None => image(images, uses.nodes.nodes()[factor as usize]),
            Some(k) => {
                let (a, b) = self.pairs[k];
                let [a, b] = [a, b].map(|part| self.build(graph, uses, part, images));
                graph.mul(a, b)
            }
        }
    }
}

/// Shares the products of pairs below `roots`.
pub(super) fn share_products(graph: &mut Graph, roots: &[ExprId]) -> Vec<ExprId> {
    let uses = Uses::new(graph, roots);
    let mut products = Products::new(graph, &uses);
    products.share();
    let mut next = 0;
    rebuild(graph, roots, &uses, |graph, id, images| {
        let (head, factors) = products.lists.get(next)?;
        if *head != id {
            return None;
        }
        next += 1;
        let factors: Vec<ExprId> = factors.iter().map(|&factor| products.build(graph, &uses, factor, images)).collect();
        Some(product(graph, &factors))
    })
}
