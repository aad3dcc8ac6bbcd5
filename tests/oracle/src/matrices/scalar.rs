//! The number types of the oracle.

use num_dual::{Dual, DualNum};

/// A real number or a (nested, hyper-) dual number over `f64`.
pub trait Scalar: DualNum<Primitive = f64> + Copy {}

impl<T: DualNum<Primitive = f64> + Copy> Scalar for T {}

/// `x + epsilon dx` for every component.
pub(crate) fn along<D: Scalar>(values: &[D], direction: &[D]) -> Vec<Dual<D>> {
    assert_eq!(values.len(), direction.len(), "one component of the direction per value");
    values.iter().zip(direction).map(|(&value, &rate)| Dual::new(value, rate)).collect()
}

/// `x + 0 epsilon` for every component.
pub(crate) fn still<D: Scalar>(values: &[D]) -> Vec<Dual<D>> {
    values.iter().map(|&value| Dual::new(value, D::zero())).collect()
}

/// `x + epsilon e_k`.
pub(crate) fn seeded<D: Scalar>(values: &[D], k: usize) -> Vec<Dual<D>> {
    let mut seeded = still(values);
    seeded[k].eps = D::one();
    seeded
}

/// The `epsilon` parts.
pub(crate) fn rates<D: Scalar>(values: &[Dual<D>]) -> Vec<D> {
    values.iter().map(|value| value.eps).collect()
}
