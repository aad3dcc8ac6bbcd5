//! Whether beams have enough coordinates.

use clap::Args;
use eigentol_interpreter::Interpreted;

use crate::failure::Failure;
use crate::output::Output;
use crate::point::{Point, whole};
use crate::verdict::Verdict;

/// Changes of all frequencies, damping ratios and outputs with one and two more coordinates of each beam's components
#[derive(Args, Debug)]
pub(crate) struct Converge {
    #[command(flatten)]
    point: Point,
    /// How many of the first modes that oscillate are compared [default: all]
    #[arg(long, value_name = "NUMBER", value_parser = whole)]
    modes: Option<usize>,
    #[command(flatten)]
    output: Output,
}

impl Converge {
    pub(crate) fn run(&self) -> Result<Verdict, Failure> {
        self.output.check()?;
        let question = self.point.question()?;
        question.note_unset();
        let refined = |more| Interpreted::refined(&question.text, more);
        let convergence = (question.study).convergence([refined(1)?, refined(2)?])?;
        let mut answer = self.output.answer();
        answer.add(&convergence.of_first(self.modes.unwrap_or(usize::MAX)))?;
        self.output.write(&answer)?;
        Ok(Verdict::of(&question.study)?)
    }
}
