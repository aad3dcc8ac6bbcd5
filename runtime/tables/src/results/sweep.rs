use eigentol::Mode;
use eigentol::sweep::{Sweep, SweepPoint};

use super::Tables;
use super::equilibrium::stability;
use super::names::{operating_point, unknowns, varied};
use crate::Table;

/// `sweep`: a row for each value of the input, with the unknowns, the stability and of each motion the frequency, the damping ratio
/// and the eigenvalue; `critical states`, where there are any.
impl Tables for Sweep {
    fn tables(&self) -> Vec<Table> {
        let d = &self.description;
        let points = self.points.iter();
        let mut table = Table::new("sweep");
        varied(
            &mut table,
            d,
            self.input,
            points.clone().map(|own| own.value),
        );
        unknowns(&mut table, d, points.clone().map(state));
        let found = points.clone().map(|own| own.equilibrium.as_ref().ok());
        table.texts("stability", found.map(|state| stability(state?)));
        let all = points.clone().filter_map(|own| own.modes.as_ref().ok());
        let labels = all
            .flat_map(|own| &own.modes)
            .map(|mode| mode.label + 1)
            .max();
        for label in 0..labels.unwrap_or(0) {
            let of = |pick: fn(&Mode) -> Option<f64>| {
                points.clone().map(move |point| {
                    let modes = &point.modes.as_ref().ok()?.modes;
                    modes.iter().find(|mode| mode.label == label).and_then(pick)
                })
            };
            let number = label + 1;
            table.numbers(format!("frequency {number}"), "rad/s", of(Mode::frequency));
            table.numbers(
                format!("damping ratio {number}"),
                "",
                of(Mode::damping_ratio),
            );
            table.numbers(format!("Re s {number}"), "1/s", of(|mode| Some(mode.s.re)));
            table.numbers(format!("Im s {number}"), "1/s", of(|mode| Some(mode.s.im)));
        }
        let errors = points.map(|own| match (&own.equilibrium, &own.modes) {
            (Err(error), _) | (_, Err(error)) => Some(error.to_string()),
            _ => None,
        });
        table.texts("error", errors);
        operating_point(&mut table, d, &self.inputs, Some(self.input));
        let mut tables = vec![table];
        tables.extend(self.critical[..].tables());
        tables
    }
}

fn state(point: &SweepPoint) -> Option<&[f64]> {
    Some(&point.equilibrium.as_ref().ok()?.coordinates[..])
}
