//! Converts a declaration into the oracle's plain data with every value fixed to a number, so that the oracle can check
//! machines written in the language, whatever their expressions. Only names and values come from the compiler; no
//! equation does.

use std::rc::Rc;

use eigentol_compiler::base::ids::{CoordinateId, PointId};
use eigentol_compiler::model::evaluate::Values as Evaluation;
use eigentol_compiler::model::expression::{Expr as Written, Function, Matrix, Vector};
use eigentol_compiler::model::mechanism as declared;

use eigentol_oracle::model::{
    Amount, Beam, Body, Coordinate, Curve, Drive, Expr, Flexure, Force, ForceLaw, Frame, Input,
    Joint, Model, Motion, ORIGIN, Part, Placement, Point, Section, Shape, Step, Unit, Value,
    Values, Word,
};

/// The model of `mechanism` at inputs `u` and design variables `b`, and the speeds of its drives, which
/// are the inputs of that model.
pub fn to_oracle_model(mechanism: &declared::Mechanism, u: &[f64], b: &[f64]) -> (Model, Vec<f64>) {
    let evaluation = Evaluation::new(&mechanism.constants, u, b);
    let fixing = Fixing {
        mechanism,
        evaluation,
    };
    let mut speeds = Vec::new();
    let mut joints: Vec<Joint> = mechanism
        .joints
        .iter()
        .map(|joint| fixing.joint(joint, &mut speeds))
        .collect();
    let bodies = mechanism.bodies.iter().map(|body| fixing.body(body));
    let mut bodies: Vec<Body> = bodies.collect();
    for (index, beam) in mechanism.beams.iter().enumerate() {
        for slice in fixing.slices(beam) {
            let (from, to) = (Frame::Body(beam.body.index()), Frame::Body(bodies.len()));
            joints.push(Joint {
                flexure: Some(Flexure {
                    beam: index,
                    place: slice.0,
                }),
                ..Joint::new("slice", Word::Fixed, Vec::new(), from, to)
            });
            bodies.push(slice.1);
        }
    }
    let inputs = (0..speeds.len())
        .map(|k| Input {
            name: format!("speed{k}"),
            unit: Unit::RadianPerSecond,
        })
        .collect();
    let model = Model {
        name: mechanism.name.to_string(),
        inputs,
        design: Vec::new(),
        gravity: fixing.vector(&mechanism.gravity),
        bodies,
        beams: mechanism
            .beams
            .iter()
            .map(|beam| fixing.beam(beam))
            .collect(),
        joints,
        points: mechanism
            .points
            .iter()
            .map(|point| Point {
                name: point.name.to_string(),
                frame: frame(point.frame),
                placement: fixing.placement(&point.placement),
            })
            .collect(),
        forces: mechanism
            .forces
            .iter()
            .map(|force| Force {
                name: force.name.to_string(),
                law: fixing.law(&force.law),
            })
            .collect(),
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
        Body {
            name: body.name.to_string(),
            parts: body.parts.iter().map(part).collect(),
        }
    }

    fn shape(&self, shape: &declared::Shape) -> Shape {
        let v = |value: &Written| self.value(value);
        let amount = |value: &Written| Amount::Mass(self.value(value));
        let n = |vector: &Vector| self.numbers(vector);
        let w = |vector: &Vector| self.vector(vector);
        match shape {
            declared::Shape::Point { mass, center } => Shape::Point {
                mass: v(mass),
                center: w(center),
            },
            declared::Shape::Rod {
                mass,
                length,
                along,
                center,
            } => Shape::Rod {
                mass: amount(mass),
                length: v(length),
                along: n(along),
                center: Some(w(center)),
            },
            declared::Shape::Disk {
                mass,
                radius,
                axis,
                center,
            } => Shape::Disk {
                mass: amount(mass),
                radius: v(radius),
                axis: n(axis),
                center: w(center),
            },
            declared::Shape::Cylinder {
                mass,
                radius,
                length,
                axis,
                center,
            } => Shape::Cylinder {
                mass: amount(mass),
                radius: v(radius),
                length: v(length),
                axis: n(axis),
                center: w(center),
            },
            declared::Shape::Tube {
                mass,
                inner,
                outer,
                length,
                axis,
                center,
            } => Shape::Tube {
                mass: amount(mass),
                inner: v(inner),
                outer: v(outer),
                length: v(length),
                axis: n(axis),
                center: w(center),
            },
            declared::Shape::Cuboid { mass, size, center } => Shape::Cuboid {
                mass: amount(mass),
                size: w(size),
                center: w(center),
            },
            declared::Shape::Sphere {
                mass,
                radius,
                center,
            } => Shape::Sphere {
                mass: amount(mass),
                radius: v(radius),
                center: w(center),
            },
            declared::Shape::Rigid {
                mass,
                center,
                inertia,
                about,
            } => Shape::Rigid {
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
                    declared::StepMotion::Screw { lead } => Motion::Screw {
                        lead: self.value(lead),
                    },
                };
                let coordinate = &self.mechanism.coordinates[step.coordinate.index()];
                let mut fixed =
                    Step::new(motion, self.numbers(&step.axis)).named(&coordinate.name.to_string());
                if let declared::Motion::Driven(speed) = &coordinate.motion {
                    fixed.drive = Some(Drive {
                        input: speeds.len(),
                        factor: 1.0,
                    });
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
            ..Joint::new(
                &joint.name.to_string(),
                Word::Free,
                steps,
                frame(joint.from),
                frame(joint.to),
            )
        }
    }

    /// The coordinates of a beam, as steps of the joint to its first station.
    fn bends(&self, beam: &declared::Beam) -> Vec<Step> {
        let about = |axis: usize| {
            let axes = self.numbers(&beam.axes[axis]);
            beam.coordinates[axis].iter().map(move |id| (axes, id))
        };
        let steps = (0..3).flat_map(about).map(|(axis, id)| {
            let name = &self.mechanism.coordinates[id.index()].name;
            Step::new(Motion::Turn, axis).named(&name.to_string())
        });
        steps.collect()
    }

    fn beam(&self, beam: &declared::Beam) -> Beam {
        let section = |(place, weight, section): &(f64, f64, declared::Section)| Section {
            place: *place,
            weight: *weight,
            twist: self.value(&section.twist),
            stiffness: self.vector(&section.stiffness),
        };
        Beam {
            name: self.mechanism.bodies[beam.body.index()].name.to_string(),
            joint: beam.stations[0].joint.index(),
            counts: beam.coordinates.each_ref().map(Vec::len),
            length: self.value(&beam.length),
            axes: beam.axes.each_ref().map(|axis| self.numbers(axis)),
            sections: beam.sections.iter().map(section).collect(),
            lag: self.value(&beam.lag),
        }
    }

    /// The mass of each section at a point of quadrature, as a flat body across the beam, and its place.
    fn slices(&self, beam: &declared::Beam) -> Vec<(f64, Body)> {
        let axes = beam.axes.each_ref().map(|axis| self.numbers(axis));
        let length = self.number(&beam.length);
        let slice = |(place, weight, section): &(f64, f64, declared::Section)| {
            let [second, third] = section.inertia.each_ref().map(|own| self.number(own));
            let about = [second + third, second, third];
            let inertia = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2)].map(|(i, j)| {
                let terms = axes.iter().zip(about).map(|(e, own)| own * e[i] * e[j]);
                Value::Number(length * weight * terms.sum::<f64>())
            });
            let [y, z] = section.center.each_ref().map(|own| self.number(own));
            let shape = Shape::Rigid {
                mass: Value::Number(length * weight * self.number(&section.mass)),
                center: [0, 1, 2].map(|i| Value::Number(y * axes[1][i] + z * axes[2][i])),
                inertia,
                about: None,
            };
            let placement = Placement {
                offset: ORIGIN,
                rotations: vec![(axes[0], self.value(&section.twist))],
            };
            let part = Part {
                hole: false,
                shape,
                placement,
            };
            let body = Body {
                name: "slice".to_owned(),
                parts: vec![part],
            };
            (*place, body)
        };
        beam.sections.iter().map(slice).collect()
    }

    fn coordinate(&self, id: CoordinateId) -> Coordinate {
        let joint = self.mechanism.coordinates[id.index()].joint.index();
        let declared = &self.mechanism.joints[joint];
        let steps = declared.steps.iter().map(|step| step.coordinate);
        let beam = declared.flexure.map(|(beam, _)| beam.index());
        let bends = beam.map(|beam| self.mechanism.beams[beam].coordinates.concat());
        let mut all = steps.chain(bends.unwrap_or_default());
        let step = all.position(|own| own == id).expect("its joint has it");
        Coordinate { joint, step }
    }

    fn law(&self, law: &declared::ForceLaw) -> ForceLaw {
        let point = |id: &PointId| id.index();
        let v = |value: &Written| self.value(value);
        let w = |vector: &Vector| self.vector(vector);
        let rows = |matrix: &Matrix| matrix.each_ref().map(|row| self.vector(row));
        match law {
            declared::ForceLaw::CoordinateSpring {
                coordinate,
                stiffness,
                rest,
            } => ForceLaw::Spring {
                coordinate: self.coordinate(*coordinate),
                stiffness: v(stiffness),
                rest: v(rest),
            },
            declared::ForceLaw::CoordinateDamper {
                coordinate,
                damping,
            } => ForceLaw::Damper {
                coordinate: self.coordinate(*coordinate),
                damping: v(damping),
            },
            declared::ForceLaw::SpringDamper {
                from,
                to,
                stiffness,
                damping,
                length,
            } => ForceLaw::SpringDamper {
                from: point(from),
                to: point(to),
                stiffness: v(stiffness),
                damping: v(damping),
                length: v(length),
            },
            declared::ForceLaw::Tension { from, to, tension } => ForceLaw::Tension {
                from: point(from),
                to: point(to),
                tension: self.expression(tension),
            },
            declared::ForceLaw::Generalized { coordinate, value } => ForceLaw::Generalized {
                coordinate: self.coordinate(*coordinate),
                value: self.expression(value),
            },
            declared::ForceLaw::Potential { energy } => ForceLaw::Potential {
                energy: self.expression(energy),
            },
            declared::ForceLaw::Bushing {
                from,
                to,
                stiffness,
                damping,
                turning_stiffness,
                turning_damping,
            } => ForceLaw::Bushing {
                from: point(from),
                to: point(to),
                stiffness: rows(stiffness),
                damping: rows(damping),
                turning_stiffness: rows(turning_stiffness),
                turning_damping: rows(turning_damping),
            },
            declared::ForceLaw::Load {
                point: at,
                force,
                moment,
                following,
            } => ForceLaw::Load {
                point: point(at),
                force: w(force),
                moment: w(moment),
                following: *following,
            },
            declared::ForceLaw::Drag {
                point: at,
                damping,
                turning_damping,
            } => ForceLaw::Drag {
                point: point(at),
                damping: v(damping),
                turning_damping: v(turning_damping),
            },
            declared::ForceLaw::Distributed { .. } => {
                unreachable!("no machine that the oracle evaluates has forces along beams")
            }
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
            Written::Divide(a, b) => {
                Expr::Product(vec![part(a), Expr::Power(Box::new(part(b)), -1)])
            }
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
