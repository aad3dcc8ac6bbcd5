//! All equilibria at one operating point.

use clap::Args;

use crate::failure::Failure;
use crate::interrupt;
use crate::output::Output;
use crate::point::Point;
use crate::verdict::Verdict;

/// Distinct equilibria at one operating point, numbered, from random starts (`--between`)
#[derive(Args, Debug)]
pub(crate) struct Equilibria {
    #[command(flatten)]
    point: Point,
    #[command(flatten)]
    output: Output,
}

impl Equilibria {
    pub(crate) fn run(&self) -> Result<Verdict, Failure> {
        self.output.check()?;
        let question = self.point.question()?;
        question.note_unset();
        let states = question.equilibria()?;
        self.output.show(&states)?;
        if interrupt::stopped() {
            return Ok(Verdict::Stopped(format!("after {} starts", states.starts)));
        }
        Ok(if states.iter().any(|state| state.stability.holds()) {
            Verdict::Yes
        } else {
            Verdict::No("no stable equilibrium was found".to_owned())
        })
    }
}
