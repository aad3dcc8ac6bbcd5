use eigentol_results::numbers::{counted, rough, short};
use eigentol_results::title::title;
use eigentol_results::{Answer, Findings, Subject, Table, displayed};

use crate::requirement::RareFailure;

/// `rare failure`: one row.
impl Answer for RareFailure {
    const KIND: &'static str = "rare failure";

    fn subject(&self) -> Option<Subject<'_>> {
        Some(Subject::at(&self.description, &self.inputs))
    }

    fn findings(&self) -> Findings {
        let failure = &self.failure;
        let mut said = Findings::titled(format!(
            "{}: {} importance samples about {}",
            title(&self.description, &self.inputs),
            failure.samples,
            counted(self.centres, "design point")
        ));
        said.data(self.row());
        said.note(format!(
            "At least one requirement fails with probability {} +- {} ({} failed, {} undecided).",
            rough(failure.probability.value),
            short(failure.probability.standard_error),
            counted(failure.failures, "sample"),
            failure.without_value
        ));
        if self.contradicted() {
            said.note(format!("Not to be relied on: along lines of designs, the probability is {}.", self.judgement));
        } else if !failure.reached {
            said.note("Not settled: the samples did not reach their target.");
        }
        if !self.without_design_point.is_empty() {
            let numbers = self.without_design_point.iter();
            let numbers: Vec<String> = numbers.map(|k| (k + 1).to_string()).collect();
            said.note(format!(
                "No design point for requirement {}: failures with a probability of up to {} may have gone unseen (95 %).",
                numbers.join(", "),
                rough(self.unseen)
            ));
        }
        said
    }
}

displayed!(RareFailure);

impl RareFailure {
    fn row(&self) -> Table {
        let failure = &self.failure;
        let whole = |count: u64| [usize::try_from(count).ok()];
        let mut table = Table::new("rare failure");
        table.numbers("probability of failure", "", [failure.probability.value]);
        table.numbers("standard error", "", [failure.probability.standard_error]);
        table.whole("samples", whole(failure.samples));
        table.whole("failures", whole(failure.failures));
        table.whole("without value", whole(failure.without_value));
        table.whole("design points", [self.centres]);
        table.numbers("unseen", "", [self.unseen]);
        table.flags("trusted", [self.trusted()]);
        table
    }
}
