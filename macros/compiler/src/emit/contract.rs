//! Methods of the runtime's contract: signatures, documentation, and how results are put together.

use std::fmt::Write;

use crate::algebra::Stage;
use crate::mechanics::KernelName;
use crate::program::Kernel;

use super::names::local;
use super::results::Results;

/// How a method returns its results.
#[derive(Clone, Copy)]
pub(super) enum Form {
    /// One array.
    Single,
    /// Arrays side by side.
    Tuple,
    /// A struct of the runtime with one field per array, generic over the types of the first so many.
    Record(&'static str, usize),
    /// `LinearPartials`: three lists of three matrices.
    Partials,
}

/// The form of a kernel of the contract; `None` for requirements and poses, which have methods of their own kind.
pub(super) fn form(kernel: KernelName) -> Option<Form> {
    Some(match kernel {
        KernelName::Residual
        | KernelName::MotionResidual
        | KernelName::Outputs
        | KernelName::Whirl => Form::Single,
        KernelName::Motion
        | KernelName::ResidualAndStiffness
        | KernelName::ResidualPartials
        | KernelName::OutputPartials => Form::Tuple,
        KernelName::ResidualParts => Form::Record("RestParts", 1),
        KernelName::Linear | KernelName::MotionLinear => Form::Record("Linear", 1),
        KernelName::LinearPartials => Form::Partials,
        KernelName::ModeGradient | KernelName::PencilGradient | KernelName::ResidualGradient => {
            Form::Record("Gradient", 3)
        }
        KernelName::Violation | KernelName::PoseMargin => return None,
    })
}

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

/// A call of a variant of the kernel's method, with one more argument or none.
pub(super) fn call(kernel: &Kernel, method: &str, last: &str) -> String {
    let names = kernel.parameters.iter().map(|p| local(p.name));
    let last = (!last.is_empty()).then(|| last.to_owned());
    let arguments: Vec<String> = names.chain(last).collect();
    format!("self.{method}({})", arguments.join(", "))
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

/// Documentation and signature of a method; `bound` is added to the scalar's.
pub(super) fn signature(kernel: &Kernel, returned: &str, bound: &str) -> String {
    let head = head(kernel, kernel.name, "", returned, bound);
    format!("#[doc = {:?}]\n{head}", documentation(kernel))
}

/// A signature with one more parameter or none.
fn head(kernel: &Kernel, name: &str, last: &str, returned: &str, bound: &str) -> String {
    let mut parameters = String::new();
    for parameter in &kernel.parameters {
        let kind = match parameter.scalar {
            true => "T".to_owned(),
            false => format!("&[T; {}]", parameter.entries.len()),
        };
        let _ = write!(parameters, ", {}: {kind}", local(parameter.name));
    }
    if !last.is_empty() {
        let _ = write!(parameters, ", {last}");
    }
    format!("fn {name}<T: ::eigentol::Real{bound}>(&self{parameters}) -> {returned} ")
}

fn documentation(kernel: &Kernel) -> String {
    let mut text = format!(
        "{} additions and multiplications, {} divisions and functions",
        kernel.cost.operations, kernel.cost.functions
    );
    let stages: Vec<String> = kernel
        .cost_by_stage()
        .into_iter()
        .filter_map(|(stage, count)| match stage {
            Stage::Constant => None,
            Stage::Design => Some(format!("{count} depend on the design only")),
            Stage::Input => Some(format!("{count} change with the inputs")),
            Stage::Configuration => Some(format!("{count} with the position")),
            Stage::Rate => Some(format!("{count} with a rate or direction")),
        })
        .collect();
    if stages.len() > 1 {
        let _ = write!(text, ": {}", stages.join(", "));
    }
    text.push('.');
    for parameter in kernel
        .parameters
        .iter()
        .filter(|p| !p.scalar && !p.entries.is_empty())
    {
        let _ = write!(
            text,
            "\n\n`{}` = [{}]",
            parameter.name,
            parameter.entries.join(", ")
        );
    }
    text
}
