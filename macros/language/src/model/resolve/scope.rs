//! The single namespace that contains all names of a declaration.

use std::collections::{BTreeMap, BTreeSet};

use proc_macro2::Ident;

use super::coordinates::Declared;
use crate::base::diagnostics::Diagnostics;
use crate::base::ids::{BodyId, ConstraintId, CoordinateId, DesignId, ForceId, InputId, JointId, PointId};
use crate::base::names::{LINK, joined};
use crate::base::nearest::nearest;
use crate::syntax::ast::{Ast, ItemKind};

/// The meaning of a name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Meaning {
    Input(InputId),
    Design(DesignId),
    /// The index of the `let` among the lets.
    Let(usize),
    /// The index of the curve among the curves.
    Curve(usize),
    Body(BodyId),
    /// A joint without a coordinate of its name: it has none at all, or several with their own names.
    Joint(JointId),
    /// A joint with a single coordinate, and that coordinate.
    OnlyCoordinate(CoordinateId),
    /// One of several coordinates of a joint.
    Coordinate(CoordinateId),
    Point(PointId),
    Force(ForceId),
    Excitation,
    Material,
    Constraint(ConstraintId),
    Output,
    /// Belongs to something that could not be read, or to several things: uses of the name are not checked.
    Unclear,
}

impl Meaning {
    /// Whether the name stands for a coordinate.
    pub(super) fn is_coordinate(self) -> bool {
        matches!(self, Meaning::OnlyCoordinate(_) | Meaning::Coordinate(_))
    }

    /// The kind of thing, with an article.
    pub(super) fn describe(self) -> &'static str {
        match self {
            Meaning::Input(_) => "an input",
            Meaning::Design(_) => "a design variable",
            Meaning::Let(_) => "a constant",
            Meaning::Curve(_) => "a curve",
            Meaning::Body(_) => "a body",
            Meaning::Joint(_) | Meaning::OnlyCoordinate(_) => "a joint",
            Meaning::Coordinate(_) => "a coordinate",
            Meaning::Point(_) => "a point",
            Meaning::Force(_) => "a force",
            Meaning::Excitation => "an excitation",
            Meaning::Material => "a material",
            Meaning::Constraint(_) => "a constraint",
            Meaning::Output => "an output",
            Meaning::Unclear => "something",
        }
    }
}

/// All names, in order of declaration and by spelling.
#[derive(Debug, Default)]
pub(super) struct Scope {
    order: Vec<(String, Meaning)>,
    by_name: BTreeMap<String, usize>,
    /// Names that something has and an array or an instance too.
    clashes: BTreeSet<String>,
    /// Whether the name of some item could not be read.
    is_incomplete: bool,
    /// Whether some name means more than one thing.
    pub(super) is_ambiguous: bool,
}

impl Scope {
    /// Enters the name of every item, even if the rest of the item is wrong.
    pub(super) fn new(ast: &Ast, coordinates: &[Declared<'_>], diagnostics: &mut Diagnostics) -> Self {
        let mut scope = Self::default();
        let mut counts = [0; 9];
        let mut next = |table: usize| {
            counts[table] += 1;
            counts[table] - 1
        };
        for item in &ast.items {
            let meaning = match &item.kind {
                ItemKind::Input(_) => Meaning::Input(InputId::new(next(0))),
                ItemKind::Design(_) => Meaning::Design(DesignId::new(next(1))),
                ItemKind::Let(_) => Meaning::Let(next(2)),
                ItemKind::Curve(_) => Meaning::Curve(next(7)),
                ItemKind::Body(_) => Meaning::Body(BodyId::new(next(3))),
                ItemKind::Joint(_) => {
                    let id = JointId::new(next(4));
                    scope.declare_joint(id, item.kind.name(), coordinates, diagnostics);
                    continue;
                }
                ItemKind::Point(_) => Meaning::Point(PointId::new(next(5))),
                ItemKind::Force(force) if force.is_harmonic() => Meaning::Excitation,
                ItemKind::Force(_) => Meaning::Force(ForceId::new(next(8))),
                ItemKind::Unbalance(_) => Meaning::Excitation,
                ItemKind::Material(_) => Meaning::Material,
                ItemKind::Constraint(_) => Meaning::Constraint(ConstraintId::new(next(6))),
                ItemKind::Output(_) => Meaning::Output,
                ItemKind::Gravity(_)
                | ItemKind::KernelsOnly(_)
                | ItemKind::Every(_)
                | ItemKind::Correlated(_)
                | ItemKind::Cyclic(_)
                | ItemKind::Steady(_) => continue,
            };
            if let Some(name) = item.kind.name() {
                scope.declare(name, meaning, diagnostics);
            }
        }
        for unread in &ast.unread {
            scope.is_incomplete |= unread.names.is_empty() && !unread.is_nameless();
            for name in unread.names.iter().map(Ident::to_string) {
                if scope.find(&name).is_none() && reserved(&name).is_none() {
                    scope.enter(name, Meaning::Unclear);
                }
            }
        }
        scope
    }

    /// Declares a joint and the coordinates that have their own names.
    fn declare_joint(
        &mut self,
        id: JointId,
        name: Option<&Ident>,
        coordinates: &[Declared<'_>],
        diagnostics: &mut Diagnostics,
    ) {
        let of_joint = || {
            coordinates
                .iter()
                .enumerate()
                .filter(|(_, coordinate)| coordinate.joint == id)
                .map(|(index, coordinate)| (CoordinateId::new(index), coordinate.name))
        };
        // The only coordinate's name is the token that names the joint; any other can only be spelt like it.
        let is_only = |coordinate: &Ident| name.is_some_and(|name| std::ptr::eq(name, coordinate));
        let only = of_joint().find(|(_, coordinate)| is_only(coordinate));
        if let Some(name) = name {
            let meaning = match only {
                Some((coordinate, _)) => Meaning::OnlyCoordinate(coordinate),
                None => Meaning::Joint(id),
            };
            self.declare(name, meaning, diagnostics);
        }
        for (coordinate, name) in of_joint().filter(|(_, name)| !is_only(name)) {
            self.declare(name, Meaning::Coordinate(coordinate), diagnostics);
        }
    }

    /// Declares a name, which may mean only one thing of any kind: `theta1` in an output must not be a guess.
    fn declare(&mut self, name: &Ident, meaning: Meaning, diagnostics: &mut Diagnostics) {
        let text = name.to_string();
        if let Some(reason) = reserved(&text) {
            diagnostics.error(name, format!("`{text}` cannot be declared: it is {reason}"));
            self.is_ambiguous = true;
            if text.contains(LINK) {
                // Its part means it by this word.
                self.enter(text, Meaning::Unclear);
            }
        } else if let Some(&first) = self.by_name.get(&text) {
            let first = &mut self.order[first].1;
            let message = match *first {
                Meaning::Unclear => format!("`{text}` is declared more than once"),
                first => format!("`{text}` is declared twice: it is {} already", first.describe()),
            };
            *first = Meaning::Unclear;
            diagnostics.error_with_help(name, message, "all kinds of names share one namespace");
            self.is_ambiguous = true;
        } else if let Some(other) = self.part_or_whole_of(&text).map(str::to_owned) {
            let shorter = if other.len() < text.len() { &other } else { &text };
            if self.clashes.insert(shorter.clone()) {
                let message = format!("`{text}` is declared, and so is `{other}`");
                diagnostics.error_with_help(name, message, "an array or an instance needs a name of its own");
            }
            self.is_ambiguous = true;
            self.enter(text, Meaning::Unclear);
        } else {
            self.enter(text, meaning);
        }
    }

    /// A declared name of what contains this, or of what this contains.
    fn part_or_whole_of(&self, name: &str) -> Option<&str> {
        let starts = name.match_indices(LINK).map(|(end, _)| &name[..end]);
        let whole = starts.into_iter().find_map(|start| self.by_name.get_key_value(start));
        let inside = joined(name, "");
        let part = self.by_name.range(inside.clone()..).next().filter(|(other, _)| other.starts_with(&inside));
        whole.or(part).map(|(other, _)| other.as_str())
    }

    fn enter(&mut self, name: String, meaning: Meaning) {
        self.by_name.insert(name.clone(), self.order.len());
        self.order.push((name, meaning));
    }

    /// The meaning of a name. An undeclared name may be one that could not be read.
    pub(super) fn find_or_unclear(&self, name: &str) -> Option<Meaning> {
        let mut wholes = name.match_indices(LINK).filter_map(|(end, _)| self.find(&name[..end]));
        let is_unclear = self.is_incomplete || wholes.any(|whole| whole == Meaning::Unclear);
        self.find(name).or(is_unclear.then_some(Meaning::Unclear))
    }

    pub(super) fn find(&self, name: &str) -> Option<Meaning> {
        self.by_name.get(name).map(|&index| self.order[index].1)
    }

    /// The nearest declared name of the right kind.
    pub(super) fn nearest(&self, name: &str, kind: impl Fn(Meaning) -> bool) -> Option<&str> {
        let candidates = self.order.iter().filter(|(_, meaning)| kind(*meaning));
        // An array without its index, or an instance.
        let inside = candidates.clone().find(|(candidate, _)| candidate.starts_with(&joined(name, "")));
        if let Some((inside, _)) = inside {
            return Some(inside);
        }
        nearest(name, candidates.map(|(candidate, _)| candidate.as_str()))
    }
}

/// Names that are already in use by the language.
fn reserved(name: &str) -> Option<&'static str> {
    name.split(LINK).find_map(|word| match word {
        "ground" => Some("the inertial frame"),
        "pi" => Some("the constant 3.14159..."),
        _ => None,
    })
}
