//! From a program to Rust items that people can read.
//!
//! ```text
//! pub struct Pendulum;
//! impl Pendulum { pub const theta: Coordinate<Self> = Coordinate::new(0); .. }
//! const _: () = {
//! fn Pendulum() {} // so that a variable may have this name
//! impl Mechanism for Pendulum {
//!     type Coordinates<T: Copy> = [T; 1];
//!     ..
//!     const DESCRIPTION: Description = ..;
//!     fn residual<T: Real>(&self, q_: &[T; 1], u_: &[T; 1], b_: &[T; 2]) -> [T; 1] {
//!         let l_ = b_[0];
//!         let theta_ = q_[0];
//!         let (sin_theta_, cos_theta_) = theta_.sin_cos();
//!         ..
//!     }
//! }
//! ```
//!
//! Method bodies are written as text and lexed once: building them token by token would cost more than the algebra.
//!
//! # Shape of the emitted code
//!
//! With debug information, rustc crashes on one block with thousands of plain `let`s. Bodies of up to 256 statements
//! are plain `let`s; longer ones declare the names of a block at once, `let (a, b, ..,);`, and then assign them. Bodies
//! are written as text and parsed once. Local variables end in an underscore, because rustc takes one spelt like a
//! constant or unit struct of the user's module for that item. The mechanism itself is such a struct; a function of its
//! name hides it where the trait is implemented. Files get a line for each statement (`emit/lines.rs`): on one line
//! rustc takes the square of its length, for a robot of 29 joints minutes. With that, its time is proportional to the
//! operations, and longer kernels need not be cut.

mod body;
mod contract;
mod curves;
mod description;
mod expression;
mod form;
mod handles;
mod held_values;
mod lines;
mod names;
mod picture;
mod pose_margin;
mod results;
mod signature;
mod sines;
mod tolerance;
mod violation;

pub(crate) use lines::lines;

use std::fmt::{Debug, Write};

use proc_macro2::TokenStream;
use quote::quote;

use crate::base::names::written;
use crate::mechanics::{Functions, KernelName};
use crate::model::mechanism::Mechanism;
use crate::program::Program;

/// Generates the type, its handles and its implementation of the runtime's contract.
pub fn emit<E: Debug>(
    mechanism: &Mechanism,
    functions: &Functions,
    program: &Program,
    lexer: impl Fn(&str) -> Result<TokenStream, E>,
) -> TokenStream {
    let mut methods = String::new();
    for kernel in &program.kernels {
        let name = KernelName::named(kernel.name).expect("mechanics names the kernels");
        let method = match form::form(name) {
            Some(form) => contract::method(kernel, form),
            None if name == KernelName::Violation => violation::method(kernel, &functions.requirements),
            None if matches!(name, KernelName::HeldValues | KernelName::Spans) => held_values::method(kernel),
            None => pose_margin::method(kernel, &functions.poses),
        };
        let _ = writeln!(methods, "{method}");
    }
    let methods = lexer(&written(&methods)).expect("the emitter writes well-formed tokens");
    let curves = lexer(&curves::constants(program)).expect("the emitter writes well-formed tokens");

    let Mechanism { name, visibility, attributes, .. } = mechanism;
    let [handles, grouped] = handles::handles(mechanism, functions);
    let description = description::description(mechanism, functions, program);
    let warnings = description::warnings(mechanism);
    let picture = picture::info(&functions.picture);
    let pictured = functions.picture.computed.len();
    let (coordinates, inputs) = (functions.unknowns.len(), mechanism.inputs.len());
    let (design, outputs) = (mechanism.design.len(), mechanism.outputs.len());
    let excitations = mechanism.excitations.len();
    let conditions: Vec<_> = attributes.iter().filter(|attribute| attribute.path().is_ident("cfg")).collect();
    quote! {
        #(#attributes)*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        #visibility struct #name;

        #(#conditions)*
        #[allow(non_upper_case_globals, dead_code)]
        impl #name {
            #handles
        }

        #warnings

        #(#conditions)*
        const _: () = {
            #[allow(dead_code, non_snake_case)]
            fn #name() {}
            #curves
            #grouped

            #[allow(unused_variables, unused_parens, non_snake_case, clippy::all, clippy::pedantic)]
            impl ::eigentol::Mechanism for #name {
                type Coordinates<T: ::core::marker::Copy> = [T; #coordinates];
                type Inputs<T: ::core::marker::Copy> = [T; #inputs];
                type Design<T: ::core::marker::Copy> = [T; #design];
                type Outputs<T: ::core::marker::Copy> = [T; #outputs];
                type Excitations<T: ::core::marker::Copy> = [T; #excitations];
                type Picture<T: ::core::marker::Copy> = [T; #pictured];
                #description
                #picture
                #methods
            }
        };
    }
}
