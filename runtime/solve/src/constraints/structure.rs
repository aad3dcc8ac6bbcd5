//! Numbers and positions of the unknowns by role.

use core::ops::Range;

use crate::{Description, Role};

/// Numbers of unknowns by role; unknowns and rows of the residual are both in this order ([`Role`]).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[doc(hidden)]
pub struct Structure {
    #[doc(hidden)]
    pub coordinates: usize,
    pub(crate) speeds: usize,
    #[doc(hidden)]
    pub position_constraints: usize,
    pub(crate) velocity_constraints: usize,
}

impl Structure {
    #[doc(hidden)]
    pub fn of(description: &Description) -> Self {
        let mut counts = [0; 4];
        for unknown in description.coordinates.iter() {
            counts[unknown.role as usize] += 1;
        }
        let count = |role: Role| counts[role as usize];
        Self {
            coordinates: count(Role::Position),
            speeds: count(Role::Speed),
            position_constraints: count(Role::PositionReaction),
            velocity_constraints: count(Role::VelocityReaction),
        }
    }

    /// Number of all unknowns.
    pub(crate) fn size(&self) -> usize {
        self.motions() + self.constraints()
    }

    /// Whether every unknown is a coordinate: no speeds, no constraints.
    #[doc(hidden)]
    pub fn open(&self) -> bool {
        self.speeds == 0 && self.constraints() == 0
    }

    /// Whether there are neither speeds nor constraints on velocities: the free directions are those of the coordinates
    /// alone.
    #[doc(hidden)]
    pub fn holonomic(&self) -> bool {
        self.speeds == 0 && self.velocity_constraints == 0
    }

    #[doc(hidden)]
    pub fn constraints(&self) -> usize {
        self.position_constraints + self.velocity_constraints
    }

    /// Number of coordinates and speeds, the unknowns that are not reactions.
    #[doc(hidden)]
    pub fn motions(&self) -> usize {
        self.coordinates + self.speeds
    }

    /// Positions of the speeds.
    pub(crate) fn speed_range(&self) -> Range<usize> {
        self.coordinates..self.motions()
    }

    /// Positions of the constraints on positions and of their reactions.
    #[doc(hidden)]
    pub fn position_rows(&self) -> Range<usize> {
        self.motions()..self.motions() + self.position_constraints
    }

    /// Positions of the constraints on velocities and of their reactions.
    #[doc(hidden)]
    pub fn velocity_rows(&self) -> Range<usize> {
        let start = self.motions() + self.position_constraints;
        start..start + self.velocity_constraints
    }

    /// Positions of all constraints and reactions.
    pub(crate) fn constraint_rows(&self) -> Range<usize> {
        self.motions()..self.motions() + self.constraints()
    }
}
