//! All names of a declaration live in one namespace; this is it.

use std::collections::BTreeMap;

use proc_macro2::Ident;

use crate::base::diagnostics::Diagnostics;
use crate::base::ids::{BodyId, DesignId, InputId, JointId, PointId};
use crate::base::nearest::nearest;
use crate::syntax::ast::{Ast, ItemKind};

/// What a name stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Meaning {
    Input(InputId),
    Design(DesignId),
    /// The index of the `let` among the lets.
    Let(usize),
    Body(BodyId),
    Joint(JointId),
    Point(PointId),
    Force,
    Output,
}

impl Meaning {
    /// The kind of thing, with an article.
    pub(super) fn describe(self) -> &'static str {
        match self {
            Meaning::Input(_) => "an input",
            Meaning::Design(_) => "a design variable",
            Meaning::Let(_) => "a constant",
            Meaning::Body(_) => "a body",
            Meaning::Joint(_) => "a joint",
            Meaning::Point(_) => "a point",
            Meaning::Force => "a force",
            Meaning::Output => "an output",
        }
    }
}

/// Names in order of declaration and by spelling.
#[derive(Debug, Default)]
pub(super) struct Scope {
    order: Vec<(String, Meaning)>,
    by_name: BTreeMap<String, usize>,
}

impl Scope {
    /// Enters the name of every item, whether or not the rest of the item is right.
    pub(super) fn new(ast: &Ast, diagnostics: &mut Diagnostics) -> Self {
        let mut scope = Self::default();
        let mut counts = [0; 6];
        let mut next = |table: usize| {
            counts[table] += 1;
            counts[table] - 1
        };
        for item in &ast.items {
            let meaning = match &item.kind {
                ItemKind::Input(_) => Meaning::Input(InputId::new(next(0))),
                ItemKind::Design(_) => Meaning::Design(DesignId::new(next(1))),
                ItemKind::Let(_) => Meaning::Let(next(2)),
                ItemKind::Body(_) => Meaning::Body(BodyId::new(next(3))),
                ItemKind::Joint(_) => Meaning::Joint(JointId::new(next(4))),
                ItemKind::Point(_) => Meaning::Point(PointId::new(next(5))),
                ItemKind::Force(_) => Meaning::Force,
                ItemKind::Output(_) => Meaning::Output,
                ItemKind::Gravity(_) => continue,
            };
            if let Some(name) = item.kind.name() {
                scope.declare(name, meaning, diagnostics);
            }
        }
        scope
    }

    /// One name means one thing, whatever its kind: `theta1` in an output must not be a guess.
    fn declare(&mut self, name: &Ident, meaning: Meaning, diagnostics: &mut Diagnostics) {
        let text = name.to_string();
        if let Some(reason) = reserved(&text) {
            diagnostics.error(name, format!("`{text}` cannot be declared: it is {reason}"));
        } else if let Some(&first) = self.by_name.get(&text) {
            let kind = self.order[first].1.describe();
            let message = format!("`{text}` is declared twice: it is {kind} already");
            diagnostics.error_with_help(name, message, "all kinds of names share one namespace");
        } else {
            self.by_name.insert(text.clone(), self.order.len());
            self.order.push((text, meaning));
        }
    }

    pub(super) fn find(&self, name: &str) -> Option<Meaning> {
        self.by_name.get(name).map(|&index| self.order[index].1)
    }

    /// The nearest declared name that is of the right kind.
    pub(super) fn nearest(&self, name: &str, kind: impl Fn(Meaning) -> bool) -> Option<&str> {
        let candidates = self.order.iter().filter(|(_, meaning)| kind(*meaning));
        nearest(name, candidates.map(|(candidate, _)| candidate.as_str()))
    }
}

/// Names with a meaning of their own.
fn reserved(name: &str) -> Option<&'static str> {
    match name {
        "ground" => Some("the inertial frame"),
        "pi" => Some("the constant 3.14159..."),
        _ => None,
    }
}
