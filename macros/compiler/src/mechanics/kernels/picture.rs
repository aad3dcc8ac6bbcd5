//! Poses of the bodies and of the sections of beams, and the shapes of bodies, joints and points in the frames that carry
//! them.
//!
//! # Pictures are written in body frames
//!
//! Only the poses of bodies and sections depend on the state; solids, joints and points are written in the frames that
//! carry them and depend at most on the design. The kernel `picture` returns only the numbers that vary;
//! `Mechanism::PICTURE` holds the constants, the names and the places of the computed numbers. Callers that need no
//! picture do not compile it.

mod shafts;

use crate::algebra::{Array, ExprId, Function, Graph, Matrix3, Vector3};
use crate::base::ids::{BeamId, BodyId, JointId, PointId};
use crate::mechanics::kernel_name::KernelName;
use crate::mechanics::motion::{Kinematics, offset, unbent};
use crate::mechanics::picture::{Picture, PictureBeam, PictureBody, PictureJoint, PictureLink, SolidKind};
use crate::mechanics::setup::{Context, Values};
use crate::model::expression::{Expr, Vector};
use crate::model::mechanism::{
    Beam, Body, Constraint, ConstraintLaw, Force, ForceLaw, Joint, Motion, Part, Placement, Section, Shape,
};

use super::parameters::parameter;

/// The function that computes the numbers of a picture, and how to interpret them.
pub(crate) fn picture(g: &mut Graph, context: &Context, kinematics: &Kinematics) -> (Function, Picture) {
    let (mechanism, symbols) = (context.mechanism, context.symbols);
    let mut numbers = Numbers::new(context.values);
    for body in &kinematics.bodies {
        numbers.pose(body.frame.position, body.frame.orientation.axes);
    }
    for id in (0..mechanism.beams.len()).map(BeamId::new) {
        numbers.poses_of_beam(g, kinematics, id, &mechanism.beams[id.index()]);
    }
    for shaft in &mechanism.shafts {
        numbers.poses_of_shaft(g, kinematics, shaft);
    }
    let bodies = mechanism.bodies.iter().enumerate();
    let bodies = bodies.map(|(index, body)| {
        let mut shown = numbers.body(g, body);
        shown.solids.extend(numbers.spoke(g, mechanism, BodyId::new(index)));
        shown
    });
    let bodies = bodies.collect();
    let beams = mechanism.beams.chunk_by(|a, b| a.whole == b.whole);
    let mut beams: Vec<PictureBeam> = beams.filter_map(|parts| numbers.beam(g, parts)).collect();
    beams.extend(mechanism.shafts.iter().map(|shaft| numbers.shaft(g, shaft)));
    let joints = mechanism.joints.iter().enumerate();
    let joints = joints.map(|(index, joint)| {
        let cut = context.topology.cut.contains(&JointId::new(index));
        let driven = joint.steps.iter().any(|step| {
            let motion = &mechanism.coordinates[step.coordinate.index()].motion;
            matches!(motion, Motion::Driven(_)) && motion.runs()
        });
        PictureJoint { cut, driven, ..numbers.joint(g, joint) }
    });
    let joints = joints.collect();
    for point in &mechanism.points {
        numbers.declared(g, &point.placement.offset);
    }
    let axes = |g: &mut Graph, point: PointId| {
        let placement = &mechanism.points[point.index()].placement;
        context.values.placement(g, placement).1
    };
    let wheels = mechanism.constraints.iter();
    let wheels = wheels.filter_map(|constraint| numbers.wheel(g, axes, constraint));
    let wheels = wheels.collect();
    numbers.declared(g, &mechanism.gravity);
    let (numbers, computed, values) = numbers.split(g);
    let function = Function {
        name: KernelName::Picture.name(),
        parameters: vec![parameter("q", &symbols.q), parameter("u", &symbols.u), parameter("b", &symbols.b)],
        results: vec![Array { name: "picture", shape: vec![values.len()], values }],
    };
    let points = mechanism.points.iter();
    let picture = Picture {
        bodies,
        beams,
        joints,
        points: points.map(|point| (point.name.to_string(), point.frame)).collect(),
        links: forces(&mechanism.forces).chain(constraints(&mechanism.constraints)).collect(),
        wheels,
        elements: mechanism.elements(),
        numbers,
        computed,
    };
    (function, picture)
}

fn forces(forces: &[Force]) -> impl Iterator<Item = PictureLink> + '_ {
    forces.iter().filter_map(|force| {
        let (kind, from, to) = match &force.law {
            ForceLaw::SpringDamper { from, to, .. } => ("spring_damper", from, to),
            ForceLaw::Tension { from, to, .. } => ("tension", from, to),
            ForceLaw::Bushing { from, to, .. } => ("bushing", from, to),
            ForceLaw::CoordinateSpring { .. }
            | ForceLaw::CoordinateDamper { .. }
            | ForceLaw::CoordinateInerter { .. }
            | ForceLaw::Generalized { .. }
            | ForceLaw::Potential { .. }
            | ForceLaw::Load { .. }
            | ForceLaw::Distributed { .. }
            | ForceLaw::Drag { .. } => return None,
        };
        Some(PictureLink { name: force.name.to_string(), kind, ends: [*from, *to] })
    })
}

fn constraints(constraints: &[Constraint]) -> impl Iterator<Item = PictureLink> + '_ {
    constraints.iter().filter_map(|constraint| {
        let (kind, from, to) = match &constraint.law {
            ConstraintLaw::Coincident { from, to, .. } => ("coincident", from, to),
            ConstraintLaw::Aligned { from, to, .. } => ("aligned", from, to),
            ConstraintLaw::Distance { from, to, .. } => ("distance", from, to),
            ConstraintLaw::Equation { .. } | ConstraintLaw::Rolling { .. } => return None,
        };
        Some(PictureLink { name: constraint.name.to_string(), kind, ends: [*from, *to] })
    })
}

/// The numbers of a picture, one after the other.
struct Numbers<'a> {
    values: &'a Values<'a>,
    all: Vec<ExprId>,
}

impl<'a> Numbers<'a> {
    fn new(values: &'a Values<'a>) -> Self {
        let all = Vec::new();
        Self { values, all }
    }

    fn vector(&mut self, vector: Vector3) {
        self.all.extend(vector.0);
    }

    fn pose(&mut self, position: Vector3, axes: Matrix3) {
        self.vector(position);
        axes.transpose().0.into_iter().for_each(|row| self.vector(row));
    }

    fn number(&mut self, g: &mut Graph, value: &Expr) {
        let value = self.values.scalar(g, value);
        self.all.push(value);
    }

    fn declared(&mut self, g: &mut Graph, vector: &Vector) {
        let vector = self.values.vector(g, vector);
        self.vector(vector);
    }

    /// The poses of the sections of a beam: at the root, at the places of quadrature and at the tip.
    fn poses_of_beam(&mut self, g: &mut Graph, kinematics: &Kinematics, id: BeamId, beam: &Beam) {
        let values = self.values;
        let own_axes = Matrix3([0, 1, 2].map(|k| values.vector(g, &beam.axes[k])));
        let root = &kinematics.of(beam.body).frame;
        let motion = &kinematics.beams[id.index()];
        let axes = root.orientation.axes.multiply(g, own_axes);
        self.section(g, (root.position, axes), &beam.root);
        let length = values.scalar(g, &beam.length);
        let rule = beam.quadrature();
        for ((fraction, _, section), bent) in beam.sections.iter().zip(&motion.sections) {
            let mut position = root.position;
            for (direction, share) in motion.directions.iter().zip(rule.integrals_to(*fraction)) {
                let reach = g.scale(share, length);
                let arm = direction.vector.scale(g, reach);
                position = position.add(g, arm);
            }
            self.section(g, (position, bent.frame.orientation.axes), section);
        }
        if let Some(tip) = beam.stations.last() {
            let frame = &kinematics.of(tip.body).frame;
            let axes = frame.orientation.axes.multiply(g, own_axes);
            self.section(g, (frame.position, axes), &tip.section);
        }
    }

    /// The pose of a section at its centre of mass, from its place on the axis and the axes it would have without twist and
    /// prebend.
    fn section(&mut self, g: &mut Graph, (place, axes): (Vector3, Matrix3), section: &Section) {
        let arm = offset(g, self.values, section);
        let arm = axes.apply(g, arm);
        let center = place.add(g, arm);
        let turn = unbent(g, self.values, section);
        self.pose(center, axes.multiply(g, turn));
    }

    /// A declared beam, from its parts between loads.
    fn beam(&mut self, g: &mut Graph, parts: &[Beam]) -> Option<PictureBeam> {
        let mut sections = 0;
        for beam in parts {
            let places = beam.sections.iter().map(|(_, _, section)| section);
            let tip = beam.stations.last().map(|station| &station.section);
            for section in [&beam.root].into_iter().chain(places).chain(tip) {
                section.size.iter().for_each(|size| self.number(g, size));
                sections += 1;
            }
        }
        let first = parts.first()?;
        Some(PictureBeam { name: first.whole.to_string(), sections, round: first.round })
    }

    fn body(&mut self, g: &mut Graph, body: &Body) -> PictureBody {
        let solids = body.parts.iter();
        PictureBody {
            name: body.name.to_string(),
            solids: solids.map(|part| (self.solid(g, part), part.hole)).collect(),
        }
    }

    fn solid(&mut self, g: &mut Graph, part: &Part) -> SolidKind {
        let Part { shape, placement, .. } = part;
        let (offset, rotation) = self.values.placement(g, placement);
        let center = self.values.vector(g, shape.reduced().center);
        let position = turned(g, rotation, center).add(g, offset);
        self.vector(position);
        let direction = |numbers: &mut Self, g: &mut Graph, direction: &Vector| {
            let direction = numbers.values.vector(g, direction);
            let direction = turned(g, rotation, direction);
            numbers.vector(direction);
        };
        match shape {
            Shape::Point { mass, .. } => {
                self.number(g, mass);
                SolidKind::Point
            }
            Shape::Rod { length, along, .. } => {
                direction(self, g, along);
                self.number(g, length);
                SolidKind::Rod
            }
            Shape::Disk { radius, axis, .. } => {
                direction(self, g, axis);
                self.number(g, radius);
                SolidKind::Disk
            }
            Shape::Cylinder { radius, length, axis, .. } => {
                direction(self, g, axis);
                self.number(g, radius);
                self.number(g, length);
                SolidKind::Cylinder
            }
            Shape::Tube { inner, outer, length, axis, .. } => {
                direction(self, g, axis);
                for value in [inner, outer, length] {
                    self.number(g, value);
                }
                SolidKind::Tube
            }
            Shape::Cuboid { size, .. } => {
                self.axes(g, rotation);
                self.declared(g, size);
                SolidKind::Box
            }
            Shape::Sphere { radius, .. } => {
                self.number(g, radius);
                SolidKind::Sphere
            }
            Shape::Rigid { mass, inertia, about, .. } => {
                self.axes(g, rotation);
                self.number(g, mass);
                for entry in inertia {
                    self.number(g, entry);
                }
                let about = match about {
                    Some(about) => self.values.vector(g, about).sub(g, center),
                    None => Vector3::zero(g),
                };
                self.vector(about);
                SolidKind::Rigid
            }
        }
    }

    /// The axes of a frame, one after the other.
    fn axes(&mut self, g: &mut Graph, rotation: Option<Matrix3>) {
        rotation.unwrap_or_else(|| Matrix3::identity(g)).0.into_iter().for_each(|axis| self.vector(axis));
    }

    fn joint(&mut self, g: &mut Graph, joint: &Joint) -> PictureJoint {
        let mut side = |placement: &Placement, axis: Option<&Vector>| {
            let (offset, rotation) = self.values.placement(g, placement);
            let axis = match axis {
                Some(axis) => self.values.vector(g, axis),
                None => Vector3::zero(g),
            };
            let axis = turned(g, rotation, axis);
            self.vector(offset);
            self.vector(axis);
        };
        let (first, last) = (joint.steps.first(), joint.steps.last());
        side(&joint.from_placement, first.map(|step| &step.axis));
        side(&joint.to_placement, last.map(|step| &step.axis));
        PictureJoint {
            name: joint.name.to_string(),
            kind: joint.word,
            sides: [joint.from, joint.to],
            cut: false,
            driven: false,
        }
    }

    fn wheel(
        &mut self,
        g: &mut Graph,
        axes: impl Fn(&mut Graph, PointId) -> Option<Matrix3>,
        constraint: &Constraint,
    ) -> Option<(String, [PointId; 2])> {
        let ConstraintLaw::Rolling { wheel, axis, radius, on, normal } = &constraint.law else {
            return None;
        };
        self.number(g, radius);
        let axle = match axis {
            Some(axis) => self.values.vector(g, axis),
            None => Vector3::zero(g),
        };
        let normal = self.values.vector(g, normal);
        for (point, direction) in [(*wheel, axle), (*on, normal)] {
            let rotation = axes(g, point);
            let direction = turned(g, rotation, direction);
            self.vector(direction);
        }
        Some((constraint.name.to_string(), [*wheel, *on]))
    }

    /// The constant numbers, the positions of the others, and the others.
    fn split(self, g: &Graph) -> (Vec<f64>, Vec<u32>, Vec<ExprId>) {
        let known = self.all.iter().map(|&value| g.constant_value(value));
        let numbers = known.clone().map(Option::unwrap_or_default).collect();
        let unknown = (0..).zip(self.all.iter().zip(known));
        let (computed, values) =
            unknown.filter(|(_, (_, known))| known.is_none()).map(|(index, (value, _))| (index, value)).unzip();
        (numbers, computed, values)
    }
}

/// A vector of a frame that is turned by a constant rotation, in the axes outside.
fn turned(g: &mut Graph, rotation: Option<Matrix3>, vector: Vector3) -> Vector3 {
    match rotation {
        Some(rotation) => rotation.apply(g, vector),
        None => vector,
    }
}
