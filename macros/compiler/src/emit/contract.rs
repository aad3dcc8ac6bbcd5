//! Methods of the runtime's contract, each with the variants that loops over vector lanes call.

use crate::mechanics::KernelName;
use crate::program::Kernel;

use super::form::Form;
use super::results::Results;
use super::signature::{call, head, signature};

/// Kernels that loops over vector lanes call: their bodies are written where they are called, because the instructions of
/// such a loop reach only what is inlined into it.
const INLINED: [KernelName; 7] = [
    KernelName::ResidualParts,
    KernelName::ResidualAndStiffness,
    KernelName::Linear,
    KernelName::ResidualPartials,
    KernelName::LinearPartials,
    KernelName::ModeGradient,
    KernelName::ResidualGradient,
];

/// Instructions that a kernel may have for `Real::run` to choose those of the processor: it is compiled once for each choice.
const CHOSEN: usize = 2048;

/// Kernels for which it is worth it at any length: two are generated for small mechanisms only, the third is what large ones
/// spend their time in.
const ALWAYS_CHOSEN: [KernelName; 3] = [
    KernelName::MotionLinear,
    KernelName::LinearPartials,
    KernelName::ModeGradient,
];

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

/// A body that runs with the instructions of the processor that suit it, where that pays.
fn run(kernel: &Kernel, body: &str) -> String {
    let chosen = kernel.instructions.len() <= CHOSEN || is_one_of(kernel, &ALWAYS_CHOSEN);
    match chosen && !kernel.instructions.is_empty() {
        true => format!("{{ T::run(#[inline(always)] || {{\n{body}\n}}) }}\n"),
        false => format!("{{\n{body}\n}}\n"),
    }
}

/// A method that is written where it is called.
fn inlined(head: &str, body: &str) -> String {
    format!("#[doc(hidden)]\n#[inline(always)]\n{head}{{\n{body}\n}}\n")
}
