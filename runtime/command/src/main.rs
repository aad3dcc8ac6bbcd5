//! The command `eigentol`: reads a declaration from a file, runs an analysis of the library and prints the answer.

mod advice;
mod answer;
mod arguments;
mod color;
mod commands;
mod declaration;
mod destination;
mod diagnostics;
mod failure;
mod interrupt;
mod mistake;
mod nearby;
mod output;
mod parts;
mod picture;
mod point;
mod progress;
mod requirements;
mod rotor;
mod rows;
mod study_file;
mod superelement;
mod sweep;
mod verdict;

use std::process::ExitCode;

use clap::Parser as _;

use self::arguments::Arguments;

fn main() -> ExitCode {
    match Arguments::try_parse() {
        Ok(arguments) => arguments.run(),
        Err(error) => {
            let error = arguments::with_hint(error);
            arguments::explain(&error);
            ExitCode::from(u8::try_from(error.exit_code()).unwrap_or(2))
        }
    }
}
