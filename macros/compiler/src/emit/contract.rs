//! Methods of the runtime's contract, each with the variants that loops over vector lanes call.
//!
//! # AVX for plain numbers
//!
//! Kernels of `f64` with 256 operations or more, and gradients and partial derivatives of any length, run with AVX
//! where the processor has it (`Real::run`): not in wider vectors, but with a sixth to a quarter fewer instructions and
//! the same bits. Kernels too long for the instruction cache, those of robots along a motion above all, take up to a
//! third less time, short ones the same. Each such kernel is compiled twice (`emit/contract.rs`). Kernels in one call
//! share computations (`Mechanism::partials`, or residual and matrices where a solve ends): a sine is computed before
//! testing that its angle is small enough, so that LLVM sees two equal ones.

use crate::mechanics::KernelName;
use crate::program::Kernel;

use super::form::Form;
use super::results::Results;
use super::signature::{call, head, signature};

/// Kernels that loops over vector lanes call. Their bodies are inlined at the call, because the instruction set of such
/// a loop applies only to code inlined into it.
const INLINED: [KernelName; 13] = [
    KernelName::Residual,
    KernelName::MotionResidual,
    KernelName::Motion,
    KernelName::MotionLinear,
    KernelName::ResidualParts,
    KernelName::ResidualAndStiffness,
    KernelName::Linear,
    KernelName::ResidualPartials,
    KernelName::LinearPartials,
    KernelName::ModeGradient,
    KernelName::PencilGradient,
    KernelName::ResidualGradient,
    KernelName::ForcedGradient,
];

/// Kernels for which `Real::run` selects the processor's instruction set at any length: their values are needed
/// repeatedly and take three quarters to nine tenths of the time.
const CHOSEN: [KernelName; 4] =
    [KernelName::LinearPartials, KernelName::ModeGradient, KernelName::PencilGradient, KernelName::ResidualGradient];

/// Number of instructions from which selection pays in any other kernel. With AVX a kernel takes a sixth to a quarter
/// fewer instructions. That saves up to a third of the time beyond some 2000, which no longer fit the instruction cache;
/// below 500 it saves little, below 200 nothing.
const LONG: usize = 256;

fn is_one_of(kernel: &Kernel, names: &[KernelName]) -> bool {
    KernelName::named(kernel.name).is_some_and(|name| names.contains(&name))
}

/// A method as text, with its variants.
pub(super) fn method(kernel: &Kernel, form: Form) -> String {
    let results = Results::new(kernel, form);
    let (name, kind) = (kernel.name, results.kind());
    let mut text = signature(kernel, &kind, "");
    if !is_one_of(kernel, &INLINED) {
        text += &run(kernel, &results.body());
        return text;
    }
    let hidden = format!("{name}_inlined");
    text += &run(kernel, &call(kernel, &hidden, ""));
    text += &inlined(&head(kernel, &hidden, "", &kind, ""), &results.body());
    if let Some(stores) = results.stores() {
        let (into, hidden) = (format!("{name}_into"), format!("{name}_into_inlined"));
        let head = |name: &str| head(kernel, name, &format!("result_: &mut {kind}"), "()", "");
        text += &head(&into);
        text += &run(kernel, &call(kernel, &hidden, "result_"));
        text += &inlined(&head(&hidden), &stores);
    }
    text
}

/// A body that runs with a suitable instruction set of the processor where that pays.
fn run(kernel: &Kernel, body: &str) -> String {
    let count = kernel.instructions.len();
    let chosen = is_one_of(kernel, &CHOSEN) || count >= LONG;
    if chosen && count > 0 {
        format!("{{ T::run(#[inline(always)] || {{\n{body}\n}}) }}\n")
    } else {
        format!("{{\n{body}\n}}\n")
    }
}

/// A method that is always inlined.
fn inlined(head: &str, body: &str) -> String {
    format!("#[doc(hidden)]\n#[inline(always)]\n{head}{{\n{body}\n}}\n")
}
