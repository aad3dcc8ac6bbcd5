//! Laws as text, every value in SI, with names resolved.

mod constraint;
mod elements;
mod law;

use super::expression::{Expr, Matrix, Vector};
use super::mechanism::{Mechanism, Unit};
use super::simplify::diagonal_of;

const AXES: [&str; 3] = ["x", "y", "z"];

/// Converts values to text, using the names of their mechanism.
struct Names<'a>(&'a Mechanism);

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
}

fn unit(unit: &Unit) -> String {
    if unit.symbol.is_empty() { String::new() } else { format!(" [{}]", unit.symbol) }
}
