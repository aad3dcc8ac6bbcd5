//! Tensor products of Gauss-Hermite rules.

use super::{CompensatedSum, Node, Rule, finite, gauss_hermite};
use crate::Error;

/// Every combination of the nodes of one rule per dimension: exact for polynomials of degree `2 nodes - 1` in each
/// variable.
///
/// Efficient only in few dimensions.
///
/// ```
/// use eigentol_statistics::quadrature::TensorGrid;
///
/// let grid = TensorGrid::new(&[2, 3])?;
/// assert_eq!(grid.points(), 6);
/// let mean = grid.integrate(|z| z[0].powi(2) * z[1].powi(4))?;
/// assert!((mean - 3.0).abs() < 1e-14);
/// # Ok::<(), eigentol_statistics::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct TensorGrid {
    rules: Vec<Rule>,
    points: u64,
}

impl TensorGrid {
    /// A grid with the given number of nodes in each dimension.
    ///
    /// # Errors
    /// [`Error::Setting`] for zero dimensions, if a rule does not exist (see [`gauss_hermite`]) or for more than 2^64
    /// points.
    pub fn new(nodes: &[usize]) -> Result<Self, Error> {
        let setting = |reason: &str| Error::Setting { setting: "nodes", reason: reason.into() };
        if nodes.is_empty() {
            return Err(setting("a grid has at least one dimension"));
        }
        let rules = nodes.iter().map(|&nodes| gauss_hermite(nodes));
        let points = nodes.iter().try_fold(1_u64, |points, &nodes| points.checked_mul(nodes as u64));
        Ok(Self {
            rules: rules.collect::<Result<_, _>>()?,
            points: points.ok_or_else(|| setting("more than 2^64 points: take a sparse grid"))?,
        })
    }

    /// Number of coordinates of a point.
    pub fn dimensions(&self) -> usize {
        self.rules.len()
    }

    /// Number of points of the grid.
    pub fn points(&self) -> u64 {
        self.points
    }

    /// Iterates over the points, starting at point `first`; the last coordinate changes fastest.
    pub fn from(&self, first: u64) -> TensorWalk<'_> {
        let mut rest = first;
        let mut places: Vec<usize> = (self.rules.iter().rev())
            .map(|rule| {
                let number = rule.nodes.len() as u64;
                let digit = rest % number;
                rest /= number;
                digit as usize
            })
            .collect();
        places.reverse();
        TensorWalk {
            rules: &self.rules,
            left: self.points.saturating_sub(first),
            point: vec![0.0; places.len()],
            products: vec![1.0; places.len() + 1],
            places,
            changed: 0,
        }
    }

    /// The mean of a function of independent standard normal variables.
    ///
    /// # Errors
    /// [`Error::NotFinite`] if the sum is not finite.
    pub fn integrate(&self, mut f: impl FnMut(&[f64]) -> f64) -> Result<f64, Error> {
        let mut walk = self.from(0);
        let mut sum = CompensatedSum::default();
        while let Some(Node { point, weight }) = walk.next_point() {
            sum.add(weight * f(point));
        }
        finite(sum.value())
    }
}

/// Iterates over a [`TensorGrid`].
#[derive(Clone, Debug)]
pub struct TensorWalk<'a> {
    rules: &'a [Rule],
    left: u64,
    /// For the next point: its nodes, the first dimension that differs from the previous point, its coordinates, and
    /// the products of the weights of the leading dimensions.
    places: Vec<usize>,
    changed: usize,
    point: Vec<f64>,
    products: Vec<f64>,
}

impl TensorWalk<'_> {
    /// The next point and its weight; `None` after the last one.
    pub fn next_point(&mut self) -> Option<Node<'_>> {
        self.left.checked_sub(1).map(|left| {
            self.update();
            self.left = left;
            self.step();
            Node { point: &self.point, weight: self.products.last().copied().unwrap_or(1.0) }
        })
    }

    fn update(&mut self) {
        for j in self.changed..self.places.len() {
            let (rule, index) = (&self.rules[j], self.places[j]);
            self.point[j] = rule.nodes[index];
            self.products[j + 1] = self.products[j] * rule.weights[index];
        }
    }

    fn step(&mut self) {
        for j in (0..self.places.len()).rev() {
            self.changed = j;
            self.places[j] += 1;
            if self.places[j] < self.rules[j].nodes.len() {
                return;
            }
            self.places[j] = 0;
        }
    }
}
