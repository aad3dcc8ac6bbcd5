//! The box of limits for a worst case.

use eigentol_statistics::Distribution;

use crate::tolerance::Tolerances;

/// Smallest and largest value of each design variable, SI. Distributions bounded on both sides use their limits; all
/// others use as many standard normal deviations from the median as a half-width represents.
pub(super) fn limits(nominal: &[f64], tolerances: &Tolerances) -> Vec<(f64, f64)> {
    let level = tolerances.sigma_level();
    let Some((joint, about)) = tolerances.joint() else {
        let means = nominal.iter().zip(tolerances.shifts());
        let means = means.map(|(nominal, shift)| nominal + shift);
        return means.zip(tolerances.half_widths()).map(|(mean, half)| (mean - half, mean + half)).collect();
    };
    joint
        .variables()
        .iter()
        .zip(nominal.iter().zip(about))
        .map(|(item, (nominal, about))| {
            let (low, high) = ends(item, level);
            (low + (nominal - about), high + (nominal - about))
        })
        .collect()
}

fn ends(variable: &Distribution, level: f64) -> (f64, f64) {
    match variable.support() {
        (low, high) if low.is_finite() && high.is_finite() => (low, high),
        _ => (variable.from_normal(-level), variable.from_normal(level)),
    }
}
