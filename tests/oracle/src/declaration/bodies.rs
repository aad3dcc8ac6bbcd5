//! Bodies as sums of shapes.

use super::quantities::{Printer, direction};
use crate::model::{Amount, Body, Shape, Unit, Value};

impl Printer<'_> {
    pub(super) fn body(&self, body: &Body) -> String {
        let mut text = String::new();
        for part in &body.parts {
            let sign = match (text.is_empty(), part.hole) {
                (true, false) => "",
                (true, true) => "-",
                (false, false) => " + ",
                (false, true) => " - ",
            };
            let (shape, placement) = (self.shape(&part.shape), self.placement(&part.placement));
            text.push_str(&format!("{sign}{shape}{placement}"));
        }
        if text.is_empty() {
            text.push_str("massless");
        }
        format!("body {}: {text};", body.name)
    }

    /// `mass: 1.0 kg`, or `density: 7800.0 kg/m^3` per unit of length, area or volume according to `dimensions`.
    fn amount(&self, amount: Amount, dimensions: i8) -> String {
        match amount {
            Amount::Mass(mass) => self.mass(mass),
            Amount::Density(density) => {
                let density = self.value(density, Unit::Of([1, -dimensions, 0]));
                format!("density: {density}")
            }
        }
    }

    fn mass(&self, mass: Value) -> String {
        format!("mass: {}", self.value(mass, Unit::Kilogram))
    }

    fn shape(&self, shape: &Shape) -> String {
        let metre = |value: &Value| self.value(*value, Unit::Metre);
        match shape {
            Shape::Point { mass, center } => {
                let center = self.metres(center);
                format!("point({}, center: {center})", self.mass(*mass))
            }
            Shape::Rod { mass, length, along, center } => {
                let center = center.map(|center| format!(", center: {}", self.metres(&center)));
                format!(
                    "rod({}, length: {}, along: {}{})",
                    self.amount(*mass, 1),
                    metre(length),
                    direction(along),
                    center.unwrap_or_default()
                )
            }
            Shape::Disk { mass, radius, axis, center } => format!(
                "disk({}, radius: {}, axis: {}, center: {})",
                self.amount(*mass, 2),
                metre(radius),
                direction(axis),
                self.metres(center)
            ),
            Shape::Cylinder { mass, radius, length, axis, center } => format!(
                "cylinder({}, radius: {}, length: {}, axis: {}, center: {})",
                self.amount(*mass, 3),
                metre(radius),
                metre(length),
                direction(axis),
                self.metres(center)
            ),
            Shape::Tube { mass, inner, outer, length, axis, center } => format!(
                "tube({}, inner: {}, outer: {}, length: {}, axis: {}, center: {})",
                self.amount(*mass, 3),
                metre(inner),
                metre(outer),
                metre(length),
                direction(axis),
                self.metres(center)
            ),
            Shape::Cuboid { mass, size, center } => {
                format!("box({}, size: {}, center: {})", self.amount(*mass, 3), self.metres(size), self.metres(center))
            }
            Shape::Sphere { mass, radius, center } => {
                format!("sphere({}, radius: {}, center: {})", self.amount(*mass, 3), metre(radius), self.metres(center))
            }
            Shape::Rigid { mass, center, inertia, about } => {
                let about = about.map(|about| format!(", about: {}", self.metres(&about)));
                format!(
                    "rigid({}, center: {}, inertia: {}{})",
                    self.mass(*mass),
                    self.metres(center),
                    self.list(inertia, Unit::KilogramSquareMetre),
                    about.unwrap_or_default()
                )
            }
        }
    }
}
