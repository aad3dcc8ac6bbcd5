//! Springs and dampers on every free coordinate of one kind.

use proc_macro2::Ident;

use super::arguments::Signature;
use super::coordinates::DeclaredMotion;
use super::expected::Expected;
use super::resolver::Resolver;
use crate::base::dimension::Dimension;
use crate::base::ids::CoordinateId;
use crate::base::nearest::suggestion;
use crate::model::expression::Expr;
use crate::model::mechanism::{CoordinateQuantity, Force, ForceLaw};
use crate::syntax::ast::Every;

type Row = Signature<()>;

const ON: (&str, &str) = ("on", "it acts on every free coordinate; on one of them it is a `force`");

const LAWS: &[Row] = &[
    Row::new("spring", &["stiffness"], "spring(stiffness: 10 N*m/rad)", ())
        .optional(&["rest"])
        .refusing(&[ON, ("damping", "both together are a `spring_damper`")]),
    Row::new("damper", &["damping"], "damper(damping: 0.1 N*m*s/rad)", ())
        .refusing(&[ON, ("stiffness", "both together are a `spring_damper`")]),
    Row::new(
        "spring_damper",
        &["stiffness", "damping"],
        "spring_damper(stiffness: 10 N*m/rad, damping: 0.1 N*m*s/rad)",
        (),
    )
    .optional(&["rest"])
    .refusing(&[ON, ("length", "a coordinate has a `rest`")]),
];

/// Names of the laws in other tools.
const SYNONYMS: [(&str, &str); 5] = [
    ("stiffness", "spring"),
    ("dashpot", "damper"),
    ("damping", "damper"),
    ("friction", "damper"),
    ("bushing", "spring_damper"),
];

const QUANTITIES: [(&str, CoordinateQuantity); 2] =
    [("angle", CoordinateQuantity::Angle), ("displacement", CoordinateQuantity::Displacement)];

/// Other names for the coordinates, and their quantities.
const SYNONYMS_OF_QUANTITIES: [(&str, &str); 12] = [
    ("joint", "angle"),
    ("coordinate", "angle"),
    ("rotation", "angle"),
    ("turn", "angle"),
    ("revolute", "angle"),
    ("hinge", "angle"),
    ("position", "displacement"),
    ("translation", "displacement"),
    ("slide", "displacement"),
    ("slider", "displacement"),
    ("prismatic", "displacement"),
    ("length", "displacement"),
];

/// The laws declared so far for the coordinates of a kind.
#[derive(Default)]
struct Given {
    stiffness: bool,
    damping: bool,
}

impl Resolver<'_> {
    /// Forces on every free coordinate that has no spring, or no damper, of its own.
    pub(super) fn forces_of_every(&mut self, existing: &[Force]) -> Vec<Force> {
        let mut given = QUANTITIES.map(|_| Given::default());
        let mut forces = Vec::new();
        for every in self.ast.all() {
            forces.extend(self.forces_of(every, existing, &mut given).unwrap_or_default());
        }
        forces
    }

    fn forces_of(&mut self, every: &Every, forces: &[Force], given: &mut [Given]) -> Option<Vec<Force>> {
        let index = self.quantity(&every.quantity);
        let signature = self.signature(&every.law, "law of every coordinate", LAWS, &SYNONYMS)?;
        let arguments = self.arguments(&every.law, signature);
        let pick =
            |angle: Expected, displacement: Dimension| Some(QUANTITIES[index?].1.either(angle, displacement.into()));
        let stiffness = pick(Expected::rotary_stiffness(), Dimension::STIFFNESS);
        let stiffness = self.coefficient(&arguments, "stiffness", stiffness);
        let damping = pick(Expected::rotary_damping(), Dimension::DAMPING);
        let damping = self.coefficient(&arguments, "damping", damping);
        let rest = pick(Expected::angle(), Dimension::LENGTH);
        let rest = self.coefficient_or_zero(&arguments, "rest", rest)?;
        let index = index?;
        let given = &mut given[index];
        let repeated =
            [(stiffness.is_some() && given.stiffness, "a spring"), (damping.is_some() && given.damping, "a damper")];
        given.stiffness |= stiffness.is_some();
        given.damping |= damping.is_some();
        let (word, quantity) = QUANTITIES[index];
        if let Some((_, what)) = repeated.iter().find(|(is_repeated, _)| *is_repeated) {
            let message = format!("every {word} has {what} already");
            return self.refuse(&every.law.word, message);
        }
        let coordinates = self.free_coordinates(quantity);
        if coordinates.is_empty() && !self.may_have_more_coordinates() {
            let message = format!("no {word} is free");
            let help = "remove this, or let a joint move";
            return self.refuse_with_help(&every.quantity, message, help);
        }
        Some(laws(every, forces, &coordinates, stiffness, damping, rest))
    }

    /// The index of a kind of coordinate in the table.
    fn quantity(&mut self, word: &Ident) -> Option<usize> {
        let index = QUANTITIES.iter().position(|(known, _)| word == known);
        if index.is_none() {
            let known = QUANTITIES.map(|(known, _)| known);
            let meant = suggestion(&word.to_string(), known, &SYNONYMS_OF_QUANTITIES);
            let help = match meant {
                Some("displacement") => "did you mean `displacement`?",
                _ => "write `every angle` for joints that turn, `every displacement` for those that slide",
            };
            let message = format!("`every {word}` is neither `every angle` nor `every displacement`");
            self.diagnostics.error_with_help(word, message, help);
        }
        index
    }

    fn free_coordinates(&self, quantity: CoordinateQuantity) -> Vec<CoordinateId> {
        self.coordinates
            .iter()
            .enumerate()
            .filter(|(_, coordinate)| {
                coordinate.quantity == Some(quantity) && coordinate.motion == DeclaredMotion::Free && !coordinate.cut
            })
            .map(|(index, _)| CoordinateId::new(index))
            .collect()
    }
}

/// A spring and a damper on each coordinate that has none.
fn laws(
    every: &Every,
    forces: &[Force],
    coordinates: &[CoordinateId],
    stiffness: Option<Expr>,
    damping: Option<Expr>,
    rest: Expr,
) -> Vec<Force> {
    let mut laws = Vec::new();
    for &id in coordinates {
        let has_spring = forces
            .iter()
            .any(|force| matches!(force.law, ForceLaw::CoordinateSpring { coordinate, .. } if coordinate == id));
        let has_damper = forces
            .iter()
            .any(|force| matches!(force.law, ForceLaw::CoordinateDamper { coordinate, .. } if coordinate == id));
        if let Some(stiffness) = stiffness.clone().filter(|_| !has_spring) {
            laws.push(ForceLaw::CoordinateSpring { coordinate: id, stiffness, rest: rest.clone() });
        }
        if let Some(damping) = damping.clone().filter(|_| !has_damper) {
            laws.push(ForceLaw::CoordinateDamper { coordinate: id, damping });
        }
    }
    laws.into_iter().map(|law| Force { name: every.quantity.clone(), law, of_every: true }).collect()
}
