use core::fmt;

use eigentol_contract::DesignInfo;
use eigentol_results::grid::cells;
use eigentol_results::numbers::{given_in, heading, in_unit, per, rough, rough_in, with_unit};
use eigentol_results::relevance::{BELOW, CHANCE, largest, names, relevant};
use eigentol_results::title::title;
use eigentol_results::{Columns, Findings, Grid};

use crate::judge::chance;
use crate::second_order::Margin;
use crate::setters;
use crate::tolerance::far;
use crate::{Description, Unit};

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

    /// Title and probabilities.
    pub(super) fn probabilities(&self) -> Findings {
        let (margin, unit) = (self.margin, &self.unit);
        let (low, high) = margin.band;
        let mut said = Findings::titled(format!(
            "{}: margin of {} against the band {} to {}",
            title(self.description, self.inputs),
            self.quantity,
            given_in(low, unit),
            with_unit(given_in(high, unit), unit)
        ));
        let mut table = Grid::new(cells([
            &heading("nominal", unit),
            &heading("sigma", unit),
            "to band [sigma]",
            "first order",
            "second order",
            match margin.corrected.model_error {
                None => "integration error",
                Some(_) => "error of second order",
            },
        ]));
        table.row(vec![
            in_unit(margin.value, unit),
            rough_in(margin.sigma, unit),
            far(margin.distance),
            chance(margin.first_order, 0.0),
            chance(margin.corrected.value, margin.corrected.error),
            format!("{:.1e}", margin.corrected.error),
        ]);
        said.text(table);
        said
    }

    /// The derivatives of the first-order probability: a row for each design variable.
    pub(super) fn slopes(&self, said: &mut Findings) {
        let margin = self.margin;
        let Some(slopes) = &margin.derivatives else {
            let why = match margin.sigma {
                0.0 => "nothing varies at first order",
                _ => "they exist for normal variables, and within the range of a double",
            };
            said.note(format!("No derivatives: {why}."));
            return;
        };
        let own = slopes.by_design.iter().zip(&slopes.by_half_width);
        let rows = self.description.design.iter().zip(own);
        let rows = rows.map(|(info, (nominal, half_width))| Slope {
            info,
            nominal: *nominal,
            half_width: *half_width,
        });
        let rows: Vec<Slope<'_>> = rows.collect();
        let still = rows.iter().all(|row| row.largest() == 0.0);
        if still {
            said.note("No variable changes the probability, within the range of a double.");
        } else if margin.first_order < CHANCE {
            said.note("The tables show what changes so small a probability.");
        }
        let told = !still && margin.first_order >= CHANCE;
        slope_table(said, &rows, told);
    }
}

impl fmt::Display for MarginTable<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut said = self.probabilities();
        self.slopes(&mut said);
        said.fmt(f)
    }
}

/// Derivatives of a probability with respect to the nominal value and half-width of a design variable, per SI unit.
struct Slope<'a> {
    info: &'a DesignInfo,
    nominal: f64,
    half_width: f64,
}

impl Slope<'_> {
    fn largest(&self) -> f64 {
        self.nominal.abs().max(self.half_width.abs())
    }

    /// The effect of a change as large as the nominal value.
    fn effect(&self) -> f64 {
        self.largest() * self.info.nominal.abs()
    }
}

/// The text, if anything is told, leaves out what has little effect.
fn slope_table(said: &mut Findings, rows: &[Slope<'_>], told: bool) {
    let most = largest(rows.iter().map(Slope::effect));
    let matters = |row: &Slope<'_>| row.info.nominal == 0.0 || relevant(row.effect(), most);
    let (shown, left): (Vec<usize>, Vec<usize>) = (0..rows.len()).partition(|&k| matters(&rows[k]));
    let mut table = Columns::new("probability by design", rows);
    table.show_rows(if told { shown } else { Vec::new() });
    table.words("by", &|row| Some(row.info.name.to_string()));
    table.words("unit", &|row| Some(row.info.unit.symbol.to_string()));
    table.cells("probability by", &|row| per(&row.info.name, &row.info.unit));
    let nominal = table.number("by nominal value", "per unit", &|row| {
        Some(row.nominal * row.info.unit.scale)
    });
    nominal.digits(rough).headed("nominal value");
    let half_width = table.number("by half-width", "per unit", &|row| {
        Some(row.half_width * row.info.unit.scale)
    });
    half_width.digits(rough).headed("half-width");
    said.columns(table);
    if told && !left.is_empty() {
        let left: Vec<&str> = left.iter().map(|&k| &*rows[k].info.name).collect();
        let names = names(&left, "variables");
        said.note(format!("Left out, {BELOW} of the largest effect: {names}"));
    }
}
