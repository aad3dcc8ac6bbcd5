//! The effect of tolerances at one operating point.

use clap::Args;
use eigentol::Error;
use eigentol_figures::shares_of_all;

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
        let bar = progress::bar("samples", None);
        question.study = progress::watched(question.study, &bar);
        let study = &question.study;
        let solved = study.solve()?;
        let mut answer = self.output.answer();
        let first = solved.first_order()?;
        let summary = solved.summary();
        bar.finish_and_clear();
        let stopped = matches!(summary, Err(Error::Stopped));
        if stopped {
            answer.add(&first)?;
        } else {
            answer.add_aside(&first)?;
            answer.add(&summary?)?;
        }
        let mut without_outputs = None;
        if !study.description().outputs.is_empty() {
            match solved.output_tolerances() {
                Ok(outputs) => answer.add(&outputs)?,
                Err(error) => without_outputs = Some(error),
            }
        }
        let style = self.picture.style(&question, solved.modes.modes.len())?;
        self.picture.draw(|| shares_of_all(&first, &style))?;
        self.output.write(&answer)?;
        if let Some(error) = without_outputs {
            return Err(error.into());
        }
        if stopped {
            let reason = "before samples and second order could judge the first-order spread";
            return Ok(Verdict::Stopped(reason.to_owned()));
        }
        Ok(Verdict::of(&solved.equilibrium, &solved.modes))
    }
}
