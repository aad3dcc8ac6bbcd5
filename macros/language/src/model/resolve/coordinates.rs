//! The coordinates of a declaration. They are collected before anything is resolved, so that everything can refer to
//! them.

use proc_macro2::Ident;

use super::joints::kinds::Kind;
use crate::base::dimension::Dimension;
use crate::base::ids::JointId;
use crate::model::mechanism::CoordinateQuantity;
use crate::syntax::ast::{Ast, Joint, JointClause};

/// A coordinate as declared, even if the rest of its joint is wrong. Its index in the list is its id.
#[derive(Clone, Debug)]
pub(super) struct Declared<'a> {
    /// The joint's name if it is the only one, otherwise its own.
    pub(super) name: &'a Ident,
    pub(super) joint: JointId,
    /// `None` if the joint is wrong.
    pub(super) quantity: Option<CoordinateQuantity>,
    pub(super) motion: DeclaredMotion,
    /// Whether its joint closes a loop and has no coordinates.
    pub(super) cut: bool,
}

/// The declared motion of a coordinate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum DeclaredMotion {
    Free,
    Driven,
    Coasting,
    Shaken,
}

impl DeclaredMotion {
    /// Whether the declaration gives the motion, so that no equation determines it.
    pub(super) fn is_given(self) -> bool {
        matches!(self, Self::Driven | Self::Shaken)
    }

    /// The word that declares it.
    pub(super) fn word(self) -> &'static str {
        match self {
            Self::Free => "free",
            Self::Driven => "driven",
            Self::Coasting => "coasting",
            Self::Shaken => "shaken",
        }
    }
}

/// The dimension of a coordinate.
pub(super) fn dimension(quantity: CoordinateQuantity) -> Dimension {
    quantity.either(Dimension::NONE, Dimension::LENGTH)
}

/// The dimension of a coordinate's rate.
pub(super) fn rate_dimension(quantity: CoordinateQuantity) -> Dimension {
    quantity.either(Dimension::RATE, Dimension::SPEED)
}

/// All joints in order.
pub(super) fn joints(ast: &Ast) -> impl Iterator<Item = &Joint> {
    ast.all()
}

/// All coordinates in the order of their joints.
pub(super) fn declared(ast: &Ast) -> Vec<Declared<'_>> {
    let mut coordinates = Vec::new();
    for (index, joint) in joints(ast).enumerate() {
        let id = JointId::new(index);
        let kind = Kind::find(&joint.kind.to_string());
        let motions = kind.map_or(&[][..], |kind| kind.motions);
        if kind.is_some_and(Kind::has_one_coordinate) {
            coordinates.push(Declared {
                name: &joint.name,
                joint: id,
                quantity: motions.first().map(|motion| motion.quantity()),
                motion: motion(joint, &joint.name, true),
                cut: is_cut(joint),
            });
            continue;
        }
        // A joint of an unknown kind may also name coordinates; `lead` is not one of them.
        let named = joint.arguments.iter().flatten().filter_map(|argument| argument.name.as_ref());
        for (position, name) in named.filter(|name| *name != "lead").enumerate() {
            coordinates.push(Declared {
                name,
                joint: id,
                quantity: motions.get(position).map(|motion| motion.quantity()),
                motion: motion(joint, name, false),
                cut: is_cut(joint),
            });
        }
    }
    coordinates
}

/// The motion declared by the first clause about a coordinate. A drive without a name refers to the only coordinate,
/// `coasting` without a name to all of them.
fn motion(joint: &Joint, name: &Ident, is_only: bool) -> DeclaredMotion {
    let said = joint.clauses.iter().find_map(|clause| match clause {
        JointClause::Drive(drive) => {
            let meant = drive.coordinate.as_ref().map_or(is_only, |coordinate| coordinate == name);
            meant.then_some(DeclaredMotion::Driven)
        }
        JointClause::Shake(shake) => {
            let meant = shake.coordinate.as_ref().map_or(is_only, |coordinate| coordinate == name);
            meant.then_some(DeclaredMotion::Shaken)
        }
        JointClause::Coast(coast) => {
            coast.coordinate.as_ref().is_none_or(|coordinate| coordinate == name).then_some(DeclaredMotion::Coasting)
        }
        JointClause::Placement { .. } | JointClause::Cut(_) => None,
    });
    said.unwrap_or(DeclaredMotion::Free)
}

/// Whether the joint is declared as one that closes a loop.
pub(super) fn is_cut(joint: &Joint) -> bool {
    let mut clauses = joint.clauses.iter();
    clauses.any(|clause| matches!(clause, JointClause::Cut(_)))
}
