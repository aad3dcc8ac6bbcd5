//! The cheapest tolerances as text.

use core::fmt;

use super::table::{Table, cells, heading, in_unit, number, optional};
use super::title::title;
use crate::allocation::Allocation;

impl fmt::Display for Allocation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let d = &self.description;
        writeln!(
            f,
            "{}: allocation, cost {} instead of {}",
            title(d, &self.inputs),
            number(self.cost),
            number(self.cost_before)
        )?;
        let mut table = Table::new(cells(["variable", "nominal value", "half-width"]));
        for (k, info) in d.design.iter().enumerate() {
            table.row(vec![
                heading(&info.name, &info.unit),
                in_unit(self.nominal[k], &info.unit),
                in_unit(self.half_widths[k], &info.unit),
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
                number(*allowed),
                optional(self.reliability.beta_of(k)),
                number(self.chances.each[k].failure()),
                if self.refuted.contains(&k) {
                    "yes"
                } else {
                    "no"
                }
                .to_owned(),
            ]);
        }
        write!(f, "{table}")
    }
}
