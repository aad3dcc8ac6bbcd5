//! Methods of the runtime's contract, each with the variants that loops over vector lanes call.
//!
//! # AVX for plain numbers
//!
//! Some kernels of `f64` run with AVX where the processor has it (`Real::run`): not in wider vectors, but with a
//! quarter fewer instructions and the same bits. These are gradients and partial derivatives of the matrices, which
//! gain a tenth to a quarter of the time, and other kernels with 1024 to 2048 operations. AVX slows shorter ones by up
//! to a quarter (six bars: 112 ns against 82 for the matrices); longer ones are left out because such kernels are
//! compiled twice (`emit/contract.rs`). Kernels in one call share computations (`Mechanism::partials`, or residual and
//! matrices where a solve ends): a sine is computed before testing that its angle is small enough, so that LLVM sees
//! two equal ones.

use std::ops::RangeInclusive;

use crate::mechanics::KernelName;
use crate::program::Kernel;

use super::form::Form;
use super::results::Results;
use super::signature::{call, head, signature};

/// Kernels that loops over vector lanes call. Their bodies are inlined at the call, because the instruction set of such
/// a loop applies only to code inlined into it.
const INLINED: [KernelName; 7] = [
    KernelName::ResidualParts,
    KernelName::ResidualAndStiffness,
    KernelName::Linear,
    KernelName::ResidualPartials,
    KernelName::LinearPartials,
    KernelName::ModeGradient,
    KernelName::ResidualGradient,
];

/// Kernels of any length for which `Real::run` selects the processor's instruction set: their values are needed
/// repeatedly and take three quarters to nine tenths of the time.
const CHOSEN: [KernelName; 4] = [
    KernelName::LinearPartials,
    KernelName::ModeGradient,
    KernelName::PencilGradient,
    KernelName::ResidualGradient,
];

/// Numbers of instructions for which selection pays in any other kernel: shorter kernels are up to a quarter slower
/// with AVX, and since a kernel is compiled once per choice, longer ones would take too long to compile.
const LONG: RangeInclusive<usize> = 1024..=2048;

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
    let chosen = is_one_of(kernel, &CHOSEN) || LONG.contains(&count);
    match chosen && count > 0 {
        true => format!("{{ T::run(#[inline(always)] || {{\n{body}\n}}) }}\n"),
        false => format!("{{\n{body}\n}}\n"),
    }
}

/// A method that is always inlined.
fn inlined(head: &str, body: &str) -> String {
    format!("#[doc(hidden)]\n#[inline(always)]\n{head}{{\n{body}\n}}\n")
}
