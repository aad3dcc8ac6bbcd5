//! The data of a mass distribution.

use crate::algebra::{ExprId, Graph, Vector3};

/// A mass distribution in terms of arms.
#[derive(Clone, Debug)]
pub(crate) struct MassDistribution {
    /// Total mass, kg.
    pub(crate) mass: ExprId,
    /// Multiple of the identity in the second moment, kg m^2.
    pub(crate) isotropic: ExprId,
    /// The vectors in which the moments are written.
    pub(crate) arms: Vec<Arm>,
}

/// One arm.
#[derive(Clone, Debug)]
pub(crate) struct Arm {
    /// In the body frame.
    pub(crate) direction: Vector3,
    /// Weight in the first moment.
    pub(crate) first: ExprId,
    /// Weights in the second moment with each arm.
    pub(crate) second: Vec<ExprId>,
}

impl MassDistribution {
    /// Adds an arm with its weight in the first moment, and in the second with itself.
    pub(crate) fn add_arm(&mut self, g: &mut Graph, direction: Vector3, first: ExprId, second: ExprId) {
        if direction.is_zero(g) {
            return;
        }
        let zero = g.zero();
        for arm in &mut self.arms {
            arm.second.push(zero);
        }
        let mut row = vec![zero; self.arms.len()];
        row.push(second);
        self.arms.push(Arm { direction, first, second: row });
    }
}
