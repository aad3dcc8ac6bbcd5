//! A robot as described by its file; links and joints are referred to by their indices in the lists.

use std::collections::BTreeMap;

use crate::error::{Mistake, Reason};
use crate::geometry::{Inertial, Pose, Vector};

#[derive(Clone, Debug)]
pub(crate) struct Robot {
    pub(crate) name: String,
    pub(crate) at: SourcePosition,
    pub(crate) links: Vec<Link>,
    pub(crate) joints: Vec<Joint>,
    /// Elements of the file that this type does not represent, by kind of owner (`joints`) and element, with the
    /// owners' names.
    pub(crate) ignored: BTreeMap<(&'static str, String), Vec<String>>,
}

#[derive(Clone, Debug)]
pub(crate) struct Link {
    pub(crate) name: String,
    pub(crate) at: SourcePosition,
    pub(crate) inertial: Option<Inertial>,
}

#[derive(Clone, Debug)]
pub(crate) struct Joint {
    pub(crate) name: String,
    pub(crate) at: SourcePosition,
    pub(crate) kind: JointKind,
    pub(crate) parent: usize,
    pub(crate) child: usize,
    /// Pose of the child in the parent where the coordinate is zero.
    pub(crate) pose: Pose,
    pub(crate) axis: Vector,
    pub(crate) mimic: Option<Mimic>,
    /// N m s/rad or N s/m.
    pub(crate) damping: f64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum JointKind {
    Fixed,
    Revolute,
    Prismatic,
    Planar,
    Floating,
}

impl JointKind {
    pub(crate) fn has_one_coordinate(self) -> bool {
        matches!(self, JointKind::Revolute | JointKind::Prismatic)
    }
}

/// The coordinate is `ratio` times that of another joint, plus `offset`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Mimic {
    pub(crate) of: usize,
    pub(crate) ratio: f64,
    pub(crate) offset: f64,
}

/// Position in the file: line and column, from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct SourcePosition {
    pub(crate) line: u32,
    pub(crate) column: u32,
}

impl SourcePosition {
    pub(crate) fn mistake(self, reason: Reason) -> Mistake {
        Mistake { line: self.line, column: self.column, reason }
    }
}
