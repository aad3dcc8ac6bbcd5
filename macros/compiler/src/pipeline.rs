//! The compilation pipeline: every stage in order.

use std::fmt::Debug;

use proc_macro2::TokenStream;

use crate::algebra::{Function, regrouped};
use crate::base::diagnostics::Diagnostics;
use crate::base::names::written;
use crate::emit::{emit, lines};
use crate::mechanics::{Functions, KernelName, Limits, derive};
use crate::model::mechanism::Mechanism;
use crate::model::resolve::resolve_what_is_right;
use crate::program::{Program, lower};
use crate::syntax::ast::Ast;
use crate::syntax::parse::parse_what_can_be_read;
use crate::syntax::print::print;
use crate::topology::Topology;
use crate::topology::build::build;

/// A declaration at every stage of its compilation.
#[derive(Clone, Debug)]
pub struct Compilation {
    /// The declaration as written.
    pub ast: Ast,
    /// Names resolved, values in SI, every rule checked.
    pub mechanism: Mechanism,
    /// The spanning forest.
    pub topology: Topology,
    /// The equations and everything derived from them.
    pub functions: Functions,
    /// Straight-line kernels.
    pub program: Program,
}

/// Runs every stage up to the program. Mistakes in syntax, in names and values, and in the connections between bodies
/// are reported together; the equations are derived only if there are none.
pub fn compile(declaration: TokenStream, limits: Limits) -> Result<Compilation, Diagnostics> {
    compile_refined(declaration, limits, 0)
}

/// [`compile`] with this many `more` coordinates of every component of a beam than declared; one that has none stays
/// rigid.
pub fn compile_refined(declaration: TokenStream, limits: Limits, more: usize) -> Result<Compilation, Diagnostics> {
    let mut compilation = derived(declaration, limits, more)?;
    let functions = &mut compilation.functions;
    let kernels = regrouped_kernels(functions);
    compilation.program = lower(&functions.graph, &kernels);
    Ok(compilation)
}

/// [`compile`] up to the equations, with which the search for mistakes ends: the program has no kernels.
pub fn check(declaration: TokenStream, limits: Limits) -> Result<Compilation, Diagnostics> {
    derived(declaration, limits, 0)
}

fn derived(declaration: TokenStream, limits: Limits, more: usize) -> Result<Compilation, Diagnostics> {
    let (ast, mut mechanism, mut topology) = accepted(declaration, more)?;
    let functions = derive(&mut mechanism, &mut topology, limits).map_err(|mistakes| explained(&ast, mistakes))?;
    Ok(Compilation { ast, mechanism, topology, functions, program: Program::default() })
}

/// The stages that look for mistakes. Each continues with whatever the previous stage could make sense of.
fn accepted(declaration: TokenStream, more: usize) -> Result<(Ast, Mechanism, Topology), Diagnostics> {
    let mut mistakes = Diagnostics::new();
    let Some(ast) = parse_what_can_be_read(declaration, &mut mistakes) else {
        return Err(mistakes);
    };
    let resolution = resolve_what_is_right(&ast, more);
    mistakes.append(resolution.mistakes);
    if !resolution.is_connected {
        return Err(explained(&ast, mistakes));
    }
    let mut mechanism = resolution.mechanism;
    match build(&mechanism) {
        Ok(topology) => {
            mechanism.forget_forces_of(&topology.cut);
            mistakes.into_result(()).map_err(|mistakes| explained(&ast, mistakes))?;
            Ok((ast, mechanism, topology))
        }
        Err(more) => {
            mistakes.append(more);
            Err(explained(&ast, mistakes))
        }
    }
}

fn explained(ast: &Ast, mut mistakes: Diagnostics) -> Diagnostics {
    ast.uses.explain(&mut mistakes);
    mistakes
}

/// The stages before the equations as text, by name and in order. For snapshots and for tracing a surprising result, as the
/// texts of [`Functions`] and [`Program`].
pub fn early_stages(declaration: TokenStream) -> Result<[(&'static str, String); 3], Diagnostics> {
    let (ast, mechanism, topology) = accepted(declaration, 0)?;
    let topology = topology.describe(&mechanism);
    Ok([
        ("flat", print(&ast)),
        ("mechanism", written(&format!("{mechanism:#?}")).into_owned()),
        ("topology", written(&topology).into_owned()),
    ])
}

/// Kernels whose residuals a solver compares with each other, so all of them must return exactly the same number.
const OF_ONE_RESIDUAL: [KernelName; 3] =
    [KernelName::Residual, KernelName::ResidualParts, KernelName::ResidualAndStiffness];

/// The kernels, regrouped where that saves operations.
fn regrouped_kernels(functions: &mut Functions) -> Vec<Function> {
    let (alike, others): (Vec<Function>, Vec<Function>) = functions
        .functions
        .iter()
        .cloned()
        .partition(|function| KernelName::named(function.name).is_some_and(|name| OF_ONE_RESIDUAL.contains(&name)));
    let mut kernels = regrouped(&mut functions.graph, &alike);
    for function in others {
        kernels.extend(regrouped(&mut functions.graph, &[function]));
    }
    let position = |name: &str| functions.functions.iter().position(|f| f.name == name);
    kernels.sort_by_key(|kernel| position(kernel.name));
    kernels
}

impl Compilation {
    /// The generated items.
    pub fn emit(&self) -> TokenStream {
        self.emit_with(str::parse)
    }

    /// The generated items as lines of text. Write these to a file, not [`emit`](Self::emit) on one line, on which rustc
    /// takes minutes for a robot.
    pub fn emit_text(&self) -> String {
        lines(self.emit())
    }

    /// The generated items, tokenised by a custom lexer.
    pub fn emit_with<E: Debug>(&self, lexer: impl Fn(&str) -> Result<TokenStream, E>) -> TokenStream {
        emit(&self.mechanism, &self.functions, &self.program, lexer)
    }
}
