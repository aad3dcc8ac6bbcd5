//! The effect of tolerances at one operating point.

use clap::Args;
use eigentol::summary::Summary;
use eigentol::tolerance::OutputTolerances;
use eigentol::{Error, FirstOrder};
use eigentol_figures::shares_of_all;
use eigentol_tables::Answer as _;

use crate::failure::Failure;
use crate::output::Output;
use crate::picture::Picture;
use crate::point::Point;
use crate::progress;
use crate::verdict::Verdict;

/// Spread of frequencies and outputs by tolerances, and how far that of the frequencies can be trusted
#[derive(Args, Debug)]
pub(crate) struct Tolerance {
    #[command(flatten)]
    point: Point,
    #[command(flatten)]
    output: Output,
    #[command(flatten)]
    picture: Picture,
}

impl Tolerance {
    pub(crate) fn run(&self) -> Result<Verdict, Failure> {
        self.output.check()?;
        self.picture.check(&self.output)?;
        let mut question = self.point.question()?;
        question.note_unset();
        let bar = progress::bar("samples", None);
        question.study = progress::watched(question.study, &bar);
        let study = &question.study;
        let has_outputs = !study.description().outputs.is_empty();
        let kinds = [
            // The text of the summary includes it.
            (FirstOrder::KIND, true),
            (Summary::KIND, false),
            (OutputTolerances::KIND, false),
        ];
        let kinds = &kinds[..if has_outputs { 3 } else { 2 }];
        let shown = self.output.shown(kinds)?;
        let of = |kind: &str| kinds.iter().zip(&shown).any(|(x, shown)| x.0 == kind && *shown);
        let modes = study.modes()?;
        let mut answer = self.output.answer();
        let summary = of(Summary::KIND).then(|| study.summary());
        drop(bar);
        let stopped = matches!(summary, Some(Err(Error::Stopped)));
        let first =
            if of(FirstOrder::KIND) || stopped || self.picture.is_wanted() { Some(study.first_order()?) } else { None };
        if let Some(first) = &first {
            if stopped { answer.add(first)? } else { answer.add_aside(first)? }
        }
        if let Some(summary) = summary.filter(|_| !stopped) {
            answer.add(&summary?)?;
        }
        let mut without_outputs = None;
        if of(OutputTolerances::KIND) {
            match study.output_tolerances() {
                Ok(outputs) => answer.add(&outputs)?,
                Err(error) => without_outputs = Some(error),
            }
        }
        if let Some(first) = &first {
            let style = self.picture.style(&question, modes.modes.len())?;
            self.picture.draw(|| shares_of_all(first, &style))?;
        }
        self.output.write(&answer)?;
        if let Some(error) = without_outputs {
            return Err(error.into());
        }
        if stopped {
            let reason = "before samples and second order could judge the first-order spread";
            return Ok(Verdict::Stopped(reason.to_owned()));
        }
        Ok(Verdict::of(study)?)
    }
}
