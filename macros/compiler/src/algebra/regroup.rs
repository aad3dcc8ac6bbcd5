//! Fewer operations by another grouping of sums and products: factors common to terms are taken out, and products that
//! share pairs of factors share their product.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use rustc_hash::FxHashMap;

use super::count::{cost, reachable};
use super::graph::{Graph, Node, Operator};
use crate::base::ids::ExprId;

/// `roots` regrouped, or as they are where that is no cheaper. Values change by rounding only.
pub fn regroup(graph: &mut Graph, roots: &[ExprId]) -> Vec<ExprId> {
    let factored = factor_sums(graph, roots);
    let shared = share_products(graph, &factored);
    let size = |graph: &Graph, roots: &[ExprId]| {
        let cost = cost(graph, roots);
        cost.operations + cost.functions + cost.negations
    };
    let before = size(graph, roots);
    match size(graph, &shared) < before {
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

/// Rebuilds the nodes below `roots`; `special` may build a node in its own way from the images of older ones, and tells which
/// nodes it never needs.
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

/// `a b + a c` as `a (b + c)`, in sums of any length.
fn factor_sums(graph: &mut Graph, roots: &[ExprId]) -> Vec<ExprId> {
    let uses = Uses::new(graph, roots);
    rebuild(graph, roots, &uses, |graph, id, image| {
        let Node::Binary(operator, ..) = graph.node(id) else {
            return None;
        };
        if !is_sum(operator) || uses.in_sum[id.index()] {
            return None;
        }
        let mut terms = Vec::new();
        uses.terms(graph, id, false, &mut terms);
        let terms: Vec<Term> = terms
            .into_iter()
            .map(|(minus, term)| {
                let mut factors = Vec::new();
                match uses.in_sum[term.index()] {
                    true => uses.factors(graph, term, &mut factors),
                    false => factors.push(term),
                }
                let factors = factors.iter().map(|f| image[f.index()]).collect();
                Term { minus, factors }
            })
            .collect();
        most_common(&terms)?;
        Some(sum(graph, terms))
    })
}

/// A term of a sum.
struct Term {
    minus: bool,
    factors: Vec<ExprId>,
}

/// The factor that occurs in most terms of several factors, if it occurs in two at least.
fn most_common(terms: &[Term]) -> Option<ExprId> {
    let mut counts: Vec<(ExprId, u32)> = Vec::new();
    for term in terms.iter().filter(|term| term.factors.len() > 1) {
        for (k, factor) in term.factors.iter().enumerate() {
            if term.factors[..k].contains(factor) {
                continue;
            }
            match counts.iter_mut().find(|(known, _)| known == factor) {
                Some((_, count)) => *count += 1,
                None => counts.push((*factor, 1)),
            }
        }
    }
    let (factor, count) = counts
        .into_iter()
        .max_by_key(|&(id, count)| (count, Reverse(id)))?;
    (count > 1).then_some(factor)
}

fn sum(graph: &mut Graph, mut terms: Vec<Term>) -> ExprId {
    let mut done: Vec<(bool, ExprId)> = Vec::new();
    while let Some(common) = most_common(&terms) {
        let (mut with, without): (Vec<Term>, Vec<Term>) = terms
            .into_iter()
            .partition(|term| term.factors.len() > 1 && term.factors.contains(&common));
        for term in &mut with {
            if let Some(k) = term.factors.iter().position(|&factor| factor == common) {
                term.factors.remove(k);
            }
        }
        let minus = with.iter().all(|term| term.minus);
        for term in &mut with {
            term.minus ^= minus;
        }
        let rest = sum(graph, with);
        done.push((minus, graph.mul(common, rest)));
        terms = without;
    }
    let products: Vec<(bool, ExprId)> = terms
        .into_iter()
        .map(|term| (term.minus, product(graph, &term.factors)))
        .collect();
    let all = products.into_iter().chain(done);
    let (minus, plus): (Vec<_>, Vec<_>) = all.partition(|&(minus, _)| minus);
    let mut total = graph.zero();
    for (_, term) in plus {
        total = graph.add(total, term);
    }
    for (_, term) in minus {
        total = graph.sub(total, term);
    }
    total
}

fn product(graph: &mut Graph, factors: &[ExprId]) -> ExprId {
    let one = graph.constant(1.0);
    factors
        .iter()
        .fold(one, |all, &factor| graph.mul(all, factor))
}

/// A factor: a node, or a pair of factors.
type Factor = u32;

/// The products below some roots, and pairs of factors that stand for their product.
#[derive(Default)]
struct Products {
    /// Heads of products, and their factors in order.
    lists: Vec<(ExprId, Vec<Factor>)>,
    /// What stands behind the factors that are no nodes.
    pairs: Vec<(Factor, Factor)>,
    /// Products in which two factors may stand.
    users: FxHashMap<(Factor, Factor), Vec<usize>>,
    nodes: usize,
}

impl Products {
    fn new(graph: &Graph, uses: &Uses) -> Self {
        let mut this = Self {
            nodes: uses.count.len(),
            ..Self::default()
        };
        for &id in &uses.order {
            let is_product = matches!(graph.node(id), Node::Binary(Operator::Multiply, ..));
            if is_product && !uses.in_product[id.index()] {
                let mut factors = Vec::new();
                uses.factors(graph, id, &mut factors);
                let mut factors: Vec<Factor> = factors.iter().map(|f| f.index() as u32).collect();
                factors.sort_unstable();
                this.lists.push((id, factors));
            }
        }
        this
    }

    /// Whether a product holds both factors, the same one twice if they are equal.
    fn holds(&self, list: usize, (a, b): (Factor, Factor)) -> bool {
        let factors = &self.lists[list].1;
        let count = |wanted: Factor| factors.iter().filter(|&&f| f == wanted).count();
        match a == b {
            true => count(a) > 1,
            false => count(a) > 0 && count(b) > 0,
        }
    }

    /// As long as two products share a pair, the pair that most share becomes one factor.
    fn share(&mut self) {
        for list in 0..self.lists.len() {
            let factors = self.lists[list].1.clone();
            for (k, &a) in factors.iter().enumerate() {
                for (l, &b) in factors.iter().enumerate().skip(k + 1) {
                    let repeated = factors[..k].contains(&a) || factors[k + 1..l].contains(&b);
                    if !repeated {
                        self.users.entry((a, b)).or_default().push(list);
                    }
                }
            }
        }
        let mut heap: BinaryHeap<(usize, Reverse<(Factor, Factor)>)> = self
            .users
            .iter()
            .filter(|(_, lists)| lists.len() > 1)
            .map(|(&pair, lists)| (lists.len(), Reverse(pair)))
            .collect();
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

    fn build(&self, graph: &mut Graph, factor: Factor, image: &[ExprId]) -> ExprId {
        match (factor as usize).checked_sub(self.nodes) {
            None => image[factor as usize],
            Some(k) => {
                let (a, b) = self.pairs[k];
                let (a, b) = (self.build(graph, a, image), self.build(graph, b, image));
                graph.mul(a, b)
            }
        }
    }
}

/// Products that share a pair of factors share its product.
fn share_products(graph: &mut Graph, roots: &[ExprId]) -> Vec<ExprId> {
    let uses = Uses::new(graph, roots);
    let mut products = Products::new(graph, &uses);
    products.share();
    let mut next = 0;
    rebuild(graph, roots, &uses, |graph, id, image| {
        let (head, factors) = products.lists.get(next)?;
        if *head != id {
            return None;
        }
        next += 1;
        let factors: Vec<ExprId> = factors
            .iter()
            .map(|&factor| products.build(graph, factor, image))
            .collect();
        Some(product(graph, &factors))
    })
}
