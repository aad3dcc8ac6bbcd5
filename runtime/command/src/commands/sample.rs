//! Monte Carlo.

use clap::Args;

use crate::failure::Failure;
use crate::output::{Answer, Output};
use crate::point::Point;
use crate::progress;
use crate::verdict::Verdict;

/// Samples of the design within its tolerances, each solved anew
#[derive(Args, Debug)]
pub(crate) struct Sample {
    #[command(flatten)]
    point: Point,
    /// Number of samples [default: 3000]
    #[arg(long, value_name = "COUNT")]
    samples: Option<usize>,
    /// Seed of the samples [default: 0]
    #[arg(long, value_name = "NUMBER")]
    seed: Option<u64>,
    /// Which of the seed's independent sequences [default: 0]
    #[arg(long, value_name = "NUMBER")]
    stream: Option<u64>,
    /// Threads; as many as the machine has unless set
    #[arg(long, value_name = "COUNT")]
    threads: Option<usize>,
    #[command(flatten)]
    output: Output,
}

impl Sample {
    pub(crate) fn run(&self) -> Result<Verdict, Failure> {
        self.output.check()?;
        let question = self.point.question()?;
        let file = &question.file;
        let samples = self.samples.or(file.samples).unwrap_or(3000);
        let study = question
            .study
            .samples(samples)
            .seed(self.seed.or(file.seed).unwrap_or(0))
            .stream(self.stream.or(file.stream).unwrap_or(0))
            .threads(self.threads.unwrap_or(0));
        let solved = study.solve()?;
        let bar = progress::bar("samples", samples as u64);
        let found = solved.monte_carlo_with_progress(&|done| bar.inc(done as u64))?;
        bar.finish_and_clear();
        let mut answer = Answer::default();
        answer.add(&found);
        self.output.write(&answer)?;
        Ok(Verdict::of(&solved.equilibrium, &solved.modes))
    }
}
