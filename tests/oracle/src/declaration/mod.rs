//! Prints a model in the language of `mechanism!`, every number to full precision.

mod bodies;
mod forces;
mod joints;
mod quantities;

use self::quantities::{Printer, quantity, symbol};
use crate::model::{Model, Unit};

/// The declaration of a model: the text between the braces of `mechanism! { ... }`.
///
/// # Panics
/// When it has beams, which come from declarations only.
pub fn declaration(model: &Model) -> String {
    assert!(model.beams.is_empty(), "beams are not printed");
    let print = Printer { model };
    let mut lines = Vec::new();
    for input in &model.inputs {
        lines.push(format!("input {}: {};", input.name, symbol(input.unit)));
    }
    for variable in &model.design {
        let nominal = quantity(variable.nominal, variable.unit);
        lines.push(format!("design {} = {nominal};", variable.name));
    }
    lines.extend(print.curves());
    let gravity = print.vector(&model.gravity, Unit::MetrePerSquareSecond);
    lines.push(format!("gravity {gravity};"));
    lines.extend(model.bodies.iter().map(|body| print.body(body)));
    lines.extend(model.joints.iter().map(|joint| print.joint(joint)));
    lines.extend(model.points.iter().map(|point| print.point(point)));
    lines.extend(model.forces.iter().map(|force| print.force(force)));
    format!("pub mechanism {} {{\n    {}\n}}\n", model.name, lines.join("\n    "))
}
