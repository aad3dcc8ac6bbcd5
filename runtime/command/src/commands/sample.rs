//! Monte Carlo, whole or in parts.

use std::ops::Range;
use std::path::PathBuf;

use clap::Args;
use eigentol::tolerance::numbered_samples_table;
use eigentol::tolerance::{PartialMonteCarlo, Sample as Solution, Sampling};
use eigentol::{Error, Study};
use eigentol_interpreter::Interpreted;

use crate::failure::Failure;
use crate::interrupt;
use crate::output::Output;
use crate::parts::{self, Shard};
use crate::point::{Point, exact, samples, whole};
use crate::progress::{self, Bar};
use crate::verdict::Verdict;

/// Monte Carlo: samples of the design within its tolerances, each solved again; all of them, or a part that `merge`
/// combines with others
#[derive(Args, Debug)]
pub(crate) struct Sample {
    #[command(flatten)]
    point: Point,
    /// Number of samples of the whole run [default: 3000]
    #[arg(long, value_name = "COUNT", value_parser = whole, allow_negative_numbers = true)]
    samples: Option<usize>,
    /// Seed of the samples [default: 0]
    #[arg(long, value_name = "NUMBER", value_parser = exact::<u64>, allow_negative_numbers = true)]
    seed: Option<u64>,
    /// Which of the seed's independent sequences [default: 0]
    #[arg(long, value_name = "NUMBER", value_parser = exact::<u64>, allow_negative_numbers = true)]
    stream: Option<u64>,
    /// Number of threads [default: as many as the machine has]
    #[arg(long, value_name = "COUNT", value_parser = exact::<usize>, allow_negative_numbers = true)]
    threads: Option<usize>,
    /// Keep every sample, for `--json` and partial results; not needed for `--table samples`, which writes them as they
    /// come
    #[arg(long)]
    keep: bool,
    /// Take only one part of the samples, here the third of 64, and write a partial result for `merge`
    #[arg(long, value_name = "3/64", conflicts_with_all = ["json", "csv", "parquet", "table"])]
    shard: Option<Shard>,
    /// Write a partial result for `merge` or `--resume`, also after Ctrl-C
    #[arg(long, conflicts_with_all = ["json", "csv", "parquet", "table"])]
    partial: bool,
    /// Continue from a partial result of this run
    #[arg(long, value_name = "FILE")]
    resume: Option<PathBuf>,
    #[command(flatten)]
    output: Output,
}

impl Sample {
    pub(crate) fn run(&self) -> Result<Verdict, Failure> {
        self.output.check()?;
        let question = self.point.question()?;
        question.note_unset();
        let file = &question.file;
        let samples = samples(self.samples, file)?;
        let shown = self.output.wants_table("samples");
        if self.keep && !shown && samples > MOST_KEPT {
            let message = format!("one document cannot hold {samples} samples");
            let help = "as rows there is no limit: `--csv --table samples`, or `--parquet`";
            return Err(Failure::usage(message, help));
        }
        let study = question
            .study
            .samples(samples)
            .seed(self.seed.or(file.seed).unwrap_or(0))
            .stream(self.stream.or(file.stream).unwrap_or(0))
            .threads(self.threads.unwrap_or(0))
            .keep_samples(self.keep || shown);
        let range = self.shard.unwrap_or(Shard::WHOLE).range(samples as u64);
        let bar = progress::bar("samples", Some(range.end - range.start));
        let study = progress::watched(study, &bar);
        let run = Run { study: &study, sampling: study.sampling(), range: &range, bar: &bar };
        // An empty part, to reject a partial result of another run before any work.
        let mut part = run.take(range.start..range.start)?;
        if let Some(path) = &self.resume {
            parts::add(&mut part, path, parts::read(path)?)?;
        }
        if shown {
            self.write_samples(&run, &mut part)?;
        } else {
            run.complete(&mut part, u64::MAX, |_| Ok(()))?;
            bar.finish_and_clear();
            if self.shard.is_some() || self.partial {
                self.output.write_text(&parts::text(&part)?)?;
            } else {
                self.output.show(&part.result())?;
            }
        }
        let missing = within(&part.missing(), &range);
        if interrupt::stopped() && !missing.is_empty() {
            let wanted = range.end - range.start;
            let done = wanted - length(&missing);
            return Ok(Verdict::Stopped(format!("after {done} of {wanted} samples")));
        }
        Ok(Verdict::of(&study)?)
    }

    /// Computes the missing samples of a run and writes them as they arrive.
    fn write_samples(&self, run: &Run<'_>, part: &mut PartialMonteCarlo) -> Result<(), Failure> {
        let whole = part.result();
        let make = |all: &[(u64, Solution)]| numbered_samples_table(&whole, all);
        let Some(mut rows) = self.output.rows(("Monte Carlo", "samples"), make)? else {
            return Err(Failure::usage("samples belong to the result `Monte Carlo`", "leave `--result` out"));
        };
        run.complete(part, TOGETHER, |part| {
            let mut samples = part.take_samples().into_iter();
            samples.try_for_each(|one| rows.add(one))
        })?;
        run.bar.finish_and_clear();
        rows.finish()
    }
}

/// Most samples in one document: each takes some kilobytes of memory.
const MOST_KEPT: usize = 100_000;
/// Number of samples in memory at once when all are written.
const TOGETHER: u64 = 16_384;

/// A run in progress.
struct Run<'a> {
    study: &'a Study<Interpreted>,
    sampling: Sampling<'a>,
    range: &'a Range<u64>,
    bar: &'a Bar,
}

impl Run<'_> {
    fn take(&self, range: Range<u64>) -> Result<PartialMonteCarlo, Error> {
        let sampling = self.sampling.clone();
        self.study.sample_modes(&sampling.range(Some(range)))
    }

    /// Computes the missing samples, `together` at a time, and passes each part to `each` before merging it.
    fn complete(
        &self,
        done: &mut PartialMonteCarlo,
        together: u64,
        mut each: impl FnMut(&mut PartialMonteCarlo) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        each(done)?;
        let missing = within(&done.missing(), self.range);
        self.bar.set_position(self.range.end - self.range.start - length(&missing));
        for range in missing {
            let mut start = range.start;
            while start < range.end && !interrupt::stopped() {
                let end = start.saturating_add(together).min(range.end);
                let mut part = self.take(start..end)?;
                each(&mut part)?;
                done.merge(part)?;
                start = end;
            }
        }
        Ok(())
    }
}

fn length(ranges: &[Range<u64>]) -> u64 {
    ranges.iter().map(|range| range.end - range.start).sum()
}

/// The intersections of these ranges with another range.
fn within(ranges: &[Range<u64>], within: &Range<u64>) -> Vec<Range<u64>> {
    let inside = |range: &Range<u64>| range.start.max(within.start)..range.end.min(within.end);
    let inside = ranges.iter().map(inside);
    inside.filter(|inside| inside.start < inside.end).collect()
}
