//! Merging the parts of a run.

use std::path::PathBuf;

use clap::Args;
use eigentol::tolerance::PartialMonteCarlo;

use crate::failure::Failure;
use crate::output::Output;
use crate::parts;
use crate::verdict::Verdict;

/// Combine the partial results of one sampling run, in any order: the same bits as in a single run
#[derive(Args, Debug)]
pub(crate) struct Merge {
    /// Partial results that `sample --shard` or `sample --partial` wrote
    #[arg(value_name = "FILE", required = true)]
    files: Vec<PathBuf>,
    /// Write another partial result, to be merged with more
    #[arg(long, conflicts_with_all = ["json", "csv", "parquet", "table"])]
    partial: bool,
    #[command(flatten)]
    output: Output,
}

impl Merge {
    pub(crate) fn run(&self) -> Result<Verdict, Failure> {
        self.output.check()?;
        let mut all: Option<PartialMonteCarlo> = None;
        for file in &self.files {
            let part = parts::read(file)?;
            match &mut all {
                None => all = Some(part),
                Some(all) => parts::add(all, file, part)?,
            }
        }
        let Some(all) = all else {
            return Err(Failure::usage("there is nothing to merge", "name partial results"));
        };
        if self.partial {
            self.output.write_text(&parts::text(&all)?)?;
            return Ok(Verdict::Yes);
        }
        self.output.show(&all.result())?;
        Ok(match all.check_complete() {
            Ok(()) => Verdict::Yes,
            Err(error) => Verdict::No(error.to_string()),
        })
    }
}
