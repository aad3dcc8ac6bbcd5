//! Poses of bodies, and the velocity transformation `xdot = B_D u + B_R qdot_R` (eq. 4).

use super::bodies::{inertia, placement};
use super::space::{Matrix, Pose, Vector, rotation, unit};
use super::{Oracle, Scalar};
use crate::model::{Frame, JointKind};

/// Where everything is, in the ground frame.
pub(crate) struct Configuration<D> {
    /// The ground itself: the identity unless the oracle is turned.
    pub(crate) ground: Pose<D>,
    /// Pose of each body.
    pub(crate) bodies: Vec<Pose<D>>,
    /// Centre of mass of each body.
    pub(crate) centers: Vec<Vector<D>>,
    /// Direction and origin of each joint's axis; the direction is zero for a fixed joint.
    pub(crate) axes: Vec<(Vector<D>, Vector<D>)>,
}

impl<D: Scalar> Configuration<D> {
    pub(crate) fn pose(&self, frame: Frame) -> Pose<D> {
        match frame {
            Frame::Ground => self.ground,
            Frame::Body(body) => self.bodies[body],
        }
    }
}

/// The velocity transformation: one column per coordinate, and in it for each body the three components of the
/// velocity of its centre of mass, then those of its angular velocity, all in the ground frame.
pub(crate) type Columns<D> = Vec<Vec<D>>;

/// `B_D` and `B_R`.
pub(crate) struct VelocityTransformation<D> {
    pub(crate) driven: Columns<D>,
    pub(crate) free: Columns<D>,
}

/// `B v`.
pub(crate) fn times<D: Scalar>(columns: &Columns<D>, vector: &[D], rows: usize) -> Vec<D> {
    let mut product = vec![D::zero(); rows];
    for (column, &factor) in columns.iter().zip(vector) {
        for (sum, &entry) in product.iter_mut().zip(column) {
            *sum += entry * factor;
        }
    }
    product
}

/// `B^T x`.
pub(crate) fn transposed_times<D: Scalar>(columns: &Columns<D>, x: &[D]) -> Vec<D> {
    let product = |column: &Vec<D>| column.iter().zip(x).map(|(&entry, &x)| entry * x).sum();
    columns.iter().map(product).collect()
}

impl Oracle<'_> {
    /// Pose of every body: `X_child = X_parent X_from J(q) X_to^-1`; a joint declared from the child to its parent
    /// is passed the other way, `X_child = X_parent X_to J(-q) X_from^-1`.
    pub(crate) fn configuration<D: Scalar>(
        &self,
        free: &[D],
        driven: &[D],
        design: &[D],
    ) -> Configuration<D> {
        let model = self.model;
        let zero = Pose::identity();
        let mut at = Configuration {
            ground: Pose {
                rotation: Matrix::constant(self.ground),
                ..zero
            },
            bodies: vec![zero; model.bodies.len()],
            centers: vec![Vector::zero(); model.bodies.len()],
            axes: vec![(Vector::zero(), Vector::zero()); model.joints.len()],
        };
        for branch in &self.tree {
            let joint = &model.joints[branch.joint];
            let coordinate = self.coordinate(branch.joint, free, driven);
            let from = placement(&joint.from_placement, design);
            let to = placement(&joint.to_placement, design);
            let (inboard, outboard, sign) = if branch.reversed {
                (to, from, -1.0)
            } else {
                (from, to, 1.0)
            };
            let frame = at.pose(branch.parent) * inboard;
            let displacement = coordinate * sign;
            let (motion, axis) = match joint.kind {
                JointKind::Fixed => (zero, Vector::zero()),
                JointKind::Revolute(axis) => {
                    let turn = Pose {
                        rotation: rotation(axis, displacement),
                        ..zero
                    };
                    (turn, Vector::constant(unit(axis)))
                }
                JointKind::Prismatic(axis) => {
                    let axis = Vector::constant(unit(axis));
                    (
                        Pose {
                            origin: axis.scaled(displacement),
                            ..zero
                        },
                        axis,
                    )
                }
            };
            // A reversed joint moves the outer body backwards along the axis.
            let direction = (frame.rotation * axis).scaled(D::from(sign));
            at.axes[branch.joint] = (direction, frame.origin);
            let pose = frame * motion * outboard.inverse();
            at.bodies[branch.body] = pose;
            at.centers[branch.body] =
                pose.point(inertia(&model.bodies[branch.body].shape, design).center);
        }
        at
    }

    /// The value of a joint's coordinate; zero for a fixed joint.
    pub(crate) fn coordinate<D: Scalar>(&self, joint: usize, free: &[D], driven: &[D]) -> D {
        if let Some(index) = self.free.iter().position(|&other| other == joint) {
            return free[index];
        }
        let index = self.driven.iter().position(|&other| other == joint);
        index.map_or(D::zero(), |index| driven[index])
    }

    /// `B_D` and `B_R` (eq. 4), column by column.
    pub(crate) fn velocity_transformation<D: Scalar>(
        &self,
        at: &Configuration<D>,
    ) -> VelocityTransformation<D> {
        let columns = |joints: &[usize]| -> Columns<D> {
            joints.iter().map(|&joint| self.column(at, joint)).collect()
        };
        VelocityTransformation {
            driven: columns(&self.driven),
            free: columns(&self.free),
        }
    }

    /// The velocities that a unit speed of one joint gives to the bodies it carries: about an axis `a` through `o`
    /// `v = a x (c - o)` and `omega = a`; along it `v = a` and `omega = 0`.
    fn column<D: Scalar>(&self, at: &Configuration<D>, joint: usize) -> Vec<D> {
        let (axis, origin) = at.axes[joint];
        let mut column = vec![D::zero(); 6 * at.bodies.len()];
        for (body, carried) in self.carried(joint).into_iter().enumerate() {
            if !carried {
                continue;
            }
            let (velocity, spin) = match self.model.joints[joint].kind {
                JointKind::Revolute(_) => (axis.cross(at.centers[body] - origin), axis),
                JointKind::Prismatic(_) => (axis, Vector::zero()),
                JointKind::Fixed => (Vector::zero(), Vector::zero()),
            };
            column[6 * body..6 * body + 3].copy_from_slice(&velocity.0);
            column[6 * body + 3..6 * body + 6].copy_from_slice(&spin.0);
        }
        column
    }

    /// Which bodies hang on a joint.
    fn carried(&self, joint: usize) -> Vec<bool> {
        let mut carried = vec![false; self.model.bodies.len()];
        for branch in &self.tree {
            let inherits = matches!(branch.parent, Frame::Body(parent) if carried[parent]);
            carried[branch.body] = inherits || branch.joint == joint;
        }
        carried
    }
}
