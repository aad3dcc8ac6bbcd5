//! Numbers as text, with an appropriate number of digits.

use eigentol_contract::Unit;

/// A computed value: six significant digits, in scientific notation where that is shorter.
pub fn number(value: f64) -> String {
    digits(value, 6)
}

/// A spread or a derivative: four significant digits.
pub fn rough(value: f64) -> String {
    digits(value, 4)
}

/// A distance in standard deviations, or an error: three significant digits.
pub fn short(value: f64) -> String {
    digits(value, 3)
}

/// A value entered by the user: no trailing zeros.
pub fn given(value: f64) -> String {
    let text = number(value);
    match text.split_once('e') {
        None => without_zeros(&text).to_owned(),
        Some((digits, exponent)) => format!("{}e{exponent}", without_zeros(digits)),
    }
}

fn without_zeros(text: &str) -> &str {
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { text }
}

fn digits(value: f64, count: usize) -> String {
    let size = value.abs();
    if value == 0.0 {
        "0".to_owned()
    } else if !value.is_finite() {
        if value > 0.0 { "inf".to_owned() } else { format!("{value}") }
    } else {
        let scientific = format!("{value:.*e}", count - 1);
        if !(1e-3..1e6).contains(&size) {
            return scientific;
        }
        // Use the rounded number: 0.99999 has one digit before the point.
        let exponent = scientific.rsplit('e').next();
        let exponent = exponent.and_then(|text| text.parse::<i32>().ok());
        let decimals = (count as i32 - 1 - exponent.unwrap_or(0)).clamp(0, 8) as usize;
        format!("{value:.decimals$}")
    }
}

/// A computed value, or `-` if there is none.
pub fn optional(value: Option<f64>) -> String {
    or_dash(value, number)
}

/// A value in the given format, or `-` if there is none.
pub fn or_dash(value: Option<f64>, form: fn(f64) -> String) -> String {
    value.map_or_else(|| "-".to_owned(), form)
}

/// A fraction as `12.3 %`.
pub fn percent(share: f64) -> String {
    format!("{:.1} %", 100.0 * share)
}

/// `1 sample`, `2 samples`.
pub fn counted(number: impl core::fmt::Display, one: &str) -> String {
    let number = number.to_string();
    let ending = if number == "1" { "" } else { "s" };
    format!("{number} {one}{ending}")
}

/// Replaces a number that a member of a cluster of equal eigenvalues does not have.
pub const CLUSTER: &str = "cluster";

/// Like [`or_dash`], for a mode that may be a member of a cluster.
pub fn of_mode(value: Option<f64>, clustered: bool, form: fn(f64) -> String) -> String {
    if clustered { CLUSTER.to_owned() } else { or_dash(value, form) }
}

/// A value converted from SI to a declared unit.
pub fn in_unit(value: f64, unit: &Unit) -> String {
    number(converted(value, unit))
}

/// Like [`in_unit`], for a value entered by the user.
pub fn given_in(value: f64, unit: &Unit) -> String {
    given(converted(value, unit))
}

/// Like [`in_unit`], for a spread.
pub fn rough_in(value: f64, unit: &Unit) -> String {
    rough(converted(value, unit))
}

/// A value converted from SI to a declared unit; unchanged where the unit has no size.
pub fn converted(value: f64, unit: &Unit) -> f64 {
    if unit.scale == 0.0 { value } else { value / unit.scale }
}

/// `name [unit]`.
pub fn heading(name: &str, unit: &Unit) -> String {
    if unit.symbol.is_empty() { name.to_owned() } else { format!("{name} [{}]", unit.symbol) }
}

/// What frequencies in this unit are called: `omega` in rad/s, else `f`.
pub fn frequency_symbol(unit: &Unit) -> &'static str {
    if &*unit.symbol == "rad/s" { "omega" } else { "f" }
}

/// A frequency, rad/s, in the unit of answers: `25.0 Hz`.
pub fn frequency_in(omega: f64, unit: &Unit, form: fn(f64) -> String) -> String {
    with_unit(form(converted(omega, unit)), unit)
}

/// A number with its unit, if it has one: `3000 rpm`.
pub fn with_unit(number: String, unit: &Unit) -> String {
    if unit.symbol.is_empty() { number } else { format!("{number} {}", unit.symbol) }
}

/// A user-chosen value as the user wrote it: 3000 rpm, not 3000.0000000000005. Rounded to 15 digits if these give the
/// same SI value.
pub fn as_written(value: f64, unit: &Unit) -> f64 {
    let number = converted(value, unit);
    let short = format!("{number:.14e}").parse().unwrap_or(number);
    if unit.to_si(short) == value { short } else { number }
}

/// `top per unit`, for derivatives.
pub fn per(name: &str, unit: &Unit) -> String {
    if unit.symbol.is_empty() { format!("/ {name}") } else { format!("/ {name} [{}]", unit.symbol) }
}

#[cfg(test)]
mod tests {
    use eigentol_contract::{Text, Unit};

    use super::as_written;

    #[test]
    fn chosen_values_come_back_as_they_were_written() {
        let unit = |scale: f64| Unit { symbol: Text::Static("a unit"), scale };
        let rpm = unit(core::f64::consts::PI / 30.0);
        let mut rough = 0;
        for speed in 0..=20_000 {
            let speed = 0.5 * f64::from(speed);
            rough += usize::from(rpm.from_si(rpm.to_si(speed)) != speed);
            assert_eq!(as_written(rpm.to_si(speed), &rpm), speed);
        }
        assert!(rough > 0);
        for length in [0.1, 0.3, -2.7, 1e-3, 12.345] {
            let mm = unit(1e-3);
            assert_eq!(as_written(mm.to_si(length), &mm), length);
        }
    }

    #[test]
    fn what_nobody_wrote_keeps_its_digits() {
        let one = Unit { symbol: Text::Static("m"), scale: 1.0 };
        for value in [core::f64::consts::PI, 1.0 / 3.0, -0.1 - 0.2, 0.0] {
            assert_eq!(as_written(value, &one), value);
        }
    }
}
