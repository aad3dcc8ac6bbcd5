//! What is worth reading, decided here for every report. What is left out of a text is counted in it, and is in the tables that CSV,
//! JSON and Parquet are written from.

use crate::Description;

/// What is below this part of the largest beside it is left out.
pub(super) const RELEVANT: f64 = 1e-3;
/// [`RELEVANT`] in words.
pub(super) const BELOW: &str = "below 0.1 %";
/// Where everything is to be found.
pub(super) const EVERYTHING: &str = "CSV and JSON have all";

/// What is below this part of its neighbours is rounding.
const ROUNDING: f64 = 1e-12;
/// No length, angle, speed or force of an equilibrium is known to this, SI: where all are smaller, all are zero.
const NOTHING: f64 = 1e-15;
/// A chance below this is not told apart from none: no tolerance is known so far out.
pub(super) const CHANCE: f64 = 1e-12;

/// Rows of a long table that are shown.
const SHOWN: usize = 11;
/// Names that are listed; of more the number is told.
const NAMED: usize = 6;
/// Columns of one kind that stand side by side; of more the largest are named in one.
pub(super) const COLUMNS: usize = 6;

/// Whether a value matters beside the largest.
pub(super) fn relevant(value: f64, largest: f64) -> bool {
    value.abs() >= RELEVANT * largest.abs() && value != 0.0
}

/// The value, or zero where it is rounding beside the largest of its kind.
pub(super) fn unless_rounding(value: f64, largest: f64) -> f64 {
    if value.abs() <= ROUNDING * largest.abs() || value.abs() <= NOTHING && largest.abs() <= NOTHING
    {
        0.0
    } else {
        value
    }
}

/// The largest size; zero of nothing.
pub(super) fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    (values.into_iter()).fold(0.0, |most, value| value.abs().max(most))
}

/// The value of an unknown, or zero where it is rounding beside others of its unit.
pub(super) fn of_its_kind(description: &Description, values: &[f64], i: usize) -> f64 {
    let infos = description.coordinates.iter().zip(values);
    let own = &description.coordinates[i].unit.symbol;
    let kind = infos.filter(|(info, _)| info.unit.symbol == *own);
    unless_rounding(values[i], largest(kind.map(|(_, value)| *value)))
}

/// Which of so many rows are shown: all of a short table, else some at equal distances, both ends among them.
pub(super) fn shown(count: usize) -> Vec<usize> {
    if count < 2 * SHOWN {
        return (0..count).collect();
    }
    (0..SHOWN).map(|k| k * (count - 1) / (SHOWN - 1)).collect()
}

/// `a, b and c`, or `12 variables`.
pub(super) fn names(all: &[&str], many: &str) -> String {
    match all {
        [] => format!("no {many}"),
        [one] => (*one).to_owned(),
        [others @ .., last] if all.len() <= NAMED => format!("{} and {last}", others.join(", ")),
        _ => format!("{} {many}", all.len()),
    }
}
