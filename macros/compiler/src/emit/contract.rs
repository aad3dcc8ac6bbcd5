//! Methods of the runtime's contract: signatures, documentation, and how results are put together.

use std::fmt::Write;

use crate::algebra::Stage;
use crate::program::{Array, Kernel};

use super::body::Body;

/// Numbers of free coordinates, inputs, design variables and outputs.
#[derive(Clone, Copy)]
pub(super) struct Sizes {
    pub(super) coordinates: usize,
    pub(super) inputs: usize,
    pub(super) design: usize,
    pub(super) outputs: usize,
}

/// How a method returns its results.
#[derive(Clone, Copy)]
pub(super) enum Form {
    /// One array.
    Single,
    /// Arrays side by side.
    Tuple,
    /// A struct of the runtime with one field per array, generic over the scalar and some sizes.
    Record(&'static str, fn(Sizes) -> Vec<usize>),
    /// `LinearPartials`: three lists of three matrices.
    Partials,
}

/// The form of a kernel of the contract; `None` for the requirements, which have a method of their own kind.
pub(super) fn form(kernel: &str) -> Option<Form> {
    Some(match kernel {
        "residual" | "motion_residual" | "outputs" | "whirl" => Form::Single,
        "motion" | "residual_and_stiffness" | "residual_partials" | "output_partials" => {
            Form::Tuple
        }
        "residual_parts" => Form::Record("RestParts", |s| vec![s.coordinates]),
        "linear" | "linear_along" | "motion_linear" => {
            Form::Record("Linear", |s| vec![s.coordinates])
        }
        "linear_partials" => Form::Partials,
        "mode_gradient"
        | "pencil_gradient"
        | "residual_gradient"
        | "mode_gradient_along"
        | "pencil_gradient_along"
        | "residual_gradient_along" => {
            Form::Record("Gradient", |s| vec![s.coordinates, s.inputs, s.design])
        }
        _ => return None,
    })
}

/// Kernels that loops over vector lanes call: their bodies are written where they are called, because the instructions of
/// such a loop reach only what is inlined into it.
const INLINED: [&str; 7] = [
    "residual_parts",
    "residual_and_stiffness",
    "linear",
    "residual_partials",
    "linear_partials",
    "mode_gradient",
    "residual_gradient",
];

/// A method as text.
pub(super) fn method(kernel: &Kernel, form: Form, sizes: Sizes) -> String {
    let body = Body::new(kernel);
    let arrays: Vec<String> = kernel
        .results
        .iter()
        .map(|array| literal(&body, array))
        .collect();
    let types: Vec<String> = kernel
        .results
        .iter()
        .map(|array| array_type(&array.shape))
        .collect();
    let (returned, result) = match form {
        Form::Single => (types[0].clone(), arrays[0].clone()),
        Form::Tuple => (
            format!("({})", types.join(", ")),
            format!("({})", arrays.join(", ")),
        ),
        Form::Record(name, generics) => {
            let generics: String = generics(sizes)
                .iter()
                .fold("T".to_owned(), |list, n| format!("{list}, {n}"));
            let fields: Vec<String> = kernel
                .results
                .iter()
                .zip(&arrays)
                .map(|(array, value)| format!("{}: {value}", array.name))
                .collect();
            (
                format!("::eigentol::{name}<{generics}>"),
                format!("::eigentol::{name} {{ {} }}", fields.join(", ")),
            )
        }
        Form::Partials => (
            format!(
                "::eigentol::LinearPartials<T, {}, {}, {}>",
                sizes.coordinates, sizes.inputs, sizes.design
            ),
            partials(&body, kernel),
        ),
    };
    let mut text = signature(kernel, &returned, "");
    if INLINED.contains(&kernel.name) {
        let arguments: Vec<&str> = kernel.parameters.iter().map(|p| p.name).collect();
        let inlined = format!("{}_inlined", kernel.name);
        let _ = writeln!(text, "{{ self.{inlined}({}) }}", arguments.join(", "));
        let head = head(kernel, &inlined, &returned, "");
        let _ = write!(text, "#[doc(hidden)]\n#[inline(always)]\n{head}");
    }
    let _ = writeln!(text, "{{\n{}{result}\n}}", body.statements());
    text
}

/// Documentation and signature of a method; `bound` is added to the scalar's.
pub(super) fn signature(kernel: &Kernel, returned: &str, bound: &str) -> String {
    let head = head(kernel, kernel.name, returned, bound);
    format!("#[doc = {:?}]\n{head}", documentation(kernel))
}

fn head(kernel: &Kernel, name: &str, returned: &str, bound: &str) -> String {
    let mut parameters = String::new();
    for parameter in &kernel.parameters {
        let kind = match parameter.scalar {
            true => "T".to_owned(),
            false => format!("&[T; {}]", parameter.entries.len()),
        };
        let _ = write!(parameters, ", {}: {kind}", parameter.name);
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

/// `[[T; 3]; 2]` of shape 2, 3.
fn array_type(shape: &[usize]) -> String {
    shape
        .iter()
        .rev()
        .fold("T".to_owned(), |inner, n| format!("[{inner}; {n}]"))
}

fn literal(body: &Body, array: &Array) -> String {
    nested(body, &array.shape, &array.values)
}

fn nested(body: &Body, shape: &[usize], values: &[crate::program::Operand]) -> String {
    let Some((&length, inner)) = shape.split_first() else {
        return body.text(values[0]).text;
    };
    let size = values.len().checked_div(length).unwrap_or(0);
    let entries: Vec<String> = (0..length)
        .map(|k| nested(body, inner, &values[k * size..(k + 1) * size]))
        .collect();
    format!("[{}]", entries.join(", "))
}

fn partials(body: &Body, kernel: &Kernel) -> String {
    let mut fields = Vec::new();
    for (name, arrays) in ["by_coordinate", "by_input", "by_design"]
        .iter()
        .zip(kernel.results.chunks(3))
    {
        let count = arrays[0].shape[0];
        let entries: Vec<String> = (0..count)
            .map(|k| {
                let matrices: Vec<String> = arrays
                    .iter()
                    .map(|array| {
                        let size = array.values.len() / count;
                        let values = &array.values[k * size..(k + 1) * size];
                        format!(
                            "{}: {}",
                            array.name,
                            nested(body, &array.shape[1..], values)
                        )
                    })
                    .collect();
                format!("::eigentol::Linear {{ {} }}", matrices.join(", "))
            })
            .collect();
        fields.push(format!("{name}: [{}]", entries.join(", ")));
    }
    format!("::eigentol::LinearPartials {{ {} }}", fields.join(", "))
}
