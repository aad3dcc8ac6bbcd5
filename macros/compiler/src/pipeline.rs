//! The recipe: every stage in order.

use std::fmt::Debug;

use proc_macro2::TokenStream;

use crate::algebra::Function;
use crate::base::diagnostics::Diagnostics;
use crate::emit::emit;
use crate::mechanics::{Functions, Limits, derive};
use crate::model::mechanism::Mechanism;
use crate::model::resolve::resolve;
use crate::program::{Program, lower};
use crate::syntax::ast::Ast;
use crate::syntax::parse::parse;
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
    /// The equations and what is derived from them.
    pub functions: Functions,
    /// Straight-line kernels.
    pub program: Program,
}

/// Runs every stage up to the program. The mistakes of one stage are reported together; a later stage runs only on
/// what the earlier ones accepted.
pub fn compile(declaration: TokenStream, limits: Limits) -> Result<Compilation, Diagnostics> {
    let ast = parse(declaration)?;
    let mechanism = resolve(&ast)?;
    let topology = build(&mechanism)?;
    let mut functions = derive(&mechanism, &topology, limits)?;
    let regrouped: Vec<Function> = functions
        .functions
        .iter()
        .map(|function| function.regrouped(&mut functions.graph))
        .collect();
    let program = lower(&functions.graph, &regrouped);
    Ok(Compilation {
        ast,
        mechanism,
        topology,
        functions,
        program,
    })
}

impl Compilation {
    /// Every stage as text, by name, in order: for snapshots, and for looking into a surprising result.
    pub fn dumps(&self) -> [(&'static str, String); 5] {
        [
            ("ast", print(&self.ast)),
            ("mechanism", self.mechanism.to_string()),
            ("topology", self.topology.describe(&self.mechanism)),
            ("functions", self.functions.to_string()),
            ("program", self.program.to_string()),
        ]
    }

    /// The generated items.
    pub fn emit(&self) -> TokenStream {
        self.emit_with(str::parse)
    }

    /// The generated items, their text taken apart by another lexer.
    pub fn emit_with<E: Debug>(
        &self,
        lexer: impl Fn(&str) -> Result<TokenStream, E>,
    ) -> TokenStream {
        emit(&self.mechanism, &self.functions, &self.program, lexer)
    }
}
