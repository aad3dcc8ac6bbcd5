//! Point after point of a sparse grid, none of them stored.

use super::SparseGrid;

/// A point of a sparse grid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SparseNode<'a> {
    /// Standard normal values, one for each dimension.
    pub point: &'a [f64],
    /// Its weight, possibly negative. The sum over all points is 1.
    pub weight: f64,
    /// Its weight in the grid of one level less, zero if it is not in there.
    pub coarse_weight: f64,
}

/// Walks along a [`SparseGrid`].
#[derive(Clone, Debug)]
pub struct SparseWalk<'a> {
    grid: &'a SparseGrid,
    started: bool,
    /// Coordinates other than zero, by dimension.
    active: Vec<Active>,
    /// What their rules leave of the level.
    left: usize,
    point: Vec<f64>,
}

/// A coordinate at a node other than zero.
#[derive(Clone, Copy, Debug)]
struct Active {
    dimension: usize,
    /// The rule has `2 g + 1` nodes.
    g: usize,
    node: usize,
    /// Product of the weights up to here.
    weight: f64,
}

impl<'a> SparseWalk<'a> {
    pub(super) fn new(grid: &'a SparseGrid) -> Self {
        Self {
            grid,
            started: false,
            active: Vec::new(),
            left: grid.level,
            point: vec![0.0; grid.dimensions],
        }
    }

    /// The next point and its weights. `None` behind the last one.
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

    /// Goes on in depth first: one more coordinate, else the next node, rule or dimension of the last one.
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

    /// Sets a coordinate to a node, if there is one and the level allows its rule.
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
        self.active.push(Active {
            dimension,
            g,
            node,
            weight: before * weight,
        });
        true
    }
}
