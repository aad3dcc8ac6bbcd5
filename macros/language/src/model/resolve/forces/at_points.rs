//! Loads, and the resistance of a medium, at a point of a body.

use super::super::arguments::Arguments;
use super::super::expected::Expected;
use super::super::resolver::Resolver;
use crate::base::dimension::Dimension;
use crate::base::ids::PointId;
use crate::model::mechanism::ForceLaw;
use crate::syntax::ast::ValueKind;

impl Resolver<'_> {
    pub(super) fn load(&mut self, arguments: &Arguments, following: bool) -> Option<ForceLaw> {
        let point = self.moving_point(arguments, "nothing moves under a load there");
        let force = self.vector_or_zero(arguments, "force", Dimension::FORCE);
        let moment = self.vector_or_zero(arguments, "moment", Expected::moment());
        Some(ForceLaw::Load { point: point?, force: force?, moment: moment?, following })
    }

    pub(super) fn distributed(&mut self, arguments: &Arguments) -> Option<ForceLaw> {
        let on = arguments.get("on").and_then(|value| match &value.kind {
            ValueKind::Name(name) if self.is_beam(name) => Some(name.clone()),
            _ => {
                let message = "`on` is the name of a beam";
                let help = "a force at one place of a body is a `load`";
                self.refuse_with_help(value.extent, message, help)
            }
        });
        let per_length = Expected::force_per_length;
        let force = self.vector_or_zero(arguments, "force", per_length());
        let follower = self.vector_or_zero(arguments, "follower", per_length());
        let damping = self.coefficient_or_zero(arguments, "damping", Dimension::new(-1, 1, -1));
        Some(ForceLaw::Distributed { on: on?, force: force?, follower: follower?, damping: damping? })
    }

    pub(super) fn drag(&mut self, arguments: &Arguments) -> Option<ForceLaw> {
        let point = self.moving_point(arguments, "it never moves");
        let damping = self.coefficient_or_zero(arguments, "damping", Dimension::DAMPING);
        let turning_damping = self.coefficient_or_zero(arguments, "turning_damping", Expected::rotary_damping());
        Some(ForceLaw::Drag { point: point?, damping: damping?, turning_damping: turning_damping? })
    }

    /// A point of a body. A force at a point of the ground does nothing; `reason` explains this.
    pub(in crate::model::resolve) fn moving_point(&mut self, arguments: &Arguments, reason: &str) -> Option<PointId> {
        let point = self.point_argument(arguments, "at")?;
        if self.point_frame(point)? == "ground" {
            let value = arguments.get("at")?;
            let message = format!("this point is fixed in the ground: {reason}");
            return self.refuse(value.extent, message);
        }
        Some(point)
    }
}
