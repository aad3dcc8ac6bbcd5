//! The data that the steps of resolution share; each step is a file that adds its methods.

use std::collections::BTreeSet;

use super::beams::declared::{Stations, number_of};
use super::beams::table::Properties;
use super::coordinates::{self, Declared};
use super::exerted::Exerted;
use super::joints::kinds::Kind;
use super::nominal::Nominal;
use super::scope::Scope;
use super::typed::{Typed, ValueContext};
use crate::base::diagnostics::{Diagnostic, Diagnostics};
use crate::base::dimension::Dimension;
use crate::base::span::Extent;
use crate::model::expression::Expr;
use crate::model::mechanism::{Constant, Coordinate, Curve, CurveArgument, Part};
use crate::model::rules::composite::GivenInertia;
use crate::model::rules::physical::{Demand, Requirement};
use crate::syntax::ast::{Ast, Joint, Unit, Unread};

/// The facts known while resolving. Tables are indexed by id; wrong items have no entry or `None`.
pub(super) struct Resolver<'a> {
    pub(super) ast: &'a Ast,
    pub(super) diagnostics: Diagnostics,
    pub(super) scope: Scope,
    pub(super) inputs: Vec<Option<Dimension>>,
    pub(super) design: Vec<Option<Nominal>>,
    pub(super) used: BTreeSet<String>,
    /// `None` for a wrong curve.
    pub(super) curves: Vec<Option<Curve>>,
    pub(super) curve_arguments: Vec<CurveArgument>,
    pub(super) lets: Vec<Option<Typed>>,
    pub(super) constants: Vec<Constant>,
    pub(super) coordinates: Vec<Declared<'a>>,
    pub(super) declared_coordinates: Vec<Coordinate>,
    pub(super) exerted: Vec<Option<Exerted>>,
    pub(super) parts: Vec<Option<Vec<Part>>>,
    pub(super) materials: Vec<(String, Option<Properties>)>,
    pub(super) stations: Stations,
    /// Points at which the force inside a beam is asked for.
    pub(super) cut_open: BTreeSet<String>,
    /// How many coordinates every component of a beam gets beyond those declared.
    pub(super) more: usize,
    pub(super) given_inertias: Vec<GivenInertia>,
    pub(super) requirements: Vec<Requirement>,
    /// The shortest and the longest length that is written, m; the first is the greater one if there is none.
    pub(super) lengths: [f64; 2],
    /// Units after numbers and vectors, in which declared names could have been meant.
    pub(super) units: Vec<(Option<f64>, Unit, ValueContext)>,
}

impl<'a> Resolver<'a> {
    pub(super) fn new(ast: &'a Ast, coordinates: Vec<Declared<'a>>, scope: Scope, diagnostics: Diagnostics) -> Self {
        Self {
            ast,
            diagnostics,
            scope,
            inputs: Vec::new(),
            design: Vec::new(),
            used: BTreeSet::new(),
            curves: Vec::new(),
            curve_arguments: Vec::new(),
            lets: Vec::new(),
            constants: Vec::new(),
            coordinates,
            declared_coordinates: Vec::new(),
            exerted: Vec::new(),
            parts: Vec::new(),
            materials: Vec::new(),
            stations: Stations::default(),
            cut_open: BTreeSet::new(),
            more: 0,
            given_inertias: Vec::new(),
            requirements: Vec::new(),
            lengths: [f64::INFINITY, 0.0],
            units: Vec::new(),
        }
    }

    /// Records a mistake, with its help if there is any.
    pub(super) fn report(&mut self, span: impl Into<Extent>, message: impl Into<String>, help: Option<String>) {
        let mut diagnostic = Diagnostic::new(span, message);
        diagnostic.help = help;
        self.diagnostics.push(diagnostic);
    }

    /// Records a mistake; what was asked for does not exist.
    pub(super) fn refuse<T>(&mut self, span: impl Into<Extent>, message: impl Into<String>) -> Option<T> {
        self.refuse_with(span, message, None)
    }

    /// [`Self::refuse`] with advice on how to fix the mistake.
    pub(super) fn refuse_with_help<T>(
        &mut self,
        span: impl Into<Extent>,
        message: impl Into<String>,
        help: impl Into<String>,
    ) -> Option<T> {
        self.refuse_with(span, message, Some(help.into()))
    }

    /// [`Self::refuse`] with advice if there is any.
    pub(super) fn refuse_with<T>(
        &mut self,
        span: impl Into<Extent>,
        message: impl Into<String>,
        help: Option<String>,
    ) -> Option<T> {
        self.report(span, message, help);
        None
    }

    /// Notes a value, in case it is a length.
    pub(super) fn note_length(&mut self, value: f64, dimension: Dimension) {
        let size = value.abs();
        if dimension == Dimension::LENGTH && size > 0.0 {
            let [shortest, longest] = self.lengths;
            self.lengths = [shortest.min(size), longest.max(size)];
        }
    }

    /// A length typical of the mechanism, m; one metre if it has none.
    pub(super) fn typical_length(&self) -> f64 {
        let [shortest, longest] = self.lengths;
        if shortest <= longest { shortest.sqrt() * longest.sqrt() } else { 1.0 }
    }

    /// Requires something of values; `what` names them.
    pub(super) fn require(
        &mut self,
        what: impl Into<String>,
        values: impl Into<Vec<Expr>>,
        demand: Demand,
        extent: impl Into<Extent>,
    ) {
        let (what, values, extent) = (what.into(), values.into(), extent.into());
        self.requirements.push(Requirement { what, values, demand, extent });
    }

    /// Requires values to be finite at the nominal design; `what` names them, a vector only once.
    pub(super) fn require_finite(&mut self, values: &[Expr], what: &str, extent: Extent) {
        if !values.iter().all(|value| matches!(value, Expr::Number(_))) {
            self.require(what, values, Demand::Finite, extent);
        }
    }

    /// Whether some coordinate is free or coasting. Anything that could not be understood gets the benefit of the
    /// doubt.
    pub(super) fn can_move(&self) -> bool {
        let moves = |coordinate: &Declared| !coordinate.motion.is_given() && !coordinate.cut;
        let bends = ["beam", "shaft", "superelement"].iter().any(|word| number_of(self.ast, word) > 0);
        bends || self.coordinates.iter().any(moves) || self.may_have_more_coordinates()
    }

    /// Whether there is a joint of an unknown kind, or an item that could not be read.
    pub(super) fn may_have_more_coordinates(&self) -> bool {
        let unknown = |joint: &Joint| Kind::find(&joint.kind.to_string()).is_none();
        coordinates::joints(self.ast).any(unknown) || self.ast.unread.iter().any(Unread::may_connect)
    }
}
