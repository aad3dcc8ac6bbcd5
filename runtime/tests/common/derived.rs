//! A mechanism from nothing but its equations of motion: every other method by nested dual numbers. An oracle that
//! shares no code with the compiler.

use std::array::from_fn;

use eigentol::{
    Description, Gradient, Linear, LinearPartials, Mechanism, Real, RestParts, Violation,
};

use super::dual::Dual;

/// Equations of motion `g = inertia - applied`.
pub trait Model<const N: usize, const U: usize, const P: usize, const O: usize>:
    Clone + Sync
{
    const DESCRIPTION: Description;

    fn inertia<T: Real>(
        &self,
        acceleration: &[T; N],
        velocity: &[T; N],
        q: &[T; N],
        u: &[T; U],
        b: &[T; P],
    ) -> [T; N];

    fn applied<T: Real>(&self, velocity: &[T; N], q: &[T; N], u: &[T; U], b: &[T; P]) -> [T; N];

    fn violation<T: Real + PartialOrd>(&self, _: &[T; U], _: &[T; P]) -> Option<Violation<T>> {
        None
    }

    /// A model with outputs says what they are.
    fn outputs<T: Real>(&self, _: &[T; N], _: &[T; U], _: &[T; P]) -> [T; O] {
        from_fn(|_| T::constant(f64::NAN))
    }
}

/// The mechanism of a model.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Derived<X>(pub X);

fn fixed<T: Real, const C: usize>(x: &[T; C]) -> [Dual<T>; C] {
    x.map(Dual::fixed)
}

fn along<T: Real, const C: usize>(x: &[T; C], dx: &[T; C]) -> [Dual<T>; C] {
    from_fn(|i| Dual::new(x[i], dx[i]))
}

fn unit<T: Real, const C: usize>(x: &[T; C], j: usize) -> [Dual<T>; C] {
    from_fn(|i| Dual::new(x[i], T::constant(if i == j { 1.0 } else { 0.0 })))
}

fn zeros<T: Real, const C: usize>() -> [T; C] {
    [T::constant(0.0); C]
}

fn slopes<T: Real, const C: usize>(x: [Dual<T>; C]) -> [T; C] {
    x.map(|value| value.slope)
}

fn slopes_linear<T: Real, const N: usize>(x: Linear<Dual<T>, N>) -> Linear<T, N> {
    Linear {
        mass: x.mass.map(slopes),
        damping: x.damping.map(slopes),
        stiffness: x.stiffness.map(slopes),
    }
}

fn transpose<T: Copy, const R: usize, const C: usize>(x: [[T; C]; R]) -> [[T; R]; C] {
    from_fn(|j| from_fn(|i| x[i][j]))
}

fn product<T: Real, const N: usize>(a: &[T; N], b: &[T; N]) -> T {
    (0..N).fold(T::constant(0.0), |sum, i| sum + a[i] * b[i])
}

/// Derivative of `function` by each coordinate, input and design variable.
macro_rules! gradient {
    ($q:expr, $u:expr, $b:expr, $function:expr) => {
        Gradient {
            coordinates: from_fn(|j| $function(&unit($q, j), &fixed($u), &fixed($b)).slope),
            inputs: from_fn(|j| $function(&fixed($q), &unit($u, j), &fixed($b)).slope),
            design: from_fn(|j| $function(&fixed($q), &fixed($u), &unit($b, j)).slope),
        }
    };
}

fn slopes_gradient<T: Real, const N: usize, const U: usize, const P: usize>(
    x: Gradient<Dual<T>, N, U, P>,
) -> Gradient<T, N, U, P> {
    Gradient {
        coordinates: slopes(x.coordinates),
        inputs: slopes(x.inputs),
        design: slopes(x.design),
    }
}

impl<X, const N: usize, const U: usize, const P: usize, const O: usize> Mechanism<N, U, P, O>
    for Derived<X>
where
    X: Model<N, U, P, O>,
{
    const DESCRIPTION: Description = X::DESCRIPTION;

    fn residual<T: Real>(&self, q: &[T; N], u: &[T; U], b: &[T; P]) -> [T; N] {
        self.motion_residual(&zeros(), &zeros(), q, u, b)
    }

    fn residual_parts<T: Real>(&self, q: &[T; N], u: &[T; U], b: &[T; P]) -> RestParts<T, N> {
        RestParts {
            inertia: self.0.inertia(&zeros(), &zeros(), q, u, b),
            applied: self.0.applied(&zeros(), q, u, b),
        }
    }

    fn motion_residual<T: Real>(
        &self,
        acceleration: &[T; N],
        velocity: &[T; N],
        q: &[T; N],
        u: &[T; U],
        b: &[T; P],
    ) -> [T; N] {
        let inertia = self.0.inertia(acceleration, velocity, q, u, b);
        let applied = self.0.applied(velocity, q, u, b);
        from_fn(|i| inertia[i] - applied[i])
    }

    fn motion<T: Real>(
        &self,
        velocity: &[T; N],
        q: &[T; N],
        u: &[T; U],
        b: &[T; P],
    ) -> ([[T; N]; N], [T; N]) {
        let (v, x, u_, b_) = (fixed(velocity), fixed(q), fixed(u), fixed(b));
        let mass = transpose(from_fn(|j| {
            slopes(self.motion_residual(&unit(&zeros(), j), &v, &x, &u_, &b_))
        }));
        (
            mass,
            self.motion_residual(&zeros(), velocity, q, u, b)
                .map(|value| -value),
        )
    }

    fn residual_and_stiffness<T: Real>(
        &self,
        q: &[T; N],
        u: &[T; U],
        b: &[T; P],
    ) -> ([T; N], [[T; N]; N]) {
        let stiffness = from_fn(|j| slopes(self.residual(&unit(q, j), &fixed(u), &fixed(b))));
        (self.residual(q, u, b), transpose(stiffness))
    }

    fn linear<T: Real>(&self, q: &[T; N], u: &[T; U], b: &[T; P]) -> Linear<T, N> {
        let (x, u_, b_, zero) = (fixed(q), fixed(u), fixed(b), zeros::<Dual<T>, N>());
        Linear {
            mass: transpose(from_fn(|j| {
                slopes(self.motion_residual(&unit(&zeros(), j), &zero, &x, &u_, &b_))
            })),
            damping: transpose(from_fn(|j| {
                slopes(self.motion_residual(&zero, &unit(&zeros(), j), &x, &u_, &b_))
            })),
            stiffness: self.residual_and_stiffness(q, u, b).1,
        }
    }

    fn residual_partials<T: Real>(
        &self,
        q: &[T; N],
        u: &[T; U],
        b: &[T; P],
    ) -> ([[T; U]; N], [[T; P]; N]) {
        let by_input = from_fn(|j| slopes(self.residual(&fixed(q), &unit(u, j), &fixed(b))));
        let by_design = from_fn(|j| slopes(self.residual(&fixed(q), &fixed(u), &unit(b, j))));
        (transpose(by_input), transpose(by_design))
    }

    fn linear_partials<T: Real>(
        &self,
        q: &[T; N],
        u: &[T; U],
        b: &[T; P],
    ) -> LinearPartials<T, N, U, P> {
        LinearPartials {
            by_coordinate: from_fn(|j| {
                slopes_linear(self.linear(&unit(q, j), &fixed(u), &fixed(b)))
            }),
            by_input: from_fn(|j| slopes_linear(self.linear(&fixed(q), &unit(u, j), &fixed(b)))),
            by_design: from_fn(|j| slopes_linear(self.linear(&fixed(q), &fixed(u), &unit(b, j)))),
        }
    }

    fn linear_along<T: Real>(
        &self,
        q: &[T; N],
        u: &[T; U],
        b: &[T; P],
        dq: &[T; N],
        du: &[T; U],
        db: &[T; P],
    ) -> Linear<T, N> {
        slopes_linear(self.linear(&along(q, dq), &along(u, du), &along(b, db)))
    }

    fn mode_gradient<T: Real>(
        &self,
        q: &[T; N],
        u: &[T; U],
        b: &[T; P],
        phi: &[T; N],
        lambda: T,
    ) -> Gradient<T, N, U, P> {
        let functional = |q: &[Dual<T>; N], u: &[Dual<T>; U], b: &[Dual<T>; P]| {
            let (linear, phi) = (self.linear(q, u, b), fixed(phi));
            let stiffness = product(&phi, &linear.stiffness.map(|row| product(&row, &phi)));
            let mass = product(&phi, &linear.mass.map(|row| product(&row, &phi)));
            stiffness - Dual::fixed(lambda) * mass
        };
        gradient!(q, u, b, functional)
    }

    fn pencil_gradient<T: Real>(
        &self,
        q: &[T; N],
        u: &[T; U],
        b: &[T; P],
        left: &[T; N],
        acceleration: &[T; N],
        velocity: &[T; N],
        position: &[T; N],
    ) -> Gradient<T, N, U, P> {
        let functional = |q: &[Dual<T>; N], u: &[Dual<T>; U], b: &[Dual<T>; P]| {
            let linear = self.linear(q, u, b);
            let terms = [
                (linear.mass, acceleration),
                (linear.damping, velocity),
                (linear.stiffness, position),
            ];
            terms
                .iter()
                .fold(Dual::constant(0.0), |sum, (matrix, vector)| {
                    let vector = fixed(vector);
                    sum + product(&fixed(left), &matrix.map(|row| product(&row, &vector)))
                })
        };
        gradient!(q, u, b, functional)
    }

    fn residual_gradient<T: Real>(
        &self,
        q: &[T; N],
        u: &[T; U],
        b: &[T; P],
        w: &[T; N],
    ) -> Gradient<T, N, U, P> {
        let functional = |q: &[Dual<T>; N], u: &[Dual<T>; U], b: &[Dual<T>; P]| {
            product(&fixed(w), &self.residual(q, u, b))
        };
        gradient!(q, u, b, functional)
    }

    fn mode_gradient_along<T: Real>(
        &self,
        q: &[T; N],
        u: &[T; U],
        b: &[T; P],
        phi: &[T; N],
        lambda: T,
        dq: &[T; N],
        du: &[T; U],
        db: &[T; P],
        dphi: &[T; N],
        dlambda: T,
    ) -> Gradient<T, N, U, P> {
        slopes_gradient(self.mode_gradient(
            &along(q, dq),
            &along(u, du),
            &along(b, db),
            &along(phi, dphi),
            Dual::new(lambda, dlambda),
        ))
    }

    fn pencil_gradient_along<T: Real>(
        &self,
        q: &[T; N],
        u: &[T; U],
        b: &[T; P],
        left: &[T; N],
        acceleration: &[T; N],
        velocity: &[T; N],
        position: &[T; N],
        dq: &[T; N],
        du: &[T; U],
        db: &[T; P],
        dleft: &[T; N],
        dacceleration: &[T; N],
        dvelocity: &[T; N],
        dposition: &[T; N],
    ) -> Gradient<T, N, U, P> {
        slopes_gradient(self.pencil_gradient(
            &along(q, dq),
            &along(u, du),
            &along(b, db),
            &along(left, dleft),
            &along(acceleration, dacceleration),
            &along(velocity, dvelocity),
            &along(position, dposition),
        ))
    }

    fn residual_gradient_along<T: Real>(
        &self,
        q: &[T; N],
        u: &[T; U],
        b: &[T; P],
        w: &[T; N],
        dq: &[T; N],
        du: &[T; U],
        db: &[T; P],
        dw: &[T; N],
    ) -> Gradient<T, N, U, P> {
        slopes_gradient(self.residual_gradient(
            &along(q, dq),
            &along(u, du),
            &along(b, db),
            &along(w, dw),
        ))
    }

    fn violation<T: Real + PartialOrd>(&self, u: &[T; U], b: &[T; P]) -> Option<Violation<T>> {
        self.0.violation(u, b)
    }

    fn outputs<T: Real>(&self, q: &[T; N], u: &[T; U], b: &[T; P]) -> [T; O] {
        self.0.outputs(q, u, b)
    }

    fn output_partials<T: Real>(
        &self,
        q: &[T; N],
        u: &[T; U],
        b: &[T; P],
    ) -> ([[T; N]; O], [[T; U]; O], [[T; P]; O]) {
        let by_coordinate = from_fn(|j| slopes(self.outputs(&unit(q, j), &fixed(u), &fixed(b))));
        let by_input = from_fn(|j| slopes(self.outputs(&fixed(q), &unit(u, j), &fixed(b))));
        let by_design = from_fn(|j| slopes(self.outputs(&fixed(q), &fixed(u), &unit(b, j))));
        (
            transpose(by_coordinate),
            transpose(by_input),
            transpose(by_design),
        )
    }
}
