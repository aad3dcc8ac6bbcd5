//! Operations on coordinates.

/// `a . b`.
pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// Euclidean length, without overflow or underflow of the squares.
pub(super) fn norm(a: &[f64]) -> f64 {
    let largest = a.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    if largest == 0.0 || !largest.is_finite() {
        return largest;
    }
    let squares: f64 = a.iter().map(|x| (x / largest) * (x / largest)).sum();
    largest * squares.sqrt()
}

/// `a + factor b`.
pub(super) fn add_scaled(a: &[f64], factor: f64, b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(x, y)| x + factor * y).collect()
}

/// `factor a`.
pub(super) fn scaled(factor: f64, a: &[f64]) -> Vec<f64> {
    a.iter().map(|x| factor * x).collect()
}

/// `a / |a|`, unless `a` is zero.
pub(super) fn unit(a: &[f64]) -> Option<Vec<f64>> {
    let length = norm(a);
    (length > 0.0 && length.is_finite()).then(|| a.iter().map(|x| x / length).collect())
}

/// `|a - b|`.
pub(super) fn distance(a: &[f64], b: &[f64]) -> f64 {
    norm(&add_scaled(a, -1.0, b))
}
