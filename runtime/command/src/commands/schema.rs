//! The schema of JSON documents.

use clap::Args;
use eigentol_tables::json::SCHEMA;

use crate::destination::print;
use crate::failure::Failure;
use crate::verdict::Verdict;

/// Print the JSON schema of all documents that `--json` writes
#[derive(Args, Debug)]
pub(crate) struct Schema {}

impl Schema {
    pub(crate) fn run(&self) -> Result<Verdict, Failure> {
        print(SCHEMA)?;
        Ok(Verdict::Yes)
    }
}
