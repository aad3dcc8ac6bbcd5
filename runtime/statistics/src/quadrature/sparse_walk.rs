//! Iteration over a sparse grid without storing its points.

use super::SparseGrid;

/// A point of a sparse grid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SparseNode<'a> {
    /// Standard normal values, one per dimension.
    pub point: &'a [f64],
    /// Its weight, possibly negative. The weights of all points sum to 1.
    pub weight: f64,
    /// Its weight in the grid of the next lower level; zero if it is not part of it.
    pub coarse_weight: f64,
}

/// Iterates over a [`SparseGrid`].
#[derive(Clone, Debug)]
pub struct SparseWalk<'a> {
    grid: &'a SparseGrid,
    started: bool,
    /// Nonzero coordinates, by dimension.
    active: Vec<Active>,
    /// Remainder of the level after their rules.
    left: usize,
    point: Vec<f64>,
}

/// A coordinate at a nonzero node.
#[derive(Clone, Copy, Debug)]
struct Active {
    dimension: usize,
    /// Size of its rule, which has `2 g + 1` nodes.
    g: usize,
    node: usize,
    /// Product of the weights of the coordinates up to this one.
    weight: f64,
}

impl<'a> SparseWalk<'a> {
    pub(super) fn new(grid: &'a SparseGrid) -> Self {
        Self { grid, started: false, active: Vec::new(), left: grid.level, point: vec![0.0; grid.dimensions] }
    }

    /// The next point and its weights; `None` after the last one.
    pub fn next_point(&mut self) -> Option<SparseNode<'_>> {
        loop {
            if self.started && !self.advance() {
                return None;
            }
            self.started = true;
            let (fine, coarse) = self.grid.factors[self.active.len()].pair(self.left);
            if (fine, coarse) != (0.0, 0.0) {
                let product = self.active.last().map_or(1.0, |active| active.weight);
                return Some(SparseNode {
                    point: &self.point,
                    weight: product * fine,
                    coarse_weight: product * coarse,
                });
            }
        }
    }

    /// Advances depth first: adds a coordinate, otherwise moves the last one to its next node, rule or dimension.
    fn advance(&mut self) -> bool {
        let behind = self.active.last().map_or(0, |last| last.dimension + 1);
        if self.push(behind, 1, 0) {
            return true;
        }
        while let Some(last) = self.active.pop() {
            self.left += 2 * last.g - 1;
            self.point[last.dimension] = 0.0;
            if self.push(last.dimension, last.g, last.node + 1)
                || self.push(last.dimension, last.g + 1, 0)
                || self.push(last.dimension + 1, 1, 0)
            {
                return true;
            }
        }
        false
    }

    /// Sets a coordinate to a node, if the node exists and the level allows its rule.
    fn push(&mut self, dimension: usize, g: usize, node: usize) -> bool {
        let Some(left) = self.left.checked_sub(2 * g - 1) else {
            return false;
        };
        let Some(coordinate) = self.point.get_mut(dimension) else {
            return false;
        };
        let Some(&(value, weight)) = self.grid.rules.get(g - 1).and_then(|r| r.get(node)) else {
            return false;
        };
        *coordinate = value;
        let before = self.active.last().map_or(1.0, |last| last.weight);
        self.left = left;
        self.active.push(Active { dimension, g, node, weight: before * weight });
        true
    }
}
