//! The [`mechanism!`] macro: tokens in, tokens or errors out. The work is done by `eigentol-compiler`, an ordinary
//! library that build scripts and tests can call too.

use proc_macro::TokenStream;

#[doc = include_str!("../REFERENCE.md")]
#[proc_macro]
pub fn mechanism(declaration: TokenStream) -> TokenStream {
    let lexer = |text: &str| text.parse().map(TokenStream::into);
    eigentol_compiler::expand_with(declaration.into(), lexer).into()
}
