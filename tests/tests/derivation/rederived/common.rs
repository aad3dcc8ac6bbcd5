//! Comparisons.

/// Requires every error to be at most `tolerance`, relative to the larger of the expected value and `scale`.
#[track_caller]
pub(crate) fn assert_within(tolerance: f64, values: &[f64], expected: &[f64], scale: f64, what: &str) {
    assert_eq!(values.len(), expected.len(), "{what}");
    for (k, (one, other)) in values.iter().zip(expected).enumerate() {
        let error = (one - other).abs();
        assert!(error <= tolerance * other.abs().max(scale), "{what}, number {k}: {one:e}, not {other:e}");
    }
}

/// [`assert_within`] with a tolerance of 1e-10.
#[track_caller]
pub(crate) fn assert_close(values: &[f64], expected: &[f64], scale: f64, what: &str) {
    assert_within(1e-10, values, expected, scale, what);
}

pub(crate) fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, value| most.max(value.abs()))
}
