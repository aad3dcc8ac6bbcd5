//! Random values, some of them multiples of shared design variables.

use std::f64::consts::{FRAC_PI_2, PI};

use super::Random;
use crate::model::{DesignVariable, Placement, Unit, Value, Values};

/// The most design variables.
const MOST: usize = 8;

pub(super) struct Source {
    pub(super) random: Random,
    pub(super) design: Vec<DesignVariable>,
    /// Values are taken from small sets.
    pub(super) special: bool,
    /// How frames are oriented in a special tree.
    pub(super) frames: Frames,
    /// The axis of the last joint.
    pub(super) hinge: [f64; 3],
    /// Number of curves drawn so far.
    pub(super) curves: usize,
}

/// How frames are oriented relative to each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Frames {
    /// Parallel, joints at the origins of the bodies they carry: successive hinges share one axis.
    Aligned,
    /// Rotated by right angles, as in robot files.
    Square,
    /// Arbitrary.
    Mixed,
}

/// Frame angles: right angles, one typed with twelve digits, and one whose cosine rounds to one.
const ANGLES: [f64; 6] = [FRAC_PI_2, -FRAC_PI_2, PI, FRAC_PI_2, FRAC_PI_2 - 4.9e-12, 1e-8];

/// Axes that lie in a coordinate plane, and one that nearly coincides with a frame axis.
const LEANING: [[f64; 3]; 4] = [[1.0, 1.0, 0.0], [0.0, 3.0, -4.0], [-1.0, 0.0, 2.0], [1e-9, 1.0, 0.0]];

impl Source {
    pub(super) fn new(mut random: Random, special: bool) -> Self {
        let frames = match special {
            true => {
                let list = [Frames::Aligned, Frames::Aligned, Frames::Aligned];
                random.of(&[list, [Frames::Square, Frames::Square, Frames::Mixed]].concat())
            }
            false => Frames::Mixed,
        };
        Self { random, design: Vec::new(), special, frames, hinge: [0.0, 1.0, 0.0], curves: 0 }
    }

    /// A value equal to `number`: a number, a multiple of an existing design variable, or of a new one.
    pub(super) fn value(&mut self, number: f64, unit: Unit) -> Value {
        if number == 0.0 {
            return Value::Number(0.0);
        }
        let first = self.design.is_empty();
        if !first && self.random.chance(0.45) {
            return Value::Number(number);
        }
        let fitting: Vec<usize> = (0..self.design.len()).filter(|&k| self.design[k].unit == unit).collect();
        let full = self.design.len() == MOST;
        if !fitting.is_empty() && (full || self.random.chance(0.8)) {
            let variable = fitting[self.random.below(fitting.len())];
            return Value::Design { variable, factor: number / self.design[variable].nominal };
        }
        // A small value would need large factors elsewhere.
        if full || number.abs() < 0.1 || !(first || self.random.chance(0.3)) {
            return Value::Number(number);
        }
        // Positive, so that it can be a mass or a length elsewhere.
        let name = format!("b{}", self.design.len());
        self.design.push(DesignVariable { name, unit, nominal: number.abs() });
        Value::Design { variable: self.design.len() - 1, factor: number.signum() }
    }

    /// A value in an interval.
    pub(super) fn between(&mut self, low: f64, high: f64, unit: Unit) -> Value {
        let number = match self.special && self.random.chance(0.6) {
            true => low + (high - low) * self.random.of(&[0.25, 0.5]),
            false => self.random.between(low, high),
        };
        self.value(number, unit)
    }

    /// A position; occasionally with a zero component.
    pub(super) fn position(&mut self, limit: f64) -> Values {
        let often = if self.special { 0.7 } else { 0.3 };
        std::array::from_fn(|_| {
            let zero = self.random.chance(often);
            let number = self.random.between(-limit, limit);
            self.value(if zero { 0.0 } else { number }, Unit::Metre)
        })
    }

    /// An axis: a frame axis, or any vector, not normalised.
    pub(super) fn axis(&mut self) -> [f64; 3] {
        let mut axis = [0.0; 3];
        if self.special && self.random.chance(0.3) {
            return self.hinge;
        }
        let leaning = if self.frames == Frames::Mixed { 0.3 } else { 0.05 };
        if self.special && self.random.chance(leaning) {
            return self.random.of(&LEANING);
        }
        if self.random.chance(if self.special { 0.9 } else { 0.4 }) {
            axis[self.random.below(3)] = if self.random.chance(0.5) { 1.0 } else { -1.0 };
            return axis;
        }
        while axis.iter().map(|component| component * component).sum::<f64>() < 0.1 {
            axis = self.random.vector(2.0);
        }
        axis
    }

    /// A placement; occasionally none.
    pub(super) fn placement(&mut self) -> Placement {
        let none = match self.frames {
            Frames::Aligned => 0.3,
            Frames::Square => 0.1,
            Frames::Mixed => 0.25,
        };
        if self.random.chance(none) {
            return Placement::NONE;
        }
        let offset = self.position(0.6);
        let rotations = match self.frames {
            Frames::Aligned => usize::from(self.random.chance(0.05)),
            Frames::Square => 1 + self.random.below(2),
            Frames::Mixed => self.random.below(3),
        };
        let rotations = (0..rotations).map(|_| (self.axis(), self.angle()));
        Placement { offset, rotations: rotations.collect() }
    }

    /// The placement of a joint on the body it carries.
    pub(super) fn outer_placement(&mut self) -> Placement {
        match self.frames == Frames::Aligned && self.random.chance(0.8) {
            true => Placement::NONE,
            false => self.placement(),
        }
    }

    fn angle(&mut self) -> Value {
        if self.special && self.random.chance(0.8) {
            let angle = match self.frames {
                Frames::Square => self.random.of(&ANGLES[..4]),
                _ => self.random.of(&ANGLES),
            };
            return match self.random.chance(0.9) {
                true => Value::Number(angle),
                false => self.value(angle, Unit::Radian),
            };
        }
        self.between(-2.0, 2.0, Unit::Radian)
    }
}
