//! The mass matrix from composite bodies: each entry follows from the force and moment that accelerate a body together
//! with everything it carries, as if all of it were one rigid body.
//!
//! # The mass matrix by composite bodies
//!
//! Each column follows from the force and moment that accelerate everything a coordinate carries, passed on towards the
//! ground (`mechanics/inertia/composite.rs`): four operations per entry of a planar chain. Turning an inertia tensor
//! about a coordinate axis, as between most joints, costs ten operations. Along a run, the absolute angle of a body
//! moves the bodies behind it with their seats without turning them: for this angle they count as point masses at their
//! seats; for the coordinates before the run, their first moments are accelerated with the seats as well.

use crate::algebra::{ExprId, Graph, Vector3};
use crate::census::taken;
use crate::mechanics::motion::{BodyMotion, FrameMotion, Kinematics, StepAxis, Tree, Wrench};
use crate::mechanics::setup::{Context, ForceSelection};
use crate::model::mechanism::Frame;

use super::augmented::{AugmentedBody, augmented_bodies, rides_on_seat};

/// Mass, first and second moment (`integral rho rho^T dm`) about a body's origin, in the axes of the body's motion.
#[derive(Clone, Copy)]
pub(crate) struct Composite {
    pub(crate) mass: ExprId,
    pub(crate) first: Vector3,
    pub(crate) second: [[ExprId; 3]; 3],
}

impl Composite {
    fn empty(g: &mut Graph) -> Self {
        let zero = g.zero();
        Self { mass: zero, first: Vector3::zero(g), second: [[zero; 3]; 3] }
    }

    fn of_body(g: &mut Graph, body: &AugmentedBody, motion: &FrameMotion) -> Self {
        let axes = motion.axes().map(|(axis, _)| axis);
        let mut this = Self::empty(g);
        this.mass = body.mass;
        for k in 0..3 {
            let share = axes[k].scale(g, body.first.0[k]);
            this.first = this.first.add(g, share);
            let diagonal = axes[k].scale(g, body.second[k][k]);
            add_symmetric(g, &mut this.second, |g, i, j| g.mul(diagonal.0[i], axes[k].0[j]));
            for j in k + 1..3 {
                let weighted = axes[j].scale(g, body.second[k][j]);
                add_products(g, &mut this.second, axes[k], weighted);
            }
        }
        let zero = g.zero();
        add_symmetric(g, &mut this.second, |_, i, j| if i == j { body.isotropic } else { zero });
        this
    }

    fn add(&mut self, g: &mut Graph, other: &Self) {
        self.mass = g.add(self.mass, other.mass);
        self.first = self.first.add(g, other.first);
        add_symmetric(g, &mut self.second, |_, i, j| other.second[i][j]);
    }

    fn add_point(&mut self, g: &mut Graph, mass: ExprId, vector: Vector3) {
        let share = vector.scale(g, mass);
        self.mass = g.add(self.mass, mass);
        self.first = self.first.add(g, share);
        add_symmetric(g, &mut self.second, |g, i, j| g.mul(vector.0[i], share.0[j]));
    }

    /// The composite about the parent's origin, in the axes of the parent's motion. Only `mass` is not part of the
    /// augmented parent.
    fn moved_to_parent(&self, g: &mut Graph, motion: &BodyMotion, mass: ExprId) -> Self {
        let mut moved = Self { mass: g.zero(), ..*self };
        if let Some(rotation) = motion.to_parent {
            moved.first = rotation.apply(g, self.first);
            moved.second = rotation.turn_symmetric(g, self.second);
        }
        let offset = motion.frame.offset;
        let first = moved.first;
        add_products(g, &mut moved.second, offset, first);
        moved.add_point(g, mass, offset);
        moved
    }
}

/// Adds a symmetric matrix, given by its entries on and above the diagonal.
pub(crate) fn add_symmetric(
    g: &mut Graph,
    matrix: &mut [[ExprId; 3]; 3],
    mut entry: impl FnMut(&mut Graph, usize, usize) -> ExprId,
) {
    for (i, j) in [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)] {
        let more = entry(g, i, j);
        let sum = g.add(matrix[i][j], more);
        (matrix[i][j], matrix[j][i]) = (sum, sum);
    }
}

/// Adds `a b^T + b a^T`.
pub(crate) fn add_products(g: &mut Graph, matrix: &mut [[ExprId; 3]; 3], a: Vector3, b: Vector3) {
    add_symmetric(g, matrix, |g, i, j| {
        let product = g.mul(a.0[i], b.0[j]);
        let mirrored = g.mul(b.0[i], a.0[j]);
        g.add(product, mirrored)
    });
}

/// Force and moment needed to accelerate a body and everything it carries by one unit along `step`.
pub(crate) fn accelerating(
    g: &mut Graph,
    step: &StepAxis,
    body: &AugmentedBody,
    motion: &FrameMotion,
    carried: &Composite,
) -> Wrench {
    let composite = Composite::of_body(g, body, motion);
    let mass = g.add(composite.mass, carried.mass);
    let first = composite.first.add(g, carried.first);
    let zero = Vector3::zero(g);
    let (mut force, mut moment) = (zero, zero);
    if let Some(axis) = step.turn {
        // the body's own share in body axes, where it is constant
        let twice = g.scale(2.0, body.isotropic);
        let own_moment = spun(g, body.second, step.own_axis);
        let isotropic = step.own_axis.scale(g, twice);
        let own_moment = own_moment.add(g, isotropic);
        let own_moment = motion.orientation.express(g, own_moment);
        let carried_moment = spun(g, carried.second, axis);
        let about_point = step.point.scale(g, mass);
        let lever = first.sub(g, about_point);
        force = axis.cross(g, lever);
        let at_origin = axis.cross(g, step.point);
        let shift = first.cross(g, at_origin);
        moment = own_moment.add(g, carried_moment).sub(g, shift);
    }
    if let Some(slide) = step.slide {
        let push = slide.scale(g, mass);
        let turning = first.cross(g, slide);
        force = force.add(g, push);
        moment = moment.add(g, turning);
    }
    Wrench { force, moment }
}

/// `integral rho x (axis x rho) dm = (tr second 1 - second) axis`, without the terms that cancel.
pub(crate) fn spun(g: &mut Graph, second: [[ExprId; 3]; 3], axis: Vector3) -> Vector3 {
    Vector3(std::array::from_fn(|i| {
        let mut sum = g.zero();
        for j in (0..3).filter(|&j| j != i) {
            let across = g.mul(second[j][j], axis.0[i]);
            let along = g.mul(second[i][j], axis.0[j]);
            let difference = g.sub(across, along);
            sum = g.add(sum, difference);
        }
        sum
    }))
}

/// The masses that bodies carry, by body id.
pub(crate) struct Composites {
    /// Everything that turns with the body's angle, with the bodies that continue its run as point masses: these move
    /// with their seats without turning.
    pub(crate) carried: Vec<Composite>,
    /// The body with everything it carries.
    pub(crate) whole: Vec<Composite>,
    /// The mass that is not part of the augmented parent; it moves to the parent's origin with the rest.
    pub(crate) apart: Vec<ExprId>,
}

impl Composites {
    pub(crate) fn new(g: &mut Graph, context: &Context, kinematics: &Kinematics, bodies: &[AugmentedBody]) -> Self {
        let count = context.mechanism.bodies.len();
        let empty = Composite::empty(g);
        let mut this = Self { carried: vec![empty; count], whole: vec![empty; count], apart: vec![empty.mass; count] };
        // the bodies that continue the run, without their point masses
        let mut going_on = vec![empty; count];
        for branch in context.topology.branches.iter().rev() {
            let index = branch.body.index();
            let motion = kinematics.of(branch.body);
            let mut whole = this.carried[index];
            whole.add(g, &going_on[index]);
            let behind = whole.mass;
            let composite = Composite::of_body(g, &bodies[index], &motion.frame);
            whole.add(g, &composite);
            let apart = if rides_on_seat(g, motion) { behind } else { whole.mass };
            (this.whole[index], this.apart[index]) = (whole, apart);
            let Frame::Body(parent) = branch.parent else {
                continue;
            };
            let carried = &mut this.carried[parent.index()];
            if context.runs.layout.of(branch.body).continues_run {
                if !g.is(apart, 0.0) {
                    taken(|| "composite: mass in a run that rides on no seat".into());
                }
                carried.add_point(g, apart, motion.frame.offset);
                let turning = whole.moved_to_parent(g, motion, empty.mass);
                going_on[parent.index()].add(g, &turning);
            } else {
                let moved = whole.moved_to_parent(g, motion, apart);
                carried.add(g, &moved);
            }
        }
        this
    }
}

/// The columns of the mass matrix with respect to the absolute angles; zero outside the moving coordinates. Only the
/// accelerations of free coordinates have columns.
pub(crate) fn mass_matrix(g: &mut Graph, context: &Context, kinematics: &Kinematics) -> Vec<Vec<ExprId>> {
    let topology = context.topology;
    let bodies = augmented_bodies(g, context, kinematics, ForceSelection::ALL);
    let Composites { carried, whole, .. } = Composites::new(g, context, kinematics, &bodies);
    let n = context.symbols.q.ids.len();
    let free = topology.free.len();
    let tree = Tree::new(context.mechanism, topology);
    let unknown = |step: &StepAxis| {
        let mut moving = topology.free.iter().chain(&topology.coasting);
        moving.position(|&id| id == step.coordinate)
    };
    let mut columns = vec![vec![g.zero(); n]; n];
    for branch in &topology.branches {
        let index = branch.body.index();
        let motion = kinematics.of(branch.body);
        for step in &motion.steps {
            let Some(j) = unknown(step) else { continue };
            let load = accelerating(g, step, &bodies[index], &motion.frame, &carried[index]);
            let mut set = |g: &mut Graph, at: &BodyMotion, load: Wrench| {
                for other in &at.steps {
                    let Some(i) = unknown(other) else { continue };
                    let entry = other.project(g, load.force, load.moment);
                    for (row, column) in [(i, j), (j, i)] {
                        if column < free {
                            columns[column][row] = entry;
                        }
                    }
                }
            };
            set(g, motion, load);
            let mut load = load;
            // a body that continues the run moves with its seat: no work along this angle, but along those before it
            for next in topology.branches.iter().filter(|next| {
                next.parent == Frame::Body(branch.body) && context.runs.layout.of(next.body).continues_run
            }) {
                let seat = kinematics.of(next.body).frame.offset;
                let acceleration = step.velocity(g, seat);
                let moment = whole[next.body.index()].first.cross(g, acceleration);
                if !moment.is_zero(g) {
                    taken(|| "composite: moment of what goes on in a run".into());
                }
                load.moment = load.moment.add(g, moment);
            }
            let mut at = *branch;
            while let Frame::Body(parent) = at.parent {
                let motion = kinematics.of(at.body);
                if let Some(rotation) = motion.to_parent {
                    load.force = rotation.apply(g, load.force);
                    load.moment = rotation.apply(g, load.moment);
                }
                let shift = motion.frame.offset.cross(g, load.force);
                load.moment = load.moment.add(g, shift);
                let turning = if context.runs.layout.of(at.body).continues_run { shift } else { load.moment };
                let seen = Wrench { moment: turning, ..load };
                set(g, kinematics.of(parent), seen);
                let Some(next) = tree.branch(parent) else {
                    break;
                };
                at = next;
            }
        }
    }
    columns
}
