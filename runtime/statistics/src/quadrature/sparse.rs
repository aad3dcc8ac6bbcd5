//! Smolyak's sparse grids of Gauss-Hermite rules, with every point once.
//!
//! In one variable, level `l` is the rule with `2 g + 1` nodes, `g = ceil(l / 2)`: just enough for degree `2 l + 1`.
//! Rules of different size share only the node 0, so the nonzero coordinates of a point tell which rules it belongs to.
//! The products whose levels sum to `T` have Smolyak's coefficients `(-1)^(L-T) C(d-1, L-T)`. The weight of a point
//! with `s` nonzero coordinates is therefore the product of their weights and the coefficient of `x^(L-t)`, where `t`
//! is the sum of their `2 g - 1`, in
//!
//! ```text
//! (1-x)^(d-1) (1+x)^s Z(x)^(d-s),   Z(x) = sum over l of x^l (weight of 0 in level l)
//! ```

use super::polynomial::Truncated;
use super::sparse_walk::SparseWalk;
use super::{CompensatedSum, finite, gauss_hermite};
use crate::Error;

/// A sparse grid for functions of independent standard normal variables (Smolyak 1963; Gerstner and Griebel, Numer.
/// Algorithms 18, 1998): exact for polynomials of total degree `2 level + 1`, with about `(2 d)^level / level!` points
/// in `d` dimensions.
///
/// ```
/// use eigentol_statistics::quadrature::SparseGrid;
///
/// let grid = SparseGrid::new(10, 2)?;
/// assert_eq!(grid.points(), 201);
/// let integral = grid.integrate(|z| z[0].powi(4) + z[3].powi(2) * z[7].powi(2))?;
/// assert!((integral.value - 4.0).abs() < 1e-12);
/// # Ok::<(), eigentol_statistics::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct SparseGrid {
    pub(super) dimensions: usize,
    pub(super) level: usize,
    /// Nonzero nodes and their weights, indexed by `g - 1`.
    pub(super) rules: Vec<Vec<(f64, f64)>>,
    /// Indexed by the number of nonzero coordinates; the coefficients are indexed by `L - t`.
    pub(super) factors: Vec<Truncated>,
    points: u64,
}

/// The mean of a function and its difference from the next lower level.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Integral {
    /// The mean, in the unit of the function.
    pub value: f64,
    /// The difference from the grid of the next lower level, which uses the same points: an estimate of the error of
    /// that grid, and usually an overestimate of the error of `value`. At level 0 there is no lower level, and this is
    /// the value itself.
    pub difference: f64,
}

impl SparseGrid {
    /// A grid in `dimensions` dimensions of the given level. Level 0 is the origin alone.
    ///
    /// # Errors
    /// [`Error::Setting`] for zero dimensions or more than 2^64 points.
    pub fn new(dimensions: usize, level: usize) -> Result<Self, Error> {
        let setting = |setting, reason: &str| Error::Setting { setting, reason: reason.into() };
        if dimensions == 0 {
            return Err(setting("dimensions", "a grid has at least one"));
        }
        let mut rules = Vec::new();
        let mut centres = vec![1.0];
        for g in 1..=level.div_ceil(2) {
            let rule = gauss_hermite(2 * g + 1)?;
            centres.push(rule.weights[g]);
            let nodes = rule.nodes.into_iter().zip(rule.weights);
            rules.push(nodes.filter(|(node, _)| *node != 0.0).collect());
        }
        let factors = factors(dimensions, level, &centres);
        let points = count(dimensions, level, &factors);
        Ok(Self {
            dimensions,
            level,
            rules,
            factors,
            points: points.ok_or_else(|| setting("level", "more than 2^64 points"))?,
        })
    }

    /// Number of coordinates of a point.
    pub fn dimensions(&self) -> usize {
        self.dimensions
    }

    /// Number of points of the grid.
    pub fn points(&self) -> u64 {
        self.points
    }

    /// Iterates over the points. Weights of both signs cancel: use a [`CompensatedSum`].
    pub fn walk(&self) -> SparseWalk<'_> {
        SparseWalk::new(self)
    }

    /// The mean of a function of independent standard normal variables.
    ///
    /// # Errors
    /// [`Error::NotFinite`] if the sum is not finite.
    pub fn integrate(&self, mut f: impl FnMut(&[f64]) -> f64) -> Result<Integral, Error> {
        let (mut fine, mut coarse) = (CompensatedSum::default(), CompensatedSum::default());
        let mut walk = self.walk();
        while let Some(node) = walk.next_point() {
            let result = f(node.point);
            fine.add(node.weight * result);
            coarse.add(node.coarse_weight * result);
        }
        Ok(Integral { value: finite(fine.value())?, difference: finite(fine.value() - coarse.value())?.abs() })
    }
}

/// `(1-x^2)^s ((1-x) Z)^(d-s) / (1-x)` for each `s`: the polynomial above with smaller intermediate numbers.
fn factors(dimensions: usize, level: usize, centres: &[f64]) -> Vec<Truncated> {
    let mut zero = vec![1.0];
    zero.extend((1..=level).map(|l| centres[l.div_ceil(2)] - centres[(l - 1).div_ceil(2)]));
    let zero = Truncated::new(zero, level);
    let other = Truncated::new(vec![1.0, 0.0, -1.0], level);
    (0..=level.min(dimensions))
        .map(|s| {
            let product = other.power(s).times(&zero.power(dimensions - s));
            product.summed()
        })
        .collect()
}

/// Number of points with a weight in this level or the next lower one.
fn count(dimensions: usize, level: usize, factors: &[Truncated]) -> Option<u64> {
    // Numbers of nodes of one coordinate, by 2 g - 1.
    let nodes: Vec<u128> = (0..=level).map(|t| if t % 2 == 1 { t as u128 + 1 } else { 0 }).collect();
    let mut ways = vec![0; level + 1];
    ways[0] = 1_u128;
    let mut subsets = 1_u128;
    let mut sum = 0_u128;
    for (s, factor) in factors.iter().enumerate() {
        let present = (0..=level).filter(|t| factor.pair(level - t) != (0.0, 0.0));
        for t in present {
            sum = sum.checked_add(subsets.checked_mul(ways[t])?)?;
        }
        let mut next = vec![0_u128; level + 1];
        for (t, way) in ways.iter().enumerate() {
            for (u, node) in nodes[..=level - t].iter().enumerate() {
                next[t + u] = next[t + u].checked_add(way.checked_mul(*node)?)?;
            }
        }
        ways = next;
        subsets = subsets.checked_mul((dimensions - s) as u128)? / (s as u128 + 1);
    }
    u64::try_from(sum).ok()
}
