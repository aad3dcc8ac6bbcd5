//! Gauss-Hermite rules for the standard normal density.

use nalgebra::DMatrix;

use crate::Error;

/// The largest rule: the weights of much larger ones underflow.
const MAX_NODES: usize = 256;

/// A quadrature rule for the standard normal density: the mean of `f(z)` is approximately the sum of
/// `weights[i] f(nodes[i])`.
#[derive(Clone, Debug, PartialEq)]
pub struct Rule {
    /// The nodes, ascending and symmetric about 0.
    pub nodes: Vec<f64>,
    /// Their weights, which are positive and sum to 1.
    pub weights: Vec<f64>,
}

/// The Gauss-Hermite rule with `nodes` nodes, exact for polynomials of degree `2 nodes - 1`.
///
/// The starting values are the eigenvalues of the Jacobi matrix (Golub and Welsch, Math. Comp. 23, 1969), refined by
/// Newton's method. The weights follow from the orthonormal polynomials at the nodes, which keeps even the smallest
/// accurate.
///
/// # Errors
/// [`Error::Setting`] for zero nodes or more than 256.
///
/// ```
/// use eigentol_statistics::quadrature::gauss_hermite;
///
/// let rule = gauss_hermite(3)?;
/// let fourth: f64 = rule.nodes.iter().zip(&rule.weights).map(|(z, w)| w * z.powi(4)).sum();
/// assert!((fourth - 3.0).abs() < 1e-14);
/// # Ok::<(), eigentol_statistics::Error>(())
/// ```
pub fn gauss_hermite(nodes: usize) -> Result<Rule, Error> {
    if !(1..=MAX_NODES).contains(&nodes) {
        return Err(Error::Setting {
            setting: "nodes",
            reason: format!("a Gauss-Hermite rule has between 1 and {MAX_NODES}, not {nodes}"),
        });
    }
    let mut starts: Vec<f64> = jacobi(nodes).symmetric_eigenvalues().iter().copied().collect();
    starts.sort_by(f64::total_cmp);
    let mut rule = Rule { nodes: vec![0.0; nodes], weights: vec![0.0; nodes] };
    for (i, start) in starts.into_iter().enumerate().skip(nodes / 2) {
        let middle = 2 * i + 1 == nodes;
        let (node, weight) = node_near(if middle { 0.0 } else { start }, nodes);
        (rule.nodes[nodes - 1 - i], rule.nodes[i]) = (0.0 - node, node);
        (rule.weights[nodes - 1 - i], rule.weights[i]) = (weight, weight);
    }
    let sum: f64 = rule.weights.iter().sum();
    rule.weights.iter_mut().for_each(|weight| *weight /= sum);
    Ok(rule)
}

/// Multiplication by `x` in the basis of the orthonormal polynomials: `x p_k = sqrt(k+1) p_(k+1) + sqrt(k) p_(k-1)`.
fn jacobi(nodes: usize) -> DMatrix<f64> {
    DMatrix::from_fn(nodes, nodes, |i, j| if i.abs_diff(j) == 1 { (i.max(j) as f64).sqrt() } else { 0.0 })
}

/// The root of `p_n` near a value, and its weight `1 / (n p_(n-1)^2)`.
fn node_near(start: f64, n: usize) -> (f64, f64) {
    let slope = (n as f64).sqrt();
    let mut node = start;
    for _ in 0..3 {
        let (p, before) = orthonormal(node, n);
        node -= p / (slope * before);
    }
    // The rounding left in the step affects the weight: d ln w / dx = -2 x.
    let (p, before) = orthonormal(node, n);
    let step = -p / (slope * before);
    let weight = (1.0 - 2.0 * node * step) / (n as f64 * before * before);
    (node, weight)
}

/// The orthonormal polynomials `p_n` and `p_(n-1)`.
fn orthonormal(x: f64, n: usize) -> (f64, f64) {
    (0..n).fold((1.0, 0.0), |(p, before), k| {
        let next = (x * p - (k as f64).sqrt() * before) / (k as f64 + 1.0).sqrt();
        (next, p)
    })
}
