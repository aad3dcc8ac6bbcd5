//! The page of the manual.

use clap::{Args, Command};
use clap_mangen::Man as Page;

use crate::destination::print;
use crate::failure::Failure;
use crate::verdict::Verdict;

/// Print the page of the manual, of the command or of one of its subcommands: `eigentol man > eigentol.1`
#[derive(Args, Debug)]
pub(crate) struct Man {
    /// Subcommand [default: the command itself]
    subcommand: Option<String>,
}

impl Man {
    pub(crate) fn run(&self, mut command: Command) -> Result<Verdict, Failure> {
        command.build();
        let page = match &self.subcommand {
            None => Page::new(command),
            Some(name) => {
                let named = command.find_subcommand(name).cloned();
                let unknown =
                    || Failure::usage(format!("there is no subcommand `{name}`"), "`eigentol --help` lists them");
                Page::new(named.ok_or_else(unknown)?)
            }
        };
        let mut text = Vec::new();
        page.render(&mut text).map_err(Failure::Print)?;
        print(&String::from_utf8_lossy(&text))?;
        Ok(Verdict::Yes)
    }
}
