//! The cheapest tolerances as text.

use core::fmt;

use super::margin::chance;
use crate::allocation::Allocation;
use eigentol_results::numbers::{given, heading, in_unit, or_dash, rough, rough_in, short};
use eigentol_results::table::{Table, cells};
use eigentol_results::title::title;

impl fmt::Display for Allocation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let d = &self.description;
        writeln!(
            f,
            "{}: allocation, cost {} instead of {}",
            title(d, &self.inputs),
            rough(self.cost),
            rough(self.cost_before)
        )?;
        let mut table = Table::new(cells(["variable", "nominal value", "half-width"]));
        for (k, info) in d.design.iter().enumerate() {
            table.row(vec![
                heading(&info.name, &info.unit),
                in_unit(self.nominal[k], &info.unit),
                rough_in(self.half_widths[k], &info.unit),
            ]);
        }
        write!(f, "{table}")?;
        let mut table = Table::new(cells([
            "requirement",
            "allowed to fail",
            "beta",
            "P(failed), sampled",
            "samples refute it",
        ]));
        for (k, allowed) in self.failure.iter().enumerate() {
            table.row(vec![
                (k + 1).to_string(),
                given(*allowed),
                or_dash(self.reliability.beta_of(k), short),
                chance(self.chances.each[k].failure(), 0.0),
                if self.refuted.contains(&k) {
                    "yes"
                } else {
                    "no"
                }
                .to_owned(),
            ]);
        }
        write!(f, "{table}")?;
        if self.stopped {
            writeln!(f, "  Stopped: there may be cheaper tolerances.")?;
        }
        let planned = self.chances.planned;
        if self.chances.all.samples() < planned {
            writeln!(f, "  Not complete: {planned} samples were asked for.")?;
        }
        Ok(())
    }
}
