//! Mechanisms of point masses and bodies in absolute coordinates: `M qddot + grad (V + mu . Phi) = 0`, `Phi = 0`, which is
//! the gradient of `V + mu . Phi` by all unknowns. Every row of the bordered system comes out of one function.

use std::array::from_fn;

use eigentol::{CoordinateInfo, Description, Real, Role, Unit};

use crate::common::derived::{Derived, Model};
use crate::common::dual::Dual;

pub(crate) trait Lagrangian<const N: usize, const U: usize, const P: usize>:
    Clone + Sync
{
    const DESCRIPTION: Description;

    /// Masses of the coordinates, zero in the places of reactions.
    fn masses<T: Real>(&self, b: &[T; P]) -> [T; N];

    /// `V + mu . Phi`, centrifugal potential included.
    fn value<T: Real>(&self, x: &[T; N], u: &[T; U], b: &[T; P]) -> T;
}

#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Bordered<X>(pub(crate) X);

impl<X, const N: usize, const U: usize, const P: usize> Model<N, U, P, 0> for Bordered<X>
where
    X: Lagrangian<N, U, P>,
{
    const DESCRIPTION: Description = X::DESCRIPTION;

    fn inertia<T: Real>(
        &self,
        acceleration: &[T; N],
        _: &[T; N],
        _: &[T; N],
        _: &[T; U],
        b: &[T; P],
    ) -> [T; N] {
        let masses = self.0.masses(b);
        from_fn(|i| masses[i] * acceleration[i])
    }

    fn applied<T: Real>(&self, _: &[T; N], q: &[T; N], u: &[T; U], b: &[T; P]) -> [T; N] {
        let (u, b) = (u.map(Dual::fixed), b.map(Dual::fixed));
        from_fn(|i| {
            let x = from_fn(|j| Dual::new(q[j], T::constant(if i == j { 1.0 } else { 0.0 })));
            -self.0.value(&x, &u, &b).slope
        })
    }
}

pub(crate) const fn bordered<X>(model: X) -> Derived<Bordered<X>> {
    Derived(Bordered(model))
}

/// A reaction of a constraint on positions.
pub(crate) const fn reaction(name: &'static str, symbol: &'static str) -> CoordinateInfo {
    CoordinateInfo {
        name,
        unit: Unit { symbol, scale: 1.0 },
        role: Role::PositionReaction,
    }
}

/// `sqrt(x^2 + y^2)`.
pub(crate) fn distance<T: Real>(x: T, y: T) -> T {
    (x * x + y * y).sqrt()
}
