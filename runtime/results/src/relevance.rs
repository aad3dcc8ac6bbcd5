//! Decides what is worth reading, for all reports. Whatever a text omits is counted in it, and is contained in the
//! tables from which CSV, JSON and Parquet are written.

use eigentol_contract::Description;

/// Values below this fraction of the largest next to them are omitted.
pub const RELEVANT: f64 = 1e-3;
/// [`RELEVANT`] in words.
pub const BELOW: &str = "below 0.1 %";
/// Tells where to find everything.
pub const EVERYTHING: &str = "CSV and JSON have all";

/// Values below this fraction of their neighbours are rounding.
const ROUNDING: f64 = 1e-12;
/// Lengths, angles, speeds and forces (SI) of an equilibrium are not known more accurately: if all are smaller, all are
/// zero.
const NOTHING: f64 = 1e-15;
/// A smaller probability is indistinguishable from zero: no tolerance is known so far out.
pub const CHANCE: f64 = 1e-12;

/// Number of rows shown of a long table.
const SHOWN: usize = 11;
/// Maximum number of names listed; if there are more, only their number is given.
const NAMED: usize = 6;
/// Maximum number of columns of one kind; if there are more, a single column names the largest.
pub const COLUMNS: usize = 6;

/// Says why nothing spreads.
pub const NOTHING_VARIES: &str = "No tolerance is declared, so nothing varies.";

/// Whether a value matters compared to the largest.
pub fn relevant(value: f64, largest: f64) -> bool {
    value.abs() >= RELEVANT * largest.abs() && value != 0.0
}

/// The value, or zero if it is rounding compared to the largest of its kind.
pub fn unless_rounding(value: f64, largest: f64) -> f64 {
    if value.abs() <= ROUNDING * largest.abs() || value.abs() <= NOTHING && largest.abs() <= NOTHING {
        0.0
    } else {
        value
    }
}

/// The largest magnitude; zero for an empty list.
pub fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    (values.into_iter()).fold(0.0, |most, value| value.abs().max(most))
}

/// The value of an unknown, or zero if it is rounding compared to others with the same unit.
pub fn of_its_kind(description: &Description, values: &[f64], i: usize) -> f64 {
    let infos = description.coordinates.iter().zip(values);
    let symbol = &description.coordinates[i].unit.symbol;
    let kind = infos.filter(|(info, _)| info.unit.symbol == *symbol);
    unless_rounding(values[i], largest(kind.map(|(_, value)| *value)))
}

/// The rows to show: all of a short table, otherwise some at equal intervals, including both ends.
pub fn shown(count: usize) -> Vec<usize> {
    if count < 2 * SHOWN {
        return (0..count).collect();
    }
    (0..SHOWN).map(|k| k * (count - 1) / (SHOWN - 1)).collect()
}

/// `a, b and c`, or `12 variables`.
pub fn names(all: &[&str], many: &str) -> String {
    match all {
        [] => format!("no {many}"),
        [one] => (*one).to_owned(),
        [others @ .., last] if all.len() <= NAMED => format!("{} and {last}", others.join(", ")),
        _ => format!("{} {many}", all.len()),
    }
}
