//! Functions of positions, velocities, and the energies and forces of the motion.

use proc_macro2::Ident;

use super::super::coordinates::{self, DeclaredMotion};
use super::super::resolver::Resolver;
use super::super::typed::{Quantity, Typed, ValueContext};
use crate::base::dimension::Dimension;
use crate::base::ids::CoordinateId;
use crate::model::expression::{Expr, Vector};
use crate::model::simplify;
use crate::syntax::ast::{self, ItemKind, Value, ValueKind};

/// Force laws whose stored energy is unknown.
const WITHOUT_ENERGY: [&str; 3] = ["tension", "generalized", "bushing"];

impl<'a> Resolver<'a> {
    pub(super) fn of_motion(
        &mut self,
        name: &str,
        function: &Ident,
        arguments: &[Value],
        value_context: ValueContext,
    ) -> Option<Typed> {
        let length = Quantity::Of(Dimension::LENGTH);
        let energy = Quantity::Of(Dimension::MOMENT);
        Some(match (name, arguments) {
            ("position", [point]) => Typed::Vector(self.position_of(point)?, length),
            ("distance", [from, to]) => {
                let (from, to) = (self.position_of(from), self.position_of(to));
                let apart = simplify::componentwise(to?, from?, simplify::subtract);
                Typed::Scalar(simplify::norm(&apart), length)
            }
            ("distance_from_axis", [point, axis]) => {
                let (point, axis) = (self.position_of(point), self.direction(axis, value_context));
                let arm = simplify::cross(&axis?, &point?);
                Typed::Scalar(simplify::norm(&arm), length)
            }
            ("rate", [coordinate]) => {
                let name = self.name_of(coordinate, "coordinate")?;
                let (coordinate, quantity) = self.coordinate(name)?;
                if value_context == ValueContext::Output {
                    self.rate_is_constant(function, name, coordinate)?;
                }
                let rate = Quantity::Of(coordinates::rate_dimension(quantity));
                Typed::Scalar(Expr::Rate(coordinate), rate)
            }
            ("reaction_force" | "reaction_moment", [joint]) => self.reaction_vector(name, joint)?,
            ("reaction", [constraint]) => self.reaction_number(constraint)?,
            ("curvature" | "moment" | "strain" | "inner_force", [point]) => self.bent(name, point)?,
            ("kinetic_energy", []) => Typed::Scalar(Expr::KineticEnergy, energy),
            ("potential_energy", []) => {
                self.energy_is_known(function)?;
                Typed::Scalar(Expr::PotentialEnergy, energy)
            }
            // The number of arguments has already been checked.
            _ => return None,
        })
    }

    /// Requires a rate to be a useful result: in steady motion a free coordinate is at rest, and the speed of a driven
    /// one is given.
    fn rate_is_constant(&mut self, function: &Ident, name: &Ident, coordinate: CoordinateId) -> Option<()> {
        let reason = match self.coordinates.get(coordinate.index())?.motion {
            DeclaredMotion::Coasting => return Some(()),
            DeclaredMotion::Driven => "it is the speed of the drive",
            DeclaredMotion::Free | DeclaredMotion::Shaken => "in steady motion it is zero",
        };
        let message = format!("the rate of `{name}` is no output: {reason}");
        self.refuse(function, message)
    }

    /// Requires all forces to have a known potential, which `tension`, `generalized` and `bushing` do not have.
    fn energy_is_known(&mut self, function: &Ident) -> Option<()> {
        let unknown = self.ast.items.iter().find_map(|item| match &item.kind {
            ItemKind::Force(force) => {
                let word = force.law.word.to_string();
                WITHOUT_ENERGY.contains(&word.as_str()).then_some((&force.name, word))
            }
            _ => None,
        });
        let Some((name, word)) = unknown else {
            return Some(());
        };
        self.refuse_with_help(
            function,
            format!("the energy of `{name}` is unknown: a {word} gives its force only"),
            "write the force as a `potential`, or leave out this output",
        )
    }

    /// Curvature, moment, strain or force of a beam at a point of it.
    fn bent(&mut self, function: &str, point: &Value) -> Option<Typed> {
        let name = self.name_of(point, "point")?;
        let id = self.point_named(name)?;
        let point = self.declared_point(name);
        if !point.is_some_and(|point| self.is_beam(&point.frame)) {
            let function = function.replace('_', " ");
            let message = format!("`{name}` is not on a beam: it has no {function}");
            let help = "declare a point of the beam: `point gauge: blade at 0.3 length;`";
            return self.refuse_with_help(name, message, help);
        }
        let (first, dimension) = match function {
            "curvature" => (0, Dimension::new(-1, 0, 0)),
            "moment" => (3, Dimension::MOMENT),
            "strain" => {
                self.strains_at(name)?;
                (6, Dimension::NONE)
            }
            _ => {
                self.cut_open_at(name)?;
                (9, Dimension::FORCE)
            }
        };
        let components = [0, 1, 2].map(|axis| Expr::Bent(id, first + axis));
        Some(Typed::Vector(components, Quantity::Of(dimension)))
    }

    /// The declaration of a point.
    pub(in crate::model::resolve) fn declared_point(&self, name: &Ident) -> Option<&'a ast::Point> {
        self.ast.all::<ast::Point>().find(|point| point.name == *name)
    }

    /// Requires that the sections of a beam stretch or shear by coordinates.
    fn strains_at(&mut self, name: &Ident) -> Option<()> {
        let beam = self.declared_point(name)?.frame.clone();
        if self.strains(&beam)? {
            return Some(());
        }
        let message = format!("`{beam}` neither stretches nor shears by coordinates of its own");
        let help = "give the beam `stretch: 2` or `shear: 5`, or ask for `curvature`";
        self.refuse_with_help(name, message, help)
    }

    /// The force inside a beam is what its outer part transmits: the beam ends there, and another continues it.
    fn cut_open_at(&mut self, name: &Ident) -> Option<()> {
        let placement = self.declared_point(name)?.placement.as_ref();
        let offset = placement.and_then(|placement| placement.offset.as_ref());
        let is_inside = offset.is_some_and(|place| match &place.kind {
            ValueKind::Fraction(fraction) => *fraction > 0.0,
            ValueKind::Name(word) => word == "tip",
            _ => false,
        });
        if !is_inside {
            let message = "the force inside a beam is known behind its root only";
            let help = "at the root, write `reaction_force` of the joint that holds the beam";
            return self.refuse_with_help(name, message, help);
        }
        self.cut_open.insert(name.to_string());
        Some(())
    }

    fn position_of(&mut self, point: &Value) -> Option<Vector> {
        let name = self.name_of(point, "point")?;
        let point = self.point_named(name)?;
        Some([0, 1, 2].map(|axis| Expr::Position(point, axis)))
    }

    /// An argument that must be a name.
    pub(in crate::model::resolve) fn name_of<'v>(&mut self, value: &'v Value, kind: &str) -> Option<&'v Ident> {
        match &value.bare().kind {
            ValueKind::Name(name) => Some(name),
            _ => {
                let message = format!("the name of a {kind} is expected here");
                self.refuse(value.extent, message)
            }
        }
    }
}
