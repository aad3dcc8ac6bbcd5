//! A mechanism as text, for snapshots: every value in SI, with names resolved.

mod beam;
mod constraint;
mod elements;
mod excitation;
mod law;
mod shape;

use std::fmt::{self, Display, Formatter};

use super::expression::{Expr, Matrix, Vector};
use super::mechanism::{Frame, Joint, Law, Mechanism, Motion, Placement, StepMotion, Tolerance, Unit};
use super::simplify::diagonal_of;

const AXES: [&str; 3] = ["x", "y", "z"];

/// Converts values to text, using the names of their mechanism.
struct Names<'a>(&'a Mechanism);

impl Display for Mechanism {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        let names = Names(self);
        writeln!(f, "mechanism {}", self.name)?;
        writeln!(f, "gravity {}", names.vector(&self.gravity))?;
        if self.kernels_only {
            writeln!(f, "kernels only")?;
        }
        for input in &self.inputs {
            let tolerance = match input.tolerance.varies() {
                true => tolerance(&input.tolerance),
                false => String::new(),
            };
            writeln!(f, "input {}{tolerance}{}", input.name, unit(&input.unit))?;
        }
        for variable in &self.design {
            writeln!(
                f,
                "design {} = {}{}{}",
                variable.name,
                variable.nominal,
                tolerance(&variable.tolerance),
                unit(&variable.unit)
            )?;
        }
        for curve in &self.curves {
            let points = curve.spline.pieces()[1..].iter();
            let points: Vec<String> = points.map(|[x, y, ..]| format!("({x}, {y})")).collect();
            writeln!(f, "curve {}: {}", curve.spline.name(), points.join(", "))?;
        }
        for constant in &self.constants {
            writeln!(f, "let {} = {}", constant.name, names.scalar(&constant.value))?;
        }
        for body in &self.bodies {
            writeln!(f, "body {}: {}", body.name, names.parts(&body.parts))?;
        }
        for beam in &self.beams {
            names.beam(f, beam)?;
        }
        for joint in &self.joints {
            writeln!(
                f,
                "joint {}: {} from {}{} to {}{}{}",
                joint.name,
                names.joint(joint),
                names.frame(joint.from),
                names.placement(&joint.from_placement),
                names.frame(joint.to),
                names.placement(&joint.to_placement),
                if joint.cut { ", cut" } else { "" }
            )?;
        }
        for coordinate in &self.coordinates {
            if self.joints[coordinate.joint.index()].cut {
                continue;
            }
            match &coordinate.motion {
                Motion::Free => writeln!(f, "free {}: {:?}", coordinate.name, coordinate.quantity)?,
                Motion::Coasting => {
                    writeln!(f, "coasting {}: {:?}", coordinate.name, coordinate.quantity)?;
                }
                Motion::Driven(speed) => {
                    writeln!(f, "driven {}: {:?} at {}", coordinate.name, coordinate.quantity, names.scalar(speed))?
                }
            }
        }
        for point in &self.points {
            let frame = names.frame(point.frame);
            let offset = names.vector(&point.placement.offset);
            let rotations = names.rotations(&point.placement);
            writeln!(f, "point {}: {frame} at {offset}{rotations}", point.name)?;
        }
        for force in &self.forces {
            let word = if force.of_every { "every" } else { "force" };
            writeln!(f, "{word} {}: {}", force.name, names.law(&force.law))?;
        }
        for excitation in &self.excitations {
            let law = names.excitation(excitation);
            writeln!(f, "excitation {}: {law}", excitation.name)?;
        }
        for constraint in &self.constraints {
            let law = names.constraint(&constraint.law);
            writeln!(f, "constraint {}: {law}", constraint.name)?;
        }
        for steady in &self.steady {
            writeln!(f, "steady {} = {}", steady.name, names.scalar(&steady.value))?;
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
        let binary = |a: &Expr, sign: &str, b: &Expr| format!("({} {sign} {})", self.scalar(a), self.scalar(b));
        match value {
            Expr::Number(value) => format!("{value}"),
            Expr::Design(id) => self.0.design[id.index()].name.to_string(),
            Expr::Input(id) => self.0.inputs[id.index()].name.to_string(),
            Expr::Constant(id) => self.0.constants[id.index()].name.to_string(),
            Expr::Coordinate(id) => self.0.coordinates[id.index()].name.to_string(),
            Expr::Rate(id) => format!("rate({})", self.0.coordinates[id.index()].name),
            Expr::Position(id, axis) => {
                format!("{}.{}", self.0.points[id.index()].name, AXES[*axis])
            }
            Expr::Length => "length".to_owned(),
            Expr::LengthRate => "rate".to_owned(),
            Expr::Reaction(id, component) => {
                let kind = ["force", "moment"][component / 3];
                let name = &self.0.joints[id.index()].name;
                format!("reaction_{kind}({name}).{}", AXES[component % 3])
            }
            Expr::ConstraintReaction(id, component) => {
                let name = &self.0.constraints[id.index()].name;
                format!("reaction({name}).{component}")
            }
            Expr::Bent(id, component) => {
                let kind = ["curvature", "moment", "strain", "inner_force"][component / 3];
                let name = &self.0.points[id.index()].name;
                format!("{kind}({name}).{}", AXES[component % 3])
            }
            Expr::Exerted(id, component) => {
                let name = &self.0.forces[id.index()].name;
                format!("exerted({name}).{component}")
            }
            Expr::KineticEnergy => "kinetic_energy()".to_owned(),
            Expr::PotentialEnergy => "potential_energy()".to_owned(),
            Expr::Negate(a) => format!("-{}", self.scalar(a)),
            Expr::Add(a, b) => binary(a, "+", b),
            Expr::Subtract(a, b) => binary(a, "-", b),
            Expr::Multiply(a, b) => binary(a, "*", b),
            Expr::Divide(a, b) => binary(a, "/", b),
            Expr::Power(a, b) => binary(a, "^", b),
            Expr::PowerInteger(a, n) => format!("{}^{n}", self.scalar(a)),
            Expr::Call(function, a) => format!("{}({})", function.name(), self.scalar(a)),
            Expr::Atan2(a, b) => format!("atan2({}, {})", self.scalar(a), self.scalar(b)),
        }
    }

    fn vector(&self, vector: &Vector) -> String {
        let components: Vec<String> = vector.iter().map(|value| self.scalar(value)).collect();
        format!("[{}]", components.join(", "))
    }

    /// The rows of a matrix, or only the diagonal of a diagonal one.
    fn matrix(&self, matrix: &Matrix) -> String {
        if let Some(diagonal) = diagonal_of(matrix) {
            return self.vector(&diagonal);
        }
        let rows: Vec<String> = matrix.iter().map(|row| self.vector(row)).collect();
        format!("[{}]", rows.join(", "))
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
        offset + &self.rotations(placement)
    }

    fn rotations(&self, placement: &Placement) -> String {
        let rotations = placement
            .rotations
            .iter()
            .map(|(axis, angle)| format!(" rotated({}, {})", self.vector(axis), self.scalar(angle)));
        rotations.collect()
    }

    /// The keyword with its axes; if there are several coordinates, each with its own name.
    fn joint(&self, joint: &Joint) -> String {
        let several = joint.steps.len() > 1;
        let arguments = joint.steps.iter().map(|step| {
            let axis = self.vector(&step.axis);
            let name = &self.0.coordinates[step.coordinate.index()].name;
            match &step.motion {
                StepMotion::Screw { lead } => format!("{axis}, {} m/rad", self.scalar(lead)),
                StepMotion::Turn | StepMotion::Slide if several => format!("{name}: {axis}"),
                StepMotion::Turn | StepMotion::Slide => axis,
            }
        });
        let arguments: Vec<String> = arguments.collect();
        match arguments.as_slice() {
            [] => joint.word.to_owned(),
            arguments => format!("{}({})", joint.word, arguments.join(", ")),
        }
    }
}

/// Limits, in SI or as factors of the value, and the law unless it is normal.
fn tolerance(tolerance: &Tolerance) -> String {
    let Tolerance { lower, upper, .. } = tolerance;
    let mut text = match tolerance.is_symmetric() {
        true => format!(" +/- {upper}"),
        false => format!(" {upper:+} {lower:+}"),
    };
    if tolerance.relative {
        text += " of it";
    }
    match &tolerance.law {
        Law::Normal => {}
        Law::OneOf(values) => {
            let each = values.iter().map(|(fraction, weight)| format!("{fraction}: {weight}"));
            text += &format!(" one of [{}]", each.collect::<Vec<_>>().join(", "));
        }
        law => text += &format!(" {law}"),
    }
    text
}

fn unit(unit: &Unit) -> String {
    if unit.symbol.is_empty() { String::new() } else { format!(" [{}]", unit.symbol) }
}
