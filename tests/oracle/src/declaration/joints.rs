//! Joints and points.

use std::f64::consts::TAU;

use super::quantities::{Printer, direction};
use crate::model::{Drive, Joint, Motion, Point, Step, Unit, Value, Word};

impl Printer<'_> {
    pub(super) fn joint(&self, joint: &Joint) -> String {
        let mut text = format!(
            "joint {}: {} from {} to {}",
            joint.name,
            self.kind(joint),
            self.frame(joint.from),
            self.frame(joint.to)
        );
        let from = self.placement(&joint.from_placement);
        let to = self.placement(&joint.to_placement);
        text.push_str(&from);
        if !to.is_empty() {
            text.push_str(if from.is_empty() { "" } else { "," });
            text.push_str(&format!("{to} on {}", self.frame(joint.to)));
        }
        for step in &joint.steps {
            let Some(Drive { input, factor }) = step.drive else {
                continue;
            };
            let name = match joint.steps.len() {
                1 => String::new(),
                _ => format!("{} ", step.name),
            };
            let factor = match factor {
                1.0 => String::new(),
                _ => format!("{factor:?} * "),
            };
            let speed = &self.model.inputs[input].name;
            text.push_str(&format!(", {name}driven at {factor}{speed}"));
        }
        text.push(';');
        text
    }

    /// `universal(flap: y, lag: z)`, `revolute(x)`, `fixed`.
    fn kind(&self, joint: &Joint) -> String {
        let word = match joint.word {
            Word::Fixed => return "fixed".to_owned(),
            Word::Revolute => "revolute",
            Word::Prismatic => "prismatic",
            Word::Screw => "screw",
            Word::Cylindrical => "cylindrical",
            Word::Universal => "universal",
            Word::Planar => "planar",
            Word::Spherical => "spherical",
            Word::Free => "free",
        };
        let steps = match &joint.steps[..] {
            [single] => self.single(single),
            several => {
                let named = several.iter().map(|step| {
                    let axis = direction(&step.axis);
                    format!("{}: {axis}", step.name)
                });
                named.collect::<Vec<_>>().join(", ")
            }
        };
        format!("{word}({steps})")
    }

    /// An axis, with its lead per turn if it is a screw.
    fn single(&self, step: &Step) -> String {
        let axis = direction(&step.axis);
        let Motion::Screw { lead } = step.motion else {
            return axis;
        };
        let per_turn = match lead {
            Value::Number(lead) => Value::Number(lead * TAU),
            Value::Design { variable, factor } => Value::Design { variable, factor: factor * TAU },
        };
        format!("{axis}, lead: {}", self.value(per_turn, Unit::Metre))
    }

    pub(super) fn point(&self, point: &Point) -> String {
        let (frame, placement) = (self.frame(point.frame), self.placement(&point.placement));
        format!("point {}: {frame}{placement};", point.name)
    }
}
