//! Derivatives with respect to inputs and design variables.

use clap::Args;

use crate::failure::Failure;
use crate::output::Output;
use crate::point::Point;
use crate::verdict::Verdict;

/// Total derivatives of equilibrium, modes and outputs by every input and design variable
#[derive(Args, Debug)]
pub(crate) struct Sensitivities {
    #[command(flatten)]
    point: Point,
    #[command(flatten)]
    output: Output,
}

impl Sensitivities {
    pub(crate) fn run(&self) -> Result<Verdict, Failure> {
        self.output.check()?;
        let question = self.point.question()?;
        let solved = question.study.solve()?;
        let mut answer = self.output.answer();
        answer.add(&solved.sensitivities()?)?;
        answer.add(&solved.equilibrium_shift()?)?;
        if !question.study.description().outputs.is_empty() {
            answer.add(&solved.outputs()?)?;
        }
        self.output.write(&answer)?;
        Ok(Verdict::of(&solved.equilibrium, &solved.modes))
    }
}
