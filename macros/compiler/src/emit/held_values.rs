//! The values that select one of a family of steady motions, and the numbers of shafts.

use std::fmt::Write;

use crate::program::Kernel;

use super::body::Body;
use super::signature::{documentation, head};

/// `fn held_values` and `fn spans`: write their values into a slice.
pub(super) fn method(kernel: &Kernel) -> String {
    let body = Body::new(kernel);
    let head = head(kernel, kernel.name, "values_: &mut [T]", "()", "");
    let mut text = format!("#[doc = {:?}]\n{head}{{\n{}", documentation(kernel), body.statements());
    let values = kernel.results[0].values.iter();
    let values: Vec<String> = values.map(|&value| body.text(value).text).collect();
    let _ = writeln!(text, "values_.copy_from_slice(&[{}]);\n}}", values.join(", "));
    text
}
