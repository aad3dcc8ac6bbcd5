use eigentol_results::numbers::{optional, or_dash, percent, short};
use eigentol_results::relevance::unless_rounding;
use eigentol_results::{Answer, Columns, Findings, at_point, displayed};

use super::{Row, errors, estimates, responses};
use crate::judge::Doubt;
use crate::propagation::{Propagation, QUANTILES, Quantile, ResponseSpread};
use crate::tolerance::{joined, outcomes, standing};

/// `spreads`: a row for each response, numbers in its `unit`; `quantiles`: a row for each response and probability, if
/// there are any; `correlations`: a row for each pair of responses, if there are several; `outcomes`.
impl Answer for Propagation {
    const KIND: &'static str = "spreads";

    at_point!();

    fn findings(&self) -> Findings {
        let method = &self.method;
        let mut said = self.titled(format_args!("spread of responses by {method}"));
        if !self.reason.is_empty() {
            said.note(format!("Why: {}.", self.reason));
        }
        said.note(format!("{} designs: {}.", self.evaluations, self.counts));
        let each = self.spreads.iter().zip(&self.doubts);
        let each = each.map(|(spread, doubts)| Spread { spread: spread.as_ref(), doubts });
        let rows = Row::each(&self.wanted, &self.description, each);
        self.spreads(&mut said, &rows);
        quantiles(&mut said, &rows);
        if rows.len() > 1 {
            self.correlations(&mut said, &rows);
        }
        said.data(outcomes(&self.counts));
        doubted(&mut said, &rows);
        said
    }
}

displayed!(Propagation);

/// The spread of a response, and the doubts about it.
struct Spread<'a> {
    spread: Option<&'a ResponseSpread>,
    doubts: &'a [Doubt],
}

impl Row<Spread<'_>> {
    fn nominal(&self) -> Option<f64> {
        Some(self.in_unit(self.result.spread?.nominal?))
    }

    /// The standard deviation that the text shows.
    fn sigma(&self) -> Option<f64> {
        let spread = self.result.spread?;
        let sigma = unless_rounding(spread.sigma?.value, spread.mean.value);
        Some(self.in_unit(sigma))
    }

    fn quantiles(&self) -> &[Quantile] {
        self.result.spread.map_or(&[], |spread| &spread.quantiles)
    }
}

impl Propagation {
    fn spreads(&self, said: &mut Findings, rows: &[Row<Spread<'_>>]) {
        let mut table = Columns::new("spreads", rows);
        responses(&mut table);
        table.number("nominal", "", &Row::nominal);
        table.cells("nominal", &|row| match row.result.spread {
            Some(_) => optional(row.nominal()),
            None => "no value".to_owned(),
        });
        estimates(&mut table, "mean", &|x| Some(x.spread?.mean));
        table.number("sigma", "", &|row| Some(row.in_unit(row.result.spread?.sigma?.value)));
        table.cells("sigma", &|row| optional(row.sigma()));
        errors(&mut table, "sigma", &|x| x.spread?.sigma);
        let skewness = table.number("skewness", "", &|row| Some(row.result.spread?.skewness?.value));
        skewness.digits(short);
        let error = table.number("error of skewness", "", &|row| row.result.spread?.skewness?.error);
        error.digits(short).headed("error");
        table.number("share", "", &|row| Some(row.result.spread?.share)).digits(percent);
        table.words("method", &|_| Some(self.method.to_string()));
        table.words("doubts", &|row| joined(row.result.doubts));
        said.columns(table);
    }

    /// The square of all correlations in the text, their pairs as data.
    fn correlations(&self, said: &mut Findings, rows: &[Row<Spread<'_>>]) {
        let count = rows.len();
        let all: Vec<_> = rows.iter().enumerate().collect();
        let mut square = Columns::new("correlations", &all);
        square.cells("correlation", &|(_, row)| row.name.clone());
        for (j, with) in &all {
            square.cells(&with.name, &|(i, _)| or_dash(self.correlation(*i, *j), |x| format!("{x:.3}")));
        }
        said.text(square.finish().1);
        let pairs = (0..count).flat_map(|i| (i + 1..count).map(move |j| (i, j)));
        let pairs: Vec<_> = pairs.collect();
        let mut table = Columns::new("correlations", &pairs);
        table.words("response", &|(i, _)| Some(rows[*i].name.clone()));
        table.words("with", &|(_, j)| Some(rows[*j].name.clone()));
        table.number("correlation", "", &|(i, j)| self.correlation(*i, *j));
        said.columns(table);
    }
}

/// A row for each response in the text, one for each response and probability as data.
fn quantiles(said: &mut Findings, rows: &[Row<Spread<'_>>]) {
    let known = rows.iter().filter(|row| !row.quantiles().is_empty());
    let known: Vec<_> = known.collect();
    if known.is_empty() {
        return;
    }
    let mut text = Columns::new("quantiles", &known);
    text.cells("quantile", &|row| row.label());
    for (k, p) in QUANTILES.into_iter().enumerate() {
        text.cells(&format!("{:.3} %", 100.0 * p), &|row| {
            optional(row.quantiles().get(k).map(|quantile| row.in_unit(quantile.value)))
        });
    }
    said.text(text.finish().1);
    let each = known.iter();
    let each = each.flat_map(|row| row.quantiles().iter().map(move |quantile| (row, quantile)));
    let each: Vec<_> = each.collect();
    let mut table = Columns::new("quantiles", &each);
    table.words("response", &|(row, _)| Some(row.name.clone()));
    table.words("unit", &|(row, _)| Some(row.unit.symbol.to_string()));
    table.number("probability", "", &|(_, x)| Some(x.probability));
    table.number("value", "", &|(row, x)| Some(row.in_unit(x.value)));
    table.number("error", "", &|(row, x)| Some(row.in_unit(x.error?)));
    said.columns(table);
}

/// The doubts about each response.
fn doubted(said: &mut Findings, rows: &[Row<Spread<'_>>]) {
    let mut any = false;
    for row in rows {
        for doubt in row.result.doubts {
            said.note(format!("{} for {}: {doubt}", standing(doubt), row.name));
            any = true;
        }
    }
    if any {
        said.note("Nothing is known about their errors: samples need no model.");
    }
}
