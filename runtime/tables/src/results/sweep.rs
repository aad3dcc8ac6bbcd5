use eigentol::sweep::{Sweep, SweepPoint};
use eigentol::{Description, Input, Mode};

use super::Tables;
use super::equilibrium::stability;
use super::names::{operating_point, unknowns, varied};
use crate::Table;

/// A row for each value of the input: the unknowns, the stability, and the frequency, damping ratio and eigenvalue of
/// each motion.
///
/// The caller gives the number of motions so that parts of a sweep can be written one after the other with the same
/// columns. Motions beyond that number are left out; a mechanism of `n` coordinates and speeds has up to `2 n`, or more
/// where motions are replaced by others.
#[must_use]
pub fn sweep_table(
    d: &Description,
    inputs: &[f64],
    input: Input,
    points: &[SweepPoint],
    motions: usize,
) -> Table {
    let points = points.iter();
    let mut table = Table::new("sweep");
    let values = points.clone().map(|own| own.value);
    varied(&mut table, d, input, values);
    unknowns(&mut table, d, points.clone().map(state));
    let found = points.clone().map(|own| own.equilibrium.as_ref().ok());
    table.texts("stability", found.map(|state| stability(state?)));
    for label in 0..motions {
        let of = |pick: fn(&Mode) -> Option<f64>| {
            points.clone().map(move |point| {
                let modes = &point.modes.as_ref().ok()?.modes;
                modes.iter().find(|mode| mode.label == label).and_then(pick)
            })
        };
        let number = label + 1;
        table.numbers(format!("frequency {number}"), "rad/s", of(Mode::frequency));
        let damping = of(Mode::damping_ratio);
        table.numbers(format!("damping ratio {number}"), "", damping);
        table.numbers(format!("Re s {number}"), "1/s", of(|mode| Some(mode.s.re)));
        table.numbers(format!("Im s {number}"), "1/s", of(|mode| Some(mode.s.im)));
    }
    let errors = points.map(|own| match (&own.equilibrium, &own.modes) {
        (Err(error), _) | (_, Err(error)) => Some(error.to_string()),
        _ => None,
    });
    table.texts("error", errors);
    operating_point(&mut table, d, inputs, Some(input));
    table
}

/// `sweep`: [`sweep_table`] with all motions; `critical states`, if any.
impl Tables for Sweep {
    fn tables(&self) -> Vec<Table> {
        let all = self.points.iter().filter_map(|own| own.modes.as_ref().ok());
        let labels = all.flat_map(|own| own.modes.iter().map(|mode| mode.label + 1));
        let motions = labels.max().unwrap_or(0);
        let d = &self.description;
        let table = sweep_table(d, &self.inputs, self.input, &self.points, motions);
        let mut tables = vec![table];
        tables.extend(self.critical[..].tables());
        tables
    }
}

fn state(point: &SweepPoint) -> Option<&[f64]> {
    Some(&point.equilibrium.as_ref().ok()?.coordinates[..])
}
