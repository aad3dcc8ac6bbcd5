//! The free directions at one equilibrium.

use std::borrow::Cow;

use super::NullSpace;
use super::declared::derivatives;
use crate::algebra::{Matrix, Vector, add_to, dot};
use crate::kernels::Kernels;

/// What elimination may leave of the stiffness of an equilibrium along its free directions, relative to the terms in
/// it.
const REMAINDER: f64 = 1e-6;

/// Independent motions from one steady motion to neighbouring ones.
///
/// Along those of [`Description::free_directions`](crate::Description::free_directions) nothing depends on where the
/// mechanism stands: a shaft may turn as a whole, a body floats. The place along them is that of the start, and
/// derivatives hold it: `rows . dq = 0`. What depends on the place has no derivative.
///
/// Others lead to another member of a family of steady motions, as for a wheel that may roll in a circle of any size:
/// each of these is fixed by an unknown that is [held](field@Self::held), and derivatives hold it too.
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
    #[doc(hidden)]
    pub rows: Vec<Vector>,
    /// Where the forces that hold it act, by equation.
    #[doc(hidden)]
    pub columns: Vec<Vector>,
    /// The unknowns that select the member of a family of steady motions, one for each parameter of the family.
    pub held: Vec<Held>,
}

/// An unknown that selects the member of a family of steady motions.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Held {
    /// Its position among the unknowns.
    pub unknown: usize,
    /// The value at which it is held, SI.
    pub value: f64,
    /// The derivative of that value by each input; empty if it is a plain number.
    pub by_input: Vector,
    /// The derivative of that value by each design variable; empty if it is a plain number.
    pub by_design: Vector,
    /// Its position among the unknowns with declared values, [`Description::held`](crate::Description::held).
    pub(crate) declared: Option<usize>,
}

impl Held {
    /// Held at a plain number, SI.
    #[doc(hidden)]
    #[must_use]
    pub fn at(unknown: usize, value: f64) -> Self {
        Self { unknown, value, ..Self::default() }
    }
}

/// The combinations of motions along which no held unknown moves.
fn unheld(motions: &[Vector], held: &[Held]) -> Vec<Vector> {
    let moved =
        Matrix::from_fn(motions.len(), motions.len(), |i, k| held.get(i).map_or(0.0, |held| motions[k][held.unknown]));
    let free = motions.len().saturating_sub(held.len());
    let mut all = NullSpace::of(&moved, free).right;
    all.truncate(free);
    all
}

impl FreeDirections {
    /// No directions.
    pub(crate) const fn none() -> Self {
        Self { motions: Vec::new(), balances: Vec::new(), rows: Vec::new(), columns: Vec::new(), held: Vec::new() }
    }

    /// The directions at an equilibrium with this stiffness, which has `count` of them. None where the stiffness has
    /// fewer, which is the case away from equilibria.
    #[doc(hidden)]
    pub fn of(stiffness: &Matrix, count: usize) -> Self {
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
            held: Vec::new(),
        }
    }

    /// The directions at a member of a family of steady motions with this stiffness, whose null space has a direction
    /// for each of these held unknowns besides `count` free ones.
    #[doc(hidden)]
    pub fn of_member(stiffness: &Matrix, count: usize, held: Vec<Held>) -> Self {
        let directions = Self::of(stiffness, count + held.len());
        if directions.is_empty() {
            return directions;
        }
        let free = unheld(&directions.motions, &held);
        let n = stiffness.row_count();
        let unit = |index: usize| Vector::from_fn(n, |i| if i == index { 1.0 } else { 0.0 });
        let combined = |shares: &Vector| {
            let mut row = Vector::zeros(n);
            for (share, direction) in shares.iter().zip(&directions.rows) {
                add_to(&mut row, *share, direction);
            }
            row
        };
        let rows = held.iter().map(|held| unit(held.unknown));
        Self { rows: rows.chain(free.iter().map(combined)).collect(), held, ..directions }
    }

    /// The motions that nothing holds: those along which no held unknown moves.
    #[doc(hidden)]
    #[must_use]
    pub fn undetermined(&self) -> Vec<Vector> {
        if self.held.is_empty() {
            return self.motions.clone();
        }
        let free = unheld(&self.motions, &self.held).into_iter();
        free.map(|shares| {
            let mut motion = Vector::zeros(self.motions[0].len());
            for (share, direction) in shares.iter().zip(&self.motions) {
                add_to(&mut motion, *share, direction);
            }
            motion
        })
        .collect()
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

    /// Adds to a gradient by inputs or design variables what a change of held values contributes to `w^T dg`.
    #[doc(hidden)]
    pub fn add_to_gradient(&self, w: &[f64], by_input: &mut [f64], by_design: &mut [f64]) {
        for (held, column) in self.held.iter().zip(&self.columns) {
            let along = -dot(w, column);
            add_to(by_input, along, &held.by_input);
            add_to(by_design, along, &held.by_design);
        }
    }

    /// Adds to the derivative of a gradient along a direction of inputs and design variables what
    /// [`Self::add_to_gradient`] contributes to it.
    #[doc(hidden)]
    pub fn add_to_gradient_along(
        &self,
        mechanism: &dyn Kernels,
        at: (&[f64], &[f64]),
        w: &[f64],
        along: (&[f64], &[f64]),
        (by_input, by_design): (&mut [f64], &mut [f64]),
    ) {
        if self.held.iter().all(|held| held.declared.is_none()) {
            return;
        }
        let changes = derivatives(mechanism, at, along).along;
        for (held, column) in self.held.iter().zip(&self.columns) {
            let Some(declared) = held.declared else {
                continue;
            };
            let along = -dot(w, column);
            let (inputs, design) = changes[declared].split_at(by_input.len());
            add_to(by_input, along, inputs);
            add_to(by_design, along, design);
        }
    }

    /// Adds what a change of held values contributes to the derivatives of the residual.
    #[doc(hidden)]
    #[inline(always)]
    pub fn add_to_partials(&self, (by_input, by_design): &mut (Matrix, Matrix)) {
        for (held, column) in self.held.iter().zip(&self.columns) {
            for (i, amount) in column.iter().enumerate() {
                add_to(&mut by_input[i], -amount, &held.by_input);
                add_to(&mut by_design[i], -amount, &held.by_design);
            }
        }
    }

    /// The stiffness with the place held.
    #[inline]
    pub(crate) fn held<'a>(&self, stiffness: &'a Matrix) -> Cow<'a, Matrix> {
        if self.is_empty() {
            return Cow::Borrowed(stiffness);
        }
        let mut held = stiffness.clone();
        self.hold(&mut held);
        Cow::Owned(held)
    }

    /// The same if the deviations of these inputs follow the design variables.
    pub(crate) fn with_deviations(&self, inputs: &[usize]) -> Self {
        let mut extended = self.clone();
        for held in extended.held.iter_mut().filter(|held| held.declared.is_some()) {
            let deviations = inputs.iter().map(|&input| held.by_input[input]);
            held.by_design = held.by_design.iter().copied().chain(deviations).collect();
        }
        extended
    }

    /// Adds to a residual nearby the forces that lead held unknowns to their values. They vanish at the member of the
    /// family with these values, which is the only solution then.
    pub(crate) fn lead(&self, residual: &mut [f64], q: &[f64], held: &[Held]) {
        for (held, column) in held.iter().zip(&self.columns) {
            add_to(residual, q[held.unknown] - held.value, column);
        }
    }

    /// Holds the place in a stiffness, which may be that of a state nearby.
    pub(crate) fn hold(&self, stiffness: &mut Matrix) {
        hold(stiffness, &self.columns, &self.rows);
    }
}

/// Holds the place along `count` free directions, of which the stiffness away from an equilibrium need not be free.
pub fn fix_place(stiffness: &mut Matrix, count: usize) {
    let mut space = NullSpace::of(stiffness, count);
    space.columns.truncate(count);
    hold(stiffness, &space.columns, &space.rows);
}

fn hold(stiffness: &mut Matrix, columns: &[Vector], rows: &[Vector]) {
    for (column, row) in columns.iter().zip(rows) {
        for (matrix_row, amount) in stiffness.iter_mut().zip(column) {
            for (entry, row) in matrix_row.iter_mut().zip(row) {
                *entry += amount * row;
            }
        }
    }
}
