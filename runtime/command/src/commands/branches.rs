//! Branches of equilibria.

use clap::Args;
use eigentol_figures as figures;

use crate::failure::Failure;
use crate::output::Output;
use crate::picture::Picture;
use crate::point::Point;
use crate::sweep::Sweep;
use crate::verdict::Verdict;

/// All branches of equilibria along an input, with their limit points, branch points and stability
#[derive(Args, Debug)]
pub(crate) struct Branches {
    #[command(flatten)]
    point: Point,
    #[command(flatten)]
    sweep: Sweep,
    #[command(flatten)]
    output: Output,
    #[command(flatten)]
    picture: Picture,
}

impl Branches {
    pub(crate) fn run(&self) -> Result<Verdict, Failure> {
        self.output.check()?;
        self.picture.check()?;
        let question = self.point.question()?;
        let range = self.sweep.range(&question)?;
        let found = question
            .study
            .branches(range.input, range.low, range.high)?;
        let mut answer = self.output.answer();
        answer.add(&found)?;
        let style = self.picture.style(&question);
        self.picture.draw(|| figures::branches(&found, &style))?;
        self.output.write(&answer)?;
        if found.stable().next().is_some() {
            return Ok(Verdict::Yes);
        }
        Ok(Verdict::No("no branch has a stable part".to_owned()))
    }
}
