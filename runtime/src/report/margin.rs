//! Safety margins as text.

use core::fmt;

use super::table::{Table, cells, heading, in_unit, number, per};
use super::title::title;
use crate::second_order::Margin;
use crate::setters::setters;
use crate::{Description, Unit};

/// A margin, printed with the name and the unit of its quantity and the names of the design variables.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct MarginTable<'a> {
    /// The margin, as [`margin`](crate::second_order::margin) returns it.
    pub margin: &'a Margin,
    /// What the quantity is, for example `frequency 1`.
    pub quantity: &'a str,
    /// Its unit, for example rad/s.
    pub unit: Unit,
    /// The inputs it belongs to, SI; empty where they do not matter.
    pub inputs: &'a [f64],
    /// The mechanism it belongs to.
    pub description: &'a Description,
}

impl<'a> MarginTable<'a> {
    setters!(inputs: &'a [f64]);

    /// A margin of a `quantity` in `unit`.
    #[must_use]
    pub fn new(
        margin: &'a Margin,
        quantity: &'a str,
        unit: Unit,
        description: &'a Description,
    ) -> Self {
        Self {
            margin,
            quantity,
            unit,
            inputs: &[],
            description,
        }
    }
}

impl fmt::Display for MarginTable<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (margin, unit, d) = (self.margin, &self.unit, self.description);
        let (low, high) = margin.band;
        writeln!(
            f,
            "{}: margin of {} against the band {} to {} {}",
            title(d, self.inputs),
            self.quantity,
            in_unit(low, unit),
            in_unit(high, unit),
            unit.symbol
        )?;
        let mut table = Table::new(vec![
            heading("nominal", unit),
            heading("sigma", unit),
            "to band [sigma]".to_owned(),
            "first order".to_owned(),
            "corrected".to_owned(),
            "error below".to_owned(),
        ]);
        table.row(vec![
            in_unit(margin.value, unit),
            in_unit(margin.sigma, unit),
            number(margin.distance),
            number(margin.first_order),
            number(margin.corrected.value),
            format!("{:.0e}", margin.corrected.error),
        ]);
        write!(f, "{table}")?;
        let Some(slopes) = &margin.derivatives else {
            return writeln!(f, "  Without derivatives: nothing varies at first order.");
        };
        let all = slopes.by_design.iter().chain(&slopes.by_half_width);
        if all.copied().all(|slope| slope == 0.0) {
            return writeln!(
                f,
                "  No variable changes the probability, within the range of a double."
            );
        }
        let mut table = Table::new(cells(["probability by", "nominal value", "half-width"]));
        for (k, info) in d.design.iter().enumerate() {
            table.row(vec![
                per(&info.name, &info.unit),
                number(slopes.by_design[k] * info.unit.scale),
                number(slopes.by_half_width[k] * info.unit.scale),
            ]);
        }
        write!(f, "{table}")
    }
}
