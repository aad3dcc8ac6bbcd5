//! Kernels as functions that C can call.
//!
//! ```text
//! int32_t rotor_residual(const double *q, const double *u, const double *b, double *residual);
//! ```
//!
//! They read their arguments by value before they write a result. No reference to C memory ever exists, so arrays may
//! overlap; the caller is only responsible for the lengths. All of the unsafe code is in the text that is generated
//! here, in a module of the user's crate.
//!
//! # C gets copies
//!
//! The functions of `macros/build/src/c` read arguments by value before they compute and write after it, so no
//! reference to C memory ever exists: arrays may overlap, and the caller answers only for their lengths. A null pointer
//! returns the argument's position. The functions are made from a table of the contract, not from the emitter's text. A
//! static library without the standard library needs link-time optimisation: core itself is compiled to unwind, and its
//! unused parts would ask for the unwinder. It must not share features with packages that use the standard library, so
//! `examples/c` is outside the workspace.

mod constants;
mod function;
mod header;
mod kernels;
mod special;

use eigentol_compiler::Compilation;
use heck::{ToShoutySnakeCase as _, ToSnakeCase as _};
use proc_macro2::Ident;

/// Functions that read and write C arrays.
const HELPERS: &str = include_str!("helpers.rs");

/// The functions of a mechanism.
pub(crate) struct Interface {
    /// Constants and functions.
    pub(crate) items: String,
    names: Names,
    conditions: String,
}

/// The name of a mechanism in several forms.
pub(crate) struct Names {
    /// In Rust.
    rust: String,
    /// Prefix of each function's name.
    prefix: String,
    /// Prefix of each constant's name.
    shouted: String,
}

impl Interface {
    /// Creates the functions; `None` if C cannot spell the name of the mechanism.
    pub(crate) fn of(compilation: &Compilation) -> Option<Self> {
        let mechanism = &compilation.mechanism;
        let names = Names::of(&mechanism.name)?;
        let sizes = function::Sizes::of(compilation);
        let mut items = constants::constants(compilation, &names);
        for kernel in kernels::kernels(compilation) {
            items += &kernel.text(&names, sizes);
        }
        items += &special::functions(compilation, &names);
        let conditions = mechanism.attributes.iter();
        let conditions = conditions.filter(|attribute| attribute.path().is_ident("cfg"));
        Some(Self { items, conditions: conditions.map(|c| quote::quote!(#c).to_string() + "\n").collect(), names })
    }

    /// The functions as a module of the crate that includes the generated code.
    pub(crate) fn module(&self) -> String {
        let Self { items, conditions, .. } = self;
        let Names { rust, prefix, .. } = &self.names;
        format!(
            "/// Kernels of `{rust}` for C.\n{conditions}\
            #[allow(unsafe_code, dead_code, non_upper_case_globals, clippy::all, clippy::pedantic)]\n\
            pub mod {prefix}_c {{\n{items}\n{HELPERS}}}\n"
        )
    }
}

impl Names {
    fn of(name: &Ident) -> Option<Self> {
        let rust = name.to_string();
        let prefix = rust.to_snake_case();
        let spelt = prefix.is_ascii() && prefix.starts_with(|c: char| c.is_ascii_alphabetic());
        spelt.then(|| Self { prefix, shouted: rust.to_shouty_snake_case(), rust })
    }
}
