//! A rotor's results as CSV files: SI units, full precision, undefined numbers as empty fields.

use std::path::Path;

use eigentol::Campbell;
use eigentol::campbell::{CampbellMode, CampbellPoint};

use super::events::{Happening, RotorEvent};
use crate::Failure;
use crate::record::field;

/// Writes the points of a Campbell diagram to a CSV file.
///
/// Columns: the speed, then for each mode its frequency, growth, damping ratio, the standard deviations of frequency
/// and damping ratio, and its whirl ratio (1 forward, -1 backward).
///
/// # Errors
/// [`Failure::Output`].
pub fn diagram(campbell: &Campbell, path: &Path) -> Result<(), Failure> {
    let columns: [Column; 6] = [
        ("frequency", |mode| mode.behaviour.frequency()),
        ("growth", |mode| Some(mode.s.re)),
        ("damping_ratio", |mode| {
            Some(mode.damping_ratio.as_ref()?.mean)
        }),
        ("sigma", |mode| Some(mode.frequency.as_ref()?.sigma)),
        ("damping_sigma", |mode| {
            Some(mode.damping_ratio.as_ref()?.sigma)
        }),
        ("whirl", |mode| Some(mode.whirl?.ratio)),
    ];
    let labels = campbell.labels();
    let mut head = vec!["speed".to_owned()];
    for (name, _) in columns {
        head.extend(labels.iter().map(|label| format!("{name}_{}", label + 1)));
    }
    let row = |point: &CampbellPoint| {
        let modes = point.modes.as_deref().unwrap_or_default();
        let mut fields = vec![field(Some(point.value))];
        for (_, pick) in columns {
            fields.extend(labels.iter().map(|&label| {
                let mode = modes.iter().find(|mode| mode.label == label);
                field(mode.and_then(pick))
            }));
        }
        fields
    };
    write(path, head, campbell.points.iter().map(row))
}

/// The name of a column and the function that gets its value.
type Column = (&'static str, fn(&CampbellMode) -> Option<f64>);

/// Writes the events to a CSV file.
///
/// Columns: the event and its mode, the speed with its standard deviation, frequency, growth and whirl there, and the
/// derivatives of the speed with respect to the design variables `names`.
///
/// # Errors
/// [`Failure::Output`].
pub fn events(events: &[RotorEvent], names: &[&str], path: &Path) -> Result<(), Failure> {
    let head = [
        "event",
        "order",
        "mode",
        "speed",
        "sigma",
        "frequency",
        "growth",
        "whirl",
    ];
    let head = head.map(str::to_owned).into_iter();
    let head = head.chain(names.iter().map(|name| format!("by_{name}")));
    let row = |event: &RotorEvent| {
        let (name, order) = match event.happening {
            Happening::Order(order) => ("order", Some(order)),
            Happening::Onset => ("onset", None),
        };
        let mut fields = vec![
            name.to_owned(),
            field(order),
            (event.mode + 1).to_string(),
            field(Some(event.speed)),
            field(event.sigma()),
            field(Some(event.s.im)),
            field(Some(event.s.re)),
            field(event.whirl.map(|whirl| whirl.ratio)),
        ];
        let slopes = event.spread.as_ref().ok().map(|spread| &spread.by_design);
        fields.extend((0..names.len()).map(|j| field(slopes.map(|slopes| slopes[j]))));
        fields
    };
    write(path, head.collect(), events.iter().map(row))
}

fn write(
    path: &Path,
    head: Vec<String>,
    rows: impl Iterator<Item = Vec<String>>,
) -> Result<(), Failure> {
    let refuse = |error: csv::Error| Failure::Output {
        path: path.to_owned(),
        reason: error.to_string(),
    };
    let mut writer = csv::Writer::from_path(path).map_err(refuse)?;
    writer.write_record(head).map_err(refuse)?;
    for row in rows {
        writer.write_record(row).map_err(refuse)?;
    }
    writer.flush().map_err(|error| refuse(error.into()))
}
