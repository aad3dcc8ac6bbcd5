use eigentol_results::numbers::rough;
use eigentol_results::relevance::CHANCE;
use eigentol_results::{Answer, Columns, Findings, at_point, displayed};

use super::reliability::variables;
use super::words::probability;
use crate::requirement::{FailureProbability, Interval, Probabilities, Reliability};

/// `probabilities of failure`: a row for each requirement and one for any of them; the tables of design points and
/// samples, if there are any.
impl Answer for Probabilities {
    const KIND: &'static str = "probabilities of failure";

    at_point!();

    fn findings(&self) -> Findings {
        let mut said = self.titled("probability of failure");
        self.found(&mut said);
        let details = self.reliability.iter().map(Answer::findings);
        let details = details.chain(self.chances.iter().map(Answer::findings));
        for table in details.flat_map(Findings::into_tables) {
            said.data(table);
        }
        let untold = self.each.iter().chain([&self.any]).fold(0.0, |most: f64, x| most.max(x.untold));
        if untold > CHANCE {
            said.note(format!(
                "Designs with a probability of up to {} lack the response needed to tell; they do not count as failures.",
                rough(untold)
            ));
        }
        if let Some(reliability) = &self.reliability {
            most_probable(&mut said, reliability);
        }
        said
    }
}

displayed!(Probabilities);

/// A requirement with its number, or any of them, in words.
struct Row<'a> {
    number: Option<usize>,
    requirement: String,
    failure: &'a FailureProbability,
}

impl Row<'_> {
    fn label(&self) -> String {
        let of = &self.requirement;
        match self.number {
            Some(number) => format!("{number}: {of}"),
            None => of.clone(),
        }
    }
}

impl Probabilities {
    fn found(&self, said: &mut Findings) {
        let d = &self.description;
        let each = self.wanted.iter().zip(&self.each).enumerate();
        let each =
            each.map(|(k, (wanted, item))| Row { number: Some(k + 1), requirement: wanted.text(d), failure: item });
        let any = Row { number: None, requirement: "any".to_owned(), failure: &self.any };
        let rows: Vec<Row<'_>> = each.chain([any]).collect();
        let mut table = Columns::new("probabilities of failure", &rows);
        if self.each.len() == 1 {
            table.show_rows(vec![0]);
        }
        table.words("requirement", &|row| Some(row.requirement.clone()));
        table.cells("requirement", &Row::label);
        let value = table.number("probability of failure", "", &|row| Some(row.failure.value));
        value.digits(probability).headed("P(failed)");
        table.number("95 % from", "", &|row| Some(row.failure.interval.lower));
        table.number("95 % to", "", &|row| Some(row.failure.interval.upper));
        table.cells("95 % interval", &|row| {
            let Interval { lower, upper } = row.failure.interval;
            format!("{} to {}", probability(lower), probability(upper))
        });
        table.number("probability without response", "", &|row| Some(row.failure.untold));
        table.words("found by", &|row| Some(row.failure.by.word().to_owned())).shown();
        table.whole("designs", &|row| usize::try_from(row.failure.designs).ok()).shown();
        said.columns(table);
    }
}

/// The most probable way to fail each limit.
fn most_probable(said: &mut Findings, of: &Reliability) {
    for limit in &of.limits {
        let mut points = limit.design_points.iter().flatten();
        let Some(nearest) = points.find(|point| point.verified) else {
            continue;
        };
        said.note(format!(
            "Requirement {}: {}, most probably fails {} standard deviations from the mean.",
            limit.requirement + 1,
            limit.limit.text(&of.description),
            rough(nearest.beta().abs())
        ));
        variables(said, nearest, &of.description);
    }
}
