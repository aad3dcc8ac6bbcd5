//! Vector helpers for comparisons.

pub(crate) type Vector = [f64; 3];

pub(crate) fn subtract(a: Vector, b: Vector) -> Vector {
    std::array::from_fn(|i| a[i] - b[i])
}

pub(crate) fn add(a: Vector, b: Vector) -> Vector {
    std::array::from_fn(|i| a[i] + b[i])
}

pub(crate) fn scaled(factor: f64, a: Vector) -> Vector {
    a.map(|x| factor * x)
}

pub(crate) fn dot(a: Vector, b: Vector) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

pub(crate) fn norm(a: Vector) -> f64 {
    dot(a, a).sqrt()
}

/// The largest difference of two lists; infinite if their lengths differ or a difference is NaN.
pub(crate) fn difference(values: &[f64], expected: &[f64]) -> f64 {
    if values.len() != expected.len() {
        return f64::INFINITY;
    }
    let pairs = values.iter().zip(expected);
    pairs.fold(0.0, |most, (a, b)| {
        let apart = (a - b).abs();
        if apart.is_nan() { f64::INFINITY } else { apart.max(most) }
    })
}
