//! The `mechanism!` macro: tokens in, tokens or errors out. The work is done by `eigentol-compiler`.

use proc_macro::TokenStream;

/// Declares a mechanism.
#[proc_macro]
pub fn mechanism(declaration: TokenStream) -> TokenStream {
    eigentol_compiler::expand(declaration.into()).into()
}
