//! Random mass distributions.

use std::f64::consts::PI;

use super::values::Source;
use crate::model::{Amount, ORIGIN, Part, Placement, Shape, Unit, Value, Values};

impl Source {
    fn mass(&mut self) -> Value {
        self.between(0.3, 3.0, Unit::Kilogram)
    }

    fn length(&mut self) -> Value {
        self.between(0.2, 1.2, Unit::Metre)
    }

    /// A mass, or the density that gives this mass over a volume of the given number of dimensions.
    fn amount(&mut self, volume: f64, dimensions: i8) -> Amount {
        let mass = self.random.between(0.3, 3.0);
        self.amount_of(mass, volume, dimensions)
    }

    fn amount_of(&mut self, mass: f64, volume: f64, dimensions: i8) -> Amount {
        if self.random.chance(0.35) {
            Amount::Density(self.value(mass / volume, Unit::Of([1, -dimensions, 0])))
        } else {
            Amount::Mass(self.value(mass, Unit::Kilogram))
        }
    }

    /// The mass of a body: one piece or a sum.
    pub(super) fn parts(&mut self) -> Vec<Part> {
        if self.random.chance(0.7) {
            return vec![Part::whole(self.shape())];
        }
        let mut parts = self.pierced();
        if self.random.chance(0.6) {
            parts.push(Part { hole: false, shape: self.shape(), placement: self.placement() });
        }
        parts
    }

    /// A solid with a hole: at most a fifth of its mass, half its size, and near its centre, so that the remainder is a
    /// valid body, also off the nominal design.
    fn pierced(&mut self) -> Vec<Part> {
        let size = self.random.between(0.3, 0.8);
        let mass = self.random.between(0.5, 3.0);
        let (solid, cavity) = (self.solid(size, mass), self.random.between(0.2, 0.4) * size);
        let missing = mass * self.random.between(0.05, 0.15);
        let mut hole = self.solid(cavity, missing);
        let aside: Values = std::array::from_fn(|_| Value::Number(self.random.between(-0.15, 0.15) * size));
        match &mut hole {
            Shape::Sphere { center, .. }
            | Shape::Cuboid { center, .. }
            | Shape::Cylinder { center, .. }
            | Shape::Tube { center, .. } => *center = aside,
            other => unreachable!("{other:?} is no solid"),
        }
        let placement = self.placement();
        let turned = Placement { offset: placement.offset, ..self.placement() };
        vec![Part { hole: false, shape: solid, placement }, Part { hole: true, shape: hole, placement: turned }]
    }

    /// A compact shape centred on the origin.
    fn solid(&mut self, size: f64, mass: f64) -> Shape {
        let (center, length) = (ORIGIN, self.value(size, Unit::Metre));
        match self.random.below(4) {
            0 => Shape::Sphere { mass: self.amount_of(mass, 4.0 / 3.0 * PI * size.powi(3), 3), radius: length, center },
            1 => Shape::Cuboid {
                mass: self.amount_of(mass, 8.0 * size.powi(3), 3),
                size: [(); 3].map(|()| self.value(2.0 * size, Unit::Metre)),
                center,
            },
            2 => Shape::Cylinder {
                mass: self.amount_of(mass, 2.0 * PI * size.powi(3), 3),
                radius: length,
                length: self.value(2.0 * size, Unit::Metre),
                axis: self.axis(),
                center,
            },
            _ => Shape::Tube {
                mass: self.amount_of(mass, 2.0 * PI * 0.75 * size.powi(3), 3),
                inner: self.value(0.5 * size, Unit::Metre),
                outer: length,
                length: self.value(2.0 * size, Unit::Metre),
                axis: self.axis(),
                center,
            },
        }
    }

    /// One shape of any kind.
    fn shape(&mut self) -> Shape {
        match self.random.below(8) {
            0 => Shape::Point { mass: self.mass(), center: self.position(0.6) },
            1 => Shape::Rod {
                mass: self.amount(0.6, 1),
                length: self.length(),
                along: self.axis(),
                center: if self.random.chance(0.6) { None } else { Some(self.position(0.6)) },
            },
            2 => Shape::Disk {
                mass: self.amount(1.0, 2),
                radius: self.length(),
                axis: self.axis(),
                center: self.position(0.6),
            },
            3 => Shape::Cylinder {
                mass: self.amount(0.8, 3),
                radius: self.length(),
                length: self.length(),
                axis: self.axis(),
                center: self.position(0.6),
            },
            4 => Shape::Cuboid {
                mass: self.amount(0.3, 3),
                size: [self.length(), self.length(), self.length()],
                center: self.position(0.6),
            },
            5 => Shape::Sphere { mass: self.amount(1.0, 3), radius: self.length(), center: self.position(0.6) },
            6 => {
                let axis = self.axis();
                self.tube(axis, |source| source.position(0.6))
            }
            _ => self.rigid(),
        }
    }

    fn tube(&mut self, axis: [f64; 3], center: impl Fn(&mut Self) -> Values) -> Shape {
        let outer = self.random.between(0.3, 0.8);
        let inner = outer * self.random.between(0.2, 0.75);
        Shape::Tube {
            mass: self.amount(0.5, 3),
            inner: self.value(inner, Unit::Metre),
            outer: self.value(outer, Unit::Metre),
            length: self.length(),
            axis,
            center: center(self),
        }
    }

    /// Any physically possible inertia: `J = tr(S) I - S` with the second moments `S = A A^T + s I` about the centre,
    /// and `S + m d d^T` about a point at distance `d` from it.
    fn rigid(&mut self) -> Shape {
        let mut a: [[f64; 3]; 3] = std::array::from_fn(|_| self.random.vector(0.5));
        if self.special && self.random.chance(0.7) {
            // along the axes, with some equal or zero: a bar, a plate, a ball
            a = std::array::from_fn(|i| {
                std::array::from_fn(|j| match i == j {
                    true => self.random.of(&[0.0, 0.0, 0.3, 0.5]),
                    false => 0.0,
                })
            });
        }
        let thick = if self.special { 0.0 } else { 0.05 };
        let about: Option<[f64; 3]> = self.random.chance(0.5).then(|| self.random.vector(0.4));
        let mass = self.random.between(0.3, 3.0);
        let off = self.random.vector(0.15);
        let d = if about.is_some() { off } else { [0.0; 3] };
        let s = |i: usize, j: usize| {
            let own = (0..3).map(|k| a[i][k] * a[j][k]).sum::<f64>();
            own + thick * f64::from(i == j) + mass * d[i] * d[j]
        };
        let trace = s(0, 0) + s(1, 1) + s(2, 2);
        let j = [trace - s(0, 0), trace - s(1, 1), trace - s(2, 2), -s(0, 1), -s(1, 2), -s(0, 2)];
        // All six are numbers, or all multiples of one variable, so that the inertia stays possible off the nominal
        // design.
        let inertia = match self.value(j[0], Unit::KilogramSquareMetre) {
            Value::Number(_) => j.map(Value::Number),
            Value::Design { variable, factor } => {
                j.map(|entry| Value::Design { variable, factor: factor * entry / j[0] })
            }
        };
        let numbers = |v: [f64; 3]| v.map(Value::Number);
        Shape::Rigid {
            mass: self.value(mass, Unit::Kilogram),
            center: match about {
                Some(about) => numbers(std::array::from_fn(|i| about[i] + d[i])),
                None => self.position(0.6),
            },
            inertia,
            about: about.map(numbers),
        }
    }

    /// A body symmetric about `axis` through its origin; occasionally a sum of such shapes.
    pub(super) fn rotor(&mut self, axis: [f64; 3]) -> Vec<Part> {
        let mut parts = vec![Part::whole(self.symmetric(axis))];
        if self.random.chance(0.4) {
            let along = self.random.between(-0.3, 0.3);
            let angle = self.between(-2.0, 2.0, Unit::Radian);
            parts.push(Part {
                hole: false,
                shape: self.symmetric(axis),
                placement: Placement { offset: self.along(axis, along), rotations: vec![(axis, angle)] },
            });
        }
        parts
    }

    /// A position on an axis through the origin.
    pub(super) fn along(&mut self, axis: [f64; 3], along: f64) -> Values {
        match self.value(along, Unit::Metre) {
            Value::Number(_) => axis.map(|component| Value::Number(along * component)),
            Value::Design { variable, factor } => {
                axis.map(|component| Value::Design { variable, factor: factor * component })
            }
        }
    }

    fn symmetric(&mut self, axis: [f64; 3]) -> Shape {
        let along = self.random.between(-0.3, 0.3);
        let center = self.along(axis, along);
        match self.random.below(4) {
            0 => Shape::Disk { mass: self.amount(1.0, 2), radius: self.length(), axis, center },
            1 => Shape::Sphere { mass: self.amount(1.0, 3), radius: self.length(), center },
            2 => self.tube(axis, |_| center),
            _ => Shape::Cylinder {
                mass: self.amount(0.8, 3),
                radius: self.length(),
                length: self.length(),
                axis,
                center,
            },
        }
    }
}
