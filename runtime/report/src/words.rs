//! Human-readable numbers and names.

use eigentol::{Description, Unit};

/// A number with six significant digits, in scientific notation where that is shorter.
pub(crate) fn number(value: f64) -> String {
    digits(value, 6)
}

/// A number with `count` significant digits, at least one.
pub(crate) fn digits(value: f64, count: usize) -> String {
    let size = value.abs();
    if value == 0.0 {
        return "0".to_owned();
    }
    let scientific = format!("{value:.*e}", count.saturating_sub(1));
    if !(1e-3..1e6).contains(&size) {
        return trimmed(&scientific);
    }
    // The exponent of the rounded number: 0.99999 has one digit before the point.
    let exponent = scientific.rsplit('e').next();
    let exponent: i32 = exponent.and_then(|exponent| exponent.parse().ok()).unwrap_or(0);
    let decimals = (count as i32 - 1 - exponent).clamp(0, 9) as usize;
    trimmed(&format!("{value:.decimals$}"))
}

/// Values below this fraction of the largest are rounding errors.
const ROUNDING: f64 = 1e-12;

/// Whether a number is only rounding error relative to the largest of its kind.
pub(crate) fn is_rounding(value: f64, largest: f64) -> bool {
    value.abs() <= ROUNDING * largest.abs()
}

/// Removes trailing zeros of a fraction.
fn trimmed(text: &str) -> String {
    let (digits, power) = match text.split_once('e') {
        Some((digits, power)) => (digits, format!("e{power}")),
        None => (text, String::new()),
    };
    if !digits.contains('.') {
        return text.to_owned();
    }
    let digits = digits.trim_end_matches('0').trim_end_matches('.');
    format!("{digits}{power}")
}

/// A value with its unit: `3000 rpm`.
pub(crate) fn with_unit(value: f64, unit: &Unit) -> String {
    let number = number(unit.from_si(value));
    if unit.symbol.is_empty() { number } else { format!("{number} {}", unit.symbol) }
}

/// `speed = 3000 rpm, load = 2 N`; empty without inputs.
pub(crate) fn operating_point(d: &Description, inputs: &[f64]) -> String {
    let each = d.inputs.iter().zip(inputs);
    each.map(|(info, &value)| format!("{} = {}", info.name, with_unit(value, &info.unit)))
        .collect::<Vec<_>>()
        .join(", ")
}

/// Capitalises the first letter.
pub(crate) fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().into_iter().flat_map(char::to_uppercase).collect::<String>() + letters.as_str()
}

/// Makes a sentence: capital first letter, full stop at the end.
pub(crate) fn sentence(text: &str) -> String {
    let text = text.trim();
    let stop = if text.ends_with(['.', '?', '!']) { "" } else { "." };
    format!("{}{stop}", capital(text))
}

#[cfg(test)]
mod tests {
    use super::{number, sentence};

    #[test]
    fn numbers_have_six_digits() {
        for (value, text) in [
            (0.0, "0"),
            (3000.0, "3000"),
            (0.1, "0.1"),
            (12.345678, "12.3457"),
            (-1.0 / 3.0, "-0.333333"),
            (1e-9, "1e-9"),
            (1.234_567_8e12, "1.23457e12"),
            (999_999.7, "1000000"),
            (0.999_999_96, "1"),
        ] {
            assert_eq!(number(value), text);
        }
    }

    #[test]
    fn a_sentence_begins_and_ends() {
        assert_eq!(sentence("no oscillation, so no frequency."), "No oscillation, so no frequency.");
        assert_eq!(sentence("\u{3c9} diverges"), "\u{3a9} diverges.");
        assert_eq!(sentence(""), ".");
    }
}
