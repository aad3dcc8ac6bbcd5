//! Equilibrium and natural modes.

use clap::Args;
use eigentol_figures::mode_shapes;

use crate::failure::Failure;
use crate::output::Output;
use crate::picture::Picture;
use crate::point::Point;
use crate::verdict::Verdict;

/// Equilibrium and natural modes at one operating point
#[derive(Args, Debug)]
pub(crate) struct Modes {
    #[command(flatten)]
    point: Point,
    #[command(flatten)]
    output: Output,
    #[command(flatten)]
    picture: Picture,
}

impl Modes {
    pub(crate) fn run(&self) -> Result<Verdict, Failure> {
        self.output.check()?;
        self.picture.check(&self.output)?;
        let question = self.point.question()?;
        question.note_unset();
        let modes = question.study.modes()?;
        let mut answer = self.output.answer();
        answer.add(&modes.with_whirls(question.study.whirls()?))?;
        answer.add(&question.study.equilibrium()?)?;
        let style = self.picture.style(&question, modes.modes.len())?;
        self.picture.draw(|| mode_shapes(&modes, &style))?;
        self.output.write(&answer)?;
        Ok(Verdict::of(&question.study)?)
    }
}
