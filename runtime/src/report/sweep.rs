//! Sweeps as text: one row for each point.

use core::fmt;

use super::table::{Table, heading, in_unit, optional, undamped};
use super::title::title_along;
use crate::Mode;
use crate::sweep::Sweep;

impl fmt::Display for Sweep {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let d = &self.description;
        let title = title_along(d, &self.inputs, self.input);
        writeln!(f, "{title}: sweep")?;
        let input = d.inputs.get(self.input.index());
        let mut head = vec![input.map_or_else(String::new, |info| heading(&info.name, &info.unit))];
        head.extend(
            d.coordinates
                .iter()
                .map(|info| heading(&info.name, &info.unit)),
        );
        let found = || {
            self.points
                .iter()
                .filter_map(|point| point.modes.as_ref().ok())
        };
        let all = || found().flat_map(|modes| modes.modes.iter());
        let labels = all().fold(0, |most, mode| most.max(mode.label + 1));
        head.extend((1..=labels).map(|r| format!("omega{r} [rad/s]")));
        head.push("state".to_owned());
        let mut table = Table::new(head);
        for point in &self.points {
            let value = input.map_or_else(String::new, |info| in_unit(point.value, &info.unit));
            let mut row = vec![value];
            row.extend(d.coordinates.iter().enumerate().map(|(i, info)| {
                let state = point.equilibrium.as_ref().ok();
                state.map_or_else(
                    || "-".to_owned(),
                    |state| in_unit(state.coordinates[i], &info.unit),
                )
            }));
            row.extend((0..labels).map(|label| {
                let modes = point.modes.iter().flat_map(|modes| modes.modes.iter());
                let mode = modes.into_iter().find(|mode| mode.label == label);
                optional(mode.and_then(Mode::frequency))
            }));
            row.push(match (&point.equilibrium, &point.modes) {
                (Err(error), _) | (_, Err(error)) => error.to_string(),
                (Ok(state), Ok(_)) => state.stability.to_string(),
            });
            table.row(row);
        }
        write!(f, "{table}")?;
        for critical in &self.critical {
            if let Some(info) = input {
                let value = in_unit(critical.value, &info.unit);
                let symbol = &info.unit.symbol;
                writeln!(
                    f,
                    "  critical at {} = {value} {symbol} ({})",
                    info.name, critical.kind
                )?;
            }
        }
        match found().next() {
            Some(modes) => undamped(f, modes.family, d),
            None => Ok(()),
        }
    }
}
