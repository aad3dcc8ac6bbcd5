//! Force elements: springs and dampers on coordinates and between points.

use super::Resolver;
use super::arguments::{Arguments, Signature};
use super::expected::Expected;
use super::typed::Place;
use crate::base::dimension::Dimension;
use crate::base::ids::{CoordinateId, PointId};
use crate::model::expression::Expr;
use crate::model::mechanism::{CoordinateQuantity, Force, ForceLaw};
use crate::syntax::ast::{self, ItemKind, JointClause, ValueKind};

const LAWS: &[Signature] = &[
    Signature {
        word: "spring",
        required: &["on", "stiffness"],
        optional: &["rest"],
        example: "spring(on: theta, stiffness: 10 N*m/rad)",
    },
    Signature {
        word: "damper",
        required: &["on", "damping"],
        optional: &[],
        example: "damper(on: theta, damping: 0.1 N*m*s/rad)",
    },
    Signature {
        word: "spring_damper",
        required: &["from", "to", "stiffness"],
        optional: &["damping", "length"],
        example: "spring_damper(from: p, to: q, stiffness: 100 N/m)",
    },
];

impl Resolver<'_> {
    pub(super) fn forces(&mut self) -> Vec<Force> {
        let mut forces = Vec::new();
        for item in &self.ast.items {
            if let ItemKind::Force(force) = &item.kind
                && let Some(law) = self.law(force)
            {
                forces.push(Force {
                    name: force.name.clone(),
                    law,
                });
            }
        }
        forces
    }

    fn law(&mut self, force: &ast::Force) -> Option<ForceLaw> {
        let signature = self.signature(&force.law, "force law", LAWS)?;
        let arguments = self.arguments(&force.law, signature);
        match signature.word {
            "spring_damper" => self.spring_damper(&arguments),
            word => self.on_coordinate(word, &arguments),
        }
    }

    fn on_coordinate(&mut self, word: &str, arguments: &Arguments) -> Option<ForceLaw> {
        let target = self.free_coordinate(word, arguments);
        let quantity = target.map(|(_, quantity)| quantity);
        let is_angle = quantity == Some(CoordinateQuantity::Angle);
        let pick = |angle: Expected, displacement: Dimension| {
            let displacement = displacement.into();
            quantity.map(|_| if is_angle { angle } else { displacement })
        };
        let stiffness = self.coefficient(
            arguments,
            "stiffness",
            pick(Expected::rotary_stiffness(), Dimension::STIFFNESS),
        );
        let damping = self.coefficient(
            arguments,
            "damping",
            pick(Expected::rotary_damping(), Dimension::DAMPING),
        );
        let rest = match arguments.get("rest") {
            Some(_) => {
                let dimension = pick(Expected::angle(), Dimension::LENGTH);
                self.coefficient(arguments, "rest", dimension)
            }
            None => Some(Expr::Number(0.0)),
        };
        let (coordinate, _) = target?;
        Some(match word {
            "spring" => ForceLaw::CoordinateSpring {
                coordinate,
                stiffness: stiffness?,
                rest: rest?,
            },
            _ => ForceLaw::CoordinateDamper {
                coordinate,
                damping: damping?,
            },
        })
    }

    /// An argument of a dimension that is unknown when the coordinate is: then only the value itself is checked.
    fn coefficient(
        &mut self,
        arguments: &Arguments,
        name: &str,
        expected: Option<Expected>,
    ) -> Option<Expr> {
        let value = arguments.get(name)?;
        let Some(expected) = expected else {
            self.scalar(value, Place::Parameter);
            return None;
        };
        let what = format!("`{name}`");
        let expr = self.scalar_of(value, expected, &what)?;
        self.require_finite(&expr, &what, value.extent);
        Some(expr)
    }

    /// A spring or damper on a driven coordinate changes no motion: the drive takes whatever force it needs.
    fn free_coordinate(
        &mut self,
        word: &str,
        arguments: &Arguments,
    ) -> Option<(CoordinateId, CoordinateQuantity)> {
        let on = arguments.get("on")?;
        let ValueKind::Name(name) = &on.bare().kind else {
            let message = "the name of a joint is expected here";
            self.diagnostics.error(on.extent, message);
            return None;
        };
        let found = self.coordinate(name)?;
        let driven = self.ast.items.iter().any(|item| match &item.kind {
            ItemKind::Joint(joint) => {
                let drive = |clause: &JointClause| matches!(clause, JointClause::Drive { .. });
                joint.name == *name && joint.clauses.iter().any(drive)
            }
            _ => false,
        });
        if driven {
            self.diagnostics.error_with_help(
                name,
                format!("`{name}` is driven; a {word} on it has no effect on the motion"),
                format!("remove the {word}, or the drive"),
            );
            return None;
        }
        Some(found)
    }

    fn spring_damper(&mut self, arguments: &Arguments) -> Option<ForceLaw> {
        let (from, to) = (self.end(arguments, "from"), self.end(arguments, "to"));
        let apart = self.ends_apart(arguments, from, to);
        let stiffness = self.coefficient(arguments, "stiffness", Some(Dimension::STIFFNESS.into()));
        let mut optional = |name, dimension| match arguments.get(name) {
            Some(_) => self.coefficient(arguments, name, Some(Expected::from(dimension))),
            None => Some(Expr::Number(0.0)),
        };
        let damping = optional("damping", Dimension::DAMPING);
        let length = optional("length", Dimension::LENGTH);
        apart?;
        Some(ForceLaw::SpringDamper {
            from: from?,
            to: to?,
            stiffness: stiffness?,
            damping: damping?,
            length: length?,
        })
    }

    fn end(&mut self, arguments: &Arguments, name: &str) -> Option<PointId> {
        let value = arguments.get(name)?;
        match &value.bare().kind {
            ValueKind::Name(point) => self.point_named(point),
            _ => {
                let message = "the name of a point is expected here";
                self.diagnostics.error(value.extent, message);
                None
            }
        }
    }

    /// Between two points of one body the distance never changes, so the element does nothing.
    fn ends_apart(
        &mut self,
        arguments: &Arguments,
        from: Option<PointId>,
        to: Option<PointId>,
    ) -> Option<()> {
        let (from, to) = (from?, to?);
        let frames = self.point_frames();
        let message = if from == to {
            "both ends of this element are the same point".to_string()
        } else if frames.get(from.index()) == frames.get(to.index()) {
            let frame = frames.get(from.index())?;
            format!(
                "both ends of this element are fixed in `{frame}`: their distance never changes"
            )
        } else {
            return Some(());
        };
        self.diagnostics.error(arguments.get("to")?.extent, message);
        None
    }

    fn point_frames(&self) -> Vec<String> {
        let frames = self.ast.items.iter().filter_map(|item| match &item.kind {
            ItemKind::Point(point) => Some(point.frame.to_string()),
            _ => None,
        });
        frames.collect()
    }
}
