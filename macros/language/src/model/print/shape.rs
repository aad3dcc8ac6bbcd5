//! Bodies as text.

use std::fmt::Write;

use super::super::mechanism::{Part, Shape};
use super::super::shape::Argument;
use super::Names;

impl Names<'_> {
    /// The parts of a body.
    pub(super) fn parts(&self, parts: &[Part]) -> String {
        if parts.is_empty() {
            return "massless".to_owned();
        }
        let mut text = String::new();
        for (index, part) in parts.iter().enumerate() {
            match (part.hole, index) {
                (false, 0) => {}
                (false, _) => text.push_str(" + "),
                (true, _) => text.push_str(" - "),
            }
            text.push_str(&self.shape(&part.shape));
            text.push_str(&self.placement(&part.placement));
        }
        text
    }

    fn shape(&self, shape: &Shape) -> String {
        let shape = shape.reduced();
        let mut text = shape.word.to_owned();
        for (name, argument) in shape.arguments {
            let value = match argument {
                Argument::Scalar(value) => self.scalar(value),
                Argument::Vector(vector) => self.vector(vector),
                Argument::Tensor(entries) => {
                    let entries: Vec<String> = entries.iter().map(|e| self.scalar(e)).collect();
                    format!("[{}]", entries.join(", "))
                }
            };
            let _ = write!(text, " {name} {value}");
        }
        text
    }
}
