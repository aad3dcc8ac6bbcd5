//! The sweep as a CSV file: SI units, full precision, undefined numbers as empty fields.

use std::path::Path;

use eigentol::Text;

use crate::Failure;
use crate::question::percent;
use crate::sweep::{Row, Spread, Sweep};

/// Writes the sweep to `path`.
///
/// Columns: the speed, the angles from the axis, the frequencies; then for each tolerance and mode, first order
/// (`sigma`, `mean`), Monte Carlo (`mc_`), central differences (`fd_`), and variance shares if several variables vary;
/// and for each tolerance, the number of unstable samples and the distance to the critical state in standard
/// deviations.
///
/// # Errors
/// [`Failure::Output`].
pub fn write(sweep: &Sweep, path: &Path) -> Result<(), Failure> {
    let refuse = |error: csv::Error| Failure::Output {
        path: path.to_owned(),
        reason: error.to_string(),
    };
    let mut writer = csv::Writer::from_path(path).map_err(refuse)?;
    writer.write_record(head(sweep)).map_err(refuse)?;
    for row in &sweep.rows {
        writer.write_record(fields(sweep, row)).map_err(refuse)?;
    }
    writer.flush().map_err(|error| refuse(error.into()))
}

/// The name of a column and the function that gets its value, by mode under one tolerance.
type Column = (&'static str, fn(&Spread, usize) -> Option<f64>);

const BY_MODE: [Column; 5] = [
    ("sigma", |spread, mode| spread.first_order[mode].sigma),
    ("mean", |spread, mode| spread.first_order[mode].mean),
    ("mc_sigma", |spread, mode| spread.sampled[mode].sigma),
    ("mc_mean", |spread, mode| spread.sampled[mode].mean),
    ("fd_sigma", |spread, mode| spread.differences[mode].sigma),
];

fn head(sweep: &Sweep) -> Vec<String> {
    let angles = sweep.rows.first().map_or(0, |row| row.angles.len());
    let mut names = vec!["omega".to_owned()];
    names.extend((1..=angles).map(|angle| format!("theta{angle}")));
    names.extend((1..=sweep.modes).map(|mode| format!("frequency_{mode}")));
    let levels: Vec<String> = sweep
        .question
        .levels
        .iter()
        .map(|&level| percent(level))
        .collect();
    for (name, _) in BY_MODE {
        for mode in 1..=sweep.modes {
            names.extend(
                levels
                    .iter()
                    .map(|level| format!("{name}_{mode}_{level}pct")),
            );
        }
    }
    if sweep.variables.len() > 1 {
        for level in &levels {
            for mode in 1..=sweep.modes {
                let of = |variable: &Text| format!("share_{mode}_{variable}_{level}pct");
                names.extend(sweep.variables.iter().map(of));
            }
        }
    }
    for name in ["mc_unstable", "sigmas_to_critical"] {
        names.extend(levels.iter().map(|level| format!("{name}_{level}pct")));
    }
    names
}

fn fields(sweep: &Sweep, row: &Row) -> Vec<String> {
    let mut values = vec![Some(row.speed)];
    values.extend(&row.angles);
    values.extend(&row.frequencies);
    for (_, pick) in BY_MODE {
        for mode in 0..sweep.modes {
            values.extend(row.spreads.iter().map(|spread| pick(spread, mode)));
        }
    }
    if sweep.variables.len() > 1 {
        for spread in &row.spreads {
            for shares in &spread.shares {
                let count = 0..sweep.variables.len();
                values.extend(count.map(|variable| shares.get(variable).copied()));
            }
        }
    }
    let mut fields: Vec<String> = values.into_iter().map(field).collect();
    let unstable = |spread: &Spread| spread.unstable.map_or_else(String::new, |n| n.to_string());
    fields.extend(row.spreads.iter().map(unstable));
    fields.extend(row.spreads.iter().map(|spread| field(spread.distance)));
    fields
}

/// The shortest text that restores the same number.
pub(crate) fn field(value: Option<f64>) -> String {
    value
        .filter(|value| value.is_finite())
        .map_or_else(String::new, |value| format!("{value:?}"))
}
