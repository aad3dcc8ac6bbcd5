//! The frame around an example's `run`: arguments in, exit code out.

use std::ffi::OsString;
use std::io::{self, Write};
use std::process::ExitCode;

use crate::Failure;

/// The signature of an example: arguments (the program's name first) and where to print.
pub type Run = fn(Vec<OsString>, &mut dyn Write) -> Result<(), Failure>;

/// Runs an example as a program: messages go to standard error; a closed pipe is not an error.
pub fn program(run: Run) -> ExitCode {
    let mut out = io::BufWriter::new(io::stdout());
    let outcome = run(std::env::args_os().collect(), &mut out)
        .and_then(|()| out.flush().map_err(Failure::Print));
    let Err(failure) = outcome else {
        return ExitCode::SUCCESS;
    };
    // If even the message cannot be written, only the exit code remains.
    let _ = match &failure {
        Failure::CommandLine(error) => error.print(),
        Failure::Print(_) if failure.exit_code() == 0 => Ok(()),
        _ => writeln!(io::stderr(), "error: {failure}"),
    };
    ExitCode::from(failure.exit_code())
}
