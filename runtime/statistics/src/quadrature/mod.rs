//! Means of functions of independent standard normal variables by quadrature: few points for smooth functions of few
//! variables. Grids report their number of points in advance and generate them one by one.

mod gauss_hermite;
mod polynomial;
mod sparse;
#[cfg(test)]
mod sparse_tests;
mod sparse_walk;
mod sum;
mod tensor;
#[cfg(test)]
mod tests;

use crate::Error;

pub use gauss_hermite::{Rule, gauss_hermite};
pub use sparse::{Integral, SparseGrid};
pub use sparse_walk::{SparseNode, SparseWalk};
pub use sum::CompensatedSum;
pub use tensor::{TensorGrid, TensorWalk};

/// A point of a grid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Node<'a> {
    /// Standard normal values, one per dimension.
    pub point: &'a [f64],
    /// Its weight. The weights of all points sum to 1.
    pub weight: f64,
}

fn finite(sum: f64) -> Result<f64, Error> {
    if sum.is_finite() { Ok(sum) } else { Err(Error::NotFinite { kind: "integral" }) }
}
