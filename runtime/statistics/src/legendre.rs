//! Integrals over an interval: 16-point Gauss-Legendre rules on a number of panels.

/// Positive nodes and their weights (Abramowitz and Stegun, Handbook of Mathematical Functions, table 25.4): a library that
/// computes sixteen numbers would bring a library of matrices with it.
const RULE: [(f64, f64); 8] = [
    (0.09501250983763744, 0.1894506104550685),
    (0.2816035507792589, 0.18260341504492358),
    (0.45801677765722737, 0.16915651939500254),
    (0.6178762444026438, 0.14959598881657674),
    (0.755404408355003, 0.12462897125553388),
    (0.8656312023878318, 0.09515851168249279),
    (0.9445750230732326, 0.062253523938647894),
    (0.9894009349916499, 0.027152459411754096),
];

/// Passes each point and its weight to `give`.
pub(crate) fn points((low, high): (f64, f64), panels: usize, mut give: impl FnMut(f64, f64)) {
    let half = 0.5 * (high - low) / panels as f64;
    for panel in 0..panels {
        let middle = low + (2 * panel + 1) as f64 * half;
        for (node, weight) in RULE {
            give(middle - half * node, half * weight);
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_of_degree_31_are_exact() {
        for degree in 0..32 {
            let exact = (2.0_f64.powi(degree + 1) - (-1.0_f64).powi(degree + 1)) / f64::from(degree + 1);
            let found = composite((-1.0, 2.0), 1, |x| x.powi(degree));
            assert!((found - exact).abs() <= 1e-14 * 2.0_f64.powi(degree + 1), "{degree}: {found} {exact}");
        }
    }
}
