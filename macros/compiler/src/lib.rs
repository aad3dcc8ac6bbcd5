//! The compiler behind `mechanism!`: a declaration in, specialised Rust out.

pub mod base;
pub mod model;
pub mod syntax;
pub mod topology;

use proc_macro2::TokenStream;

/// Expands a declaration to Rust items, or to `compile_error!`s.
pub fn expand(_declaration: TokenStream) -> TokenStream {
    TokenStream::new()
}
