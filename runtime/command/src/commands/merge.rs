//! Putting parts of a run together.

use std::path::{Path, PathBuf};

use clap::Args;
use eigentol::Error;
use eigentol::tolerance::PartialMonteCarlo;

use crate::failure::Failure;
use crate::output::Output;
use crate::parts;
use crate::verdict::Verdict;

/// Put partial results of one run of samples together: the same bits as one run, in whatever order
#[derive(Args, Debug)]
pub(crate) struct Merge {
    /// Partial results that `sample --shard` or `sample --partial` wrote
    #[arg(value_name = "FILE", required = true)]
    files: Vec<PathBuf>,
    /// Write a partial result again, to be merged with others
    #[arg(long)]
    partial: bool,
    #[command(flatten)]
    output: Output,
}

impl Merge {
    pub(crate) fn run(&self) -> Result<Verdict, Failure> {
        self.output.check()?;
        let mut all: Option<(&Path, PartialMonteCarlo)> = None;
        for file in &self.files {
            let part = parts::read(file)?;
            match &mut all {
                None => all = Some((file, part)),
                Some((first, all)) => all
                    .merge(part)
                    .map_err(|error| refused(file, first, &error))?,
            }
        }
        let Some((_, all)) = all else {
            return Err(Failure::usage(
                "there is nothing to merge",
                "name partial results",
            ));
        };
        if self.partial {
            self.output.write_text(&parts::text(&all)?)?;
            return Ok(Verdict::Yes);
        }
        let mut answer = self.output.answer();
        answer.add(&all.result())?;
        self.output.write(&answer)?;
        Ok(match all.check_complete() {
            Ok(()) => Verdict::Yes,
            Err(error) => Verdict::No(error.to_string()),
        })
    }
}

/// Which file does not go with those before it.
fn refused(file: &Path, first: &Path, error: &Error) -> Failure {
    let first = first.display();
    let message = match error {
        Error::OtherRun { what, own, other } => {
            format!("it is of another run than `{first}`: {what} is {other} here and {own} there")
        }
        Error::SamplesOverlap { start, end } => {
            format!("its samples {start} to below {end} are in the files before it as well")
        }
        error => error.to_string(),
    };
    Failure::Part {
        path: file.to_owned(),
        message,
    }
}
