//! Force elements and their expressions.

use super::quantities::{Printer, symbol};
use crate::model::{Coordinate, Curve, Expr, Force, ForceLaw, Motion, Unit};

/// The curves that a law uses.
fn curves(law: &ForceLaw) -> Vec<&Curve> {
    match law {
        ForceLaw::Tension { tension: of, .. }
        | ForceLaw::Generalized { value: of, .. }
        | ForceLaw::Potential { energy: of } => of.curves(),
        _ => Vec::new(),
    }
}

impl Printer<'_> {
    /// Declarations of all curves, each once.
    pub(super) fn curves(&self) -> Vec<String> {
        let forces = self.model.forces.iter();
        let mut known: Vec<&Curve> = Vec::new();
        for curve in forces.flat_map(|force| curves(&force.law)) {
            if !known.contains(&curve) {
                known.push(curve);
            }
        }
        let list = |curve: &Curve, axis: usize| {
            let numbers = curve.points.iter().map(|point| format!("{:?}", point[axis]));
            let numbers: Vec<String> = numbers.collect();
            let unit = symbol(curve.units[axis]);
            format!("[{}] {unit}", numbers.join(", "))
        };
        let declared = |curve: &&Curve| format!("curve {}: {} -> {};", curve.name, list(curve, 0), list(curve, 1));
        known.iter().map(declared).collect()
    }

    fn motion(&self, coordinate: Coordinate) -> Motion {
        self.model.step(coordinate).motion
    }

    fn name(&self, coordinate: Coordinate) -> &str {
        &self.model.step(coordinate).name
    }

    fn end(&self, point: usize) -> &str {
        &self.model.points[point].name
    }

    pub(super) fn force(&self, force: &Force) -> String {
        format!("force {}: {};", force.name, self.law(&force.law))
    }

    fn law(&self, law: &ForceLaw) -> String {
        match law {
            ForceLaw::Spring { coordinate, stiffness, rest } => {
                let motion = self.motion(*coordinate);
                format!(
                    "spring(on: {}, stiffness: {}, rest: {})",
                    self.name(*coordinate),
                    self.value(*stiffness, motion.stiffness_unit()),
                    self.value(*rest, motion.unit())
                )
            }
            ForceLaw::Damper { coordinate, damping } => {
                let unit = self.motion(*coordinate).damping_unit();
                let (name, damping) = (self.name(*coordinate), self.value(*damping, unit));
                format!("damper(on: {name}, damping: {damping})")
            }
            ForceLaw::Inerter { coordinate, inertance } => {
                let unit = self.motion(*coordinate).inertance_unit();
                let (name, inertance) = (self.name(*coordinate), self.value(*inertance, unit));
                format!("inerter(on: {name}, inertance: {inertance})")
            }
            ForceLaw::SpringDamper { from, to, stiffness, damping, length } => format!(
                "spring_damper(from: {}, to: {}, stiffness: {}, damping: {}, length: {})",
                self.end(*from),
                self.end(*to),
                self.value(*stiffness, Unit::NewtonPerMetre),
                self.value(*damping, Unit::NewtonSecondPerMetre),
                self.value(*length, Unit::Metre)
            ),
            ForceLaw::Tension { from, to, tension } => {
                format!("tension(from: {}, to: {}, law: {})", self.end(*from), self.end(*to), self.expression(tension))
            }
            ForceLaw::Generalized { coordinate, value } => {
                format!("generalized(on: {}, value: {})", self.name(*coordinate), self.expression(value))
            }
            ForceLaw::Potential { energy } => {
                format!("potential(energy: {})", self.expression(energy))
            }
            ForceLaw::Bushing { from, to, stiffness, damping, turning_stiffness, turning_damping } => format!(
                "bushing(from: {}, to: {}, stiffness: {}, damping: {}, turning_stiffness: {}, turning_damping: {})",
                self.end(*from),
                self.end(*to),
                self.matrix(stiffness, Unit::NewtonPerMetre),
                self.matrix(damping, Unit::NewtonSecondPerMetre),
                self.matrix(turning_stiffness, Unit::NewtonMetrePerRadian),
                self.matrix(turning_damping, Unit::NewtonMetreSecondPerRadian)
            ),
            ForceLaw::Load { point, force, moment, following } => format!(
                "{}(at: {}, force: {}, moment: {})",
                if *following { "follower" } else { "load" },
                self.end(*point),
                self.vector(force, Unit::Newton),
                self.vector(moment, Unit::NewtonMetre)
            ),
            ForceLaw::Drag { point, damping, turning_damping } => format!(
                "drag(at: {}, damping: {}, turning_damping: {})",
                self.end(*point),
                self.value(*damping, Unit::NewtonSecondPerMetre),
                self.value(*turning_damping, Unit::NewtonMetreSecondPerRadian)
            ),
        }
    }

    /// A sum, without parentheses around it.
    fn expression(&self, expr: &Expr) -> String {
        match expr {
            Expr::Sum(parts) => {
                let parts: Vec<String> = parts.iter().map(|part| self.factor(part)).collect();
                parts.join(" + ")
            }
            other => self.factor(other),
        }
    }

    /// An operand, in parentheses where precedence requires them.
    fn factor(&self, expr: &Expr) -> String {
        match expr {
            Expr::Value(value, unit) => format!("({})", self.value(*value, *unit)),
            Expr::Input(input) => self.model.inputs[*input].name.clone(),
            Expr::Coordinate(coordinate) => self.name(*coordinate).to_owned(),
            Expr::Rate(coordinate) => format!("rate({})", self.name(*coordinate)),
            Expr::Position(point, axis) => {
                let component = ["x", "y", "z"][*axis];
                format!("position({}).{component}", self.end(*point))
            }
            Expr::Distance(from, to) => {
                format!("distance({}, {})", self.end(*from), self.end(*to))
            }
            Expr::Length => "length".to_owned(),
            Expr::LengthRate => "rate".to_owned(),
            Expr::Sum(_) => format!("({})", self.expression(expr)),
            Expr::Product(parts) => {
                let parts: Vec<String> = parts.iter().map(|part| self.factor(part)).collect();
                parts.join(" * ")
            }
            Expr::Power(base, exponent) => format!("({})^{exponent}", self.expression(base)),
            Expr::Sine(angle) => format!("sin({})", self.expression(angle)),
            Expr::Cosine(angle) => format!("cos({})", self.expression(angle)),
            Expr::Curve(curve, argument) => {
                format!("{}({})", curve.name, self.expression(argument))
            }
        }
    }
}
