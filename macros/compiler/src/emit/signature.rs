//! Signatures of methods, their documentation, and calls to them.

use std::fmt::Write;

use crate::algebra::Stage;
use crate::program::Kernel;

use super::names::local;

/// Documentation and signature of a method; `bound` is added to the bound on the scalar type.
pub(super) fn signature(kernel: &Kernel, returned: &str, bound: &str) -> String {
    let head = head(kernel, kernel.name, "", returned, bound);
    format!("#[doc = {:?}]\n{head}", documentation(kernel))
}

/// A signature, with an optional additional parameter.
pub(super) fn head(kernel: &Kernel, name: &str, last: &str, returned: &str, bound: &str) -> String {
    let mut parameters = String::new();
    for parameter in &kernel.parameters {
        let kind = if parameter.scalar { "T".to_owned() } else { format!("&[T; {}]", parameter.entries.len()) };
        let _ = write!(parameters, ", {}: {kind}", local(parameter.name));
    }
    if !last.is_empty() {
        let _ = write!(parameters, ", {last}");
    }
    format!("fn {name}<T: ::eigentol::Real{bound}>(&self{parameters}) -> {returned} ")
}

pub(super) fn documentation(kernel: &Kernel) -> String {
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
    for parameter in kernel.parameters.iter().filter(|p| !p.scalar && !p.entries.is_empty()) {
        let _ = write!(text, "\n\n`{} = [{}]`", parameter.name, parameter.entries.join(", "));
    }
    text
}

/// A call of a variant of the kernel's method, with an optional additional argument.
pub(super) fn call(kernel: &Kernel, method: &str, last: &str) -> String {
    let names = kernel.parameters.iter().map(|p| local(p.name));
    let last = (!last.is_empty()).then(|| last.to_owned());
    let arguments: Vec<String> = names.chain(last).collect();
    format!("self.{method}({})", arguments.join(", "))
}
