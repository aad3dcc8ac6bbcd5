//! Positions and orientations as numbers.

use super::Oracle;
use super::bodies::{inertia, placement, vector};
use super::space::{Pose, Vector};
use crate::model::{Frame, Part, Placement};

/// Origin of a frame in the ground frame, and the rows of its rotation there.
pub type Place = ([f64; 3], [[f64; 3]; 3]);

fn place(pose: Pose<f64>) -> Place {
    (pose.origin.0, pose.rotation.0)
}

impl Oracle<'_> {
    /// Place of each body.
    pub fn poses(&self, q: &[f64], b: &[f64]) -> Vec<Place> {
        let at = self.configuration(q, &self.driven_position, b);
        at.bodies.into_iter().map(place).collect()
    }

    /// Place of a placement in a frame.
    pub fn place(&self, q: &[f64], b: &[f64], frame: Frame, within: &Placement) -> Place {
        let at = self.configuration(q, &self.driven_position, b);
        place(at.pose(frame) * placement(within, b))
    }

    /// A direction of a frame in the ground frame.
    pub fn direction(&self, q: &[f64], b: &[f64], frame: Frame, direction: [f64; 3]) -> [f64; 3] {
        let at = self.configuration(q, &self.driven_position, b);
        (at.pose(frame).rotation * Vector(direction)).0
    }

    /// Acceleration of gravity in the ground frame, m/s^2.
    pub fn gravity(&self, b: &[f64]) -> [f64; 3] {
        self.in_ground(vector(&self.model.gravity, b)).0
    }

    /// For each joint, the directions of its motions as declared: unit vectors in the ground frame.
    pub fn directions(&self, q: &[f64], b: &[f64]) -> Vec<Vec<[f64; 3]>> {
        let at = self.configuration(q, &self.driven_position, b);
        let mut directions = vec![Vec::new(); at.axes.len()];
        for branch in &self.tree {
            let sign = if branch.reversed { -1.0 } else { 1.0 };
            let axes = at.axes[branch.joint].iter();
            let axes = axes.map(|axis| {
                let turns = axis.spin.dot(axis.spin) > 0.0;
                let along = if turns { axis.spin } else { axis.slide };
                along.scaled(sign).0
            });
            directions[branch.joint] = axes.collect();
        }
        directions
    }

    /// Mass, centre and central inertia of one piece of a body in the body frame; a hole counts as solid.
    pub fn piece(part: &Part, b: &[f64]) -> (f64, [f64; 3], [[f64; 3]; 3]) {
        let whole = Part { hole: false, ..part.clone() };
        let found = inertia(&[whole], b);
        (found.mass, found.center.0, found.tensor.0)
    }
}
