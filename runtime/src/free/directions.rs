//! The free directions at one equilibrium.

use std::borrow::Cow;

use super::NullSpace;
use crate::algebra::{Matrix, Vector};

/// What elimination may leave of the stiffness of an equilibrium along its free directions, relative to the terms in
/// it.
const REMAINDER: f64 = 1e-6;

/// Independent motions along which nothing depends on where the mechanism stands: a shaft that may turn as a whole, a
/// body that floats.
///
/// The place along them is that of the start, and derivatives hold it: `rows . dq = 0`. What depends on the place has
/// no derivative.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct FreeDirections {
    /// The motions, by unknown: `Khat z = 0`.
    pub motions: Vec<Vector>,
    /// Combinations of the equations in which no stiffness appears, by equation: `w^T Khat = 0`. For a conservative
    /// mechanism, the motions.
    pub balances: Vec<Vector>,
    /// What is held along the motions, by unknown.
    pub(crate) rows: Vec<Vector>,
    /// Where the forces that hold it act, by equation.
    pub(crate) columns: Vec<Vector>,
}

impl FreeDirections {
    /// The directions at an equilibrium with this stiffness, which has `count` of them. None where the stiffness has
    /// fewer, which is the case away from equilibria.
    pub(crate) fn of(stiffness: &Matrix, count: usize) -> Self {
        if count == 0 {
            return Self::default();
        }
        let space = NullSpace::of(stiffness, count);
        if space.remainder > REMAINDER {
            return Self::default();
        }
        let taken = |vectors: Vec<Vector>| vectors.into_iter().take(count).collect();
        Self {
            motions: taken(space.right),
            balances: taken(space.left),
            rows: taken(space.rows),
            columns: taken(space.columns),
        }
    }

    /// Number of directions.
    #[must_use]
    pub fn count(&self) -> usize {
        self.motions.len()
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.motions.is_empty()
    }

    /// The stiffness with the place held.
    pub(crate) fn held<'a>(&self, stiffness: &'a Matrix) -> Cow<'a, Matrix> {
        if self.is_empty() {
            return Cow::Borrowed(stiffness);
        }
        let mut held = stiffness.clone();
        hold(&mut held, &self.columns, &self.rows);
        Cow::Owned(held)
    }
}

/// Holds the place along `count` free directions, of which the stiffness away from an equilibrium need not be free.
pub(crate) fn fix_place(stiffness: &mut Matrix, count: usize) {
    let mut space = NullSpace::of(stiffness, count);
    space.columns.truncate(count);
    hold(stiffness, &space.columns, &space.rows);
}

fn hold(stiffness: &mut Matrix, columns: &[Vector], rows: &[Vector]) {
    for (column, row) in columns.iter().zip(rows) {
        for (own, amount) in stiffness.iter_mut().zip(column) {
            for (own, row) in own.iter_mut().zip(row) {
                *own += amount * row;
            }
        }
    }
}
