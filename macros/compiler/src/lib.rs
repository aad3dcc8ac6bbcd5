//! The compiler behind `mechanism!`: it turns a declaration into specialised Rust code.
//!
//! Seven types are connected by six arrows. Each arrow is a folder, the first two of `eigentol-language`, `lower` of
//! `eigentol-symbolic`, and data flows only forwards:
//!
//! ```text
//! TokenStream -> Ast -> Mechanism -> Topology -> Functions -> Program -> TokenStream
//!          parse   resolve     cut loops    derive      lower     emit
//! ```
//!
//! [`expand`] is the macro. Build scripts, snapshot tests and tools can also use `expand_pretty` (with the
//! feature `pretty`), [`program()`] to evaluate kernels without compiling them, and [`compile`] to inspect every stage.
//!
//! Architecture invariant: nothing in this crate depends on the runtime.

pub mod emit;
pub mod mechanics;
mod pipeline;
#[cfg(test)]
mod tests;
pub mod topology;

#[cfg(feature = "locations")]
pub use eigentol_language::mistakes::{Mistake, Mistakes, tokens};
pub use eigentol_language::{base, model, syntax};
pub use eigentol_symbolic::{algebra, base::census, program};
pub use pipeline::{Compilation, check, compile, compile_refined, early_stages};

use std::fmt::Debug;

use base::diagnostics::Diagnostics;
use mechanics::Limits;
use proc_macro2::TokenStream;

/// Expands a declaration to Rust items, or to one `compile_error!` per mistake at the offending tokens.
pub fn expand(declaration: TokenStream) -> TokenStream {
    expand_with(declaration, str::parse)
}

/// [`expand`] with a custom lexer for the generated text, which is well-formed and long. Inside a macro, rustc's own
/// lexer is the fastest: `proc_macro2` lexes everything twice there, to reject tokens that would upset rustc.
pub fn expand_with<E: Debug>(declaration: TokenStream, lexer: impl Fn(&str) -> Result<TokenStream, E>) -> TokenStream {
    match compile(declaration, Limits::default()) {
        Ok(compilation) => compilation.emit_with(lexer),
        Err(mistakes) => mistakes.into_compile_errors(),
    }
}

/// The kernels of a declaration, ready to be evaluated without a Rust compiler.
pub fn program(declaration: TokenStream) -> Result<program::Program, Diagnostics> {
    compile(declaration, Limits::default()).map(|compilation| compilation.program)
}

/// Compiles a declaration given as text and returns every stage; mistakes carry line and column.
///
/// # Errors
/// Every mistake that could be found.
#[cfg(feature = "locations")]
pub fn compile_text(text: &str, limits: Limits) -> Result<Compilation, Mistakes> {
    Ok(compile(tokens(text)?, limits)?)
}

/// [`check`] of a declaration in a text of its own.
///
/// # Errors
/// As [`compile_text`].
#[cfg(feature = "locations")]
pub fn check_text(text: &str, limits: Limits) -> Result<Compilation, Mistakes> {
    Ok(check(tokens(text)?, limits)?)
}

/// [`early_stages`] of a declaration in a text of its own.
///
/// # Errors
/// As [`compile_text`].
#[cfg(feature = "locations")]
pub fn early_stages_of_text(text: &str) -> Result<[(&'static str, String); 3], Mistakes> {
    Ok(early_stages(tokens(text)?)?)
}

/// The generated items, formatted for reading.
#[cfg(feature = "pretty")]
pub fn expand_pretty(declaration: TokenStream) -> Result<String, Diagnostics> {
    let items = compile(declaration, Limits::default())?.emit();
    let file = syn::parse2(items).expect("the emitter writes well-formed items");
    Ok(prettyplease::unparse(&file))
}
