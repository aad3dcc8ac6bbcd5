//! The loads that joints and constraints transmit.

use proc_macro2::Ident;

use super::super::exerted::Exerted;
use super::super::resolver::Resolver;
use super::super::scope::Meaning;
use super::super::typed::{Quantity, Typed};
use crate::base::dimension::Dimension;
use crate::base::ids::{ConstraintId, ForceId};
use crate::model::expression::Expr;
use crate::syntax::ast::{self, Value};

const KIND: &str = "joint or constraint";

impl Resolver<'_> {
    /// `reaction_force` or `reaction_moment` of a joint or a constraint.
    pub(super) fn reaction_vector(&mut self, function: &str, of: &Value) -> Option<Typed> {
        let name = self.name_of(of, KIND)?;
        let force = function == "reaction_force";
        let (first, dimension) = if force { (0, Dimension::FORCE) } else { (3, Dimension::MOMENT) };
        let components = [0, 1, 2].map(|axis| first + axis);
        let vector = match self.scope.find_or_unclear(&name.to_string()) {
            Some(Meaning::Constraint(id)) => {
                let exerted = self.exerted_by(id)?;
                let right = match exerted {
                    Exerted::Force => force,
                    Exerted::Moment => !force,
                    Exerted::Number(_) => false,
                };
                if !right {
                    self.wrong_reaction(function, name, exerted);
                    return None;
                }
                components.map(|component| Expr::ConstraintReaction(id, component))
            }
            Some(Meaning::Force(id)) if self.law_word(id) == Some("bushing") => {
                components.map(|component| Expr::Exerted(id, component))
            }
            _ => {
                let joint = self.joint_named(name, KIND)?;
                components.map(|component| Expr::Reaction(joint, component))
            }
        };
        Some(Typed::Vector(vector, Quantity::Of(dimension)))
    }

    /// `reaction` of a constraint with a single equation.
    pub(super) fn reaction_number(&mut self, of: &Value) -> Option<Typed> {
        let name = self.name_of(of, "constraint")?;
        match self.scope.find_or_unclear(&name.to_string()) {
            Some(Meaning::Constraint(id)) => {
                let exerted = self.exerted_by(id)?;
                let Exerted::Number(dimension) = exerted else {
                    self.wrong_reaction("reaction", name, exerted);
                    return None;
                };
                let value = Expr::ConstraintReaction(id, 0);
                Some(Typed::Scalar(value, Quantity::Of(dimension)))
            }
            Some(Meaning::Force(id)) if self.is_tension(id) => {
                let value = Expr::Exerted(id, 0);
                Some(Typed::Scalar(value, Quantity::Of(Dimension::FORCE)))
            }
            Some(Meaning::Joint(_) | Meaning::OnlyCoordinate(_)) => self.refuse_with_help(
                name,
                format!("`{name}` is a joint; a constraint is expected here"),
                format!("write `reaction_force({name})` or `reaction_moment({name})`"),
            ),
            other => {
                let right = |meaning| matches!(meaning, Meaning::Constraint(_));
                self.wrong_reference(name, "constraint", other, right);
                None
            }
        }
    }

    /// The word of a force law.
    fn law_word(&self, id: ForceId) -> Option<&'static str> {
        let mut forces = self.ast.all::<ast::Force>().filter(|force| !force.is_harmonic());
        let word = forces.nth(id.index())?.law.word.to_string();
        ["bushing", "spring_damper", "tension"].into_iter().find(|known| *known == word)
    }

    fn is_tension(&self, id: ForceId) -> bool {
        matches!(self.law_word(id), Some("spring_damper" | "tension"))
    }

    /// The reaction of a constraint; `None` if the constraint is wrong.
    fn exerted_by(&self, id: ConstraintId) -> Option<Exerted> {
        *self.exerted.get(id.index())?
    }

    fn wrong_reaction(&mut self, function: &str, name: &Ident, exerted: Exerted) {
        let (what, right) = match exerted {
            Exerted::Force => ("a force", "reaction_force"),
            Exerted::Moment => ("a moment", "reaction_moment"),
            Exerted::Number(_) => ("one number", "reaction"),
        };
        self.diagnostics.error_with_help(
            name,
            format!("what the constraint `{name}` exerts is {what}, not its `{function}`"),
            format!("write `{right}({name})`"),
        );
    }
}
