//! Superelements as declared.

use std::rc::Rc;

use crate::base::span::Extent;
use crate::matrix_market::{Matrix, rounding};
use crate::model::expression::{Expr, Vector};
use crate::model::mechanism::Frame;

/// Rows of a station: along and about x, y and z.
pub(super) const MOTIONS: usize = 6;
/// A difference across the diagonal that is rounding, as a part of the greatest entry of both rows.
const ROUNDED: f64 = 1e-7;

/// An entry that is rounding, as a part of the root of both on the diagonal.
const CANCELLED: f64 = 16.0 * f64::EPSILON;

/// A superelement as declared.
#[derive(Clone, Debug)]
pub(in crate::model::resolve) struct Declared {
    /// The body that it stands on, if not on the ground.
    pub(super) base: Option<(Frame, Extent)>,
    /// Places there.
    pub(in crate::model::resolve) stations: Vec<Vector>,
    pub(super) mass: Vec<Share>,
    pub(super) stiffness: Vec<Share>,
    /// Damping, and gyroscopic forces.
    pub(super) damping: [Vec<Share>; 2],
    /// Whether something is in a row.
    pub(super) moves: Vec<bool>,
}

/// A matrix with its factor.
#[derive(Clone, Debug)]
pub(super) struct Share {
    pub(super) factor: Expr,
    pub(super) matrix: Rc<Square>,
    /// Whether the factor is the square of a speed.
    pub(super) grows: bool,
}

/// A symmetric or skew-symmetric matrix.
#[derive(Clone, Debug)]
pub(in crate::model::resolve) struct Square {
    pub(super) order: usize,
    /// The sign of an entry across the diagonal.
    across: f64,
    entries: Vec<f64>,
    /// How far its numbers are rounded in its file, as a part of each.
    pub(super) rounding: f64,
}

impl Square {
    pub(super) fn zeros(order: usize) -> Self {
        Self { order, across: 1.0, entries: vec![0.0; order * order], rounding: 0.0 }
    }

    pub(super) fn of(matrix: &Matrix, across: f64) -> Self {
        let mut square = Self { across, rounding: rounding(&matrix.entries), ..Self::zeros(matrix.rows) };
        matrix.entries.iter().for_each(|(row, column, value)| square.entries[row * matrix.rows + column] = *value);
        // Modes are orthogonal but for rounding, which would couple all with all.
        let size: Vec<f64> = (0..square.order).map(|row| square.entry(row, row).abs().sqrt()).collect();
        for (place, entry) in square.entries.iter_mut().enumerate() {
            if entry.abs() <= CANCELLED * size[place / matrix.rows] * size[place % matrix.rows] {
                *entry = 0.0;
            }
        }
        square
    }

    /// With entries of nodes for each two stations, times a matrix of directions.
    pub(super) fn of_nodes(order: usize, across: f64, entry: impl Fn([usize; 2], [usize; 2]) -> f64) -> Self {
        let mut square = Self { across, ..Self::zeros(order) };
        for row in 0..order {
            for column in 0..order {
                let [i, j] = [row, column].map(|k| (k / MOTIONS, k % MOTIONS));
                if i.1 < 3 && j.1 < 3 {
                    square.entries[row * order + column] = entry([i.0, j.0], [i.1, j.1]);
                }
            }
        }
        square
    }

    pub(super) fn entry(&self, row: usize, column: usize) -> f64 {
        self.entries[row * self.order + column]
    }

    /// Half the sum of an entry and the one across the diagonal, which differ by rounding.
    pub(super) fn mean(&self, row: usize, column: usize) -> f64 {
        0.5 * (self.entry(row, column) + self.across * self.entry(column, row))
    }

    pub(super) fn row(&self, row: usize) -> &[f64] {
        &self.entries[row * self.order..][..self.order]
    }

    pub(super) fn add(&mut self, factor: f64, other: &Self) {
        self.rounding = self.rounding.max(other.rounding);
        self.entries.iter_mut().zip(&other.entries).for_each(|(to, from)| *to += factor * from);
    }

    /// The entry that differs most from the one across the diagonal, if that is not rounding.
    pub(super) fn unsymmetric(&self) -> Option<(usize, usize)> {
        let greatest = |row: usize| self.row(row).iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        let most: Vec<f64> = (0..self.order).map(greatest).collect();
        let both = (0..self.order).flat_map(|row| (0..=row).map(move |column| (row, column)));
        let part = |&(row, column): &(usize, usize)| {
            let apart = (self.entry(row, column) - self.across * self.entry(column, row)).abs();
            if apart == 0.0 { 0.0 } else { apart / most[row].max(most[column]) }
        };
        both.max_by(|a, b| part(a).total_cmp(&part(b))).filter(|worst| part(worst) > ROUNDED.max(self.rounding))
    }
}

impl Declared {
    /// Of shares of mass, stiffness, damping and gyroscopic forces; the first two have some.
    pub(super) fn new(
        base: Option<(Frame, Extent)>,
        stations: Vec<Vector>,
        [mass, stiffness, damping, gyroscopic]: [Vec<Share>; 4],
    ) -> Self {
        let order = mass[0].matrix.order;
        let matrices = || mass.iter().chain(&stiffness).map(|share| &share.matrix);
        let is_used = |row: usize| {
            matrices().any(|matrix| row < matrix.order && matrix.row(row).iter().any(|entry| *entry != 0.0))
        };
        let moves = (0..order).map(is_used).collect();
        Self { base, stations, mass, stiffness, damping: [damping, gyroscopic], moves }
    }

    pub(super) fn order(&self) -> usize {
        self.moves.len()
    }

    /// What stands in a row when the part moves as a rigid body along or about x, y, z of a place.
    pub(super) fn rigid(&self, motion: usize, arms: &[[f64; 3]]) -> Vec<f64> {
        let mut all = vec![0.0; self.order()];
        for (station, arm) in arms.iter().enumerate() {
            let own = &mut all[MOTIONS * station..];
            own[motion] = 1.0;
            if let Some(axis) = motion.checked_sub(3) {
                let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
                own[next] = -arm[last];
                own[last] = arm[next];
            }
        }
        all
    }
}
