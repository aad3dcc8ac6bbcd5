//! Shafts as declared.

use crate::model::expression::{Expr, Vector};
use crate::model::mechanism::Line;
use crate::model::simplify::{add, divide, multiply};

/// A shaft as declared; its stations are known once everything has been resolved.
#[derive(Clone, Debug)]
pub(in crate::model::resolve) struct Declared {
    pub(super) origin: Vector,
    pub(super) axes: [Vector; 3],
    pub(super) speed: Expr,
    pub(super) lag: Expr,
    pub(super) drag: Expr,
    pub(super) tension: Expr,
    pub(super) torque: Expr,
    pub(super) rows: Vec<Row>,
    /// What bends, and whether it twists and stretches.
    pub(super) bending: Option<Line>,
    pub(super) twists: bool,
    pub(super) stretches: bool,
    pub(super) elements: usize,
    pub(super) positive: Vec<(String, Expr)>,
}

/// A row of the table.
#[derive(Clone, Debug)]
pub(super) struct Row {
    pub(super) length: Expr,
    /// Outer diameter at its beginning and at its end.
    pub(super) outer: [Expr; 2],
    /// What it stands for: one section, or if it is tapered several.
    pub(super) sections: Vec<Section>,
}

/// A section that is the same all along: numbers of all its layers together.
#[derive(Clone, Debug)]
pub(super) struct Section {
    pub(super) length: Expr,
    pub(super) mass: Expr,
    pub(super) rotary: Expr,
    pub(super) polar: Expr,
    pub(super) bending: Expr,
    pub(super) shear: Expr,
    pub(super) twist: Expr,
    pub(super) stretch: Expr,
}

impl Declared {
    /// How many rows it has: the number of its last station.
    pub(in crate::model::resolve) fn last(&self) -> usize {
        self.rows.len()
    }

    /// The sections between two stations.
    pub(super) fn between(&self, first: usize, last: usize) -> impl Iterator<Item = &Section> {
        self.rows[first..last].iter().flat_map(|row| &row.sections)
    }
}

impl Section {
    /// The section that does as half of a piece whose numbers change along it: with the numbers at the two points of Gauss and
    /// the weights of the half, two such in series have errors of the fourth order (S. Blanes and P. C. Moan, "Fourth- and
    /// sixth-order commutator-free Magnus integrators", 2006). What gives way, one over the stiffness, is what is linear.
    pub(super) fn mean([first, last]: &[Self; 2], weights: [f64; 2]) -> Self {
        let [a, b] = weights.map(Expr::Number);
        let sum = |x: &Expr, y: &Expr| add(multiply(a.clone(), x.clone()), multiply(b.clone(), y.clone()));
        let gives = |x: &Expr, y: &Expr| match (x, y) {
            (Expr::Number(0.0), _) => Expr::Number(0.0),
            _ => {
                let one = Expr::Number(1.0);
                divide(one.clone(), sum(&divide(one.clone(), x.clone()), &divide(one, y.clone())))
            }
        };
        Self {
            length: first.length.clone(),
            mass: sum(&first.mass, &last.mass),
            rotary: sum(&first.rotary, &last.rotary),
            polar: sum(&first.polar, &last.polar),
            bending: gives(&first.bending, &last.bending),
            shear: gives(&first.shear, &last.shear),
            twist: gives(&first.twist, &last.twist),
            stretch: gives(&first.stretch, &last.stretch),
        }
    }
}
