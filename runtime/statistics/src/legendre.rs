//! Integrals over an interval: 16-point Gauss-Legendre rules on a number of panels.

use std::num::NonZeroUsize;
use std::sync::LazyLock;

use gauss_quad::GaussLegendre;

static RULE: LazyLock<GaussLegendre> =
    LazyLock::new(|| GaussLegendre::new(NonZeroUsize::new(16).unwrap_or(NonZeroUsize::MIN)));

/// Passes each point and its weight to `give`.
pub(crate) fn points((low, high): (f64, f64), panels: usize, mut give: impl FnMut(f64, f64)) {
    let half = 0.5 * (high - low) / panels as f64;
    for panel in 0..panels {
        let middle = low + (2 * panel + 1) as f64 * half;
        for (node, weight) in RULE.iter() {
            give(middle + half * node, half * weight);
        }
    }
}

/// The integral of a function.
pub(crate) fn composite(ends: (f64, f64), panels: usize, f: impl Fn(f64) -> f64) -> f64 {
    let mut sum = 0.0;
    points(ends, panels, |x, weight| sum += weight * f(x));
    sum
}
