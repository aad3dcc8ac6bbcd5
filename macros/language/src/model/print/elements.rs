//! Forces, drives and constraints in words, for readers of a picture.

use super::Names;
use crate::model::elements::Element;
use crate::model::expression::Expr;
use crate::model::mechanism::{Mechanism, Motion};

impl Mechanism {
    /// Gravity, drives, forces, constraints and curves, in the order of declaration of each kind.
    pub fn elements(&self) -> Vec<Element> {
        let names = Names(self);
        let still = self.gravity.iter().all(|x| *x == Expr::Number(0.0));
        let gravity = (!still).then(|| Element {
            name: "gravity".to_owned(),
            kind: "gravity".to_owned(),
            law: names.vector(&self.gravity),
        });
        let drives = self.coordinates.iter().filter_map(|coordinate| {
            let Motion::Driven(speed) = &coordinate.motion else {
                return None;
            };
            Some(Element {
                name: coordinate.name.to_string(),
                kind: "drive".to_owned(),
                law: format!("at {}", names.scalar(speed)),
            })
        });
        let members = || self.shafts.iter().map(|own| &own.name).chain(self.superelements.iter().map(|own| &own.name));
        let forces = self.forces.iter().filter(|force| !members().any(|name| *name == force.name));
        let forces = forces.map(|force| element(&force.name, &names.law(&force.law)));
        let shafts = self.shafts.iter().map(|shaft| Element {
            name: shaft.name.to_string(),
            kind: "shaft".to_owned(),
            law: format!("of {} sections with {} stations", shaft.weights.len(), shaft.stations.len()),
        });
        let superelements = self.superelements.iter().map(|own| Element {
            name: own.name.to_string(),
            kind: "superelement".to_owned(),
            law: format!(
                "of {} kg with {} stations, {} internal coordinates",
                names.scalar(&own.mass),
                own.stations.len(),
                own.internal.len()
            ),
        });
        let constraints = self.constraints.iter();
        let constraints = constraints.map(|constraint| element(&constraint.name, &names.constraint(&constraint.law)));
        let curves = self.curves.iter().map(|curve| {
            let [first, last] = curve.range();
            let first = curve.in_unit(first);
            let points = curve.spline.pieces().len().saturating_sub(1);
            Element {
                name: curve.spline.name().to_string(),
                kind: "curve".to_owned(),
                law: format!("through {points} points from {first} to {}", curve.with_unit(last)),
            }
        });
        gravity
            .into_iter()
            .chain(drives)
            .chain(forces)
            .chain(shafts)
            .chain(superelements)
            .chain(constraints)
            .chain(curves)
            .collect()
    }
}

/// Arguments that are zero if not declared.
const OPTIONAL: [&str; 7] = ["stiffness", "damping", "turning_stiffness", "turning_damping", "rest", "force", "moment"];

/// A law without its zero arguments.
fn quiet(law: &str) -> String {
    let mut text = format!("{law} ");
    for name in OPTIONAL {
        for zero in ["0", "[0, 0, 0]"] {
            text = text.replace(&format!(" {name} {zero} "), " ");
        }
    }
    text.trim_end().to_owned()
}

/// An element from the text of its law, which begins with the keyword.
fn element(name: &impl ToString, text: &str) -> Element {
    let (kind, law) = text.split_once(' ').unwrap_or((text, ""));
    Element { name: name.to_string(), kind: kind.to_owned(), law: quiet(law) }
}
