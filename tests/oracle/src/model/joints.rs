//! Joints and their coordinates.

use super::values::{Unit, Value};
use super::{Flexure, Frame, Placement};

/// The keyword of a joint; it determines the sequence of motions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Word {
    /// No motion.
    Fixed,
    /// A turn.
    Revolute,
    /// A slide.
    Prismatic,
    /// A screw.
    Screw,
    /// A slide and a turn along the same axis.
    Cylindrical,
    /// Two turns.
    Universal,
    /// Two slides and a turn perpendicular to them.
    Planar,
    /// Three turns.
    Spherical,
    /// Three slides and three turns.
    Free,
}

/// An elementary motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Motion {
    /// Rotation about the axis by the coordinate.
    Turn,
    /// Translation along the axis by the coordinate.
    Slide,
    /// Rotation about the axis by the coordinate, and translation along it.
    Screw {
        /// Translation per radian.
        lead: Value,
    },
}

impl Motion {
    /// Unit of the coordinate.
    pub fn unit(self) -> Unit {
        match self {
            Self::Slide => Unit::Metre,
            Self::Turn | Self::Screw { .. } => Unit::Radian,
        }
    }

    /// Unit of the coordinate's speed.
    pub fn rate_unit(self) -> Unit {
        match self {
            Self::Slide => Unit::MetrePerSecond,
            Self::Turn | Self::Screw { .. } => Unit::RadianPerSecond,
        }
    }

    /// Unit of a generalised force along the coordinate.
    pub fn force_unit(self) -> Unit {
        match self {
            Self::Slide => Unit::Newton,
            Self::Turn | Self::Screw { .. } => Unit::NewtonMetre,
        }
    }

    /// Unit of a stiffness on the coordinate.
    pub fn stiffness_unit(self) -> Unit {
        match self {
            Self::Slide => Unit::NewtonPerMetre,
            Self::Turn | Self::Screw { .. } => Unit::NewtonMetrePerRadian,
        }
    }

    /// Unit of an inertance on the coordinate.
    pub fn inertance_unit(self) -> Unit {
        match self {
            Self::Slide => Unit::Kilogram,
            Self::Turn | Self::Screw { .. } => Unit::KilogramSquareMetre,
        }
    }

    /// Unit of a damping on the coordinate.
    pub fn damping_unit(self) -> Unit {
        match self {
            Self::Slide => Unit::NewtonSecondPerMetre,
            Self::Turn | Self::Screw { .. } => Unit::NewtonMetreSecondPerRadian,
        }
    }
}

/// A prescribed constant speed `factor * input`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drive {
    /// Index of the input.
    pub input: usize,
    /// Pure number.
    pub factor: f64,
}

/// One elementary motion of a joint.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// Name of its coordinate: the joint's name if the step is the only one.
    pub name: String,
    /// Its kind.
    pub motion: Motion,
    /// Axis in the frame left by the preceding steps; not necessarily a unit vector.
    pub axis: [f64; 3],
    /// Its drive, if any.
    pub drive: Option<Drive>,
}

impl Step {
    /// A free step without a name.
    pub fn new(motion: Motion, axis: [f64; 3]) -> Self {
        Self { name: String::new(), motion, axis, drive: None }
    }

    /// The same step with a name.
    pub fn named(self, name: &str) -> Self {
        Self { name: name.to_owned(), ..self }
    }

    /// The same step, driven at `factor * input`.
    pub fn driven(self, input: usize, factor: f64) -> Self {
        Self { drive: Some(Drive { input, factor }), ..self }
    }
}

/// A joint: its steps move from its frame in `from` to its frame in `to`.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// Declared name.
    pub name: String,
    /// Its keyword.
    pub word: Word,
    /// Its motions from `from` to `to`.
    pub steps: Vec<Step>,
    /// One side; not necessarily the one nearer to the ground.
    pub from: Frame,
    /// The other side.
    pub to: Frame,
    /// Joint frame in `from`.
    pub from_placement: Placement,
    /// Joint frame in `to`.
    pub to_placement: Placement,
    /// The motion of a section of a beam, in place of the steps; the coordinates are those of the beam's own joint.
    pub flexure: Option<Flexure>,
}

impl Joint {
    /// A joint between the frames of two bodies. A single step takes the joint's name.
    pub fn new(name: &str, word: Word, mut steps: Vec<Step>, from: Frame, to: Frame) -> Self {
        if let [single] = &mut steps[..] {
            name.clone_into(&mut single.name);
        }
        Self {
            name: name.to_owned(),
            word,
            steps,
            from,
            to,
            from_placement: Placement::NONE,
            to_placement: Placement::NONE,
            flexure: None,
        }
    }

    /// Its elementary motions; none if it is a flexure.
    pub fn motions(&self) -> &[Step] {
        match self.flexure {
            Some(_) => &[],
            None => &self.steps,
        }
    }
}

/// A coordinate: a step of a joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Coordinate {
    /// Index of the joint.
    pub joint: usize,
    /// Index of the step in it.
    pub step: usize,
}
