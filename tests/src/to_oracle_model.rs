//! Converts a declaration into the oracle's plain data with every value fixed to a number, so that the oracle can check
//! machines written in the language, whatever their expressions. Only names and values come from the compiler; no
//! equation does.

use std::rc::Rc;

use eigentol_compiler::base::ids::{CoordinateId, PointId};
use eigentol_compiler::model::evaluate::Values as Evaluation;
use eigentol_compiler::model::expression::{Expr as Written, Function, Matrix, Vector};
use eigentol_compiler::model::mechanism as declared;

use eigentol_oracle::model::{
    Amount, Beam, Body, Coordinate, Curve, Drive, Expr, Flexure, Force, ForceLaw, Frame, Input, Joint, Model, Motion,
    ORIGIN, Part, Placement, Point, Prebend, Section, Shape, Step, Unit, Value, Values, Word,
};

/// The model of `mechanism` at inputs `u` and design variables `b`, and the speeds of its drives, which
/// are the inputs of that model.
pub fn to_oracle_model(mechanism: &declared::Mechanism, u: &[f64], b: &[f64]) -> (Model, Vec<f64>) {
    let evaluation = Evaluation::new(&mechanism.constants, u, b);
    let fixing = Fixing { mechanism, evaluation };
    let mut speeds = Vec::new();
    let mut joints: Vec<Joint> = mechanism.joints.iter().map(|joint| fixing.joint(joint, &mut speeds)).collect();
    let bodies = mechanism.bodies.iter().map(|body| fixing.body(body));
    let mut bodies: Vec<Body> = bodies.collect();
    let mut sections = Vec::new();
    let mut spins = Vec::new();
    for (index, beam) in mechanism.beams.iter().enumerate() {
        let (own, spin) = fixing.slices(index, beam, &mut bodies, &mut joints, &mut speeds);
        sections.push(own);
        spins.push(spin);
    }
    let points = mechanism.points.iter().map(|point| fixing.point(point));
    let mut points: Vec<Point> = points.collect();
    let mut forces = Vec::new();
    for force in &mechanism.forces {
        match &force.law {
            declared::ForceLaw::Distributed { .. } => {
                fixing.distribute(force, &sections, &mut points, &mut forces);
            }
            law => forces.push(Force { name: force.name.to_string(), law: fixing.law(law) }),
        }
    }
    let inputs = (0..speeds.len()).map(|k| Input { name: format!("speed{k}"), unit: Unit::RadianPerSecond }).collect();
    let model = Model {
        name: mechanism.name.to_string(),
        inputs,
        design: Vec::new(),
        gravity: fixing.vector(&mechanism.gravity),
        bodies,
        beams: mechanism.beams.iter().zip(spins).map(|(beam, spin)| fixing.beam(beam, spin)).collect(),
        joints,
        points,
        forces,
    };
    (model, speeds)
}

struct Fixing<'a> {
    mechanism: &'a declared::Mechanism,
    evaluation: Evaluation<'a>,
}

fn frame(frame: declared::Frame) -> Frame {
    match frame {
        declared::Frame::Ground => Frame::Ground,
        declared::Frame::Body(body) => Frame::Body(body.index()),
    }
}

impl Fixing<'_> {
    fn number(&self, value: &Written) -> f64 {
        self.evaluation.of(value)
    }

    fn value(&self, value: &Written) -> Value {
        Value::Number(self.number(value))
    }

    fn numbers(&self, vector: &Vector) -> [f64; 3] {
        vector.each_ref().map(|component| self.number(component))
    }

    fn vector(&self, vector: &Vector) -> Values {
        self.numbers(vector).map(Value::Number)
    }

    fn placement(&self, placement: &declared::Placement) -> Placement {
        let rotation = |(axis, angle): &(Vector, Written)| (self.numbers(axis), self.value(angle));
        Placement {
            offset: self.vector(&placement.offset),
            rotations: placement.rotations.iter().map(rotation).collect(),
        }
    }

    fn body(&self, body: &declared::Body) -> Body {
        let part = |part: &declared::Part| Part {
            hole: part.hole,
            shape: self.shape(&part.shape),
            placement: self.placement(&part.placement),
        };
        Body { name: body.name.to_string(), parts: body.parts.iter().map(part).collect() }
    }

    fn shape(&self, shape: &declared::Shape) -> Shape {
        let v = |value: &Written| self.value(value);
        let amount = |value: &Written| Amount::Mass(self.value(value));
        let n = |vector: &Vector| self.numbers(vector);
        let w = |vector: &Vector| self.vector(vector);
        match shape {
            declared::Shape::Point { mass, center } => Shape::Point { mass: v(mass), center: w(center) },
            declared::Shape::Rod { mass, length, along, center } => {
                Shape::Rod { mass: amount(mass), length: v(length), along: n(along), center: Some(w(center)) }
            }
            declared::Shape::Disk { mass, radius, axis, center } => {
                Shape::Disk { mass: amount(mass), radius: v(radius), axis: n(axis), center: w(center) }
            }
            declared::Shape::Cylinder { mass, radius, length, axis, center } => Shape::Cylinder {
                mass: amount(mass),
                radius: v(radius),
                length: v(length),
                axis: n(axis),
                center: w(center),
            },
            declared::Shape::Tube { mass, inner, outer, length, axis, center } => Shape::Tube {
                mass: amount(mass),
                inner: v(inner),
                outer: v(outer),
                length: v(length),
                axis: n(axis),
                center: w(center),
            },
            declared::Shape::Cuboid { mass, size, center } => {
                Shape::Cuboid { mass: amount(mass), size: w(size), center: w(center) }
            }
            declared::Shape::Sphere { mass, radius, center } => {
                Shape::Sphere { mass: amount(mass), radius: v(radius), center: w(center) }
            }
            declared::Shape::Rigid { mass, center, inertia, about } => Shape::Rigid {
                mass: v(mass),
                center: w(center),
                inertia: inertia.each_ref().map(v),
                about: about.as_ref().map(w),
            },
        }
    }

    fn joint(&self, joint: &declared::Joint, speeds: &mut Vec<f64>) -> Joint {
        let steps = joint
            .steps
            .iter()
            .map(|step| {
                let motion = match &step.motion {
                    declared::StepMotion::Turn => Motion::Turn,
                    declared::StepMotion::Slide => Motion::Slide,
                    declared::StepMotion::Screw { lead } => Motion::Screw { lead: self.value(lead) },
                };
                let coordinate = &self.mechanism.coordinates[step.coordinate.index()];
                let mut fixed = Step::new(motion, self.numbers(&step.axis)).named(&coordinate.name.to_string());
                if let declared::Motion::Driven(speed) = &coordinate.motion {
                    fixed.drive = Some(Drive { input: speeds.len(), factor: 1.0 });
                    speeds.push(self.number(speed));
                }
                fixed
            })
            .collect();
        let steps = match joint.flexure {
            Some((beam, 0)) => self.bends(&self.mechanism.beams[beam.index()]),
            _ => steps,
        };
        Joint {
            from_placement: self.placement(&joint.from_placement),
            to_placement: self.placement(&joint.to_placement),
            flexure: joint.flexure.map(|(beam, station)| Flexure {
                beam: beam.index(),
                place: self.mechanism.beams[beam.index()].stations[station].place,
            }),
            // The keyword only affects how a model is spelled; its motion is in the steps.
            ..Joint::new(&joint.name.to_string(), Word::Free, steps, frame(joint.from), frame(joint.to))
        }
    }

    fn point(&self, point: &declared::Point) -> Point {
        Point { name: point.name.to_string(), frame: frame(point.frame), placement: self.placement(&point.placement) }
    }

    /// The coordinates of a beam, as steps of the joint to its first station.
    fn bends(&self, beam: &declared::Beam) -> Vec<Step> {
        let about = |axis: usize| {
            let axes = self.numbers(&beam.axes[axis]);
            beam.coordinates[axis].iter().map(move |id| (axes, id))
        };
        let along = |axis: usize| {
            let axes = self.numbers(&beam.axes[axis]);
            beam.strains[axis].iter().map(move |id| (axes, id))
        };
        let all = (0..3).flat_map(about).chain((0..3).flat_map(along));
        let steps = all.map(|(axis, id)| {
            let name = &self.mechanism.coordinates[id.index()].name;
            Step::new(Motion::Turn, axis).named(&name.to_string())
        });
        steps.collect()
    }

    fn beam(&self, beam: &declared::Beam, spin: Option<Coordinate>) -> Beam {
        let section = |(place, weight, section): &(f64, f64, declared::Section)| Section {
            place: *place,
            weight: *weight,
            twist: self.value(&section.twist),
            stiffness: self.stiffness(section),
        };
        Beam {
            name: self.mechanism.bodies[beam.body.index()].name.to_string(),
            joint: beam.stations[0].joint.index(),
            counts: beam.coordinates.each_ref().map(Vec::len),
            strains: beam.strains.each_ref().map(Vec::len),
            static_shear: beam.static_shear,
            length: self.value(&beam.length),
            axes: beam.axes.each_ref().map(|axis| self.numbers(axis)),
            prebend: self.prebend(beam),
            sections: beam.sections.iter().map(section).collect(),
            lag: self.value(&beam.lag),
            spin,
        }
    }

    fn stiffness(&self, section: &declared::Section) -> [[Value; 6]; 6] {
        let strains = section.against_strain.iter();
        let mut matrix = [[Value::Number(0.0); 6]; 6];
        for (k, strain) in strains.chain(&section.stiffness).enumerate() {
            matrix[k][k] = self.value(strain);
        }
        // twist and bending come first there
        let place = |k: usize| (k + 3) % 6;
        for (i, j, own) in &section.coupling {
            let (i, j) = (place(*i), place(*j));
            (matrix[i][j], matrix[j][i]) = (self.value(own), self.value(own));
        }
        matrix
    }

    fn prebend(&self, beam: &declared::Beam) -> Prebend {
        let tip = beam.stations.last().map(|station| &station.section);
        let [root, [y, z]] = [&beam.root, tip.expect("every beam has one at its tip")]
            .map(|section| section.prebend.each_ref().map(|prebend| self.number(prebend)));
        let angle = |[y, z]: [f64; 2]| Value::Number(y.hypot(z));
        let is_straight = y == 0.0 && z == 0.0;
        Prebend { about: if is_straight { [1.0, 0.0] } else { [y, z] }, angles: [angle(root), angle([y, z])] }
    }

    /// The rotation from the root to a place of an unloaded beam, without its twist.
    fn curved(&self, beam: &declared::Beam, value: f64) -> ([f64; 3], Value) {
        let Prebend { about, angles } = self.prebend(beam);
        let [_, second, third] = beam.axes.each_ref().map(|axis| self.numbers(axis));
        let axis = [0, 1, 2].map(|i| about[0] * second[i] + about[1] * third[i]);
        let [root, tip] = angles.map(|item| match item {
            Value::Number(angle) => angle,
            Value::Design { .. } => unreachable!("every value is fixed"),
        });
        (axis, Value::Number(root + (tip - root) * value))
    }

    /// Adds the mass of each section at a point of quadrature, as a flat body across the beam. If the beam spins, the section
    /// is a massless body that does not, and the flat body turns on it. Gives the bodies that are sections, and one of the
    /// coordinates of spinning.
    fn slices(
        &self,
        index: usize,
        beam: &declared::Beam,
        bodies: &mut Vec<Body>,
        joints: &mut Vec<Joint>,
        speeds: &mut Vec<f64>,
    ) -> (Vec<usize>, Option<Coordinate>) {
        let (mut sections, mut spin) = (Vec::new(), None);
        let turns = self.number(&beam.spin) != 0.0;
        let axis = self.numbers(&beam.axes[0]);
        for (place, weight, section) in &beam.sections {
            let carrier = bodies.len();
            sections.push(carrier);
            let flexure = Flexure { beam: index, place: *place };
            joints.push(Joint {
                flexure: Some(flexure),
                ..Joint::new("section", Word::Fixed, Vec::new(), Frame::Body(beam.body.index()), Frame::Body(carrier))
            });
            if turns {
                bodies.push(Body { name: "section".to_owned(), parts: Vec::new() });
                spin = spin.or(Some(Coordinate { joint: joints.len(), step: 0 }));
                let step = Step::new(Motion::Turn, axis).driven(speeds.len(), 1.0);
                speeds.push(self.number(&beam.spin));
                joints.push(Joint::new(
                    "spin",
                    Word::Revolute,
                    vec![step],
                    Frame::Body(carrier),
                    Frame::Body(bodies.len()),
                ));
            }
            bodies.push(self.slice(beam, (*place, *weight), section));
        }
        (sections, spin)
    }

    fn slice(&self, beam: &declared::Beam, (value, weight): (f64, f64), section: &declared::Section) -> Body {
        let axes = beam.axes.each_ref().map(|axis| self.numbers(axis));
        let length = self.number(&beam.length);
        let [second, third] = section.inertia.each_ref().map(|inertia| self.number(inertia));
        let about = [second + third, second, third];
        let inertia = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2)].map(|(i, j)| {
            let terms = axes.iter().zip(about).map(|(e, x)| x * e[i] * e[j]);
            Value::Number(length * weight * terms.sum::<f64>())
        });
        let [y, z] = section.center.each_ref().map(|center| self.number(center));
        let shape = Shape::Rigid {
            mass: Value::Number(length * weight * self.number(&section.mass)),
            center: [0, 1, 2].map(|i| Value::Number(y * axes[1][i] + z * axes[2][i])),
            inertia,
            about: None,
        };
        let placement = Placement {
            offset: ORIGIN,
            rotations: vec![self.curved(beam, value), (axes[0], self.value(&section.twist))],
        };
        let part = Part { hole: false, shape, placement };
        Body { name: "slice".to_owned(), parts: vec![part] }
    }

    /// Adds forces per length as a sum of forces at the points of quadrature.
    fn distribute(
        &self,
        force: &declared::Force,
        sections: &[Vec<usize>],
        points: &mut Vec<Point>,
        forces: &mut Vec<Force>,
    ) {
        let declared::ForceLaw::Distributed { on, force: fixed, follower, damping } = &force.law else {
            return;
        };
        let beams = self.mechanism.beams.iter().zip(sections);
        for (beam, own) in beams.filter(|(beam, _)| beam.whole == *on) {
            let axes = beam.axes.each_ref().map(|axis| self.numbers(axis));
            let along = self.numbers(follower);
            let following = std::array::from_fn(|i| (0..3).map(|k| along[k] * axes[k][i]).sum());
            for ((place, weight, _), &body) in beam.sections.iter().zip(own) {
                let share = weight * self.number(&beam.length);
                let scaled = |force: [f64; 3]| force.map(|force| Value::Number(share * force));
                let load = |force, following| ForceLaw::Load {
                    point: points.len(),
                    force: scaled(force),
                    moment: ORIGIN,
                    following,
                };
                let drag = ForceLaw::Drag {
                    point: points.len(),
                    damping: Value::Number(share * self.number(damping)),
                    turning_damping: Value::Number(0.0),
                };
                let laws = [load(self.numbers(fixed), false), load(following, true), drag];
                let name = || force.name.to_string();
                forces.extend(laws.map(|law| Force { name: name(), law }));
                points.push(Point {
                    name: name(),
                    frame: Frame::Body(body),
                    placement: Placement { offset: ORIGIN, rotations: vec![self.curved(beam, *place)] },
                });
            }
        }
    }

    fn coordinate(&self, id: CoordinateId) -> Coordinate {
        let joint = self.mechanism.coordinates[id.index()].joint.index();
        let declared = &self.mechanism.joints[joint];
        let steps = declared.steps.iter().map(|step| step.coordinate);
        let beam = declared.flexure.map(|(beam, _)| beam.index());
        let bends = beam.map(|beam| {
            let beam = &self.mechanism.beams[beam];
            [beam.coordinates.concat(), beam.strains.concat()].concat()
        });
        let mut all = steps.chain(bends.unwrap_or_default());
        let step = all.position(|x| x == id).expect("its joint has it");
        Coordinate { joint, step }
    }

    fn law(&self, law: &declared::ForceLaw) -> ForceLaw {
        let point = |id: &PointId| id.index();
        let v = |value: &Written| self.value(value);
        let w = |vector: &Vector| self.vector(vector);
        let rows = |matrix: &Matrix| matrix.each_ref().map(|row| self.vector(row));
        match law {
            declared::ForceLaw::CoordinateSpring { coordinate, stiffness, rest } => {
                ForceLaw::Spring { coordinate: self.coordinate(*coordinate), stiffness: v(stiffness), rest: v(rest) }
            }
            declared::ForceLaw::CoordinateDamper { coordinate, damping } => {
                ForceLaw::Damper { coordinate: self.coordinate(*coordinate), damping: v(damping) }
            }
            declared::ForceLaw::CoordinateInerter { coordinates: [coordinate, _], inertance } => {
                ForceLaw::Inerter { coordinate: self.coordinate(*coordinate), inertance: v(inertance) }
            }
            declared::ForceLaw::SpringDamper { from, to, stiffness, damping, length } => ForceLaw::SpringDamper {
                from: point(from),
                to: point(to),
                stiffness: v(stiffness),
                damping: v(damping),
                length: v(length),
            },
            declared::ForceLaw::Tension { from, to, tension } => {
                ForceLaw::Tension { from: point(from), to: point(to), tension: self.expression(tension) }
            }
            declared::ForceLaw::Generalized { coordinate, value } => {
                ForceLaw::Generalized { coordinate: self.coordinate(*coordinate), value: self.expression(value) }
            }
            declared::ForceLaw::Potential { energy } => ForceLaw::Potential { energy: self.expression(energy) },
            declared::ForceLaw::Bushing { from, to, stiffness, damping, turning_stiffness, turning_damping } => {
                ForceLaw::Bushing {
                    from: point(from),
                    to: point(to),
                    stiffness: rows(stiffness),
                    damping: rows(damping),
                    turning_stiffness: rows(turning_stiffness),
                    turning_damping: rows(turning_damping),
                }
            }
            declared::ForceLaw::Load { point: at, force, moment, following } => {
                ForceLaw::Load { point: point(at), force: w(force), moment: w(moment), following: *following }
            }
            declared::ForceLaw::Drag { point: at, damping, turning_damping } => {
                ForceLaw::Drag { point: point(at), damping: v(damping), turning_damping: v(turning_damping) }
            }
            declared::ForceLaw::Distributed { .. } => unreachable!("it is many laws"),
        }
    }

    fn expression(&self, value: &Written) -> Expr {
        let part = |value: &Rc<Written>| self.expression(value);
        match value {
            Written::Coordinate(id) => Expr::Coordinate(self.coordinate(*id)),
            Written::Rate(id) => Expr::Rate(self.coordinate(*id)),
            Written::Position(point, axis) => Expr::Position(point.index(), *axis),
            Written::Length => Expr::Length,
            Written::LengthRate => Expr::LengthRate,
            Written::Negate(a) => part(a).times(-1.0),
            Written::Add(a, b) => Expr::Sum(vec![part(a), part(b)]),
            Written::Subtract(a, b) => part(a).minus(part(b)),
            Written::Multiply(a, b) => Expr::Product(vec![part(a), part(b)]),
            Written::Divide(a, b) => Expr::Product(vec![part(a), Expr::Power(Box::new(part(b)), -1)]),
            Written::PowerInteger(a, n) => Expr::Power(Box::new(part(a)), *n),
            Written::Call(Function::Sin, a) => Expr::Sine(Box::new(part(a))),
            Written::Call(Function::Cos, a) => Expr::Cosine(Box::new(part(a))),
            Written::Call(Function::Spline(spline, 0), a) => {
                let pieces = spline.pieces()[1..].iter();
                let curve = Curve {
                    name: spline.name().to_owned(),
                    points: pieces.map(|&[x, y, ..]| [x, y]).collect(),
                    units: [Unit::Of([0; 3]); 2],
                };
                Expr::Curve(curve, Box::new(part(a)))
            }
            constant => Expr::number(self.number(constant)),
        }
    }
}
