//! Rolling without slip.

use super::super::arguments::Arguments;
use super::super::resolver::Resolver;
use crate::model::expression::Expr;
use crate::model::mechanism::ConstraintLaw;
use crate::syntax::ast;

impl Resolver<'_> {
    pub(super) fn rolling(&mut self, constraint: &ast::Constraint, arguments: &Arguments) -> Option<ConstraintLaw> {
        let whole = "the wheel and the plane";
        let reason = "one does not roll on the other";
        let points = self.point_pair(arguments, ["wheel", "on"], whole, reason);
        let radius = self.positive_length(constraint, arguments, "radius");
        let axis = self.optional_direction(arguments, "axis");
        let normal = self.optional_direction(arguments, "normal");
        let (wheel, on) = points?;
        let axis = match axis {
            Some(axis) => Some(axis?),
            None => None,
        };
        let normal = match normal {
            Some(normal) => normal?,
            None => [0.0, 0.0, 1.0].map(Expr::Number),
        };
        Some(ConstraintLaw::Rolling { wheel, axis, radius: radius?, on, normal })
    }
}
