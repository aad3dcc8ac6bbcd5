//! Derivatives with respect to inputs and design variables.

use clap::Args;
use eigentol::sensitivity::{EquilibriumShift, OutputSensitivities};
use eigentol_tables::Answer as _;

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
        question.note_unset();
        let has_outputs = !question.study.description().outputs.is_empty();
        let kinds = [eigentol::Sensitivities::KIND, EquilibriumShift::KIND, OutputSensitivities::KIND];
        let kinds = kinds.map(|kind| (kind, false));
        let shown = self.output.shown(&kinds[..if has_outputs { 3 } else { 2 }])?;
        let study = &question.study;
        let verdict = Verdict::of(study)?;
        let mut answer = self.output.answer();
        if shown[0] {
            answer.add(&study.sensitivities()?)?;
        }
        if shown[1] {
            answer.add(&study.equilibrium_shift()?)?;
        }
        if shown.get(2) == Some(&true) {
            answer.add(&study.outputs()?)?;
        }
        self.output.write(&answer)?;
        Ok(verdict)
    }
}
