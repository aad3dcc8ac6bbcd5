//! What tolerances do at one operating point.

use clap::Args;
use eigentol_figures::shares_of_all;

use crate::failure::Failure;
use crate::output::Output;
use crate::picture::Picture;
use crate::point::Point;
use crate::verdict::Verdict;

/// Spread of frequencies and outputs by tolerances, and how far it can be trusted
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
        self.picture.check()?;
        let question = self.point.question()?;
        let solved = question.study.solve()?;
        let mut answer = self.output.answer();
        let first = solved.first_order()?;
        answer.add_aside(&first)?;
        answer.add(&solved.summary()?)?;
        if !question.study.description().outputs.is_empty() {
            answer.add(&solved.output_tolerances()?)?;
        }
        let style = self.picture.style(&question);
        self.picture.draw(|| shares_of_all(&first, &style))?;
        self.output.write(&answer)?;
        Ok(Verdict::of(&solved.equilibrium, &solved.modes))
    }
}
