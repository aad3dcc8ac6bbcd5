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

pub use eigentol_language::include;
pub use eigentol_language::matrix_market;
#[cfg(feature = "locations")]
pub use eigentol_language::mistakes::{Mistake, Mistakes, tokens};
pub use eigentol_language::{base, model, syntax};
pub use eigentol_symbolic::{algebra, base::census, program};
pub use pipeline::{Compilation, check, compile, compile_refined, early_stages};

use std::fmt::Debug;
#[cfg(feature = "locations")]
use std::path::Path;
use std::path::PathBuf;

use base::diagnostics::Diagnostics;
use eigentol_language::include::Files;
use mechanics::Limits;
use proc_macro2::TokenStream;
use quote::quote;

/// A text that includes the files it names, which may be in this folder.
///
/// # Errors
/// Files that cannot be read, are elsewhere or include themselves.
#[cfg(feature = "locations")]
pub fn with_included(text: &str, file: &Path) -> Result<(String, Vec<PathBuf>), Mistakes> {
    let folder = file.parent().unwrap_or(Path::new(""));
    let mut files = Files::of(folder);
    let text = files.text(text)?;
    Ok((text, files.into_paths()))
}

/// Expands a declaration to Rust items, or to one `compile_error!` per mistake at the offending tokens.
pub fn expand(declaration: TokenStream) -> TokenStream {
    expand_with(declaration, str::parse)
}

/// [`expand`] with a custom lexer for the generated text, which is well-formed and long. Inside a macro, rustc's own
/// lexer is the fastest: `proc_macro2` lexes everything twice there, to reject tokens that would upset rustc.
pub fn expand_with<E: Debug>(declaration: TokenStream, lexer: impl Fn(&str) -> Result<TokenStream, E>) -> TokenStream {
    let folder = std::env::var_os("CARGO_MANIFEST_DIR").map_or_else(PathBuf::new, PathBuf::from);
    let mut files = Files::of(&folder);
    let mut mistakes = Diagnostics::new();
    match files.tokens(declaration, &|text| lexer(text).ok(), &mut Vec::new()) {
        Ok(tokens) => match compile(tokens, Limits::default()) {
            Ok(compilation) => {
                let paths = files.into_paths().into_iter().map(|path| path.display().to_string());
                let items = compilation.emit_with(lexer);
                // rustc builds again when one of them changes.
                return quote! { #items #(const _: &[u8] = ::core::include_bytes!(#paths);)* };
            }
            Err(more) => mistakes.append(more),
        },
        Err(mistake) => mistakes.push(mistake),
    }
    mistakes.into_compile_errors()
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
    compile(tokens(text)?, limits).map_err(|mistakes| Mistakes::of(&mistakes, text))
}

/// [`check`] of a declaration in a text of its own.
///
/// # Errors
/// As [`compile_text`].
#[cfg(feature = "locations")]
pub fn check_text(text: &str, limits: Limits) -> Result<Compilation, Mistakes> {
    check(tokens(text)?, limits).map_err(|mistakes| Mistakes::of(&mistakes, text))
}

/// [`early_stages`] of a declaration in a text of its own.
///
/// # Errors
/// As [`compile_text`].
#[cfg(feature = "locations")]
pub fn early_stages_of_text(text: &str) -> Result<[(&'static str, String); 3], Mistakes> {
    early_stages(tokens(text)?).map_err(|mistakes| Mistakes::of(&mistakes, text))
}

/// The generated items, formatted for reading.
#[cfg(feature = "pretty")]
pub fn expand_pretty(declaration: TokenStream) -> Result<String, Diagnostics> {
    let items = compile(declaration, Limits::default())?.emit();
    let file = syn::parse2(items).expect("the emitter writes well-formed items");
    Ok(prettyplease::unparse(&file))
}
