//! Points fixed in bodies, and the outputs.

use super::expected::Expected;
use super::resolver::Resolver;
use super::typed::ValueContext;
use crate::base::dimension::Dimension;
use crate::model::expression::{Expr, Function};
use crate::model::mechanism::{CoordinateQuantity, Output, Point, Unit};
use crate::syntax::ast::{self, ItemKind};

impl Resolver<'_> {
    pub(super) fn points(&mut self) -> Vec<Point> {
        let mut points = Vec::new();
        for point in self.ast.all::<ast::Point>() {
            let (frame, placement) = self.placed_frame(&point.frame, point.placement.as_ref());
            if let (Some(frame), Some(placement)) = (frame, placement) {
                points.push(Point { name: point.name.clone(), frame, placement });
            }
        }
        points
    }

    pub(super) fn outputs(&mut self) -> Vec<Output> {
        let mut outputs = Vec::new();
        for item in &self.ast.items {
            let ItemKind::Output(output) = &item.kind else {
                continue;
            };
            let declared = output.unit.as_ref().map(|unit| self.declared_unit(unit));
            let Some((value, quantity)) = self.scalar(&output.value, ValueContext::Output) else {
                continue;
            };
            let unit = match declared {
                None => self.unit_of(&value, quantity.dimension()),
                Some((None, _)) => continue,
                Some((Some(dimension), unit)) => {
                    let what = format!("`{}`", output.name);
                    let expected = Expected::in_unit(dimension, &unit.symbol);
                    if self.expect(quantity, expected, &what, &output.value).is_none() {
                        continue;
                    }
                    unit
                }
            };
            outputs.push(Output { name: output.name.clone(), docs: item.docs.clone(), unit, value });
        }
        outputs
    }

    /// The SI unit of a value.
    pub(super) fn unit_of(&self, value: &Expr, dimension: Dimension) -> Unit {
        // A number may have a unit: a stiffness times an angle is a moment.
        match (self.measure(value), dimension) {
            (Some(Measure::Angle), Dimension::NONE) => Unit::one("rad"),
            (Some(Measure::Energy), Dimension::MOMENT) => Unit::one("J"),
            _ => Unit::si(dimension),
        }
    }

    /// Distinguishes quantities of equal dimension. Only terms of a sum and multiples by a number keep the distinction.
    fn measure(&self, value: &Expr) -> Option<Measure> {
        match value {
            Expr::Coordinate(id) => {
                let angle = Some(CoordinateQuantity::Angle);
                (self.coordinates.get(id.index())?.quantity == angle).then_some(Measure::Angle)
            }
            Expr::KineticEnergy | Expr::PotentialEnergy => Some(Measure::Energy),
            Expr::Negate(a) => self.measure(a),
            Expr::Add(a, b) | Expr::Subtract(a, b) => self.measure(a).or_else(|| self.measure(b)),
            Expr::Multiply(a, b) => match (&**a, &**b) {
                (Expr::Number(_), other) | (other, Expr::Number(_)) => self.measure(other),
                _ => None,
            },
            Expr::Divide(a, b) if matches!(**b, Expr::Number(_)) => self.measure(a),
            Expr::Call(Function::Asin | Function::Acos, _) | Expr::Atan2(..) => Some(Measure::Angle),
            _ => None,
        }
    }
}

/// Quantities that share their dimension with others.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Measure {
    /// Not a plain number.
    Angle,
    /// Not a moment.
    Energy,
}
