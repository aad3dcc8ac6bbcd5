#![doc = include_str!("../README.md")]
#![allow(clippy::needless_doctest_main, reason = "a build script is a program")]

#[cfg(feature = "c")]
mod c;
mod error;
mod script;
mod source;

pub use eigentol_compiler::{Mistake, Mistakes};
pub use error::Error;
pub use script::{compile, try_compile};
#[cfg(feature = "c")]
pub use script::{compile_for_c, try_compile_for_c};
