//! From a program to Rust items that a person can read.
//!
//! ```text
//! pub struct Pendulum;
//! impl Pendulum { pub const theta: Coordinate = Coordinate(0); pub const omega: Input = Input(0); .. }
//! const _: () = {
//! fn Pendulum() {} // so that a variable may have this name
//! impl Mechanism<1, 1, 2, 0> for Pendulum {
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
//! Method bodies are written as text and lexed once: building them token by token costs more than the algebra.

mod body;
mod contract;
mod description;
mod expression;
mod names;
mod pose_margin;
mod results;
mod sines;
mod violation;

use std::fmt::{Debug, Write};

use proc_macro2::TokenStream;
use quote::quote;

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
    let sizes = contract::Sizes {
        coordinates: functions.unknowns.len(),
        inputs: mechanism.inputs.len(),
        design: mechanism.design.len(),
        outputs: mechanism.outputs.len(),
    };
    let mut methods = String::new();
    for kernel in &program.kernels {
        let name = KernelName::named(kernel.name).expect("mechanics names the kernels");
        let method = match contract::form(name) {
            Some(form) => contract::method(kernel, form, sizes),
            None if name == KernelName::Violation => {
                violation::method(kernel, &functions.requirements)
            }
            None => pose_margin::method(kernel, &functions.poses),
        };
        let _ = writeln!(methods, "{method}");
    }
    let methods = lexer(&methods).expect("the emitter writes well-formed tokens");

    let Mechanism {
        name,
        visibility,
        attributes,
        ..
    } = mechanism;
    let handles = description::handles(mechanism, functions);
    let description = description::description(mechanism, functions, program);
    let unused = description::unused(mechanism);
    let contract::Sizes {
        coordinates,
        inputs,
        design,
        outputs,
    } = sizes;
    let conditions: Vec<_> = attributes
        .iter()
        .filter(|attribute| attribute.path().is_ident("cfg"))
        .collect();
    quote! {
        #(#attributes)*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        #visibility struct #name;

        #(#conditions)*
        #[allow(non_upper_case_globals, dead_code)]
        impl #name {
            #handles
        }

        #unused

        #(#conditions)*
        const _: () = {
            #[allow(dead_code, non_snake_case)]
            fn #name() {}

            #[allow(unused_variables, unused_parens, non_snake_case, clippy::all)]
            impl ::eigentol::Mechanism<#coordinates, #inputs, #design, #outputs> for #name {
                #description
                #methods
            }
        };
    }
}
