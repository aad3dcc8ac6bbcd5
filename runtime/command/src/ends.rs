//! The ends of a range written as text.

/// Lets the low end of a range take its unit from the high end.
pub(crate) fn with_unit_of(low: &str, high: &str) -> String {
    if low.trim().parse::<f64>().is_err() {
        return low.to_owned();
    }
    format!("{low} {}", &high[number(high)..])
}

/// Length of the number at the start of a text.
fn number(text: &str) -> usize {
    let ends = (1..=text.len()).rev().filter(|&end| text.is_char_boundary(end));
    let mut numbers = ends.filter(|&end| text[..end].trim().parse::<f64>().is_ok());
    numbers.next().unwrap_or(0)
}
