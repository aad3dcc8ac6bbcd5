//! Comparisons.

use eigentol::sweep::EventTolerance;
use eigentol::{Complex, Kernels, Study};

/// Relative error allowed against a closed form.
pub(crate) const TIGHT: f64 = 1e-9;

#[track_caller]
pub(crate) fn close(value: f64, expected: f64) {
    assert!((value - expected).abs() <= TIGHT * expected.abs().max(1e-6), "{value}, not {expected}");
}

#[track_caller]
pub(crate) fn near(complex: Complex, expected: Complex) {
    assert!((complex - expected).norm() <= TIGHT * expected.norm(), "{complex}, not {expected}");
}

/// The design variables of a study, as a fixed-size array.
pub(crate) fn design<const P: usize>(study: &Study<impl Kernels>) -> [f64; P] {
    let values = study.design_values().try_into();
    values.expect("a place for each design variable")
}

/// Checks an event against its value and its derivatives by `design`, and its standard deviation against the resulting
/// one.
#[track_caller]
pub(crate) fn event(event_tolerance: &EventTolerance, value: f64, slopes: &[f64], design: &[f64], half_widths: &[f64]) {
    close(event_tolerance.value, value);
    let spread = event_tolerance.spread.as_ref().expect("a spread");
    let mut variance = 0.0;
    for (j, &slope) in slopes.iter().enumerate() {
        let own = spread.by_design[j];
        let scale = 1e-2 * (value / design[j]).abs();
        assert!((own - slope).abs() <= TIGHT * slope.abs().max(scale), "{:?}, not {slopes:?}", spread.by_design);
        variance += (slope * half_widths[j] / 3.0).powi(2);
    }
    close(spread.sigma, variance.sqrt());
}
