use eigentol_results::numbers::{converted, heading, optional, or_dash, rough};
use eigentol_results::relevance::NOTHING_VARIES;
use eigentol_results::shares::Shares;
use eigentol_results::{Answer, Columns, Findings, at_point, displayed};

use super::first_order::spread_of;
use crate::mechanism::OutputInfo;
use crate::tolerance::{OutputTolerances, Spread};

/// An output, its nominal value and its spread, SI.
struct Row<'a> {
    info: &'a OutputInfo,
    nominal: f64,
    spread: Option<&'a Spread>,
}

impl Row<'_> {
    fn in_unit(&self, value: f64) -> f64 {
        converted(value, &self.info.unit)
    }

    fn mean(&self) -> f64 {
        self.in_unit(self.spread.map_or(self.nominal, |spread| spread.mean))
    }

    /// The standard deviation that the text shows.
    fn sigma(&self) -> Option<f64> {
        self.spread.map(|spread| self.in_unit(spread_of(spread)))
    }
}

/// The shares in the variance of an output that moves.
fn shares_of<'a>(row: &'a Row<'_>) -> Option<&'a [f64]> {
    let spread = row.spread?;
    (spread_of(spread) != 0.0).then_some(&spread.variance_shares[..])
}

/// `output tolerances`: a row for each output, numbers in its `unit`.
impl Answer for OutputTolerances {
    const KIND: &'static str = "output tolerances";

    at_point!();

    fn findings(&self) -> Findings {
        let d = &self.description;
        let mut said = self.titled("first-order spread of the outputs");
        let values = self.values.iter().zip(&self.spreads);
        let rows = d.outputs.iter().zip(values);
        let rows = rows.map(|(info, (&nominal, spread))| Row { info, nominal, spread: spread.as_ref() });
        let rows: Vec<Row<'_>> = rows.collect();
        let mut table = Columns::new("output tolerances", &rows);
        table.words("output", &|row| Some(row.info.name.to_string()));
        table.words("unit", &|row| Some(row.info.unit.symbol.to_string()));
        table.number("mean", "", &|row| Some(row.mean()));
        table.number("sigma", "", &|row| Some(row.in_unit(row.spread?.sigma)));
        table.number("band", "", &|row| Some(row.in_unit(row.spread?.band)));
        table.number("sigma level", "", &|_| Some(self.sigma_level));
        table.shares(d, &|row| Some(&row.spread?.variance_shares[..]));
        table.cells("output", &|row| heading(&row.info.name, &row.info.unit));
        table.cells("mean", &|row| optional(Some(row.mean())));
        table.cells("sigma", &|row| or_dash(row.sigma(), rough));
        table.cells(&format!("{} sigma", self.sigma_level), &|row| {
            or_dash(row.sigma().map(|sigma| sigma * self.sigma_level), rough)
        });
        let shares = Shares::of(d, rows.iter().filter_map(shares_of));
        shares.columns(&mut table, &shares_of);
        said.columns(table);
        if !self.varies {
            said.note(NOTHING_VARIES);
        }
        shares.rest(&mut said);
        said
    }
}

displayed!(OutputTolerances);
