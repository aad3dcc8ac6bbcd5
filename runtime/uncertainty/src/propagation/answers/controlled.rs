use eigentol_results::numbers::{or_dash, short};
use eigentol_results::title::title;
use eigentol_results::{Answer, Columns, Findings, Subject, displayed};

use super::{Row, estimates, responses};
use crate::propagation::Controlled;
use crate::tolerance::outcomes;

/// `controlled spreads`: a row for each response, numbers in its `unit`; `outcomes`.
impl Answer for Controlled {
    const KIND: &'static str = "controlled spreads";

    fn subject(&self) -> Option<Subject<'_>> {
        Some(Subject::at(&self.description, &self.inputs))
    }

    fn findings(&self) -> Findings {
        let d = &self.description;
        let mut said = Findings::titled(format!(
            "{}: spread of responses by random samples with the Taylor model as control",
            title(d, &self.inputs)
        ));
        let (total, counts) = (self.counts.total(), &self.counts);
        said.note(format!("{total} designs: {counts}."));
        let rows = Row::each(&self.wanted, d, self.spreads.iter().map(Option::as_ref));
        let mut table = Columns::new("controlled spreads", &rows);
        responses(&mut table);
        estimates(&mut table, "mean", &|x| Some(x.as_ref()?.mean));
        table.number("worth of mean", "", &|row| Some(row.result?.worth));
        table.cells("worth", &|row| or_dash(row.result.map(|x| x.worth), short));
        estimates(&mut table, "sigma", &|x| Some(x.as_ref()?.sigma));
        table.number("worth of sigma", "", &|row| Some(row.result?.worth_of_sigma));
        table.cells("worth", &|row| or_dash(row.result.map(|x| x.worth_of_sigma), short));
        table.words("model", &|row| Some(row.result?.model.to_string()));
        table.cells("model", &|row| row.result.map_or_else(|| "not controlled".to_owned(), |x| x.model.to_string()));
        said.columns(table);
        said.note("Worth: how many plain samples give the same error as one of these.");
        said.data(outcomes(&self.counts));
        said
    }
}

displayed!(Controlled);
