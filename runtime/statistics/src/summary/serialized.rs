//! Deserialisation of a partial result, with validation.

use super::chunk::Chunk;
use super::mask::CHUNK;
use super::partial::Partial;
use super::plan::Plan;
use super::ranges;
use super::sketch::Sketch;
use super::tree::Node;

crate::checked!(Partial);

impl Partial {
    fn checked(self) -> Result<Self, &'static str> {
        let Self { plan, tree, fragments, sketches, outcomes } = &self;
        let whole = plan_is_consistent(plan)
            && tree.nodes.iter().all(|node| node_fits(node, plan))
            && fragments.iter().all(|chunk| fragment_fits(chunk, plan))
            && sketches_fit(sketches, plan)
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
        Ok(self)
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
