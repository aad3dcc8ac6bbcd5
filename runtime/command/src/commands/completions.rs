//! Shell completions.

use clap::{Args, CommandFactory as _};
use clap_complete::{Shell, generate};

use crate::arguments::Arguments;
use crate::failure::Failure;
use crate::place::print;
use crate::verdict::Verdict;

/// Print the completion script of a shell: `eigentol completions bash > /etc/bash_completion.d/eigentol`
#[derive(Args, Debug)]
pub(crate) struct Completions {
    shell: Shell,
}

impl Completions {
    pub(crate) fn run(&self) -> Result<Verdict, Failure> {
        let mut script = Vec::new();
        generate(
            self.shell,
            &mut Arguments::command(),
            "eigentol",
            &mut script,
        );
        print(&String::from_utf8_lossy(&script))?;
        Ok(Verdict::Yes)
    }
}
