//! Beams as declared, and the places along them that are used.

use proc_macro2::Ident;

use super::super::shafts::declared::Declared as Shaft;
use super::super::superelements::declared::Declared as Superelement;
use super::table::Table;
use crate::base::legendre::Gauss;
use crate::model::expression::{Expr, Vector};
use crate::model::mechanism::Section;
use crate::syntax::ast::{self, Ast, ItemKind};

/// A beam as declared; its stations are known once everything has been resolved.
#[derive(Clone, Debug)]
pub(in crate::model::resolve) struct Declared {
    pub(super) length: Expr,
    pub(super) axes: [Vector; 3],
    pub(super) counts: [usize; 3],
    pub(super) strains: [usize; 3],
    pub(super) static_shear: bool,
    pub(super) points: usize,
    pub(super) table: Table,
    pub(super) twist: Expr,
    /// The angles by which the axis at the tip is turned before the beam bends.
    pub(super) prebend: [Expr; 2],
    pub(super) spin: Expr,
    pub(super) lag: Expr,
    /// What must be positive in any design, and its values.
    pub(super) positive: Vec<(String, Expr)>,
}

impl Declared {
    /// The same with this many more coordinates of every component that has any, and as many points.
    pub(super) fn refined(mut self, more: usize) -> Self {
        self.counts.iter_mut().chain(&mut self.strains).filter(|count| **count > 0).for_each(|count| *count += more);
        self.points += more;
        self
    }

    pub(super) fn section(&self, fraction: f64) -> Section {
        self.table.section(fraction, (&self.twist, &self.prebend))
    }

    /// Whether the axis is curved about the second and about the third axis before the beam bends.
    pub(super) fn is_curved(&self) -> [bool; 2] {
        self.prebend.each_ref().map(|prebend| *prebend != Expr::Number(0.0))
    }

    /// The sections of a part of it: their places within the part, their weights, and what they are.
    pub(super) fn sections(&self, start: f64, end: f64) -> Vec<(f64, f64, Section)> {
        let rule = Gauss::new(self.points);
        let places = rule.points.into_iter().zip(rule.weights);
        places
            .map(|(fraction, weight)| {
                let of_whole = start + (end - start) * fraction;
                (fraction, weight, self.section(of_whole))
            })
            .collect()
    }
}

/// A body with places along it; `None` if it is wrong.
#[derive(Clone, Debug)]
pub(in crate::model::resolve) enum Flexible {
    Beam(Option<Box<Declared>>),
    Shaft(Option<Box<Shaft>>),
    Superelement(Option<Box<Superelement>>),
}

/// The bodies with places along them and the stations used so far. Each has a station at its tip, a superelement all.
#[derive(Debug, Default)]
pub(in crate::model::resolve) struct Stations {
    pub(super) bodies: Vec<(Ident, Flexible)>,
    /// The beam and the fraction of its length, the shaft and the number of sections before, or the superelement and the
    /// number of stations before.
    pub(in crate::model::resolve) used: Vec<(usize, f64)>,
}

impl Stations {
    pub(in crate::model::resolve) fn declare(
        &mut self,
        name: &Ident,
        body: Flexible,
        used: impl IntoIterator<Item = usize>,
    ) {
        self.used.extend(used.into_iter().map(|place| (self.bodies.len(), place as f64)));
        self.bodies.push((name.clone(), body));
    }

    /// The superelements that are right, with their numbers and names.
    pub(in crate::model::resolve) fn superelements(&self) -> impl Iterator<Item = (usize, &Ident, &Superelement)> {
        self.bodies.iter().enumerate().filter_map(|(k, (name, own))| match own {
            Flexible::Superelement(Some(own)) => Some((k, name, &**own)),
            _ => None,
        })
    }

    /// The shafts that are right, with their numbers and names.
    pub(in crate::model::resolve) fn shafts(&self) -> impl Iterator<Item = (usize, &Ident, &Shaft)> {
        self.bodies.iter().enumerate().filter_map(|(k, (name, own))| match own {
            Flexible::Shaft(Some(shaft)) => Some((k, name, &**shaft)),
            _ => None,
        })
    }

    pub(super) fn beams(&self) -> impl Iterator<Item = (usize, &Ident, Option<&Declared>)> {
        self.bodies.iter().enumerate().filter_map(|(k, (name, own))| match own {
            Flexible::Beam(beam) => Some((k, name, beam.as_deref())),
            Flexible::Shaft(_) | Flexible::Superelement(_) => None,
        })
    }

    /// Whether all are right.
    pub(super) fn are_right(&self) -> bool {
        let is_wrong =
            |own: &Flexible| matches!(own, Flexible::Beam(None) | Flexible::Shaft(None) | Flexible::Superelement(None));
        !self.bodies.iter().any(|(_, own)| is_wrong(own))
    }
}

/// The number of bodies of this shape in a declaration: `beam`, `shaft` or `superelement`.
pub(in crate::model::resolve) fn number_of(ast: &Ast, word: &str) -> usize {
    let is_such = |item: &&ast::Item| match &item.kind {
        ItemKind::Body(body) => body.terms.iter().any(|term| term.shape.word == word),
        _ => false,
    };
    ast.items.iter().filter(is_such).count()
}
