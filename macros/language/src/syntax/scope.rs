//! What names mean where an item is read: those declared beside it, the counters of loops, the ports and arguments of a
//! part.

use std::cell::Cell;
use std::collections::BTreeMap;
use std::iter;
use std::rc::Rc;

use proc_macro2::{Ident, Span, TokenStream};
use syn::buffer::Cursor;

use super::ast::{Unit, Value};
use crate::base::diagnostics::Diagnostic;
use crate::base::names::{LINK, joined};
use crate::base::span::Extent;

/// The names that the items of a mechanism or of a part declare, each without its index.
#[derive(Clone, Debug, Default)]
pub(super) struct Names(pub(super) BTreeMap<String, Meaning>);

/// What a name stands for, as far as the parser must know.
#[derive(Clone, Debug)]
pub(super) enum Meaning {
    /// What an item that starts with this word declares.
    Item(String),
    /// An instance of a part.
    Instance(String),
    /// Something whose parts are declared one by one: `body left.arm: ...`.
    Group(Names),
}

impl Names {
    /// Enters what an item declares.
    pub(super) fn declare(&mut self, path: &[(Ident, String)], meaning: Meaning) {
        match path {
            [] => {}
            [(_, name)] => {
                self.0.entry(name.clone()).or_insert(meaning);
            }
            [(_, name), rest @ ..] => {
                let group = self.0.entry(name.clone()).or_insert_with(|| Meaning::Group(Self::default()));
                if let Meaning::Group(names) = group {
                    names.declare(rest, meaning);
                }
            }
        }
    }
}

/// What stands in braces, and the closing one.
pub(super) type Content<'a> = (Cursor<'a>, Span);

/// A part as declared.
pub(super) struct Part<'a> {
    pub(super) name: Ident,
    /// The parameters with their units.
    pub(super) parameters: Vec<(Ident, Unit)>,
    pub(super) names: Names,
    pub(super) content: Content<'a>,
    /// The same, to find the part in which a mistake is.
    pub(super) tokens: TokenStream,
}

/// A port, and what the instance has in its place.
#[derive(Clone)]
pub(super) struct Port {
    pub(super) name: String,
    pub(super) frame: Ident,
    pub(super) point: Ident,
    /// Whether an item refers to the frame.
    pub(super) framed: Rc<Cell<bool>>,
}

/// One instance of a ring: its whole name without and with its index, and its rotation.
#[derive(Clone)]
pub(super) struct Turned {
    pub(super) ring: String,
    pub(super) instance: String,
    pub(super) rotation: (Value, Value),
}

/// All parts of a declaration by name.
#[derive(Default)]
pub(super) struct Parts<'a>(pub(super) BTreeMap<String, Part<'a>>);

/// What names mean in one place.
#[derive(Clone, Default)]
pub(super) struct Scope<'a> {
    /// The instance to which the items belong; empty for the mechanism.
    pub(super) instance: String,
    /// What is declared beside them.
    pub(super) names: Option<&'a Names>,
    /// The counters of the loops around them.
    pub(super) counters: Vec<(String, u32)>,
    /// Constants that are whole numbers, by their whole names.
    pub(super) numbers: Vec<(String, i64)>,
    pub(super) ports: Vec<Port>,
    /// Design variables, and what the instance has in their place.
    pub(super) given: Vec<(String, Value)>,
    pub(super) parts: Option<&'a Parts<'a>>,
    /// The part whose items are read; empty for the mechanism.
    pub(super) part: &'a str,
    /// Items, instances and rounds of loops so far, in all of the declaration.
    pub(super) work: Rc<Cell<u32>>,
    /// How the instances of a ring are turned about its axis.
    pub(super) turned: Option<Turned>,
    /// The scope in which the instance is used.
    pub(super) user: Option<&'a Scope<'a>>,
}

/// Most items, instances and rounds of a declaration.
const MOST: u32 = 200_000;

impl<'a> Scope<'a> {
    /// The scope of an instance of a part.
    pub(super) fn of_instance(instance: String, part: &'a str, names: &'a Names, user: &'a Scope<'a>) -> Self {
        let (parts, work) = (user.parts, Rc::clone(&user.work));
        Self { instance, names: Some(names), parts, part, work, user: Some(user), ..Self::default() }
    }

    /// Counts work, and refuses what would not end.
    pub(super) fn spend(&self, count: usize, at: impl Into<Extent>) -> Result<(), Box<Diagnostic>> {
        let count = u32::try_from(count).unwrap_or(MOST);
        let sum = self.work.get().saturating_add(count);
        if sum > MOST {
            let message = format!("more than {MOST} items, instances and rounds of loops");
            return Err(Box::new(Diagnostic::new(at, message)));
        }
        self.work.set(sum);
        Ok(())
    }

    /// The meaning of a name that is declared here.
    pub(super) fn find(&self, name: &str) -> Option<&'a Meaning> {
        self.names?.0.get(name)
    }

    /// The meaning of a name inside another.
    pub(super) fn inside(&self, of: &'a Meaning, name: &str) -> Option<&'a Meaning> {
        match of {
            Meaning::Item(_) => None,
            Meaning::Instance(part) => self.parts?.0.get(part)?.names.0.get(name),
            Meaning::Group(names) => names.0.get(name),
        }
    }

    /// Whether a whole name is that of something that is no frame: a point, a coordinate.
    pub(super) fn is_no_frame(&self, whole: &str) -> bool {
        let own = whole.strip_prefix(&self.instance).unwrap_or(whole);
        let is_index = |word: &str| word.starts_with(|c: char| c.is_ascii_digit());
        let mut words = own.split(LINK).filter(|word| !word.is_empty() && !is_index(word));
        let first = words.next().and_then(|name| self.find(name));
        let meaning = words.fold(first, |of, name| self.inside(of?, name));
        matches!(meaning, Some(Meaning::Item(keyword)) if keyword != "body")
    }

    /// The counter of a loop.
    pub(super) fn counter(&self, name: &str) -> Option<u32> {
        self.counters.iter().rev().find(|(counter, _)| counter == name).map(|(_, value)| *value)
    }

    /// The whole number that a name stands for.
    pub(super) fn number(&self, name: &str) -> Option<i64> {
        self.numbers.iter().find(|(number, _)| number == name).map(|(_, value)| *value)
    }

    /// The name of the instance before a name that is declared in it.
    pub(super) fn whole(&self, name: &str) -> String {
        joined(&self.instance, name)
    }

    /// Whether what uses the part declares a name, which the part cannot see; a material it can.
    pub(super) fn hides(&self, name: &str) -> bool {
        let users = iter::successors(self.user, |scope| scope.user);
        let meanings = users.filter_map(|scope| scope.find(name));
        meanings.into_iter().any(|of| !matches!(of, Meaning::Item(keyword) if keyword == "material"))
    }
}
