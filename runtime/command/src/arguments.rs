//! The command line.

use std::process::ExitCode;

use clap::{Parser, Subcommand, ValueEnum};

use crate::commands::{
    allocate, branches, campbell, check, completions, expand, import, merge, modes, new, sample,
    sensitivities, tolerance,
};
use crate::diagnostics;
use crate::failure::Failure;
use crate::interrupt;
use crate::verdict::Verdict;

/// Natural frequencies of mechanisms in steady motion, and how tolerances move them.
///
/// Exit codes: 0, 1 where the analysis says no (no equilibrium, unstable, requirements that cannot be met), 2 for a mistake on the
/// command line, 3 for a file with a mistake or one that cannot be read or written, 130 after Ctrl-C.
#[derive(Debug, Parser)]
#[command(name = "eigentol", version, subcommand_required = true)]
pub(crate) struct Arguments {
    /// Whether messages are coloured; `auto` does it on a terminal
    #[arg(
        long,
        global = true,
        value_enum,
        default_value = "auto",
        value_name = "WHEN"
    )]
    color: Color,
    #[command(subcommand)]
    command: Command,
}

/// Whether messages are coloured.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Color {
    Auto,
    Always,
    Never,
}

#[derive(Debug, Subcommand)]
enum Command {
    Check(check::Check),
    Modes(modes::Modes),
    Sensitivities(sensitivities::Sensitivities),
    Tolerance(tolerance::Tolerance),
    Campbell(campbell::Campbell),
    Branches(branches::Branches),
    Sample(sample::Sample),
    Merge(merge::Merge),
    Allocate(allocate::Allocate),
    Expand(expand::Expand),
    New(new::New),
    Import(import::Import),
    Completions(completions::Completions),
}

impl Arguments {
    /// Does what was asked for; messages go to standard error.
    pub(crate) fn run(self) -> ExitCode {
        let color = self.color;
        let code = match interrupt::watch().and_then(|()| self.command.run()) {
            Ok(Verdict::Yes) => 0,
            Ok(Verdict::No(reason)) => {
                diagnostics::say_no("no", &reason, color);
                1
            }
            Ok(Verdict::Stopped(reason)) => {
                diagnostics::say_no("stopped", &reason, color);
                interrupt::INTERRUPTED
            }
            Err(Failure::NobodyReads) => 0,
            Err(failure) => {
                diagnostics::say(&failure, color);
                failure.exit_code()
            }
        };
        ExitCode::from(code)
    }
}

impl Command {
    fn run(self) -> Result<Verdict, Failure> {
        match self {
            Self::Check(own) => own.run(),
            Self::Modes(own) => own.run(),
            Self::Sensitivities(own) => own.run(),
            Self::Tolerance(own) => own.run(),
            Self::Campbell(own) => own.run(),
            Self::Branches(own) => own.run(),
            Self::Sample(own) => own.run(),
            Self::Merge(own) => own.run(),
            Self::Allocate(own) => own.run(),
            Self::Expand(own) => own.run(),
            Self::New(own) => own.run(),
            Self::Import(own) => own.run(),
            Self::Completions(own) => own.run(),
        }
    }
}
