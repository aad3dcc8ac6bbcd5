//! Directions: axis names, or arbitrary vectors that are normalised.

use super::resolver::Resolver;
use super::typed::ValueContext;
use crate::model::expression::{Expr, Vector};
use crate::model::rules::physical::Demand;
use crate::model::simplify;
use crate::syntax::ast::{Value, ValueKind};

impl Resolver<'_> {
    /// A unit vector. `x`, `y` and `z` always mean the axes here, whatever else is declared.
    pub(super) fn direction(&mut self, value: &Value, value_context: ValueContext) -> Option<Vector> {
        if let Some(axis) = axis(value) {
            return Some(axis);
        }
        if let ValueKind::Name(name) = &value.bare().kind
            && self.scope.find_or_unclear(&name.to_string()).is_none()
        {
            let help = match name.to_string().as_str() {
                "down" | "downward" | "downwards" => "where the z axis points up, down is `-z`",
                "up" | "upward" | "upwards" => "where the z axis points up, up is `z`",
                _ => "a direction is x, y, z, -x, -y, -z or a vector such as `[1, 0, 1]`",
            };
            let message = format!("unknown direction `{name}`");
            return self.refuse_with_help(name, message, help);
        }
        let (vector, _) = self.vector(value, value_context)?;
        if let [Expr::Number(x), Expr::Number(y), Expr::Number(z)] = vector {
            return self.constant_direction([x, y, z], value);
        }
        self.require("this direction", vector.clone(), Demand::Direction, value.extent);
        let length = simplify::norm(&vector);
        Some(vector.map(|component| simplify::divide(component, length.clone())))
    }

    /// The unit vector along a constant vector; a zero vector has no direction.
    fn constant_direction(&mut self, vector: [f64; 3], value: &Value) -> Option<Vector> {
        // Scaled first, so that the length of tiny and huge vectors can be computed.
        let largest = vector.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
        if largest == 0.0 {
            return self.refuse(value.extent, "a zero vector has no direction");
        }
        let scaled = vector.map(|component| component / largest);
        let length = scaled.iter().map(|a| a * a).sum::<f64>().sqrt();
        // Adding zero turns -0 into 0.
        Some(scaled.map(|component| Expr::Number(component / length + 0.0)))
    }
}

/// An axis by its name.
pub(super) fn axis(value: &Value) -> Option<Vector> {
    let (sign, name) = match &value.bare().kind {
        ValueKind::Name(name) => (1.0, name),
        ValueKind::Negate(operand) => match &operand.bare().kind {
            ValueKind::Name(name) => (-1.0, name),
            _ => return None,
        },
        _ => return None,
    };
    let index = ["x", "y", "z"].iter().position(|axis| name == axis)?;
    let mut components = [0.0; 3];
    components[index] = sign;
    Some(components.map(Expr::Number))
}
