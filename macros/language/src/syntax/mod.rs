//! The declaration as written: its tree, its parser and its printer. No code here knows what a name means.

pub mod ast;
pub(crate) mod nesting;
pub mod parse;
pub mod print;
mod scope;
mod tokens;
mod uses;
