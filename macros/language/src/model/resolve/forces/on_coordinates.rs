//! Springs, dampers and inerters on a coordinate.

use super::super::arguments::Arguments;
use super::super::coordinates::DeclaredMotion;
use super::super::expected::Expected;
use super::super::resolver::Resolver;
use crate::base::dimension::Dimension;
use crate::base::ids::CoordinateId;
use crate::model::mechanism::{CoordinateQuantity, ForceLaw};
use crate::syntax::ast::ValueKind;
use crate::syntax::print;

impl Resolver<'_> {
    pub(super) fn spring(&mut self, arguments: &Arguments) -> Option<ForceLaw> {
        let target = self.free_coordinate("spring", arguments);
        let pick = |angle: Expected, displacement: Dimension| Some(target?.1.either(angle, displacement.into()));
        let stiffness = pick(Expected::rotary_stiffness(), Dimension::STIFFNESS);
        let stiffness = self.coefficient(arguments, "stiffness", stiffness);
        let rest = pick(Expected::angle(), Dimension::LENGTH);
        let rest = self.coefficient_or_zero(arguments, "rest", rest);
        Some(ForceLaw::CoordinateSpring { coordinate: target?.0, stiffness: stiffness?, rest: rest? })
    }

    pub(super) fn damper(&mut self, arguments: &Arguments) -> Option<ForceLaw> {
        let target = self.free_coordinate("damper", arguments);
        let damping =
            target.map(|(_, quantity)| quantity.either(Expected::rotary_damping(), Dimension::DAMPING.into()));
        let damping = self.coefficient(arguments, "damping", damping);
        Some(ForceLaw::CoordinateDamper { coordinate: target?.0, damping: damping? })
    }

    pub(super) fn inerter(&mut self, arguments: &Arguments) -> Option<ForceLaw> {
        let target = self.free_coordinate("inerter", arguments);
        let inertance =
            target.map(|(_, quantity)| Expected::from(quantity.either(Dimension::INERTIA, Dimension::MASS)));
        let inertance = self.coefficient(arguments, "inertance", inertance);
        Some(ForceLaw::CoordinateInerter { coordinates: [target?.0; 2], inertance: inertance? })
    }

    /// A free coordinate. A force on a driven coordinate changes no motion, because the drive supplies any force that
    /// it needs. A spring on a coasting coordinate has no steady state.
    pub(in crate::model::resolve) fn free_coordinate(
        &mut self,
        word: &str,
        arguments: &Arguments,
    ) -> Option<(CoordinateId, CoordinateQuantity)> {
        let on = arguments.get("on")?;
        if !matches!(on.bare().kind, ValueKind::Name(_)) {
            let help = match word {
                "spring" => {
                    let on = print::value(on);
                    format!("a spring on an expression is a potential: `potential(energy: stiffness * ({on})^2 / 2)`")
                }
                _ => "write one `generalized` force on each coordinate, with `rate` of the others in its `value`"
                    .to_string(),
            };
            return self.refuse_with_help(
                on.extent,
                format!("a {word} acts on one coordinate, given by its name"),
                help,
            );
        }
        let name = self.name_of(on, "coordinate")?;
        let coordinate = self.coordinate(name)?;
        match self.coordinates.get(coordinate.0.index())?.motion {
            motion @ (DeclaredMotion::Driven | DeclaredMotion::Shaken) => {
                let given = motion.word();
                self.refuse_with_help(
                    name,
                    format!("`{name}` is {given}; a {word} on it has no effect on the motion"),
                    match motion {
                        DeclaredMotion::Shaken => format!("remove the {word}, or `shaken`"),
                        _ => format!("remove the {word}, or the drive"),
                    },
                )
            }
            DeclaredMotion::Coasting if word == "spring" => self.refuse_with_help(
                name,
                format!("`{name}` is coasting: nothing may depend on how far it has gone"),
                "a `damper` or a `generalized` force may act on it",
            ),
            _ => Some(coordinate),
        }
    }
}
