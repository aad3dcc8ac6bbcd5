//! Partial results.

use std::ops::Range;

use super::chunk::Chunk;
use super::mask::CHUNK;
use super::plan::Plan;
use super::tree::{Node, Tree};
use super::{Comoments, Covariance, LARGEST, Moments, Sketch, Statistics, ranges};
use crate::Error;

/// Statistics of the samples added so far, from any set of ranges.
///
/// Two instances of the same samples are equal to the last bit, however they were built. A contiguous range needs
/// memory that grows with the logarithm of its length.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(remote = "Self", expecting = "statistics of samples"))]
pub struct Partial {
    pub(super) plan: Plan,
    pub(super) tree: Tree,
    /// Incomplete chunks, in order.
    pub(super) fragments: Vec<Chunk>,
    pub(super) sketches: Vec<Option<Sketch>>,
    pub(super) outcomes: Vec<u64>,
}

impl Partial {
    /// A result without samples.
    #[must_use]
    pub fn new(plan: Plan) -> Self {
        Self {
            tree: Tree::default(),
            fragments: Vec::new(),
            sketches: plan.sketches.clone(),
            outcomes: vec![0; plan.outcomes],
            plan,
        }
    }

    /// The plan: which statistics are gathered.
    #[must_use]
    pub fn plan(&self) -> &Plan {
        &self.plan
    }

    /// Adds the samples of a chunk.
    ///
    /// # Errors
    ///
    /// If some of the samples were already added, the chunk has another plan, or a value is NaN or above [`LARGEST`] in
    /// magnitude. In that case nothing is added.
    // Inlined, so that it uses the vector instructions of its caller.
    #[inline(always)]
    pub fn add(&mut self, chunk: &Chunk) -> Result<(), Error> {
        if chunk.present.len() != self.plan.quantities() || chunk.outcomes.len() != self.plan.outcomes {
            return Err(Error::OtherPlan);
        }
        self.refuse_overlap(chunk)?;
        let node = Node::of(chunk, &self.plan);
        if !node.moments.iter().all(Moments::are_numbers) {
            return Err(not_a_number(chunk));
        }
        let mut room = [0.0; CHUNK];
        for (k, sketch) in self.sketches.iter_mut().enumerate() {
            if let (Some(sketch), Some((values, mask))) = (sketch, chunk.column(k)) {
                sketch.add_checked(mask.select(values, &mut room), &node.moments[k]);
            }
        }
        for (outcome, other) in self.outcomes.iter_mut().zip(&chunk.outcomes) {
            *outcome += other;
        }
        if chunk.covered.is_full() {
            self.tree.insert(node);
        } else {
            self.keep(chunk);
        }
        Ok(())
    }

    /// Adds all samples of another partial result.
    ///
    /// # Errors
    ///
    /// If both have samples in common, or if they have different plans. In that case nothing is added.
    pub fn merge(&mut self, other: Self) -> Result<(), Error> {
        if self.plan != other.plan {
            return Err(Error::OtherPlan);
        }
        if let Some(Range { start, end }) = ranges::overlap(&self.ranges(), &other.ranges()) {
            return Err(Error::Overlap { start, end });
        }
        for node in other.tree.nodes {
            self.tree.insert(node);
        }
        for fragment in &other.fragments {
            self.keep(fragment);
        }
        for (sketch, other) in self.sketches.iter_mut().zip(&other.sketches) {
            if let (Some(own), Some(other)) = (sketch, other) {
                own.merge_checked(other);
            }
        }
        for (outcome, other) in self.outcomes.iter_mut().zip(&other.outcomes) {
            *outcome += other;
        }
        Ok(())
    }

    /// The ranges of samples added, sorted and disjoint.
    #[must_use]
    pub fn ranges(&self) -> Vec<Range<u64>> {
        let nodes = self.tree.nodes.iter().map(Node::samples);
        let fragments = self.fragments.iter().flat_map(Chunk::samples);
        let mut all: Vec<_> = nodes.chain(fragments).collect();
        all.sort_unstable_by_key(|range| range.start);
        ranges::joined(all)
    }

    /// The ranges of samples in `whole` that are missing, in order.
    #[must_use]
    pub fn missing(&self, whole: Range<u64>) -> Vec<Range<u64>> {
        ranges::missing(&self.ranges(), whole)
    }

    /// Number of samples with each outcome.
    #[must_use]
    pub fn outcomes(&self) -> &[u64] {
        &self.outcomes
    }

    /// Moments of a quantity.
    ///
    /// # Errors
    ///
    /// If there is no such quantity.
    pub fn moments(&self, quantity: usize) -> Result<Moments, Error> {
        self.plan.check(quantity)?;
        let mut all = Moments::default();
        self.fold(|node| all.merge(&node.moments[quantity]));
        Ok(all)
    }

    /// Statistics of a quantity; `None` if no sample has it.
    ///
    /// # Errors
    ///
    /// If there is no such quantity.
    pub fn statistics(&self, quantity: usize) -> Result<Option<Statistics>, Error> {
        let moments = self.moments(quantity)?;
        Ok(Statistics::of(&moments, self.sketches[quantity].clone()))
    }

    /// Statistics of all quantities; `None` for those that no sample has.
    #[must_use]
    pub fn into_statistics(mut self) -> Vec<Option<Statistics>> {
        let mut all = vec![Moments::default(); self.plan.quantities()];
        self.fold(|node| {
            for (all, moment) in all.iter_mut().zip(&node.moments) {
                all.merge(moment);
            }
        });
        let sketches = self.sketches.drain(..);
        (all.iter().zip(sketches)).map(|(moments, sketch)| Statistics::of(moments, sketch)).collect()
    }

    /// Covariance of two quantities; `None` if no sample has both.
    ///
    /// # Errors
    ///
    /// If the plan does not include it.
    pub fn covariance(&self, first: usize, second: usize) -> Result<Option<Covariance>, Error> {
        Ok(Covariance::of(&self.comoments(first, second)?))
    }

    /// The sums behind the covariance of two quantities, for merging with those of other samples.
    ///
    /// # Errors
    ///
    /// If the plan does not include it.
    pub fn comoments(&self, first: usize, second: usize) -> Result<Comoments, Error> {
        let pair = (first.min(second), first.max(second));
        let Ok(index) = self.plan.pairs.binary_search(&pair) else {
            let reason = format!("that of {first} and {second} is not planned; ask for it with `Plan::covariances`");
            return Err(Error::setting("covariance", reason));
        };
        let mut all = Comoments::default();
        self.fold(|node| all.merge(&node.pairs[index]));
        if first > second {
            all.means.reverse();
            all.squares.reverse();
        }
        Ok(all)
    }

    /// Passes each part of the sums to `add`: complete chunks in order, then incomplete ones in order.
    fn fold(&self, mut add: impl FnMut(&Node)) {
        self.tree.nodes.iter().for_each(&mut add);
        for chunk in &self.fragments {
            add(&Node::of(chunk, &self.plan));
        }
    }

    fn keep(&mut self, part: &Chunk) {
        let position = self.fragments.binary_search_by_key(&part.index, |chunk| chunk.index);
        let at = position.unwrap_or_else(|at| {
            let mut empty = Chunk::empty(&self.plan, part.index);
            empty.outcomes.clear();
            self.fragments.insert(at, empty);
            at
        });
        self.fragments[at].join(part);
        if self.fragments[at].covered.is_full() {
            let whole = self.fragments.remove(at);
            self.tree.insert(Node::of(&whole, &self.plan));
        }
    }

    fn refuse_overlap(&self, chunk: &Chunk) -> Result<(), Error> {
        let nodes = &self.tree.nodes;
        let before = nodes.partition_point(|node| node.start <= chunk.index).checked_sub(1);
        let in_tree = before.is_some_and(|at| (chunk.index - nodes[at].start) >> nodes[at].level == 0);
        let position = self.fragments.binary_search_by_key(&chunk.index, |other| other.index);
        let in_fragment = position.is_ok_and(|at| !self.fragments[at].covered.and(chunk.covered).is_empty());
        if !in_tree && !in_fragment {
            return Ok(());
        }
        let chunk_ranges: Vec<_> = ranges::joined(chunk.samples());
        let common = ranges::overlap(&self.ranges(), &chunk_ranges).unwrap_or_default();
        Err(Error::Overlap { start: common.start, end: common.end })
    }
}

/// The error for an invalid value in the chunk.
fn not_a_number(chunk: &Chunk) -> Error {
    let mut values = (0..chunk.present.len()).flat_map(|k| {
        let column = chunk.column(k).into_iter();
        column.flat_map(move |(values, mask)| mask.places().map(move |offset| (k, offset, values[offset])))
    });
    let (quantity, offset, value) =
        values.find(|(_, _, value)| value.is_nan() || value.abs() > LARGEST).unwrap_or((0, 0, f64::NAN));
    let sample = chunk.index * CHUNK as u64 + offset as u64;
    Error::Value { quantity, sample, value: value.to_string() }
}
