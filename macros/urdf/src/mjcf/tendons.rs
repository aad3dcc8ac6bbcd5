//! Fixed tendons: springs and dampers on a sum of coordinates.

use super::attributes::{number, numbers};
use super::element::Element;
use super::model::{Coordinate, FORCES, Translation};
use super::remark;
use crate::error::ImportError;
use crate::write::number as text_of;

pub(super) fn tendon(all: &mut Translation<'_>, own: &Element) -> Result<(), ImportError> {
    let wanted = own.get("name").unwrap_or("tendon").to_owned();
    if own.tag != "fixed" {
        all.notes.push(remark(format!("the {} tendon `{wanted}` is left out", own.tag)));
        return Ok(());
    }
    let mut parts: Vec<(f64, Coordinate)> = Vec::new();
    for joint in own.named("joint") {
        parts.push((number(joint, "coef", 0.0)?, all.coordinate(joint, "joint")?));
    }
    for attribute in ["range", "frictionloss", "armature"] {
        if own.get(attribute).is_some_and(|text| text.split_whitespace().any(|x| x.parse() != Ok(0.0))) {
            all.notes.push(remark(format!("`{attribute}` of the tendon `{wanted}` is left out")));
        }
    }
    let (stiffness, damping) = (number(own, "stiffness", 0.0)?, number(own, "damping", 0.0)?);
    let unit = |coordinate: &Coordinate| if coordinate.is_angle { "rad" } else { "m" };
    // Length less that at the reference, without a unit.
    let sum = |of: &dyn Fn(&Coordinate) -> String| {
        let each = parts.iter().map(|(factor, own)| format!("{} * {}", text_of(*factor), of(own)));
        each.collect::<Vec<_>>().join(" + ")
    };
    if stiffness != 0.0 {
        let reference: f64 = parts.iter().map(|(factor, own)| factor * own.reference).sum();
        let rest = match numbers(own, "springlength")?[..] {
            // Where the springs of its joints are at rest.
            [] | [-1.0] | [-1.0, -1.0] => parts.iter().map(|(factor, own)| factor * own.rest).sum(),
            [one] => one - reference,
            [low, high, ..] => {
                if low != high {
                    let text =
                        format!("the spring of the tendon `{wanted}` is slack in between: its lower length is taken");
                    all.notes.push(remark(text));
                }
                low - reference
            }
        };
        let length = sum(&|own| format!("{} / 1 {}", own.name, unit(own)));
        let name = all.names.unique(&format!("spring_of_{wanted}"), "force");
        let law = format!("potential(energy: {} J * ({length} - {})^2 / 2)", text_of(stiffness), text_of(rest));
        all.lines[FORCES].push((String::new(), format!("force {name}: {law}")));
    }
    if damping != 0.0 {
        let speed = sum(&|own| format!("rate({}) / 1 {}", own.name, unit(own)));
        for (factor, own) in parts.iter().filter(|(factor, _)| *factor != 0.0) {
            let name = all.names.unique(&format!("damping_of_{wanted}_on_{}", own.name), "force");
            let force = if own.is_angle { "N*m*s" } else { "N*s" };
            let value = format!("{} {force} * ({speed})", text_of(-damping * factor));
            let line = format!("force {name}: generalized(on: {}, value: {value})", own.name);
            all.lines[FORCES].push((String::new(), line));
        }
    }
    Ok(())
}
