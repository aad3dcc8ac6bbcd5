//! Caption lines below a figure.

use eigentol::{Description, Input, Unit};

/// Maximum number of design variables in a caption; nobody reads more.
const MOST: usize = 12;

/// A number with five digits, without trailing zeros.
pub(crate) fn number(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let places = 4 - value.abs().log10().floor() as i32;
    if !(-4..=9).contains(&places) {
        return format!("{value:.4e}");
    }
    let text = format!("{value:.*}", places.max(0) as usize);
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

/// A value in its unit; unchanged if the unit's scale is zero.
pub(crate) fn in_unit(value: f64, unit: &Unit) -> f64 {
    if unit.scale == 0.0 { value } else { unit.from_si(value) }
}

/// `3000 rpm`.
pub(crate) fn with_unit(value: f64, unit: &Unit) -> String {
    let value = number(in_unit(value, unit));
    if unit.symbol.is_empty() { value } else { format!("{value} {}", unit.symbol) }
}

/// `Rotor at speed = 3000 rpm, load = 2 N`, without the input that varies.
pub(crate) fn operating_point(d: &Description, inputs: &[f64], varied: Option<Input>) -> String {
    let varied = varied.map(Input::index);
    let fixed = d.inputs.iter().zip(inputs).enumerate().filter(|(k, _)| Some(*k) != varied);
    let values = fixed.map(|(_, (info, &value))| format!("{} = {}", info.name, with_unit(value, &info.unit)));
    let values: Vec<String> = values.collect();
    if values.is_empty() { d.name.to_string() } else { format!("{} at {}", d.name, values.join(", ")) }
}

/// `m = 3 kg, l = 1 m +/- 0.03 m`; empty without design variables.
pub(crate) fn design(d: &Description, values: &[f64], half_widths: &[f64]) -> String {
    let each = d.design.iter().zip(values).enumerate();
    let mut parts: Vec<String> = each
        .take(MOST)
        .map(|(k, (info, &value))| {
            let value = with_unit(value, &info.unit);
            match half_widths.get(k) {
                Some(&half) if half > 0.0 => {
                    let half = with_unit(half, &info.unit);
                    format!("{} = {value} +/- {half}", info.name)
                }
                _ => format!("{} = {value}", info.name),
            }
        })
        .collect();
    let more = d.design.len().saturating_sub(MOST);
    if more > 0 {
        parts.push(format!("and {more} more"));
    }
    parts.join(", ")
}

#[cfg(test)]
mod tests {
    use super::number;

    #[test]
    fn numbers_have_five_digits_and_no_noise() {
        let pairs = [
            (0.0, "0"),
            (3_000.000_000_000_000_5, "3000"),
            (0.03, "0.03"),
            (-9.81, "-9.81"),
            (123_456.7, "123457"),
            (1.0 / 3.0, "0.33333"),
            (2.06e11, "2.0600e11"),
            (8e-5, "0.00008"),
        ];
        for (value, text) in pairs {
            assert_eq!(number(value), text);
        }
    }
}
