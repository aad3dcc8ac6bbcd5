//! Exaggeration of bands, so that they can be seen.

/// A band narrower than this fraction of the axis on either side is invisible.
const VISIBLE: f64 = 0.01;
/// A band wider than this fraction hides its surroundings.
const WIDEST: f64 = 0.12;

/// The smallest factor of 1, 2, 5, 10, 20, 50, ..., 1000 that makes the typical half-width visible on an axis of this
/// length, unless the widest band would then hide its surroundings.
pub(crate) fn factor(half_widths: impl Iterator<Item = f64>, length: f64) -> f64 {
    let mut all: Vec<f64> = half_widths.filter(|half_width| half_width.is_finite() && *half_width > 0.0).collect();
    all.sort_by(f64::total_cmp);
    let (Some(typical), Some(widest)) = (all.get(all.len() / 2), all.get(all.len() * 9 / 10)) else {
        return 1.0;
    };
    let steps = [1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0];
    let wanted = steps.into_iter().find(|factor| factor * typical >= VISIBLE * length).unwrap_or(1000.0);
    let fits = |factor: &f64| *factor <= wanted && factor * widest <= WIDEST * length;
    steps.into_iter().rev().find(fits).unwrap_or(1.0)
}

/// What the legend calls bands of so many standard deviations.
pub(crate) fn legend(sigma_level: f64, factor: f64) -> String {
    if factor == 1.0 { format!("{sigma_level} sigma") } else { format!("{sigma_level} sigma, {factor} times") }
}

/// Describes what bands and error bars show.
pub(crate) fn words(sigma_level: f64, factor: f64) -> String {
    let sigma = if sigma_level == 1.0 {
        "1 standard deviation".to_owned()
    } else {
        format!("{sigma_level} standard deviations")
    };
    if factor == 1.0 {
        format!("Shaded: {sigma} to either side.")
    } else {
        format!("Shaded: {sigma} to either side, drawn {factor} times as wide.")
    }
}

#[cfg(test)]
mod tests {
    use super::factor;

    #[test]
    fn bands_are_widened_until_they_are_seen_and_no_further() {
        let band = |half: f64| factor([half; 5].into_iter(), 100.0);
        assert_eq!(band(2.0), 1.0);
        assert_eq!(band(0.3), 5.0);
        assert_eq!(band(0.01), 100.0);
        assert_eq!(band(0.0), 1.0);
        assert_eq!(factor(std::iter::empty(), 100.0), 1.0);
        // A wide band among narrow ones limits the factor.
        let mixed = [0.1, 0.1, 0.1, 4.0].into_iter();
        assert_eq!(factor(mixed, 100.0), 2.0);
    }
}
