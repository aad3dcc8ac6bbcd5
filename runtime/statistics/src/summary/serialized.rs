//! Deserialisation of a partial result, with validation.

use super::chunk::Chunk;
use super::mask::CHUNK;
use super::partial::Partial;
use super::plan::Plan;
use super::ranges;
use super::sketch::Sketch;
use super::tree::{Node, Tree};
use serde::de::Error as _;
use serde::{Deserialize, Deserializer};

/// A [`Partial`] as read, before validation.
#[derive(serde::Deserialize)]
#[serde(expecting = "statistics of samples")]
struct Unchecked {
    plan: Plan,
    tree: Tree,
    fragments: Vec<Chunk>,
    sketches: Vec<Option<Sketch>>,
    outcomes: Vec<u64>,
}

impl<'de> Deserialize<'de> for Partial {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        Self::try_from(Unchecked::deserialize(from)?).map_err(D::Error::custom)
    }
}

impl TryFrom<Unchecked> for Partial {
    type Error = &'static str;

    fn try_from(read: Unchecked) -> Result<Self, &'static str> {
        let Unchecked { plan, tree, fragments, sketches, outcomes } = read;
        let whole = plan_is_consistent(&plan)
            && tree.nodes.iter().all(|node| node_fits(node, &plan))
            && fragments.iter().all(|chunk| fragment_fits(chunk, &plan))
            && sketches_fit(&sketches, &plan)
            && outcomes.len() == plan.outcomes;
        if !whole {
            return Err("the parts of this partial result do not fit together");
        }
        let in_order = tree.nodes.is_sorted_by(|a, b| a.samples().end <= b.samples().start)
            && fragments.is_sorted_by(|a, b| a.index < b.index);
        let nodes: Vec<_> = tree.nodes.iter().map(Node::samples).collect();
        let parts: Vec<_> = ranges::joined(fragments.iter().flat_map(Chunk::samples));
        if !in_order || ranges::overlap(&nodes, &parts).is_some() {
            return Err("the samples of this partial result overlap");
        }
        Ok(Self { plan, tree, fragments, sketches, outcomes })
    }
}

fn plan_is_consistent(plan: &Plan) -> bool {
    let pairs = plan.pairs.iter().all(|(first, second)| first < second && *second < plan.quantities());
    pairs && plan.pairs.is_sorted() && plan.sketches.iter().flatten().all(Sketch::is_consistent)
}

fn node_fits(node: &Node, plan: &Plan) -> bool {
    let lengths = node.moments.len() == plan.quantities() && node.pairs.len() == plan.pairs.len();
    let places = node.start < 1 << 52 && node.start.trailing_zeros() >= node.level;
    if !lengths || node.level >= 52 || !places {
        return false;
    }
    let counts = node.moments.iter().map(|moments| moments.count);
    let of_pairs = node.pairs.iter().map(|pair| pair.count);
    counts.chain(of_pairs).all(|count| count <= (CHUNK as u64) << node.level)
}

fn fragment_fits(chunk: &Chunk, plan: &Plan) -> bool {
    let counts = chunk.present.len() == plan.quantities()
        && chunk.values.len() == plan.quantities() * CHUNK
        && chunk.outcomes.is_empty();
    let within = chunk.present.iter().all(|mask| mask.and(chunk.covered) == *mask);
    counts && within && chunk.index < 1 << 52 && !chunk.covered.is_full() && !chunk.covered.is_empty()
}

fn sketches_fit(sketches: &[Option<Sketch>], plan: &Plan) -> bool {
    sketches.len() == plan.quantities()
        && sketches.iter().zip(&plan.sketches).all(|pair| match pair {
            (Some(sketch), Some(planned)) => sketch.is_like(planned) && sketch.is_consistent(),
            (None, None) => true,
            _ => false,
        })
}
