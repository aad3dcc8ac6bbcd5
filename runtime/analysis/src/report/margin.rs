//! Safety margins as text.

use core::fmt;

use crate::second_order::Margin;
use crate::setters;
use crate::{Description, Unit};
use eigentol_results::numbers::{
    given_in, heading, in_unit, per, rough, rough_in, short, with_unit,
};
use eigentol_results::relevance::{BELOW, CHANCE, largest, names, relevant};
use eigentol_results::table::{Table, cells};
use eigentol_results::title::title;
use eigentol_tolerance::report::far;

/// Prints a margin with the name and unit of its quantity and the names of the design variables.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct MarginTable<'a> {
    /// The margin returned by [`margin`](crate::second_order::margin).
    pub margin: &'a Margin,
    /// Name of the quantity, for example `frequency 1`.
    pub quantity: &'a str,
    /// Its unit, for example rad/s.
    pub unit: Unit,
    /// The inputs of the operating point, SI; empty if irrelevant.
    pub inputs: &'a [f64],
    /// The mechanism it belongs to.
    pub description: &'a Description,
}

impl<'a> MarginTable<'a> {
    setters!(inputs: &'a [f64]);

    /// Creates a table of the margin of `quantity` in `unit`.
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

/// A probability, as far as it can be distinguished from zero.
pub(super) fn chance(value: f64, error: f64) -> String {
    let told = error.max(CHANCE);
    if value == 0.0 && error == 0.0 {
        "0".to_owned()
    } else if value < told {
        format!("< {}", short(told))
    } else {
        rough(value)
    }
}

impl fmt::Display for MarginTable<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (margin, unit, d) = (self.margin, &self.unit, self.description);
        let (low, high) = margin.band;
        writeln!(
            f,
            "{}: margin of {} against the band {} to {}",
            title(d, self.inputs),
            self.quantity,
            given_in(low, unit),
            with_unit(given_in(high, unit), unit)
        )?;
        let mut table = Table::new(vec![
            heading("nominal", unit),
            heading("sigma", unit),
            "to band [sigma]".to_owned(),
            "first order".to_owned(),
            "second order".to_owned(),
            match margin.corrected.model_error {
                None => "integration error".to_owned(),
                Some(_) => "error of second order".to_owned(),
            },
        ]);
        table.row(vec![
            in_unit(margin.value, unit),
            rough_in(margin.sigma, unit),
            far(margin.distance),
            chance(margin.first_order, 0.0),
            chance(margin.corrected.value, margin.corrected.error),
            format!("{:.1e}", margin.corrected.error),
        ]);
        write!(f, "{table}")?;
        let Some(slopes) = &margin.derivatives else {
            let why = match margin.sigma {
                0.0 => "nothing varies at first order",
                _ => "they exist for normal variables, and within the range of a double",
            };
            return writeln!(f, "  No derivatives: {why}.");
        };
        let all = slopes.by_design.iter().chain(&slopes.by_half_width);
        if all.copied().all(|slope| slope == 0.0) {
            return writeln!(
                f,
                "  No variable changes the probability, within the range of a double."
            );
        }
        if margin.first_order < CHANCE {
            return writeln!(f, "  The tables show what changes so small a probability.");
        }
        let size = |k: usize| {
            let half_width = slopes.by_half_width[k];
            slopes.by_design[k].abs().max(half_width.abs()) * d.design[k].nominal.abs()
        };
        let most = largest((0..d.design.len()).map(size));
        let mut table = Table::new(cells(["probability by", "nominal value", "half-width"]));
        let mut left = Vec::new();
        for (k, info) in d.design.iter().enumerate() {
            if info.nominal != 0.0 && !relevant(size(k), most) {
                left.push(&*info.name);
                continue;
            }
            table.row(vec![
                per(&info.name, &info.unit),
                rough(slopes.by_design[k] * info.unit.scale),
                rough(slopes.by_half_width[k] * info.unit.scale),
            ]);
        }
        write!(f, "{table}")?;
        if left.is_empty() {
            return Ok(());
        }
        let names = names(&left, "variables");
        writeln!(f, "  Left out, {BELOW} of the largest effect: {names}")
    }
}
