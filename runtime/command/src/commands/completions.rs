//! Shell completions.

use clap::{Args, Command};
use clap_complete::{Shell, generate};

use crate::destination::print;
use crate::failure::Failure;
use crate::verdict::Verdict;

/// Print the completion script of a shell: `eigentol completions bash > /etc/bash_completion.d/eigentol`
#[derive(Args, Debug)]
pub(crate) struct Completions {
    shell: Shell,
}

impl Completions {
    pub(crate) fn run(&self, mut command: Command) -> Result<Verdict, Failure> {
        let mut script = Vec::new();
        generate(self.shell, &mut command, "eigentol", &mut script);
        print(&String::from_utf8_lossy(&script))?;
        Ok(Verdict::Yes)
    }
}
