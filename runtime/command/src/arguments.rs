//! The command line.

use std::io::{self, IsTerminal as _, Write as _};
use std::process::ExitCode;

use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{CommandFactory as _, Parser, Subcommand};
use eigentol::Error;

use crate::color::Color;
use crate::commands::{
    allocate, branches, campbell, check, completions, converge, equilibria, expand, grade, import, map, merge,
    mistuning, modes, new, probability, report, response, sample, schema, sensitivities, serve, sweep, tolerance,
};
use crate::diagnostics;
use crate::failure::Failure;
use crate::interrupt;
use crate::progress;
use crate::verdict::Verdict;

/// Natural frequencies of mechanisms in steady motion, and how tolerances move them.
///
/// Exit codes: 0, 1 if the analysis says no (no equilibrium, unstable, requirements that cannot be met), 2 for a
/// mistake on the command line, 3 for a file with a mistake or one that cannot be read or written, 130 after Ctrl-C or
/// SIGTERM.
#[derive(Debug, Parser)]
#[command(name = "eigentol", version, subcommand_required = true)]
pub(crate) struct Arguments {
    /// Whether messages are coloured; `auto` does it on a terminal
    #[arg(long, global = true, value_enum, default_value = "auto", value_name = "WHEN")]
    color: Color,
    #[command(subcommand)]
    command: Command,
}

/// Adds to a command-line error the option for which a value was probably meant.
pub(crate) fn with_hint(mut error: clap::Error) -> clap::Error {
    let given = match error.get(ContextKind::InvalidArg) {
        Some(ContextValue::String(given)) if error.kind() == ErrorKind::UnknownArgument => given,
        _ => return error,
    };
    let is_near = error.get(ContextKind::SuggestedArg).is_some();
    let hint = match given.split_once('=') {
        Some((name, value)) if !name.starts_with('-') => {
            let option = if value.contains("..") {
                "--sweep"
            } else if value.contains('%') || value.starts_with('+') {
                "--tol"
            } else {
                "--set"
            };
            format!("put the value after its option: '{option} {given}'")
        }
        None if given.starts_with(|sign: char| sign.is_ascii_digit()) => {
            format!("a name and its value are one word: '--set NAME={given}'")
        }
        _ if is_near || !given.starts_with("--") => return error,
        _ => "give the values of inputs and design variables as '--set NAME=VALUE'".to_owned(),
    };
    let hint = ContextValue::StyledStrs(vec![hint.into()]);
    error.insert(ContextKind::Suggested, hint);
    error
}

/// Prints a command-line error, or the requested help.
pub(crate) fn explain(error: &clap::Error) {
    let terminal = if error.use_stderr() { io::stderr().is_terminal() } else { io::stdout().is_terminal() };
    let text = if Color::asked().on(terminal) { error.render().ansi().to_string() } else { error.render().to_string() };
    // If the output is closed, there is nothing more to say.
    let _ = if error.use_stderr() {
        io::stderr().write_all(text.as_bytes())
    } else {
        io::stdout().write_all(text.as_bytes())
    };
}

#[derive(Debug, Subcommand)]
enum Command {
    Check(check::Check),
    Modes(modes::Modes),
    Converge(converge::Converge),
    Equilibria(equilibria::Equilibria),
    Sensitivities(sensitivities::Sensitivities),
    Tolerance(tolerance::Tolerance),
    Probability(probability::Probability),
    Response(response::Response),
    Grade(grade::Grade),
    Mistuning(mistuning::Mistuning),
    Campbell(campbell::Campbell),
    Map(map::Map),
    Sweep(sweep::Follow),
    Branches(branches::Branches),
    Sample(sample::Sample),
    Merge(merge::Merge),
    Allocate(allocate::Allocate),
    Report(report::Report),
    Serve(serve::Serve),
    Expand(expand::Expand),
    New(new::New),
    Import(import::Import),
    Schema(schema::Schema),
    Completions(completions::Completions),
    #[cfg(feature = "man")]
    Man(crate::commands::man::Man),
}

impl Arguments {
    /// Runs the command; messages go to standard error.
    pub(crate) fn run(self) -> ExitCode {
        let color = self.color;
        let run = || progress::clocked(|| self.command.run(color));
        let code = match interrupt::watch().and_then(|()| run()) {
            Ok(Verdict::Yes) => 0,
            Ok(Verdict::No(reason)) => {
                diagnostics::say_no("no", &reason, color);
                1
            }
            Ok(Verdict::Stopped(reason)) => {
                diagnostics::say_no("stopped", &reason, color);
                interrupt::INTERRUPTED
            }
            Err(Failure::Analysis(Error::Stopped)) => {
                diagnostics::say_no("stopped", "before there was an answer", color);
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
    fn run(self, color: Color) -> Result<Verdict, Failure> {
        match self {
            Self::Check(check) => check.run(color),
            Self::Modes(modes) => modes.run(),
            Self::Converge(converge) => converge.run(),
            Self::Equilibria(equilibria) => equilibria.run(),
            Self::Sensitivities(sensitivities) => sensitivities.run(),
            Self::Tolerance(tolerance) => tolerance.run(),
            Self::Probability(probability) => probability.run(),
            Self::Response(response) => response.run(),
            Self::Grade(grade) => grade.run(),
            Self::Mistuning(mistuning) => mistuning.run(),
            Self::Campbell(campbell) => campbell.run(),
            Self::Map(map) => map.run(),
            Self::Sweep(sweep) => sweep.run(),
            Self::Branches(branches) => branches.run(),
            Self::Sample(sample) => sample.run(),
            Self::Merge(merge) => merge.run(),
            Self::Allocate(allocate) => allocate.run(),
            Self::Report(report) => report.run(),
            Self::Serve(serve) => serve.run(),
            Self::Expand(expand) => expand.run(),
            Self::New(new) => new.run(),
            Self::Import(import) => import.run(),
            Self::Schema(schema) => schema.run(),
            Self::Completions(completions) => completions.run(Arguments::command()),
            #[cfg(feature = "man")]
            Self::Man(man) => man.run(Arguments::command()),
        }
    }
}
