use eigentol_results::numbers::{counted, rough, short};
use eigentol_results::relevance::NOTHING_VARIES;
use eigentol_results::{Answer, Columns, Findings, at_point, displayed};

use crate::requirement::{Chances, Interval, Tally};
use crate::tolerance::outcomes;

/// Confidence of the intervals.
const CONFIDENCE: f64 = 0.95;

/// `chances`: a row for each requirement; `chance of all`: one row; `outcomes`.
impl Answer for Chances {
    const KIND: &'static str = "chances";

    at_point!();

    fn findings(&self) -> Findings {
        let samples = self.all.samples();
        let drawn = counted(samples, "sample");
        let mut said = self.titled(format_args!("requirements, {drawn}"));
        if samples < self.planned {
            let planned = self.planned;
            said.note(format!("Not complete: {planned} samples were asked for."));
        }
        self.tallies(&mut said);
        said.data(outcomes(&self.counts));
        if !self.varies {
            said.note(NOTHING_VARIES);
        }
        if self.each.iter().any(|tally| tally.untold > 0) {
            said.note("Untold: the response does not exist; such a sample counts neither as met nor as failed.");
        }
        let stable = self.counts.stable;
        if stable < samples {
            let others = counted(samples - stable, "sample");
            said.note(format!("Not stable: {others}: {}", self.counts));
        }
        said
    }
}

displayed!(Chances);

/// The number of a requirement, `None` for all of them, and its tally.
type Row<'a> = (Option<usize>, &'a Tally);

impl Chances {
    /// Each and all in one table of the text, in two of data.
    fn tallies(&self, said: &mut Findings) {
        let mut rows: Vec<Row<'_>> = self.each.iter().enumerate().map(|(k, x)| (Some(k + 1), x)).collect();
        let mut table = Columns::new("chances", &rows);
        table.whole("requirement", &|(number, _)| *number);
        tallies(&mut table);
        said.data(table.finish().0);
        let all = [(None, &self.all)];
        let mut table = Columns::new("chance of all", &all);
        tallies(&mut table);
        said.data(table.finish().0);
        rows.extend(all);
        let mut text = Columns::new("chances", &rows);
        text.cells("requirement", &|(number, _)| number.map_or_else(|| "all".to_owned(), |number| number.to_string()));
        tallies(&mut text);
        said.text(text.finish().1);
    }
}

fn tallies(table: &mut Columns<'_, Row<'_>>) {
    let interval = |tally: &Tally| tally.clopper_pearson(CONFIDENCE).ok();
    table.whole("met", &|(_, x)| Some(x.met)).shown();
    table.whole("failed", &|(_, x)| Some(x.failed)).shown();
    table.whole("untold", &|(_, x)| Some(x.untold)).shown();
    table.number("probability of failure", "", &|(_, x)| Some(x.failure())).digits(rough).headed("P(failed)");
    table.number("95 % from", "", &|(_, x)| Some(interval(x)?.lower));
    table.number("95 % to", "", &|(_, x)| Some(interval(x)?.upper));
    table.cells("95 % interval (Clopper-Pearson)", &|(_, item)| {
        let text = |interval: Interval| format!("{} to {}", short(interval.lower), short(interval.upper));
        interval(item).map_or_else(|| "-".to_owned(), text)
    });
}
