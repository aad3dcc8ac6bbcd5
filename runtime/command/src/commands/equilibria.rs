//! All equilibria at one operating point.

use clap::Args;
use eigentol::equilibrium::Equilibria as AllEquilibria;

use crate::failure::Failure;
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
        let states: AllEquilibria = question.study.equilibria(&question.search()?)?;
        let mut answer = self.output.answer();
        answer.add(&states)?;
        self.output.write(&answer)?;
        Ok(match states.iter().any(|state| state.stability.holds()) {
            true => Verdict::Yes,
            false => Verdict::No("no stable equilibrium was found".to_owned()),
        })
    }
}
