//! Random joints: keywords, axes that obey the rules of each keyword, and drives that leave a steady state.

use super::tree::Builder;
use super::values::{Frames, Source};
use crate::model::{Coordinate, Joint, Model, Motion, Step, Unit, Word};

/// A joint not yet connected to bodies.
pub(super) type Draft = (Word, Vec<Step>);

pub(super) fn turn(axis: [f64; 3]) -> Step {
    Step::new(Motion::Turn, axis)
}

pub(super) fn slide(axis: [f64; 3]) -> Step {
    Step::new(Motion::Slide, axis)
}

pub(super) fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    let [p, q, r] = a;
    let [x, y, z] = b;
    [q * z - r * y, r * x - p * z, p * y - q * x]
}

pub(super) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn norm(a: [f64; 3]) -> f64 {
    dot(a, a).sqrt()
}

fn unit(a: [f64; 3]) -> [f64; 3] {
    a.map(|component| component / norm(a))
}

/// `|sin|` of the angle between two axes.
fn sine(a: [f64; 3], b: [f64; 3]) -> f64 {
    norm(cross(unit(a), unit(b)))
}

impl Source {
    /// An axis well away from the direction of another one.
    fn axis_across(&mut self, other: [f64; 3]) -> [f64; 3] {
        loop {
            let axis = self.axis();
            if sine(axis, other) > 0.3 {
                return axis;
            }
        }
    }

    /// A screw of either hand.
    fn lead(&mut self) -> Motion {
        let size = self.random.between(0.02, 0.2);
        let lead = self.random.signed(size);
        Motion::Screw { lead: self.value(lead, Unit::Metre) }
    }

    fn screw(&mut self, axis: [f64; 3]) -> Draft {
        (Word::Screw, vec![Step::new(self.lead(), axis)])
    }

    /// A slide and a turn along the same line, in the same direction.
    fn cylindrical(&mut self, axis: [f64; 3]) -> Draft {
        (Word::Cylindrical, vec![slide(axis), turn(axis)])
    }

    fn universal(&mut self, first: [f64; 3]) -> Draft {
        (Word::Universal, vec![turn(first), turn(self.axis_across(first))])
    }

    /// Two oblique slides, and a turn perpendicular to both.
    fn planar(&mut self, normal: [f64; 3]) -> Draft {
        let along = cross(normal, self.axis_across(normal));
        let across = cross(normal, along).map(|x| x / norm(normal));
        let lean = self.random.between(-0.8, 0.8);
        let second =
            if self.random.chance(0.5) { across } else { std::array::from_fn(|i| across[i] + lean * along[i]) };
        (Word::Planar, vec![slide(along), slide(second), turn(normal)])
    }

    fn three_turns(&mut self, first: [f64; 3]) -> Vec<Step> {
        let second = self.axis_across(first);
        let third = self.axis_across(second);
        vec![turn(first), turn(second), turn(third)]
    }

    fn spherical(&mut self, first: [f64; 3]) -> Draft {
        (Word::Spherical, self.three_turns(first))
    }

    /// Three slides that span space, then three turns.
    fn free(&mut self, first_turn: [f64; 3]) -> Draft {
        let one = self.axis();
        let two = self.axis_across(one);
        let mut three = self.axis();
        while dot(unit(cross(one, two)), unit(three)).abs() < 0.3 {
            three = self.axis();
        }
        let mut steps = vec![slide(one), slide(two), slide(three)];
        steps.extend(self.three_turns(first_turn));
        (Word::Free, steps)
    }

    /// Any joint with at most `room` coordinates; one coordinate is always allowed.
    pub(super) fn joint(&mut self, room: usize) -> Draft {
        let axis = match self.frames == Frames::Aligned && self.random.chance(0.6) {
            true => self.hinge,
            false => self.axis(),
        };
        self.hinge = axis;
        let hinge = if self.frames == Frames::Mixed { 0.3 } else { 0.7 };
        if self.special && self.random.chance(hinge) {
            return (Word::Revolute, vec![turn(axis)]);
        }
        let draft = match self.random.below(20) {
            0 => (Word::Fixed, Vec::new()),
            1..=3 => (Word::Prismatic, vec![slide(axis)]),
            4 | 5 => self.screw(axis),
            6 | 7 => self.cylindrical(axis),
            8..=10 => self.universal(axis),
            11 | 12 => self.planar(axis),
            13 | 14 => self.spherical(axis),
            15 | 16 => self.free(axis),
            _ => (Word::Revolute, vec![turn(axis)]),
        };
        if draft.1.len() > room {
            return (Word::Revolute, vec![turn(axis)]);
        }
        draft
    }
}

impl Builder {
    /// A joint with a driven motion about the vertical and free coordinates beyond it: constant rotation about the
    /// vertical changes nothing for the bodies it carries.
    pub(super) fn turning_joint(&mut self, vertical: [f64; 3], room: usize) -> Draft {
        let source = &mut self.source;
        match source.random.below(8) {
            0 if room > 1 => {
                let (word, mut steps) = source.universal(vertical);
                self.drive(&mut steps[0]);
                (word, steps)
            }
            1 if room > 2 => {
                let (word, mut steps) = source.spherical(vertical);
                self.drive(&mut steps[0]);
                (word, steps)
            }
            // A free or driven lift along the vertical.
            2 if room > 1 => {
                let (word, mut steps) = source.cylindrical(vertical);
                self.drive(&mut steps[1]);
                if self.source.random.chance(0.4) {
                    self.drive(&mut steps[0]);
                }
                (word, steps)
            }
            3 => {
                let (word, mut steps) = source.screw(vertical);
                self.drive(&mut steps[0]);
                (word, steps)
            }
            // Three driven slides, a driven turn, two free turns.
            4 if room > 2 => {
                let (word, mut steps) = source.free(vertical);
                self.drifting = true;
                steps[..4].iter_mut().for_each(|step| self.drive(step));
                (word, steps)
            }
            5 => {
                let (word, mut steps) = source.planar(vertical);
                self.drifting = true;
                steps.iter_mut().for_each(|step| self.drive(step));
                (word, steps)
            }
            _ => {
                let mut step = turn(vertical);
                self.drive(&mut step);
                (Word::Revolute, vec![step])
            }
        }
    }

    /// A joint with a driven slide anywhere in its sequence: all its motions take place in a uniformly moving frame.
    pub(super) fn sliding_joint(&mut self, axis: [f64; 3], room: usize) -> Draft {
        let source = &mut self.source;
        let (word, mut steps) = match source.random.below(8) {
            0 if room > 1 => source.cylindrical(axis),
            1 if room > 2 => source.planar(axis),
            2 if room > 5 => source.free(axis),
            _ => (Word::Prismatic, vec![slide(axis)]),
        };
        self.drive(&mut steps[0]);
        for step in steps.iter_mut().skip(1) {
            if step.motion == Motion::Slide && self.source.random.chance(0.4) {
                self.drive(step);
            }
        }
        (word, steps)
    }

    /// A joint whose last turn is driven about the symmetry axis of the body it carries.
    pub(super) fn spinning_joint(&mut self, symmetry: [f64; 3], room: usize) -> Draft {
        let source = &mut self.source;
        let (word, mut steps) = match source.random.below(6) {
            0 if room > 1 => source.cylindrical(symmetry),
            1 if room > 1 => {
                let (word, mut steps) = source.universal(symmetry);
                steps.reverse();
                (word, steps)
            }
            2 if room > 2 => {
                let (word, mut steps) = source.spherical(symmetry);
                steps.reverse();
                (word, steps)
            }
            _ => (Word::Revolute, vec![turn(symmetry)]),
        };
        if let Some(last) = steps.last_mut() {
            self.drive(last);
        }
        (word, steps)
    }
}

/// Names every joint and its coordinates.
pub(super) fn name(joints: &mut [Joint]) {
    for (index, joint) in joints.iter_mut().enumerate() {
        joint.name = format!("joint{index}");
        let several = joint.steps.len() > 1;
        for (step, place) in joint.steps.iter_mut().zip('a'..) {
            step.name = if several { format!("joint{index}{place}") } else { joint.name.clone() };
        }
    }
}

/// Moves the middle one of three free angles away from poses in which their axes lie in a plane: `a1 . (a2 x R2 a3)` is
/// `|a1 x a2| |a2 x a3|` times the sine of an angle that grows with the middle one, so a quarter turn helps.
pub(super) fn leave_singular_poses(model: &Model, q: &mut [f64]) {
    let free = model.free();
    for (index, joint) in model.joints.iter().enumerate() {
        let turns: Vec<usize> =
            (0..joint.steps.len()).filter(|&step| joint.steps[step].motion != Motion::Slide).collect();
        let &[first, middle, last] = &turns[..] else {
            continue;
        };
        let place = |step: usize| Coordinate { joint: index, step };
        let Some(angle) = free.iter().position(|&other| other == place(middle)) else {
            continue;
        };
        let [a, b, c] = [first, middle, last].map(|step| unit(joint.steps[step].axis));
        let largest = norm(cross(a, b)) * norm(cross(b, c));
        let volume = dot(a, cross(b, rotated(c, b, q[angle])));
        if volume.abs() < 0.5 * largest {
            q[angle] += std::f64::consts::FRAC_PI_2;
        }
    }
}

/// `v` turned about a unit axis: `v cos + a x v sin + a (a . v) (1 - cos)`.
fn rotated(v: [f64; 3], axis: [f64; 3], angle: f64) -> [f64; 3] {
    let (sine, cosine) = angle.sin_cos();
    let (across, along) = (cross(axis, v), dot(axis, v) * (1.0 - cosine));
    std::array::from_fn(|i| v[i] * cosine + across[i] * sine + axis[i] * along)
}
