//! Forces between two points.

use super::super::arguments::Arguments;
use super::super::expected::Expected;
use super::super::resolver::Resolver;
use super::super::typed::ValueContext;
use crate::base::dimension::Dimension;
use crate::base::ids::PointId;
use crate::model::mechanism::ForceLaw;

impl Resolver<'_> {
    pub(super) fn spring_damper(&mut self, arguments: &Arguments) -> Option<ForceLaw> {
        let ends = self.ends(arguments, "their distance never changes");
        let stiffness = self.coefficient(arguments, "stiffness", Dimension::STIFFNESS);
        let damping = self.coefficient_or_zero(arguments, "damping", Dimension::DAMPING);
        let length = self.coefficient_or_zero(arguments, "length", Dimension::LENGTH);
        let (from, to) = ends?;
        Some(ForceLaw::SpringDamper { from, to, stiffness: stiffness?, damping: damping?, length: length? })
    }

    /// A tension. The law cannot be evaluated before the motion is known, so only its dimension is checked.
    pub(super) fn tension(&mut self, arguments: &Arguments) -> Option<ForceLaw> {
        let ends = self.ends(arguments, "their distance never changes");
        let law = arguments.get("law")?;
        let (tension, quantity) = self.scalar(law, ValueContext::Tension)?;
        self.expect(quantity, Dimension::FORCE, "a tension", law)?;
        let (from, to) = ends?;
        Some(ForceLaw::Tension { from, to, tension })
    }

    pub(super) fn bushing(&mut self, arguments: &Arguments) -> Option<ForceLaw> {
        let ends = self.ends(arguments, "nothing moves between them");
        let stiffness = self.matrix_or_zero(arguments, "stiffness", Dimension::STIFFNESS);
        let damping = self.matrix_or_zero(arguments, "damping", Dimension::DAMPING);
        let turning_stiffness = self.matrix_or_zero(arguments, "turning_stiffness", Expected::rotary_stiffness());
        let turning_damping = self.matrix_or_zero(arguments, "turning_damping", Expected::rotary_damping());
        let (from, to) = ends?;
        Some(ForceLaw::Bushing {
            from,
            to,
            stiffness: stiffness?,
            damping: damping?,
            turning_stiffness: turning_stiffness?,
            turning_damping: turning_damping?,
        })
    }

    /// The two ends of an element.
    fn ends(&mut self, arguments: &Arguments, reason: &str) -> Option<(PointId, PointId)> {
        let whole = "both ends of this element";
        self.point_pair(arguments, ["from", "to"], whole, reason)
    }
}
