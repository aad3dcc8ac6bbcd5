//! Times the macro's stages in this process: optimised, and without rustc's lexer, which reads the generated text
//! afterwards.

use std::cell::Cell;
use std::convert::Infallible;
use std::error::Error;
use std::hint::black_box;

use cpu_time::ProcessTime;
use eigentol_compiler::compile;
use eigentol_compiler::mechanics::{Limits, derive};
use eigentol_compiler::model::resolve::resolve;
use eigentol_compiler::syntax::parse::parse;
use eigentol_compiler::topology::build::build;
use proc_macro2::TokenStream;

use crate::clock::milliseconds;
use crate::machines::Machine;

/// The timed stages: reading the declaration; equations and their derivatives; everything up to the program, including
/// the first two; and writing the program.
pub(crate) const STAGES: [&str; 4] = ["read", "derive", "compile", "emit"];

const REPETITIONS: usize = 5;

/// The cost of expanding one declaration.
pub(crate) struct Expansion {
    pub(crate) name: String,
    /// Total number of operations in all kernels.
    pub(crate) instructions: usize,
    /// Size of the generated text.
    pub(crate) bytes: usize,
    /// Milliseconds of each stage, the minimum of several repetitions.
    pub(crate) stages: [f64; STAGES.len()],
}

impl Expansion {
    /// Milliseconds of the whole expansion.
    pub(crate) fn milliseconds(&self) -> f64 {
        let [_, _, compile, emit] = self.stages;
        compile + emit
    }
}

/// Expands every declaration.
///
/// # Errors
/// When a declaration is rejected.
pub(crate) fn measure(machines: &[Machine]) -> Result<Vec<Expansion>, Box<dyn Error>> {
    machines.iter().map(expansion).collect()
}

fn expansion(machine: &Machine) -> Result<Expansion, Box<dyn Error>> {
    let mut least =
        Expansion { name: machine.name.clone(), instructions: 0, bytes: 0, stages: [f64::INFINITY; STAGES.len()] };
    for _ in 0..REPETITIONS {
        let once = once(&machine.text).map_err(|mistakes| format!("{}: {mistakes}", least.name))?;
        least.instructions = once.0;
        least.bytes = once.1;
        for (least, stage) in least.stages.iter_mut().zip(once.2) {
            *least = least.min(stage);
        }
    }
    Ok(least)
}

fn once(declaration: &str) -> Result<(usize, usize, [f64; STAGES.len()]), Box<dyn Error>> {
    let tokens: TokenStream = declaration.parse().map_err(|error| format!("{error}"))?;
    let refused = |mistakes| format!("{mistakes}");

    let start = ProcessTime::now();
    let ast = parse(tokens.clone()).map_err(refused)?;
    let mut mechanism = resolve(&ast).map_err(refused)?;
    let mut topology = build(&mechanism).map_err(refused)?;
    let read = start.elapsed();

    let start = ProcessTime::now();
    black_box(derive(&mut mechanism, &mut topology, Limits::default()).map_err(refused)?);
    let derived = start.elapsed();

    let start = ProcessTime::now();
    let compilation = compile(tokens, Limits::default()).map_err(refused)?;
    let compiled = start.elapsed();

    let bytes = Cell::new(0);
    let start = ProcessTime::now();
    let items = compilation.emit_with(|text| {
        bytes.set(text.len());
        Ok::<_, Infallible>(TokenStream::new())
    });
    let emitted = start.elapsed();

    black_box(items);
    let kernels = &compilation.program.kernels;
    let instructions = kernels.iter().map(|kernel| kernel.instructions.len()).sum();
    let stages = [read, derived, compiled, emitted].map(milliseconds);
    Ok((instructions, bytes.get(), stages))
}
