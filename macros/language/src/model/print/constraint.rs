//! Constraints as text.

use super::super::mechanism::ConstraintLaw;
use super::{AXES, Names};
use crate::base::ids::PointId;

impl Names<'_> {
    pub(super) fn constraint(&self, law: &ConstraintLaw) -> String {
        let point = |id: &PointId| &self.0.points[id.index()].name;
        match law {
            ConstraintLaw::Coincident { from, to, along } => {
                let axes = AXES.iter().zip(along).filter(|(_, chosen)| **chosen);
                let axes: Vec<&str> = axes.map(|(axis, _)| *axis).collect();
                let (from, to, axes) = (point(from), point(to), axes.join(", "));
                format!("coincident from {from} to {to} along {axes}")
            }
            ConstraintLaw::Aligned { from, to, axis } => {
                let axis = axis.as_ref().map(|axis| self.vector(axis));
                let axis = axis.map_or(String::new(), |axis| format!(" axis {axis}"));
                format!("aligned from {} to {}{axis}", point(from), point(to))
            }
            ConstraintLaw::Distance { from, to, length } => {
                let length = self.scalar(length);
                format!("distance from {} to {} length {length}", point(from), point(to))
            }
            ConstraintLaw::Equation { zero, unit } => {
                format!("equation zero {}{}", self.scalar(zero), super::unit(unit))
            }
            ConstraintLaw::Rolling { wheel, axis, radius, on, normal } => {
                let axis = axis.as_ref().map(|axis| self.vector(axis));
                format!(
                    "rolling wheel {} axis {} radius {} on {} normal {}",
                    point(wheel),
                    axis.unwrap_or("none".to_owned()),
                    self.scalar(radius),
                    point(on),
                    self.vector(normal)
                )
            }
        }
    }
}
