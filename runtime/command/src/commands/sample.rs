//! Monte Carlo, whole or in parts.

use std::ops::Range;
use std::path::PathBuf;

use clap::Args;
use eigentol::tolerance::PartialMonteCarlo;
use eigentol::{Solved, Study};
use eigentol_interpreter::Interpreted;

use crate::failure::Failure;
use crate::interrupt;
use crate::output::Output;
use crate::parts::{self, Shard};
use crate::point::Point;
use crate::progress;
use crate::verdict::Verdict;

/// Samples of the design within its tolerances, each solved anew; all of them, or a part that `merge` puts together with others
#[derive(Args, Debug)]
pub(crate) struct Sample {
    #[command(flatten)]
    point: Point,
    /// Number of samples of the whole run [default: 3000]
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
    /// Keep every sample: `--csv --table samples` writes them
    #[arg(long)]
    keep: bool,
    /// Take one part of the samples, the third of 64, and write a partial result for `merge`
    #[arg(long, value_name = "3/64", conflicts_with_all = ["json", "csv"])]
    shard: Option<Shard>,
    /// Write a partial result for `merge` or `--resume`, also after Ctrl-C
    #[arg(long, conflicts_with_all = ["json", "csv"])]
    partial: bool,
    /// Go on with a partial result of this run
    #[arg(long, value_name = "FILE")]
    resume: Option<PathBuf>,
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
            .threads(self.threads.unwrap_or(0))
            .keep_samples(self.keep);
        let solved = study.solve()?;
        let range = self.shard.unwrap_or(Shard::WHOLE).range(samples as u64);
        let part = self.sampled((&study, &solved), &range)?;
        if self.shard.is_some() || self.partial {
            self.output.write_text(&parts::text(&part)?)?;
        } else {
            let mut answer = self.output.answer();
            answer.add(&part.result())?;
            self.output.write(&answer)?;
        }
        let missing = within(&part.missing(), &range);
        if interrupt::stopped() && !missing.is_empty() {
            let wanted = range.end - range.start;
            let done = wanted - missing.iter().map(|own| own.end - own.start).sum::<u64>();
            return Ok(Verdict::Stopped(format!(
                "after {done} of {wanted} samples"
            )));
        }
        Ok(Verdict::of(&solved.equilibrium, &solved.modes))
    }

    /// The samples of a range, those that are done already as they are.
    fn sampled(
        &self,
        (study, solved): (&Study<Interpreted>, &Solved<'_, Interpreted>),
        range: &Range<u64>,
    ) -> Result<PartialMonteCarlo, Failure> {
        let bar = progress::bar("samples", range.end - range.start);
        let count = |done| bar.inc(done as u64);
        let sampling = study
            .sampling()
            .progress(Some(&count))
            .stop(Some(interrupt::stop()));
        let some = |range| solved.sample_modes(&sampling.clone().range(Some(range)));
        // Nothing, to refuse a partial result of another run before the work is done.
        let mut part = some(range.start..range.start)?;
        if let Some(path) = &self.resume {
            parts::add(&mut part, path, parts::read(path)?)?;
        }
        let missing = within(&part.missing(), range);
        let left: u64 = missing.iter().map(|own| own.end - own.start).sum();
        bar.set_position(range.end - range.start - left);
        for range in missing {
            part.merge(some(range)?)?;
        }
        bar.finish_and_clear();
        Ok(part)
    }
}

/// What of these ranges lies within another.
fn within(ranges: &[Range<u64>], within: &Range<u64>) -> Vec<Range<u64>> {
    let inside = |own: &Range<u64>| own.start.max(within.start)..own.end.min(within.end);
    let inside = ranges.iter().map(inside);
    inside.filter(|own| own.start < own.end).collect()
}
