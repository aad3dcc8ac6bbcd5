//! stub
use super::symmetric::Trouble;
use crate::{Complex, Linear};
pub(crate) struct Root<const N: usize> {
    pub s: Complex,
    pub right: [Complex; N],
    pub left: [Complex; N],
    pub residual: f64,
    pub error: f64,
    pub condition: f64,
}
pub(crate) struct Roots<const N: usize> {
    all: Vec<Root<N>>,
}
impl<const N: usize> Roots<N> {
    pub(crate) fn as_slice(&self) -> &[Root<N>] {
        &self.all
    }
}
pub(crate) fn solve<const N: usize>(_linear: &Linear<f64, N>) -> Result<Roots<N>, Trouble> {
    Err(Trouble::Inaccurate {
        mode: 0,
        residual: 1.0,
    })
}
