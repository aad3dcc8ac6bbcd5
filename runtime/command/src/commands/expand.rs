//! Output of the compiler stages for a declaration.

use std::fmt::Write as _;
use std::path::PathBuf;

use clap::{Args, ValueEnum};
use eigentol_compiler::Compilation;
use eigentol_compiler::base::names::written;

use crate::declaration::Declaration;
use crate::destination::Destination;
use crate::failure::Failure;
use crate::verdict::Verdict;

/// Show what the compiler makes of a declaration: Rust, any earlier stage, or the cost of each kernel
#[derive(Args, Debug)]
pub(crate) struct Expand {
    /// File with the declaration, `-` for standard input
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// What to show
    #[arg(long, value_enum, default_value = "rust")]
    stage: Stage,
    #[command(flatten)]
    place: Destination,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Stage {
    /// The declaration without parts, arrays and loops; it may be read again
    Flat,
    /// Names resolved, values in SI
    Mechanism,
    /// What hangs on what
    Topology,
    /// Equations and derivatives
    Functions,
    /// Straight-line kernels
    Program,
    /// The generated Rust
    Rust,
    /// Operations of each kernel
    Operations,
}

impl Expand {
    pub(crate) fn run(&self) -> Result<Verdict, Failure> {
        self.place.check()?;
        let declaration = Declaration::read(&self.file)?;
        let text = match self.stage {
            Stage::Flat => declaration.early_stage("flat")?,
            Stage::Mechanism => declaration.early_stage("mechanism")?,
            Stage::Topology => declaration.early_stage("topology")?,
            Stage::Functions => declaration.checked()?.functions.to_string(),
            Stage::Program => declaration.compiled()?.program.to_string(),
            Stage::Rust => declaration.compiled()?.emit_text(),
            Stage::Operations => operations(&declaration.compiled()?),
        };
        let mut text = written(&text).into_owned();
        if !text.ends_with('\n') {
            text.push('\n');
        }
        self.place.write(&text)?;
        Ok(Verdict::Yes)
    }
}

/// A line for each kernel: arithmetic operations, and functions such as sines.
fn operations(compilation: &Compilation) -> String {
    let mut text = format!("{:<24} {:>10} {:>10}\n", "kernel", "operations", "functions");
    for kernel in &compilation.program.kernels {
        let cost = &kernel.cost;
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{:<24} {:>10} {:>10}", kernel.name, cost.operations, cost.functions);
    }
    text
}
