//! Random forces that preserve a steady state.

use super::Setting;
use super::tree::Builder;
use crate::model::{
    Coordinate, Force, ForceLaw, Frame, Matrix, Motion, ORIGIN, Placement, Point, Unit, Values, ZERO, diagonal,
};

/// Points and force laws collected so far.
struct Elements {
    points: Vec<Point>,
    laws: Vec<ForceLaw>,
}

impl Elements {
    /// A new point with axes.
    fn point(&mut self, frame: Frame, placement: Placement) -> usize {
        let name = format!("point{}", self.points.len());
        self.points.push(Point { name, frame, placement });
        self.points.len() - 1
    }
}

impl Builder {
    /// Forces on free coordinates, between points that no drive moves relative to each other, and at points where
    /// drives have no effect.
    pub(super) fn forces(&mut self, setting: Setting) -> (Vec<Point>, Vec<Force>) {
        let mut elements = Elements { points: Vec::new(), laws: Vec::new() };
        let all: Vec<Coordinate> = (0..self.joints.len())
            .flat_map(|joint| (0..self.joints[joint].steps.len()).map(move |step| Coordinate { joint, step }))
            .collect();
        let driven = |q: &Coordinate| self.joints[q.joint].steps[q.step].drive.is_some();
        let free: Vec<Coordinate> = all.iter().copied().filter(|q| !driven(q)).collect();
        for &coordinate in &free {
            self.on_coordinate(coordinate, [&free, &all], &mut elements.laws);
        }
        for _ in 0..self.source.random.below(3) {
            self.between_points(&mut elements);
        }
        for _ in 0..self.source.random.below(3) {
            self.at_point(setting, &mut elements);
        }
        if self.source.random.chance(0.5) {
            self.on_rotor(&mut elements);
        }
        let name = |index| format!("force{index}");
        let laws = elements.laws.into_iter().enumerate();
        let forces = laws.map(|(i, law)| Force { name: name(i), law });
        (elements.points, forces.collect())
    }

    fn on_coordinate(&mut self, coordinate: Coordinate, [free, all]: [&[Coordinate]; 2], laws: &mut Vec<ForceLaw>) {
        let motion = self.joints[coordinate.joint].steps[coordinate.step].motion;
        // Only a spring holds a slider against its weight.
        if motion == Motion::Slide || self.source.random.chance(0.75) {
            laws.push(match self.source.random.below(6) {
                0 => ForceLaw::Generalized { coordinate, value: self.generalized(coordinate, free, all) },
                1 => ForceLaw::Potential { energy: self.energy_of_coordinates(coordinate, free) },
                _ => ForceLaw::Spring {
                    coordinate,
                    stiffness: self.source.between(5.0, 80.0, motion.stiffness_unit()),
                    rest: self.source.between(-0.3, 0.3, motion.unit()),
                },
            });
        }
        if self.source.random.chance(0.25) {
            laws.push(ForceLaw::Damper { coordinate, damping: self.source.between(0.1, 2.0, motion.damping_unit()) });
        }
    }

    fn between_points(&mut self, elements: &mut Elements) {
        let one = self.source.random.below(self.bodies.len());
        let carrier = self.carriers[one];
        let mut others: Vec<Frame> = (0..self.bodies.len())
            .filter(|&other| other != one && self.carriers[other] == carrier)
            .map(Frame::Body)
            .collect();
        if carrier == 0 {
            others.push(Frame::Ground);
        }
        if others.is_empty() {
            return;
        }
        let other = others[self.source.random.below(others.len())];
        let mut ends = [Frame::Body(one), other];
        self.source.random.shuffle(&mut ends);
        let [from, to] = ends.map(|frame| {
            let placement = self.point_placement();
            elements.point(frame, placement)
        });
        let law = match self.source.random.below(5) {
            0 => ForceLaw::Tension { from, to, tension: self.source.tension() },
            1 | 2 => self.bushing(from, to),
            3 => ForceLaw::Potential { energy: self.energy_of_distance(from, to) },
            _ => ForceLaw::SpringDamper {
                from,
                to,
                stiffness: self.source.between(10.0, 200.0, Unit::NewtonPerMetre),
                damping: self.source.between(0.1, 3.0, Unit::NewtonSecondPerMetre),
                length: self.source.between(0.1, 0.8, Unit::Metre),
            },
        };
        elements.laws.push(law);
    }

    /// A placement with axes.
    fn point_placement(&mut self) -> Placement {
        let offset = self.source.position(0.8);
        Placement { offset, ..self.source.placement() }
    }

    fn three(&mut self, low: f64, high: f64, unit: Unit) -> Values {
        [(); 3].map(|()| self.source.between(low, high, unit))
    }

    fn bushing(&mut self, from: usize, to: usize) -> ForceLaw {
        ForceLaw::Bushing {
            from,
            to,
            stiffness: self.coefficients(5.0, 100.0, Unit::NewtonPerMetre),
            damping: self.coefficients(0.1, 3.0, Unit::NewtonSecondPerMetre),
            turning_stiffness: self.coefficients(2.0, 30.0, Unit::NewtonMetrePerRadian),
            turning_damping: self.coefficients(0.1, 1.0, Unit::NewtonMetreSecondPerRadian),
        }
    }

    /// A diagonal matrix, occasionally modified: a symmetric or antisymmetric off-diagonal pair, a full matrix, a zero
    /// diagonal, or a row of zeros.
    fn coefficients(&mut self, low: f64, high: f64, unit: Unit) -> Matrix {
        let mut matrix = diagonal(self.three(low, high, unit));
        if self.source.random.chance(0.5) {
            return matrix;
        }
        let beside = 0.3 * low;
        match self.source.random.below(5) {
            kind @ (0 | 1) => {
                let [i, j] = self.source.random.of(&[[0, 1], [1, 2], [0, 2]]);
                let value = self.source.random.between(-beside, beside);
                let value = self.source.value(value, unit);
                (matrix[i][j], matrix[j][i]) = match kind {
                    0 => (value, value),
                    _ => (value, value.negated()),
                };
            }
            2 => {
                for (i, row) in matrix.iter_mut().enumerate() {
                    for (j, entry) in row.iter_mut().enumerate() {
                        if i != j {
                            let value = self.source.random.between(-beside, beside);
                            *entry = self.source.value(value, unit);
                        }
                    }
                }
            }
            3 => {
                let i = self.source.random.below(3);
                matrix[i][i] = ZERO;
                matrix[i][(i + 1) % 3] = self.source.value(-beside, unit);
            }
            _ => matrix[self.source.random.below(3)] = ORIGIN,
        }
        matrix
    }

    /// Forces at a point of a body other than the rotor. A ground-fixed force is parallel to the vertical where the
    /// body turns about the vertical.
    fn at_point(&mut self, setting: Setting, elements: &mut Elements) {
        let rotor = self.rotor.map(|(body, _)| body);
        let body = self.source.random.below(self.bodies.len());
        if rotor == Some(body) {
            return;
        }
        let turning = matches!(setting, Setting::Spinning | Setting::Climbing);
        let placement = self.point_placement();
        let point = elements.point(Frame::Body(body), placement);
        let law = match self.source.random.below(4) {
            0 => {
                let [force, moment] = [self.load(5.0, Unit::Newton), self.load(2.0, Unit::NewtonMetre)];
                let upright = |[x, y, z]: Values| {
                    if turning { [ORIGIN[0], ORIGIN[1], z] } else { [x, y, z] }
                };
                ForceLaw::Load { point, force: upright(force), moment: upright(moment), following: false }
            }
            1 => ForceLaw::Load {
                point,
                force: self.load(5.0, Unit::Newton),
                moment: self.load(2.0, Unit::NewtonMetre),
                following: true,
            },
            2 if !self.drifting => ForceLaw::Drag {
                point,
                damping: self.source.between(0.1, 2.0, Unit::NewtonSecondPerMetre),
                turning_damping: self.source.between(0.05, 0.5, Unit::NewtonMetreSecondPerRadian),
            },
            _ => {
                let axis = if turning { 2 } else { self.source.random.below(3) };
                let bound = setting == Setting::Still;
                ForceLaw::Potential { energy: self.energy_of_position(point, axis, bound) }
            }
        };
        elements.laws.push(law);
    }

    fn load(&mut self, limit: f64, unit: Unit) -> Values {
        let components = self.source.random.vector(limit);
        components.map(|component| self.source.value(component, unit))
    }

    /// Drag at a point on the rotor axis, which the rotation leaves in place.
    fn on_rotor(&mut self, elements: &mut Elements) {
        let Some((body, axis)) = self.rotor.filter(|_| !self.drifting) else {
            return;
        };
        let along = self.source.random.between(-0.4, 0.4);
        let offset = self.source.along(axis, along);
        let point = elements.point(Frame::Body(body), Placement::at(offset));
        elements.laws.push(ForceLaw::Drag {
            point,
            damping: self.source.between(0.1, 2.0, Unit::NewtonSecondPerMetre),
            turning_damping: self.source.between(0.05, 0.5, Unit::NewtonMetreSecondPerRadian),
        });
    }
}
