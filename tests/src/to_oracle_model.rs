//! Converts a declaration into the oracle's plain data with every value fixed to a number, so that the oracle can check
//! machines written in the language, whatever their expressions. Only names and values come from the compiler; no
//! equation does.

use std::rc::Rc;

use eigentol_compiler::base::ids::{CoordinateId, PointId};
use eigentol_compiler::model::evaluate::Values as Evaluation;
use eigentol_compiler::model::expression::{Expr as Written, Function, Matrix, Vector};
use eigentol_compiler::model::mechanism as declared;

use eigentol_oracle::model::{
    Amount, Body, Coordinate, Curve, Drive, Expr, Force, ForceLaw, Frame, Input, Joint, Model,
    Motion, Part, Placement, Point, Shape, Step, Unit, Value, Values, Word,
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
    let joints: Vec<Joint> = mechanism
        .joints
        .iter()
        .map(|joint| fixing.joint(joint, &mut speeds))
        .collect();
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
        bodies: mechanism
            .bodies
            .iter()
            .map(|body| fixing.body(body))
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
        Joint {
            from_placement: self.placement(&joint.from_placement),
            to_placement: self.placement(&joint.to_placement),
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

    fn coordinate(&self, id: CoordinateId) -> Coordinate {
        let joint = self.mechanism.coordinates[id.index()].joint.index();
        let steps = &self.mechanism.joints[joint].steps;
        let step = steps
            .iter()
            .position(|step| step.coordinate == id)
            .expect("its joint has it");
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
