//! `a b + a c` as `a (b + c)`, in sums of any length.

use std::cmp::Reverse;

use super::super::graph::Graph;
use super::super::node::Node;
use super::rebuild::{image, product, rebuild};
use super::uses::{Uses, is_sum};
use crate::base::ids::ExprId;
use crate::base::operators::Operator;

/// Takes common factors out of the sums below `roots`.
pub(super) fn factor_sums(graph: &mut Graph, roots: &[ExprId]) -> Vec<ExprId> {
    let uses = Uses::new(graph, roots);
    rebuild(graph, roots, &uses, |graph, id, images| {
        let Node::Binary(operator, ..) = graph.node(id) else {
            return None;
        };
        if !is_sum(operator) || uses.in_sum(id) {
            return None;
        }
        let mut terms = Vec::new();
        uses.terms(graph, id, false, &mut terms);
        let is_product = |&(_, term): &(bool, ExprId)| {
            matches!(graph.node(term), Node::Binary(Operator::Multiply, ..)) && uses.in_sum(term)
        };
        if terms.iter().filter(|term| is_product(term)).count() < 2 {
            return None;
        }
        let terms: Vec<Term> = terms
            .into_iter()
            .map(|(minus, term)| {
                let mut factors = Vec::new();
                if uses.in_sum(term) {
                    uses.factors(graph, term, &mut factors)
                } else {
                    factors.push(term)
                }
                let factors = factors.iter().map(|&f| image(images, f)).collect();
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

/// The factor that occurs in the most terms with several factors, if it occurs in at least two.
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
    let (factor, count) = counts.into_iter().max_by_key(|&(id, count)| (count, Reverse(id)))?;
    (count > 1).then_some(factor)
}

fn sum(graph: &mut Graph, mut terms: Vec<Term>) -> ExprId {
    let mut done: Vec<(bool, ExprId)> = Vec::new();
    while let Some(common) = most_common(&terms) {
        let (mut with, without): (Vec<Term>, Vec<Term>) =
            terms.into_iter().partition(|term| term.factors.len() > 1 && term.factors.contains(&common));
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
    let products: Vec<(bool, ExprId)> =
        terms.into_iter().map(|term| (term.minus, product(graph, &term.factors))).collect();
    let (minus, plus): (Vec<_>, Vec<_>) = products.into_iter().chain(done).partition(|&(minus, _)| minus);
    let mut total = graph.zero();
    for (_, term) in plus {
        total = graph.add(total, term);
    }
    for (_, term) in minus {
        total = graph.sub(total, term);
    }
    total
}
