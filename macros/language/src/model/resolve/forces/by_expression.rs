//! Forces given by expressions of the motion. They cannot be evaluated before it is known, so only their dimensions are
//! checked here.

use super::super::arguments::Arguments;
use super::super::expected::Expected;
use super::super::resolver::Resolver;
use super::super::typed::ValueContext;
use crate::base::dimension::Dimension;
use crate::model::expression::Expr;
use crate::model::mechanism::ForceLaw;

impl Resolver<'_> {
    pub(super) fn generalized(&mut self, arguments: &Arguments) -> Option<ForceLaw> {
        let target = self.free_coordinate("generalized force", arguments);
        let law = arguments.get("value")?;
        let (value, dimension) = self.scalar(law, ValueContext::GeneralizedForce)?;
        let (coordinate, quantity) = target?;
        let expected = quantity.either(Expected::moment(), Dimension::FORCE.into());
        self.expect(dimension, expected, "this generalized force", law)?;
        Some(ForceLaw::Generalized { coordinate, value })
    }

    /// A potential energy, which must contain a coordinate: otherwise it exerts no force.
    pub(super) fn potential(&mut self, arguments: &Arguments) -> Option<ForceLaw> {
        let value = arguments.get("energy")?;
        let (energy, quantity) = self.scalar(value, ValueContext::Energy)?;
        self.expect(quantity, Expected::energy(), "a potential", value)?;
        if !self.moves(&energy) {
            return self.refuse_with_help(
                value.extent,
                "this energy never changes, so it exerts no force",
                "write it with coordinates, or with positions of points",
            );
        }
        Some(ForceLaw::Potential { energy })
    }

    /// Whether the value changes with the motion.
    fn moves(&self, value: &Expr) -> bool {
        value.leaves().into_iter().any(|leaf| match leaf {
            Expr::Coordinate(_) => true,
            Expr::Position(point, _) => self.point_moves(*point),
            _ => false,
        })
    }
}
