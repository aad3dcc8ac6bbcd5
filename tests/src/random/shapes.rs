//! Random mass distributions.

use super::values::Source;
use crate::model::{Shape, Unit, Value};

impl Source {
    fn mass(&mut self) -> Value {
        self.between(0.3, 3.0, Unit::Kilogram)
    }

    fn length(&mut self) -> Value {
        self.between(0.2, 1.2, Unit::Metre)
    }

    /// A body with mass.
    pub(super) fn shape(&mut self) -> Shape {
        match self.random.below(7) {
            0 => Shape::Point {
                mass: self.mass(),
                center: self.position(0.6),
            },
            1 => Shape::Rod {
                mass: self.mass(),
                length: self.length(),
                along: self.axis(),
                center: if self.random.chance(0.6) {
                    None
                } else {
                    Some(self.position(0.6))
                },
            },
            2 => Shape::Disk {
                mass: self.mass(),
                radius: self.length(),
                axis: self.axis(),
                center: self.position(0.6),
            },
            3 => Shape::Cylinder {
                mass: self.mass(),
                radius: self.length(),
                length: self.length(),
                axis: self.axis(),
                center: self.position(0.6),
            },
            4 => Shape::Cuboid {
                mass: self.mass(),
                size: [self.length(), self.length(), self.length()],
                center: self.position(0.6),
            },
            5 => Shape::Sphere {
                mass: self.mass(),
                radius: self.length(),
                center: self.position(0.6),
            },
            _ => self.rigid(),
        }
    }

    /// Any inertia that a body can have: `J = tr(S) I - S` with the second moments `S = A A^T`.
    fn rigid(&mut self) -> Shape {
        let a: [[f64; 3]; 3] = std::array::from_fn(|_| self.random.vector(0.5));
        let s = |i: usize, j: usize| (0..3).map(|k| a[i][k] * a[j][k]).sum::<f64>();
        let trace = s(0, 0) + s(1, 1) + s(2, 2);
        let j = [
            trace - s(0, 0),
            trace - s(1, 1),
            trace - s(2, 2),
            -s(0, 1),
            -s(1, 2),
            -s(0, 2),
        ];
        // All six numbers, or all multiples of one variable, so that it stays possible off the nominal design.
        let inertia = match self.value(j[0], Unit::KilogramSquareMetre) {
            Value::Number(_) => j.map(Value::Number),
            Value::Design { variable, factor } => j.map(|entry| Value::Design {
                variable,
                factor: factor * entry / j[0],
            }),
        };
        Shape::Rigid {
            mass: self.mass(),
            center: self.position(0.6),
            inertia,
        }
    }

    /// A body symmetric about `axis` through its origin.
    pub(super) fn rotor(&mut self, axis: [f64; 3]) -> Shape {
        let along = self.random.between(-0.3, 0.3);
        let center = match self.value(along, Unit::Metre) {
            Value::Number(_) => axis.map(|component| Value::Number(along * component)),
            Value::Design { variable, factor } => axis.map(|component| Value::Design {
                variable,
                factor: factor * component,
            }),
        };
        match self.random.below(3) {
            0 => Shape::Disk {
                mass: self.mass(),
                radius: self.length(),
                axis,
                center,
            },
            1 => Shape::Sphere {
                mass: self.mass(),
                radius: self.length(),
                center,
            },
            _ => Shape::Cylinder {
                mass: self.mass(),
                radius: self.length(),
                length: self.length(),
                axis,
                center,
            },
        }
    }
}
