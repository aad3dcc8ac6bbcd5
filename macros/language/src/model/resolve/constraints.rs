//! Constraints: the table of their kinds. Each family of kinds has its own file.

mod along;
mod between_points;
mod of_expressions;
mod rolling;

use super::arguments::{Arguments, Signature};
use super::exerted::Exerted;
use super::joints::kinds::{self, Kind};
use super::resolver::Resolver;
use super::typed::ValueContext;
use crate::base::dimension::Dimension;
use crate::model::expression::{Expr, Vector};
use crate::model::mechanism::{Constraint, ConstraintLaw};
use crate::model::rules::physical::Demand;
use crate::syntax::ast;

const OF_COORDINATES: &str = "two points are tied by `coincident`, `aligned` or `distance`";

/// A function that makes a constraint from its arguments.
type Reader = fn(&mut Resolver<'_>, &ast::Constraint, &Arguments<'_>) -> Option<(ConstraintLaw, Exerted)>;

pub(super) type Row = Signature<Reader>;

pub(super) const KINDS: &[Row] = &[
    Row::new("coincident", &["from", "to"], "coincident(from: p, to: q)", |resolver, _, arguments| {
        Some((resolver.coincident(arguments)?, Exerted::Force))
    })
    .optional(&["along"]),
    Row::new("aligned", &["from", "to"], "aligned(from: p, to: q)", |resolver, _, arguments| {
        Some((resolver.aligned(arguments)?, Exerted::Moment))
    })
    .optional(&["axis"]),
    Row::new(
        "distance",
        &["from", "to", "length"],
        "distance(from: p, to: q, length: 1 m)",
        |resolver, constraint, arguments| {
            let law = resolver.distance(constraint, arguments)?;
            Some((law, Exerted::Number(Dimension::FORCE)))
        },
    )
    .refusing(&[("stiffness", "an elastic connection is the force `spring_damper`")]),
    Row::new(
        "coupling",
        &["of", "with", "ratio"],
        "coupling(of: theta1, with: theta2, ratio: -2)",
        |resolver, _, arguments| resolver.coupling(arguments),
    )
    .optional(&["offset"])
    .refusing(&[("from", OF_COORDINATES), ("to", OF_COORDINATES)]),
    Row::new("equation", &["zero"], "equation(zero: position(p).z - 1 m)", |resolver, _, arguments| {
        resolver.equation(arguments)
    }),
    Row::new(
        "rolling",
        &["wheel", "radius", "on"],
        "rolling(wheel: hub, axis: y, radius: 30 cm, on: road)",
        |resolver, constraint, arguments| Some((resolver.rolling(constraint, arguments)?, Exerted::Force)),
    )
    .optional(&["axis", "normal"]),
];

/// Names of the kinds in other tools.
const SYNONYMS: [(&str, &str); 33] = [
    ("point_to_point", "coincident"),
    ("point_on_point", "coincident"),
    ("point_on_line", "coincident"),
    ("point_on_plane", "coincident"),
    ("connect", "coincident"),
    ("attach", "coincident"),
    ("orientation", "aligned"),
    ("parallel", "aligned"),
    ("rod", "distance"),
    ("link", "distance"),
    ("bar", "distance"),
    ("strut", "distance"),
    ("rope", "distance"),
    ("gear", "coupling"),
    ("gears", "coupling"),
    ("belt", "coupling"),
    ("chain", "coupling"),
    ("pulley", "coupling"),
    ("rack", "coupling"),
    ("rack_and_pinion", "coupling"),
    ("mimic", "coupling"),
    ("ratio", "coupling"),
    ("equality", "equation"),
    ("expression", "equation"),
    ("condition", "equation"),
    ("holonomic", "equation"),
    ("wheel", "rolling"),
    ("disk", "rolling"),
    ("tire", "rolling"),
    ("roll", "rolling"),
    ("no_slip", "rolling"),
    ("contact", "rolling"),
    ("nonholonomic", "rolling"),
];

impl Resolver<'_> {
    pub(super) fn constraints(&mut self) -> Vec<Constraint> {
        let mut constraints = Vec::new();
        for constraint in self.ast.all::<ast::Constraint>() {
            let (law, exerted) = self.constraint(constraint).unzip();
            self.exerted.push(exerted);
            constraints.extend(law.map(|law| Constraint { name: constraint.name.clone(), law }));
        }
        constraints
    }

    fn constraint(&mut self, constraint: &ast::Constraint) -> Option<(ConstraintLaw, Exerted)> {
        self.is_no_joint(constraint)?;
        let signature = self.signature(&constraint.law, "constraint", KINDS, &SYNONYMS)?;
        let arguments = self.arguments(&constraint.law, signature);
        (signature.read)(self, constraint, &arguments)
    }

    /// Rejects the names of joints: a joint may close a loop directly and is not declared as a constraint.
    fn is_no_joint(&mut self, constraint: &ast::Constraint) -> Option<()> {
        let word = constraint.law.word.to_string();
        let is_constraint =
            KINDS.iter().any(|known| known.word == word) || SYNONYMS.iter().any(|(theirs, _)| *theirs == word);
        let mut synonyms = kinds::SYNONYMS.iter();
        let joint = Kind::find(&word).map(|kind| kind.word).or_else(|| {
            let (_, ours) = synonyms.find(|(theirs, _)| *theirs == word)?;
            Some(*ours)
        });
        let Some(joint) = joint.filter(|_| !is_constraint) else {
            return Some(());
        };
        let kind = Kind::find(joint)?;
        self.refuse_with_help(
            &constraint.law.word,
            format!("unknown constraint `{word}`"),
            format!(
                "it is a joint, and a joint may close a loop: `joint {}: {} from BODY to BODY;`",
                constraint.name, kind.example
            ),
        )
    }

    /// A required length above zero; `what` names it.
    fn positive_length(&mut self, constraint: &ast::Constraint, arguments: &Arguments, name: &str) -> Option<Expr> {
        let value = arguments.get(name)?;
        let length = self.scalar_of(value, Dimension::LENGTH, &format!("`{name}`"))?;
        self.require(
            format!("the {name} of `{}`", constraint.name),
            [length.clone()],
            Demand::Positive(Dimension::LENGTH),
            value.extent,
        );
        Some(length)
    }

    /// An optional argument that is a direction; the inner option is `None` if it is wrong.
    fn optional_direction(&mut self, arguments: &Arguments, name: &str) -> Option<Option<Vector>> {
        let value = arguments.get(name)?;
        Some(self.direction(value, ValueContext::Parameter))
    }
}
