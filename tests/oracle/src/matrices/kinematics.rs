//! Poses of bodies, and the velocity transformation `xdot = B_D u + B_R qdot_R` (eq. 4).

use super::bodies::{inertia, placement, value};
use super::space::{Matrix, Pose, Vector, rotation, unit};
use super::{Oracle, Scalar};
use crate::model::{Branch, Coordinate, Frame, Motion, Step};

/// The configuration of the mechanism in the ground frame.
pub(crate) struct Configuration<D> {
    /// The ground itself: the identity unless the oracle is rotated.
    pub(crate) ground: Pose<D>,
    /// Pose of each body.
    pub(crate) bodies: Vec<Pose<D>>,
    /// Centre of mass of each body.
    pub(crate) centers: Vec<Vector<D>>,
    /// The axis of every step of every joint.
    pub(crate) axes: Vec<Vec<Axis<D>>>,
}

/// The motion, at unit speed of a step, of everything beyond it: rotation `spin` about `origin` and translation
/// `slide`.
#[derive(Clone, Copy)]
pub(crate) struct Axis<D> {
    pub(crate) origin: Vector<D>,
    pub(crate) spin: Vector<D>,
    pub(crate) slide: Vector<D>,
}

impl<D: Scalar> Configuration<D> {
    pub(crate) fn pose(&self, frame: Frame) -> Pose<D> {
        match frame {
            Frame::Ground => self.ground,
            Frame::Body(body) => self.bodies[body],
        }
    }
}

/// The velocity transformation, one column per coordinate. A column holds for each body the three components of its
/// centre-of-mass velocity, then those of its angular velocity, all in the ground frame.
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

/// The components of one body: velocity of the centre of mass, then angular velocity.
pub(crate) fn of_body<D: Scalar>(rows: &[D], body: usize) -> (Vector<D>, Vector<D>) {
    let three = |start: usize| Vector([rows[start], rows[start + 1], rows[start + 2]]);
    (three(6 * body), three(6 * body + 3))
}

pub(crate) fn rows_of<D: Scalar>(linear: Vector<D>, angular: Vector<D>) -> [D; 6] {
    let ([a, b, c], [d, e, f]) = (linear.0, angular.0);
    [a, b, c, d, e, f]
}

/// The displacement of a step by `q`.
fn displacement<D: Scalar>(step: &Step, q: D, design: &[D]) -> Pose<D> {
    let e = Vector::constant(unit(step.axis));
    let zero = Pose::identity();
    match step.motion {
        Motion::Turn => Pose { rotation: rotation(step.axis, q), ..zero },
        Motion::Slide => Pose { origin: e.scaled(q), ..zero },
        Motion::Screw { lead } => Pose { rotation: rotation(step.axis, q), origin: e.scaled(value(lead, design) * q) },
    }
}

/// The axis of a step in the given frame; `sign` is -1 when the step is traversed backwards.
fn axis<D: Scalar>(step: &Step, frame: Pose<D>, sign: f64, design: &[D]) -> Axis<D> {
    let e = (frame.rotation * Vector::constant(unit(step.axis))).scaled(D::from(sign));
    let (spin, slide) = match step.motion {
        Motion::Turn => (e, Vector::zero()),
        Motion::Slide => (Vector::zero(), e),
        Motion::Screw { lead } => (e, e.scaled(value(lead, design))),
    };
    Axis { origin: frame.origin, spin, slide }
}

impl Oracle<'_> {
    /// Pose of every body: `X_child = X_parent X_from J_1(q_1) ... J_k(q_k) X_to^-1`. A joint declared from the child
    /// to its parent is traversed the other way, `X_child = X_parent X_to J_k(-q_k) ... J_1(-q_1) X_from^-1`.
    pub(crate) fn configuration<D: Scalar>(&self, free: &[D], driven: &[D], design: &[D]) -> Configuration<D> {
        let model = self.model;
        let zero = Pose::identity();
        let mut at = Configuration {
            ground: Pose { rotation: Matrix::constant(self.ground), ..zero },
            bodies: vec![zero; model.bodies.len()],
            centers: vec![Vector::zero(); model.bodies.len()],
            axes: vec![Vec::new(); model.joints.len()],
        };
        for branch in &self.tree {
            let joint = &model.joints[branch.joint];
            let from = placement(&joint.from_placement, design);
            let to = placement(&joint.to_placement, design);
            let (inboard, outboard, sign) = if branch.reversed { (to, from, -1.0) } else { (from, to, 1.0) };
            let mut order: Vec<usize> = (0..joint.motions().len()).collect();
            if branch.reversed {
                order.reverse();
            }
            let mut frame = at.pose(branch.parent) * inboard;
            let mut axes = Vec::new();
            if let Some(flexure) = joint.flexure {
                (frame, axes) = self.across(flexure, branch.reversed, frame, [free, driven, design]);
            }
            for &step in &order {
                let coordinate = Coordinate { joint: branch.joint, step };
                let q = self.coordinate(coordinate, free, driven) * sign;
                let step = &joint.steps[step];
                axes.push(axis(step, frame, sign, design));
                frame = frame * displacement(step, q, design);
            }
            if branch.reversed && joint.flexure.is_none() {
                axes.reverse();
            }
            at.axes[branch.joint] = axes;
            let pose = frame * outboard.inverse();
            at.bodies[branch.body] = pose;
            at.centers[branch.body] = pose.point(inertia(&model.bodies[branch.body].parts, design).center);
        }
        at
    }

    /// Looks up the value of a coordinate.
    pub(crate) fn coordinate<D: Scalar>(&self, coordinate: Coordinate, free: &[D], driven: &[D]) -> D {
        let place = |list: &[Coordinate]| list.iter().position(|&other| other == coordinate);
        match place(&self.free) {
            Some(index) => free[index],
            None => driven[place(&self.driven).expect("free or driven")],
        }
    }

    /// `B_D` and `B_R` (eq. 4), column by column.
    pub(crate) fn velocity_transformation<D: Scalar>(&self, at: &Configuration<D>) -> VelocityTransformation<D> {
        let columns = |coordinates: &[Coordinate]| -> Columns<D> {
            let columns = coordinates.iter();
            columns.map(|&q| self.column(at, q)).collect()
        };
        VelocityTransformation { driven: columns(&self.driven), free: columns(&self.free) }
    }

    /// The velocities that unit speed of one coordinate gives the bodies it carries: `v = s x (c - o) + t` and
    /// `omega = s` with the spin `s` about `o` and the slide `t` of its axis.
    fn column<D: Scalar>(&self, at: &Configuration<D>, coordinate: Coordinate) -> Vec<D> {
        let mut column = vec![D::zero(); 6 * at.bodies.len()];
        let joints = (0..self.carried.len()).filter(|&joint| self.moves(coordinate, joint));
        for joint in joints {
            let axis = at.axes[joint][coordinate.step];
            for &body in &self.carried[joint] {
                let velocity = axis.spin.cross(at.centers[body] - axis.origin) + axis.slide;
                let ds = rows_of(velocity, axis.spin);
                for (sum, entry) in column[6 * body..].iter_mut().zip(ds) {
                    *sum += entry;
                }
            }
        }
        column
    }

    /// By free coordinate, the twist per unit rate of a body, in the ground frame: its angular velocity, then the
    /// velocity of what it carries through the origin.
    pub fn twists(&self, q: &[f64], b: &[f64], body: usize) -> Vec<[f64; 6]> {
        let at = self.configuration(q, &self.driven_position, b);
        let columns = self.velocity_transformation(&at).free;
        let twist = |column: &Vec<f64>| {
            let (velocity, spin) = of_body(column, body);
            let at_origin = velocity - spin.cross(at.centers[body]);
            rows_of(spin, at_origin)
        };
        columns.iter().map(twist).collect()
    }
}

/// For each joint, the bodies that it carries.
pub(crate) fn carried(tree: &[Branch], joints: usize) -> Vec<Vec<usize>> {
    let mut carried = vec![Vec::new(); joints];
    for branch in tree {
        carried[branch.joint].push(branch.body);
        // Parents come first, so the joints that carry the parent are already known.
        if let Frame::Body(parent) = branch.parent {
            for bodies in carried.iter_mut().filter(|list| list.contains(&parent)) {
                if !bodies.contains(&branch.body) {
                    bodies.push(branch.body);
                }
            }
        }
    }
    carried
}
