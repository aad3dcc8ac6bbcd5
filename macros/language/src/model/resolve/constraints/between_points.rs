//! Constraints between two points: places, axes, distances.

use super::super::arguments::Arguments;
use super::super::resolver::Resolver;
use crate::base::ids::PointId;
use crate::model::mechanism::ConstraintLaw;
use crate::syntax::ast;

impl Resolver<'_> {
    pub(super) fn coincident(&mut self, arguments: &Arguments) -> Option<ConstraintLaw> {
        let ends = self.tied_points(arguments);
        let along = match arguments.get("along") {
            Some(value) => self.axes_along(value),
            None => Some([true; 3]),
        };
        let (from, to) = ends?;
        Some(ConstraintLaw::Coincident { from, to, along: along? })
    }

    pub(super) fn aligned(&mut self, arguments: &Arguments) -> Option<ConstraintLaw> {
        let ends = self.tied_points(arguments);
        let axis = self.optional_direction(arguments, "axis");
        let (from, to) = ends?;
        let axis = match axis {
            Some(axis) => Some(axis?),
            None => None,
        };
        Some(ConstraintLaw::Aligned { from, to, axis })
    }

    pub(super) fn distance(&mut self, constraint: &ast::Constraint, arguments: &Arguments) -> Option<ConstraintLaw> {
        let ends = self.tied_points(arguments);
        let length = self.positive_length(constraint, arguments, "length");
        let (from, to) = ends?;
        Some(ConstraintLaw::Distance { from, to, length: length? })
    }

    fn tied_points(&mut self, arguments: &Arguments) -> Option<(PointId, PointId)> {
        let whole = "both points of this constraint";
        let reason = "nothing moves between them";
        self.point_pair(arguments, ["from", "to"], whole, reason)
    }
}
