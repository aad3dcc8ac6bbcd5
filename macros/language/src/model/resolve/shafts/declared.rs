//! Shafts as declared.

use crate::model::expression::{Expr, Vector};
use crate::model::mechanism::Line;

/// A shaft as declared; its stations are known once everything has been resolved.
#[derive(Clone, Debug)]
pub(in crate::model::resolve) struct Declared {
    pub(super) origin: Vector,
    pub(super) axes: [Vector; 3],
    pub(super) speed: Expr,
    pub(super) lag: Expr,
    pub(super) drag: Expr,
    pub(super) sections: Vec<Section>,
    /// What bends, and whether it twists and stretches.
    pub(super) bending: Option<Line>,
    pub(super) twists: bool,
    pub(super) stretches: bool,
    pub(super) elements: usize,
    pub(super) positive: Vec<(String, Expr)>,
}

/// A row of the table: numbers of all its layers together.
#[derive(Clone, Debug)]
pub(super) struct Section {
    pub(super) length: Expr,
    pub(super) outer: Expr,
    pub(super) mass: Expr,
    pub(super) rotary: Expr,
    pub(super) polar: Expr,
    pub(super) bending: Expr,
    pub(super) shear: Expr,
    pub(super) twist: Expr,
    pub(super) stretch: Expr,
}

impl Declared {
    /// How many sections it has: the number of its last station.
    pub(in crate::model::resolve) fn last(&self) -> usize {
        self.sections.len()
    }
}
