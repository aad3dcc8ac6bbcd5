//! Points fixed in bodies, and the outputs that look at them.

use super::Resolver;
use super::typed::Place;

use crate::model::expression::{Expr, Function};
use crate::model::mechanism::{CoordinateQuantity, Output, Point, Unit};
use crate::syntax::ast::ItemKind;

impl Resolver<'_> {
    pub(super) fn points(&mut self) -> Vec<Point> {
        let mut points = Vec::new();
        for item in &self.ast.items {
            let ItemKind::Point(point) = &item.kind else {
                continue;
            };
            let frame = self.frame(&point.frame);
            let position = match &point.at {
                Some(at) => self.position(at, "a point's place"),
                None => Some([0.0; 3].map(Expr::Number)),
            };
            if let (Some(frame), Some(position)) = (frame, position) {
                points.push(Point {
                    name: point.name.clone(),
                    frame,
                    position,
                });
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
            if let Some((value, quantity)) = self.scalar(&output.value, Place::Output) {
                let dimension = quantity.dimension();
                let symbol = if dimension.is_none() && self.is_angle(&value) {
                    "rad".to_string()
                } else {
                    dimension.si_symbol()
                };
                outputs.push(Output {
                    name: output.name.clone(),
                    docs: item.docs.clone(),
                    unit: Unit { symbol, scale: 1.0 },
                    value,
                });
            }
        }
        outputs
    }

    /// The dimension does not tell an angle from a plain number; a coordinate or an inverse function does.
    fn is_angle(&self, value: &Expr) -> bool {
        match value {
            Expr::Coordinate(id) => self
                .declared_coordinates
                .get(id.index())
                .is_some_and(|coordinate| coordinate.quantity == CoordinateQuantity::Angle),
            Expr::Negate(a) => self.is_angle(a),
            Expr::Add(a, b) | Expr::Subtract(a, b) => self.is_angle(a) || self.is_angle(b),
            Expr::Multiply(a, b) => match (&**a, &**b) {
                (Expr::Number(_), angle) | (angle, Expr::Number(_)) => self.is_angle(angle),
                _ => false,
            },
            Expr::Divide(a, b) => matches!(**b, Expr::Number(_)) && self.is_angle(a),
            Expr::Call(Function::Asin | Function::Acos, _) | Expr::Atan2(..) => true,
            _ => false,
        }
    }
}
