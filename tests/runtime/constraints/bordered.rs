//! Mechanisms of point masses and bodies in absolute coordinates: `M qddot + grad (V + mu . Phi) = 0`, `Phi = 0`, where
//! the static part is the gradient of `V + mu . Phi` by all unknowns. Every row of the bordered system comes from one
//! function.

use crate::common::description;
use eigentol::{Array, CoordinateInfo, DampingKind, Description, DesignInfo, InputInfo, Real, Role, Shared, Unit};

use crate::common::derived::{Derived, Model};
use crate::common::dual::Dual;

pub(crate) trait Lagrangian: Clone + Sync {
    type Coordinates<T: Copy>: Array<T>;
    type Inputs<T: Copy>: Array<T>;
    type Design<T: Copy>: Array<T>;
    type Outputs<T: Copy>: Array<T>;
    type Excitations<T: Copy>: Array<T>;

    const DESCRIPTION: Description;

    /// Masses of the coordinates, with zeros in place of reactions.
    fn masses<T: Real>(&self, b: &Self::Design<T>) -> Self::Coordinates<T>;

    /// `V + mu . Phi`, including the centrifugal potential.
    fn value<T: Real>(&self, x: &Self::Coordinates<T>, u: &Self::Inputs<T>, b: &Self::Design<T>) -> T;
}

#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Bordered<X>(pub(crate) X);

impl<X: Lagrangian> Model for Bordered<X> {
    type Coordinates<T: Copy> = X::Coordinates<T>;
    type Inputs<T: Copy> = X::Inputs<T>;
    type Design<T: Copy> = X::Design<T>;
    type Outputs<T: Copy> = X::Outputs<T>;
    type Excitations<T: Copy> = X::Excitations<T>;

    const DESCRIPTION: Description = X::DESCRIPTION;

    fn inertia<T: Real>(
        &self,
        acceleration: &X::Coordinates<T>,
        _: &X::Coordinates<T>,
        _: &X::Coordinates<T>,
        _: &X::Inputs<T>,
        b: &X::Design<T>,
    ) -> X::Coordinates<T> {
        let masses = self.0.masses(b);
        Array::from_fn(|i| masses.as_ref()[i] * acceleration.as_ref()[i])
    }

    fn applied<T: Real>(
        &self,
        _: &X::Coordinates<T>,
        q: &X::Coordinates<T>,
        u: &X::Inputs<T>,
        b: &X::Design<T>,
    ) -> X::Coordinates<T> {
        let u: X::Inputs<Dual<T>> = Array::from_fn(|i| Dual::fixed(u.as_ref()[i]));
        let b: X::Design<Dual<T>> = Array::from_fn(|i| Dual::fixed(b.as_ref()[i]));
        Array::from_fn(|i| {
            let unit = |j| T::constant(if i == j { 1.0 } else { 0.0 });
            let x: X::Coordinates<Dual<T>> = Array::from_fn(|j| Dual::new(q.as_ref()[j], unit(j)));
            -self.0.value(&x, &u, &b).slope
        })
    }
}

pub(crate) const fn bordered<X>(model: X) -> Derived<Bordered<X>> {
    Derived(Bordered(model))
}

/// A mechanism without damping and outputs.
pub(crate) const fn described(
    name: &'static str,
    coordinates: &'static [CoordinateInfo],
    inputs: &'static [InputInfo],
    design: &'static [DesignInfo],
) -> Description {
    description!(name, coordinates, inputs, design, true, DampingKind::Zero)
}

/// A reaction of a position constraint.
pub(crate) const fn reaction(name: &'static str, symbol: &'static str) -> CoordinateInfo {
    CoordinateInfo {
        name: Shared::Static(name),
        unit: Unit { symbol: Shared::Static(symbol), scale: 1.0 },
        role: Role::PositionReaction,
    }
}

/// `sqrt(x^2 + y^2)`.
pub(crate) fn distance<T: Real>(x: T, y: T) -> T {
    (x * x + y * y).sqrt()
}
