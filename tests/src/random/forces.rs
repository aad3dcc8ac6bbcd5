//! Random springs and dampers that leave a steady state.

use super::tree::Builder;
use crate::model::{Force, ForceLaw, Frame, JointKind, Point, Unit};

impl Builder {
    /// Springs and dampers on coordinates, and between points that no drive moves relative to each other.
    pub(super) fn forces(&mut self) -> (Vec<Point>, Vec<Force>) {
        let mut laws = Vec::new();
        for joint in 0..self.joints.len() {
            self.on_coordinate(joint, &mut laws);
        }
        let mut points = Vec::new();
        for _ in 0..self.source.random.below(3) {
            self.between_points(&mut points, &mut laws);
        }
        let name = |index| format!("force{index}");
        let forces = laws
            .into_iter()
            .enumerate()
            .map(|(i, law)| Force { name: name(i), law });
        (points, forces.collect())
    }

    fn on_coordinate(&mut self, joint: usize, laws: &mut Vec<ForceLaw>) {
        let [stiffness, damping, rest] = match self.joints[joint].kind {
            JointKind::Fixed => return,
            JointKind::Revolute(_) => [
                Unit::NewtonMetrePerRadian,
                Unit::NewtonMetreSecondPerRadian,
                Unit::Radian,
            ],
            JointKind::Prismatic(_) => [
                Unit::NewtonPerMetre,
                Unit::NewtonSecondPerMetre,
                Unit::Metre,
            ],
        };
        if self.joints[joint].drive.is_some() {
            return;
        }
        // Nothing but a spring holds a slider against its weight.
        let slider = matches!(self.joints[joint].kind, JointKind::Prismatic(_));
        if slider || self.source.random.chance(0.6) {
            let stiffness = self.source.between(5.0, 80.0, stiffness);
            let rest = self.source.between(-0.3, 0.3, rest);
            laws.push(ForceLaw::Spring {
                joint,
                stiffness,
                rest,
            });
        }
        if self.source.random.chance(0.35) {
            let damping = self.source.between(0.1, 2.0, damping);
            laws.push(ForceLaw::Damper { joint, damping });
        }
    }

    fn between_points(&mut self, points: &mut Vec<Point>, laws: &mut Vec<ForceLaw>) {
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
        for frame in ends {
            let (name, position) = (format!("point{}", points.len()), self.source.position(0.8));
            points.push(Point {
                name,
                frame,
                position,
            });
        }
        laws.push(ForceLaw::SpringDamper {
            from: points.len() - 2,
            to: points.len() - 1,
            stiffness: self.source.between(10.0, 200.0, Unit::NewtonPerMetre),
            damping: self.source.between(0.1, 3.0, Unit::NewtonSecondPerMetre),
            length: self.source.between(0.1, 0.8, Unit::Metre),
        });
    }
}
