//! Comparisons.

use eigentol::Complex;
use eigentol::tolerance::EventTolerance;

/// Relative error allowed against a closed form.
pub(crate) const TIGHT: f64 = 1e-9;

#[track_caller]
pub(crate) fn close(found: f64, expected: f64) {
    assert!(
        (found - expected).abs() <= TIGHT * expected.abs().max(1e-6),
        "{found}, not {expected}"
    );
}

#[track_caller]
pub(crate) fn near(found: Complex, expected: Complex) {
    assert!(
        (found - expected).norm() <= TIGHT * expected.norm(),
        "{found}, not {expected}"
    );
}

/// An event against its value and its derivatives; its standard deviation against theirs.
#[track_caller]
pub(crate) fn event<const P: usize>(
    found: &EventTolerance<P>,
    value: f64,
    slopes: [f64; P],
    half_widths: [f64; P],
) {
    close(found.value, value);
    let spread = found.spread.as_ref().expect("a spread");
    let mut variance = 0.0;
    for ((&own, slope), half_width) in spread.by_design.iter().zip(slopes).zip(half_widths) {
        let scale = (value / slope.abs().max(1e-300)).min(1.0);
        assert!(
            (own - slope).abs() <= TIGHT * slope.abs().max(scale * 1e-3),
            "{:?}, not {slopes:?}",
            spread.by_design
        );
        variance += (slope * half_width / 3.0).powi(2);
    }
    close(spread.sigma, variance.sqrt());
}
