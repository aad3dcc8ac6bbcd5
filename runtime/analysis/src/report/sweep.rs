//! Sweeps as text: one row per point, or some of many.

use core::fmt;

use crate::Mode;
use crate::sweep::Sweep;
use eigentol_results::numbers::{given_in, heading, in_unit, optional, with_unit};
use eigentol_results::relevance::{EVERYTHING, names, of_its_kind, shown};
use eigentol_results::table::{Table, not_reached};
use eigentol_results::title::title_along;
use eigentol_solve::report::undamped;

impl fmt::Display for Sweep {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let d = &self.description;
        let title = title_along(d, &self.inputs, self.input);
        writeln!(f, "{title}: sweep")?;
        not_reached(f, self.unreached)?;
        let input = d.inputs.get(self.input.index());
        let mut head = vec![input.map_or_else(String::new, |info| heading(&info.name, &info.unit))];
        let states = self
            .points
            .iter()
            .filter_map(|point| point.equilibrium.as_ref().ok());
        let moves = |i: &usize| {
            let mut states = states.clone();
            states.any(|state| of_its_kind(d, &state.coordinates, *i) != 0.0)
        };
        let (moving, still): (Vec<usize>, Vec<usize>) = (0..d.coordinates.len()).partition(moves);
        let name = |i: &usize| heading(&d.coordinates[*i].name, &d.coordinates[*i].unit);
        head.extend(moving.iter().map(name));
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
        let rows = shown(self.points.len());
        for point in rows.iter().map(|&k| &self.points[k]) {
            let value = input.map_or_else(String::new, |info| given_in(point.value, &info.unit));
            let mut row = vec![value];
            row.extend(moving.iter().map(|&i| {
                let state = point.equilibrium.as_ref().ok();
                state.map_or_else(
                    || "-".to_owned(),
                    |state| {
                        in_unit(
                            of_its_kind(d, &state.coordinates, i),
                            &d.coordinates[i].unit,
                        )
                    },
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
        if !still.is_empty() && !self.points.is_empty() {
            let still: Vec<&str> = still.iter().map(|&i| &*d.coordinates[i].name).collect();
            writeln!(f, "  Zero all along: {}.", names(&still, "coordinates"))?;
        }
        if rows.len() < self.points.len() {
            let (rows, all) = (rows.len(), self.points.len());
            writeln!(f, "  {rows} of {all} points are shown: {EVERYTHING}.")?;
        }
        for critical in &self.critical {
            if let Some(info) = input {
                let value = with_unit(in_unit(critical.value, &info.unit), &info.unit);
                let (name, kind) = (&info.name, critical.kind);
                writeln!(f, "  critical at {name} = {value} ({kind})")?;
            }
        }
        match found().next() {
            Some(modes) => undamped(f, modes.family, d),
            None => Ok(()),
        }
    }
}
