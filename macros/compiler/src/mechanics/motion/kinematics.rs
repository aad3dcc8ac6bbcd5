//! Positions, velocities and accelerations of all bodies, from the ground outwards.
//!
//! The layout determines the axes in which vectors are written. Forces, points and outputs use one common frame, which
//! is the ground frame at the instant when all running coordinates are zero; inertia uses the axes that keep its
//! equations short.
//!
//! # Running coordinates
//!
//! Nothing may depend on a coordinate that runs in steady motion, driven or coasting; one check proves it for both. The
//! speed of a coasting coordinate is an unknown and its acceleration is the rate of that unknown, so rows for
//! velocities and speeds need nothing special in the linearisation. A coasting planar joint has speeds along its turned
//! axes (quasi-velocities, `mechanics/motion/kinematics.rs`), so heading and place drop out of the equations of a
//! vehicle.

use crate::algebra::{ExprId, Graph, Matrix3, Vector3};
use crate::base::ids::{BeamId, BodyId};
use crate::mechanics::setup::{BodyLayout, CoordinateMotion, Layout, OfBeam, State, Values};
use crate::model::expression::Expr;
use crate::model::mechanism::{Frame, Joint, Mechanism, Placement, StepMotion};
use crate::topology::Topology;

use super::beam::BeamMotion;
use super::frame::FrameMotion;
use super::step_axis::StepAxis;
use super::strain::Heading;

/// Motion of a body, and of the joint that carries it.
#[derive(Clone, Debug)]
pub(crate) struct BodyMotion {
    pub(crate) frame: FrameMotion,
    /// The axes of the joint frame on the side that was declared as `from`.
    pub(crate) from_axes: Matrix3,
    /// Origin of the joint frame on the `from` side, from the body's origin.
    pub(crate) from_origin: Vector3,
    /// The elementary motions of the joint, from the parent to the body.
    pub(crate) steps: Vec<StepAxis>,
    /// The place of the joint on its parent.
    pub(crate) seat: Seat,
    /// Transforms a vector from the axes of this body's motion to those of its parent's; `None` if they are the same.
    pub(crate) to_parent: Option<Matrix3>,
    /// The beam whose station the body is, and which station.
    pub(crate) flexure: Option<(BeamId, usize)>,
}

/// How a beam bends: the motion of its sections, and its directions relative to them.
pub(crate) type Bending = (OfBeam<CoordinateMotion>, Vec<Heading>);

/// The place of a joint on the body nearer to the ground.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Seat {
    /// From the parent's origin, in the parent's body frame.
    pub(crate) arm: Vector3,
    /// The same vector in the axes of the parent's motion.
    pub(crate) offset: Vector3,
}

/// A named point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PointMotion {
    /// Position from the origin of its frame.
    pub(crate) arm: Vector3,
    /// Position from the ground's origin.
    pub(crate) position: Vector3,
    /// Its axes.
    pub(crate) axes: Matrix3,
}

/// Motion of every frame of a mechanism.
pub(crate) struct Kinematics {
    pub(crate) coordinates: Vec<CoordinateMotion>,
    pub(crate) ground: FrameMotion,
    /// By body id.
    pub(crate) bodies: Vec<BodyMotion>,
    /// By beam id.
    pub(crate) beams: Vec<BeamMotion>,
    /// By point id.
    pub(crate) points: Vec<PointMotion>,
}

impl Kinematics {
    /// Runs the recursion. `coordinates` is indexed by coordinate id. Positions and points are meaningful only if
    /// everything is written in the common frame.
    pub(crate) fn new(
        g: &mut Graph,
        mechanism: &Mechanism,
        topology: &Topology,
        values: &Values,
        (coordinates, turns): (Vec<CoordinateMotion>, Vec<Bending>),
        layout: &Layout,
        ground_acceleration: Vector3,
    ) -> Self {
        let ground = FrameMotion::ground(g, ground_acceleration);
        let placeholder = BodyMotion {
            frame: ground,
            from_axes: ground.orientation.axes,
            from_origin: ground.position,
            steps: Vec::new(),
            seat: Seat { arm: ground.position, offset: ground.position },
            to_parent: None,
            flexure: None,
        };
        let nothing =
            BeamMotion { sections: Vec::new(), directions: Vec::new(), offsets: Vec::new(), stations: Vec::new() };
        let mut this = Self {
            coordinates,
            ground,
            bodies: vec![placeholder; mechanism.bodies.len()],
            beams: vec![nothing; mechanism.beams.len()],
            points: Vec::new(),
        };
        for branch in &topology.branches {
            let parent = *this.frame(branch.parent);
            let name = mechanism.bodies[branch.body.index()].name.to_string();
            let joint = &mechanism.joints[branch.joint.index()];
            let gliding = mechanism.glides(joint);
            let body_layout = layout.of(branch.body);
            let walk = (branch.reversed, gliding);
            let motion = match joint.flexure {
                Some(flexure) => this.station(g, flexure, body_layout, &parent, &name),
                None => this.body(g, values, joint, walk, body_layout, &parent, &name),
            };
            if let Some(id) = mechanism.beam(branch.body) {
                let turns = &turns[id.index()];
                this.beams[id.index()] = BeamMotion::new(g, mechanism, values, id, &motion.frame, turns);
            }
            this.bodies[branch.body.index()] = motion;
        }
        for point in &mechanism.points {
            let placed = this.place(g, values, point.frame, &point.placement);
            placed.position.set_name(g, &point.name.to_string());
            this.points.push(placed);
        }
        this
    }

    /// A place fixed in a frame.
    pub(crate) fn place(&self, g: &mut Graph, values: &Values, frame: Frame, placement: &Placement) -> PointMotion {
        let frame = *self.frame(frame);
        let (offset, rotation) = values.placement(g, placement);
        let arm = frame.orientation.express(g, offset);
        PointMotion { arm, position: frame.position.add(g, arm), axes: frame.orientation.then_fixed(g, rotation).axes }
    }

    /// Motion of a frame.
    pub(crate) fn frame(&self, frame: Frame) -> &FrameMotion {
        match frame {
            Frame::Ground => &self.ground,
            Frame::Body(body) => &self.bodies[body.index()].frame,
        }
    }

    /// Motion of a body.
    pub(crate) fn of(&self, body: BodyId) -> &BodyMotion {
        &self.bodies[body.index()]
    }

    /// Goes from the parent through the joint frame, one elementary motion after the other, to the body. A joint
    /// declared from the body to its parent is traversed backwards, each motion about the opposite axis.
    #[allow(clippy::too_many_arguments)]
    fn body(
        &self,
        g: &mut Graph,
        values: &Values,
        joint: &Joint,
        (reversed, gliding): (bool, bool),
        layout: BodyLayout,
        parent: &FrameMotion,
        name: &str,
    ) -> BodyMotion {
        let (inboard, outboard) = if reversed {
            (&joint.to_placement, &joint.from_placement)
        } else {
            (&joint.from_placement, &joint.to_placement)
        };
        let (inboard_offset, inboard_rotation) = values.placement(g, inboard);
        let (outboard_offset, outboard_rotation) = values.placement(g, outboard);

        let mut moving = parent.departing(g).displaced(g, inboard_offset).rotated(g, inboard_rotation);
        let joint_frame = moving;
        let mut steps = Vec::new();
        let order: Vec<_> = if reversed { joint.steps.iter().rev().collect() } else { joint.steps.iter().collect() };
        if gliding {
            (moving, steps) = self.glide(g, values, joint, moving, name);
        }
        for step in order.into_iter().filter(|_| !gliding) {
            let axis = values.vector(g, &step.axis);
            let axis = if reversed { axis.neg(g) } else { axis };
            let motion = self.coordinates[step.coordinate.index()];
            let direction = moving.orientation.express(g, axis);
            let (turn, slide) = match &step.motion {
                StepMotion::Turn => (Some(direction), None),
                StepMotion::Slide => (None, Some(direction)),
                StepMotion::Screw { lead } => {
                    let lead = values.scalar(g, lead);
                    (Some(direction), Some(direction.scale(g, lead)))
                }
            };
            let point = moving.offset;
            steps.push(StepAxis { coordinate: step.coordinate, turn, slide, own_axis: axis, point });
            if let Some(slide) = slide {
                moving = moving.slid(g, slide, motion);
            }
            if let Some(direction) = turn {
                let turn = (axis, direction);
                moving = if layout.continues_run {
                    moving.turned_on(g, turn, motion, name)
                } else {
                    moving.turned(g, turn, motion, name)
                };
            }
        }

        let backwards = outboard_offset.neg(g);
        let mut frame = moving.rotated(g, outboard_rotation.map(Matrix3::transpose)).displaced(g, backwards);
        frame.position = parent.position.add(g, frame.offset);
        frame.set_names(g, name);
        for step in &mut steps {
            step.point = step.point.sub(g, frame.offset);
        }
        let (from_axes, from_origin) = if reversed {
            (frame.orientation.then_fixed(g, outboard_rotation).axes, frame.orientation.express(g, outboard_offset))
        } else {
            (joint_frame.orientation.axes, joint_frame.offset.sub(g, frame.offset))
        };
        let to_parent = layout.own_axes.then_some(frame.orientation.axes);
        if gliding {
            for step in &mut steps {
                step.own_axis = outboard_rotation.map_or(step.own_axis, |to_body| to_body.apply(g, step.own_axis));
            }
        } else {
            let axes = self.axes_in_body(g, values, joint, reversed, outboard_rotation);
            for (step, axis) in steps.iter_mut().zip(axes) {
                step.own_axis = axis;
            }
        }
        if let Some(axes) = to_parent {
            let to_own = axes.transpose();
            for step in &mut steps {
                step.slide = step.slide.map(|slide| match step.turn {
                    Some(_) => to_own.apply(g, slide),
                    None => step.own_axis,
                });
                step.turn = step.turn.map(|_| step.own_axis);
                step.point = to_own.apply(g, step.point);
            }
            frame = frame.along_own_axes(g);
        }
        BodyMotion {
            frame,
            from_axes,
            from_origin,
            steps,
            seat: Seat { arm: inboard_offset, offset: joint_frame.offset },
            to_parent,
            flexure: None,
        }
    }

    /// A station of a beam, carried by the root of the beam.
    fn station(
        &self,
        g: &mut Graph,
        (beam, station): (BeamId, usize),
        layout: BodyLayout,
        parent: &FrameMotion,
        name: &str,
    ) -> BodyMotion {
        let mut frame = self.beams[beam.index()].stations[station].section.frame;
        frame.position = parent.position.add(g, frame.offset);
        frame.set_names(g, name);
        let back = frame.offset.neg(g);
        let zero = Vector3::zero(g);
        let to_parent = layout.own_axes.then_some(frame.orientation.axes);
        if to_parent.is_some() {
            frame = frame.along_own_axes(g);
        }
        BodyMotion {
            frame,
            from_axes: parent.orientation.axes,
            from_origin: back,
            steps: Vec::new(),
            seat: Seat { arm: zero, offset: zero },
            to_parent,
            flexure: Some((beam, station)),
        }
    }
}

impl Kinematics {
    /// The axes of a joint's motions in the body's frame, from the parent to the body: each is turned by the motions
    /// after it.
    fn axes_in_body(
        &self,
        g: &mut Graph,
        values: &Values,
        joint: &Joint,
        reversed: bool,
        outboard: Option<Matrix3>,
    ) -> Vec<Vector3> {
        let mut to_body = outboard.unwrap_or_else(|| Matrix3::identity(g));
        let mut axes = Vec::new();
        let inwards: Vec<_> = if reversed { joint.steps.iter().collect() } else { joint.steps.iter().rev().collect() };
        for step in inwards {
            let axis = values.vector(g, &step.axis);
            let axis = if reversed { axis.neg(g) } else { axis };
            axes.push(to_body.apply(g, axis));
            if step.motion != StepMotion::Slide {
                let angle = self.coordinates[step.coordinate.index()].position;
                let back = Matrix3::rotation(g, axis, angle).transpose();
                to_body = to_body.multiply(g, back);
            }
        }
        axes.reverse();
        axes
    }

    /// A planar motion that nothing depends on, described by its speeds along the turned axes: quasi-velocities, with
    /// `a = vdot + omega x v`.
    fn glide(
        &self,
        g: &mut Graph,
        values: &Values,
        joint: &Joint,
        start: FrameMotion,
        name: &str,
    ) -> (FrameMotion, Vec<StepAxis>) {
        let mut moving = start;
        let mut steps = Vec::new();
        for step in joint.steps.iter().rev() {
            let axis = values.vector(g, &step.axis);
            let motion = self.coordinates[step.coordinate.index()];
            let direction = moving.orientation.express(g, axis);
            let turns = step.motion == StepMotion::Turn;
            moving = if turns {
                moving.turned(g, (axis, direction), motion, name)
            } else {
                moving.glided(g, direction, motion)
            };
            steps.push(StepAxis {
                coordinate: step.coordinate,
                turn: turns.then_some(direction),
                slide: (!turns).then_some(direction),
                own_axis: axis,
                point: moving.offset,
            });
        }
        for step in &mut steps {
            step.point = moving.offset;
        }
        (moving, steps)
    }
}

impl State for Kinematics {
    fn leaf(&self, leaf: &Expr) -> ExprId {
        match leaf {
            Expr::Coordinate(id) => self.coordinates[id.index()].position,
            Expr::Rate(id) => self.coordinates[id.index()].velocity,
            Expr::Position(id, axis) => self.points[id.index()].position.0[*axis],
            _ => unreachable!("resolution admits {leaf:?} elsewhere only"),
        }
    }
}
