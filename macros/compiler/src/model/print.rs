//! A mechanism as text, for snapshots: every value in SI with its names resolved.

use std::fmt::{self, Display, Formatter};

use super::expression::{Expr, Function, Vector};
use super::mechanism::{ForceLaw, Frame, JointKind, Mechanism, Motion, Placement, Shape, Unit};

/// Text of values, with the names of the mechanism they belong to.
struct Names<'a>(&'a Mechanism);

impl Display for Mechanism {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        let names = Names(self);
        writeln!(f, "mechanism {}", self.name)?;
        writeln!(f, "gravity {}", names.vector(&self.gravity))?;
        for input in &self.inputs {
            writeln!(f, "input {}{}", input.name, unit(&input.unit))?;
        }
        for variable in &self.design {
            writeln!(
                f,
                "design {} = {} +/- {}{}",
                variable.name,
                variable.nominal,
                variable.tolerance,
                unit(&variable.unit)
            )?;
        }
        for constant in &self.constants {
            writeln!(
                f,
                "let {} = {}",
                constant.name,
                names.scalar(&constant.value)
            )?;
        }
        for body in &self.bodies {
            writeln!(f, "body {}: {}", body.name, names.shape(&body.shape))?;
        }
        for joint in &self.joints {
            writeln!(
                f,
                "joint {}: {} from {}{} to {}{}",
                joint.name,
                names.joint(&joint.kind),
                names.frame(joint.from),
                names.placement(&joint.from_placement),
                names.frame(joint.to),
                names.placement(&joint.to_placement)
            )?;
        }
        for coordinate in &self.coordinates {
            match &coordinate.motion {
                Motion::Free => writeln!(f, "free {}: {:?}", coordinate.name, coordinate.quantity)?,
                Motion::Driven(speed) => writeln!(
                    f,
                    "driven {}: {:?} at {}",
                    coordinate.name,
                    coordinate.quantity,
                    names.scalar(speed)
                )?,
            }
        }
        for point in &self.points {
            let (frame, position) = (names.frame(point.frame), names.vector(&point.position));
            writeln!(f, "point {}: {frame} at {position}", point.name)?;
        }
        for force in &self.forces {
            writeln!(f, "force {}: {}", force.name, names.law(&force.law))?;
        }
        for output in &self.outputs {
            let value = names.scalar(&output.value);
            writeln!(f, "output {} = {value}{}", output.name, unit(&output.unit))?;
        }
        Ok(())
    }
}

impl Names<'_> {
    fn scalar(&self, value: &Expr) -> String {
        let binary = |a: &Expr, sign: &str, b: &Expr| {
            format!("({} {sign} {})", self.scalar(a), self.scalar(b))
        };
        match value {
            Expr::Number(value) => format!("{value}"),
            Expr::Design(id) => self.0.design[id.index()].name.to_string(),
            Expr::Input(id) => self.0.inputs[id.index()].name.to_string(),
            Expr::Constant(id) => self.0.constants[id.index()].name.to_string(),
            Expr::Coordinate(id) => self.0.coordinates[id.index()].name.to_string(),
            Expr::Position(id, axis) => {
                format!(
                    "{}.{}",
                    self.0.points[id.index()].name,
                    ["x", "y", "z"][*axis]
                )
            }
            Expr::Negate(a) => format!("-{}", self.scalar(a)),
            Expr::Add(a, b) => binary(a, "+", b),
            Expr::Subtract(a, b) => binary(a, "-", b),
            Expr::Multiply(a, b) => binary(a, "*", b),
            Expr::Divide(a, b) => binary(a, "/", b),
            Expr::Power(a, b) => binary(a, "^", b),
            Expr::PowerInteger(a, n) => format!("{}^{n}", self.scalar(a)),
            Expr::Call(function, a) => format!("{}({})", name(*function), self.scalar(a)),
            Expr::Atan2(a, b) => format!("atan2({}, {})", self.scalar(a), self.scalar(b)),
        }
    }

    fn vector(&self, vector: &Vector) -> String {
        let components: Vec<String> = vector.iter().map(|value| self.scalar(value)).collect();
        format!("[{}]", components.join(", "))
    }

    fn frame(&self, frame: Frame) -> String {
        match frame {
            Frame::Ground => "ground".to_owned(),
            Frame::Body(body) => self.0.bodies[body.index()].name.to_string(),
        }
    }

    fn placement(&self, placement: &Placement) -> String {
        let zero = placement.offset.iter().all(|x| *x == Expr::Number(0.0));
        let offset = match zero {
            true => String::new(),
            false => format!(" at {}", self.vector(&placement.offset)),
        };
        placement
            .rotations
            .iter()
            .fold(offset, |text, (axis, angle)| {
                format!(
                    "{text} rotated({}, {})",
                    self.vector(axis),
                    self.scalar(angle)
                )
            })
    }

    fn joint(&self, kind: &JointKind) -> String {
        match kind {
            JointKind::Fixed => "fixed".to_owned(),
            JointKind::Revolute { axis, .. } => format!("revolute({})", self.vector(axis)),
            JointKind::Prismatic { axis, .. } => format!("prismatic({})", self.vector(axis)),
        }
    }

    fn shape(&self, shape: &Shape) -> String {
        let (s, v) = (
            |value: &Expr| self.scalar(value),
            |vector: &Vector| self.vector(vector),
        );
        match shape {
            Shape::Massless => "massless".to_owned(),
            Shape::Point { mass, center } => format!("point mass {} at {}", s(mass), v(center)),
            Shape::Rod {
                mass,
                length,
                along,
                center,
            } => format!(
                "rod mass {} length {} along {} center {}",
                s(mass),
                s(length),
                v(along),
                v(center)
            ),
            Shape::Disk {
                mass,
                radius,
                axis,
                center,
            } => format!(
                "disk mass {} radius {} axis {} center {}",
                s(mass),
                s(radius),
                v(axis),
                v(center)
            ),
            Shape::Cylinder {
                mass,
                radius,
                length,
                axis,
                center,
            } => format!(
                "cylinder mass {} radius {} length {} axis {} center {}",
                s(mass),
                s(radius),
                s(length),
                v(axis),
                v(center)
            ),
            Shape::Cuboid { mass, size, center } => {
                format!("box mass {} size {} center {}", s(mass), v(size), v(center))
            }
            Shape::Sphere {
                mass,
                radius,
                center,
            } => {
                format!(
                    "sphere mass {} radius {} center {}",
                    s(mass),
                    s(radius),
                    v(center)
                )
            }
            Shape::Rigid {
                mass,
                center,
                inertia,
            } => {
                let inertia: Vec<String> = inertia.iter().map(s).collect();
                format!(
                    "rigid mass {} center {} inertia [{}]",
                    s(mass),
                    v(center),
                    inertia.join(", ")
                )
            }
        }
    }

    fn law(&self, law: &ForceLaw) -> String {
        let s = |value: &Expr| self.scalar(value);
        let coordinate = |id: &crate::base::ids::CoordinateId| &self.0.coordinates[id.index()].name;
        let point = |id: &crate::base::ids::PointId| &self.0.points[id.index()].name;
        match law {
            ForceLaw::CoordinateSpring {
                coordinate: on,
                stiffness,
                rest,
            } => {
                format!(
                    "spring on {} stiffness {} rest {}",
                    coordinate(on),
                    s(stiffness),
                    s(rest)
                )
            }
            ForceLaw::CoordinateDamper {
                coordinate: on,
                damping,
            } => {
                format!("damper on {} damping {}", coordinate(on), s(damping))
            }
            ForceLaw::SpringDamper {
                from,
                to,
                stiffness,
                damping,
                length,
            } => format!(
                "spring_damper from {} to {} stiffness {} damping {} length {}",
                point(from),
                point(to),
                s(stiffness),
                s(damping),
                s(length)
            ),
        }
    }
}

fn unit(unit: &Unit) -> String {
    if unit.symbol.is_empty() {
        String::new()
    } else {
        format!(" [{}]", unit.symbol)
    }
}

fn name(function: Function) -> &'static str {
    match function {
        Function::Sqrt => "sqrt",
        Function::Sin => "sin",
        Function::Cos => "cos",
        Function::Tan => "tan",
        Function::Asin => "asin",
        Function::Acos => "acos",
        Function::Exp => "exp",
        Function::Ln => "ln",
    }
}
