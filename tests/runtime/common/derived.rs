//! A mechanism defined by its equations of motion alone; every other method follows by nested dual numbers. An oracle
//! that shares no code with the compiler.

use eigentol::{
    Array, Description, Forcing, Gradient, GradientOf, Linear, LinearPartials, Mechanism, OutputMotionOf, PartialsOf,
    Real, ResidualPartialsOf, RestParts, Square, Violation,
};

use super::dual::Dual;

/// What the excitations of a model exert.
pub type Excited<X, T> = Forcing<
    <X as Model>::Excitations<<X as Model>::Coordinates<T>>,
    <X as Model>::Excitations<T>,
    <X as Model>::Excitations<<X as Model>::Outputs<T>>,
>;

/// Equations of motion `g = inertia - applied`.
pub trait Model: Clone + Sync {
    type Coordinates<T: Copy>: Array<T>;
    type Inputs<T: Copy>: Array<T>;
    type Design<T: Copy>: Array<T>;
    type Outputs<T: Copy>: Array<T>;
    type Excitations<T: Copy>: Array<T>;

    const DESCRIPTION: Description;

    fn inertia<T: Real>(
        &self,
        acceleration: &Self::Coordinates<T>,
        velocity: &Self::Coordinates<T>,
        q: &Self::Coordinates<T>,
        u: &Self::Inputs<T>,
        b: &Self::Design<T>,
    ) -> Self::Coordinates<T>;

    fn applied<T: Real>(
        &self,
        velocity: &Self::Coordinates<T>,
        q: &Self::Coordinates<T>,
        u: &Self::Inputs<T>,
        b: &Self::Design<T>,
    ) -> Self::Coordinates<T>;

    fn violation<T: Real + PartialOrd>(&self, _: &Self::Inputs<T>, _: &Self::Design<T>) -> Option<Violation<T>> {
        None
    }

    /// The outputs, for models that have any.
    fn outputs<T: Real>(&self, _: &Self::Coordinates<T>, _: &Self::Inputs<T>, _: &Self::Design<T>) -> Self::Outputs<T> {
        Array::filled(T::constant(f64::NAN))
    }

    /// The outputs along any motion, for models in which they depend on more than the position.
    fn moving_outputs<T: Real>(
        &self,
        _acceleration: &Self::Coordinates<T>,
        _velocity: &Self::Coordinates<T>,
        q: &Self::Coordinates<T>,
        u: &Self::Inputs<T>,
        b: &Self::Design<T>,
    ) -> Self::Outputs<T> {
        self.outputs(q, u, b)
    }

    /// What the excitations exert, for models that have any.
    fn forcing<T: Real>(&self, _: &Self::Coordinates<T>, _: &Self::Inputs<T>, _: &Self::Design<T>) -> Excited<Self, T> {
        Forcing {
            cosine: Array::filled(zeros()),
            frequency: zeros(),
            direct_cosine: Array::filled(zeros()),
            sine: Array::filled(zeros()),
            direct_sine: Array::filled(zeros()),
        }
    }
}

/// The mechanism of a model.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Derived<X>(pub X);

fn fixed<T: Real, D: Array<Dual<T>>>(x: &impl Array<T>) -> D {
    D::from_fn(|i| Dual::fixed(x.as_ref()[i]))
}

fn along<T: Real, A: Array<T>, D: Array<Dual<T>>>(x: &A, dx: &A) -> D {
    D::from_fn(|i| Dual::new(x.as_ref()[i], dx.as_ref()[i]))
}

/// The values `x`, with a unit derivative in number `j`.
fn unit<T: Real, D: Array<Dual<T>>>(x: &impl Array<T>, j: usize) -> D {
    D::from_fn(|i| Dual::new(x.as_ref()[i], T::constant(if i == j { 1.0 } else { 0.0 })))
}

fn zeros<T: Real, A: Array<T>>() -> A {
    A::filled(T::constant(0.0))
}

fn slopes<T: Real, A: Array<T>>(x: &impl Array<Dual<T>>) -> A {
    A::from_fn(|i| x.as_ref()[i].slope)
}

fn slopes_linear<X: Model, T: Real>(x: Linear<Square<Derived<X>, Dual<T>>>) -> Linear<Square<Derived<X>, T>> {
    x.map(|matrix| Array::from_fn(|i| slopes(&matrix.as_ref()[i])))
}

fn transpose<T: Copy, C: Array<T>, R: Array<T>, M: Array<R>>(columns: &[C]) -> M {
    M::from_fn(|i| R::from_fn(|j| columns[j].as_ref()[i]))
}

fn product<T: Real>(a: &[T], b: &[T]) -> T {
    (0..a.len()).fold(T::constant(0.0), |sum, i| sum + a[i] * b[i])
}

/// `left^T matrix right`.
fn form<T: Real, R: Array<T>>(left: &[T], matrix: &[R], right: &[T]) -> T {
    (0..left.len()).fold(T::constant(0.0), |sum, i| sum + left[i] * product(matrix[i].as_ref(), right))
}

/// Derivative of `function` by each coordinate, input and design variable.
macro_rules! gradient {
    ($q:expr, $u:expr, $b:expr, $function:expr) => {
        Gradient {
            coordinates: Array::from_fn(|j| $function(&unit($q, j), &fixed($u), &fixed($b)).slope),
            inputs: Array::from_fn(|j| $function(&fixed($q), &unit($u, j), &fixed($b)).slope),
            design: Array::from_fn(|j| $function(&fixed($q), &fixed($u), &unit($b, j)).slope),
        }
    };
}

fn slopes_gradient<X: Model, T: Real>(x: GradientOf<Derived<X>, Dual<T>>) -> GradientOf<Derived<X>, T> {
    Gradient { coordinates: slopes(&x.coordinates), inputs: slopes(&x.inputs), design: slopes(&x.design) }
}

impl<X: Model> Mechanism for Derived<X> {
    type Coordinates<T: Copy> = X::Coordinates<T>;
    type Inputs<T: Copy> = X::Inputs<T>;
    type Design<T: Copy> = X::Design<T>;
    type Outputs<T: Copy> = X::Outputs<T>;
    type Excitations<T: Copy> = X::Excitations<T>;
    type Picture<T: Copy> = [T; 0];

    const DESCRIPTION: Description = X::DESCRIPTION;

    fn residual<T: Real>(&self, q: &X::Coordinates<T>, u: &X::Inputs<T>, b: &X::Design<T>) -> X::Coordinates<T> {
        self.motion_residual(&zeros(), &zeros(), q, u, b)
    }

    fn residual_parts<T: Real>(
        &self,
        q: &X::Coordinates<T>,
        u: &X::Inputs<T>,
        b: &X::Design<T>,
    ) -> RestParts<X::Coordinates<T>> {
        RestParts { inertia: self.0.inertia(&zeros(), &zeros(), q, u, b), applied: self.0.applied(&zeros(), q, u, b) }
    }

    fn motion_residual<T: Real>(
        &self,
        acceleration: &X::Coordinates<T>,
        velocity: &X::Coordinates<T>,
        q: &X::Coordinates<T>,
        u: &X::Inputs<T>,
        b: &X::Design<T>,
    ) -> X::Coordinates<T> {
        let inertia = self.0.inertia(acceleration, velocity, q, u, b);
        let applied = self.0.applied(velocity, q, u, b);
        Array::from_fn(|i| inertia.as_ref()[i] - applied.as_ref()[i])
    }

    fn motion<T: Real>(
        &self,
        velocity: &X::Coordinates<T>,
        q: &X::Coordinates<T>,
        u: &X::Inputs<T>,
        b: &X::Design<T>,
    ) -> (Square<Self, T>, X::Coordinates<T>) {
        let (v, x, u_, b_) = (fixed(velocity), fixed(q), fixed(u), fixed(b));
        let rest: X::Coordinates<T> = zeros();
        let by_acceleration: Square<Self, T> =
            Array::from_fn(|j| slopes(&self.motion_residual::<Dual<T>>(&unit(&rest, j), &v, &x, &u_, &b_)));
        let residual = self.motion_residual(&rest, velocity, q, u, b);
        (transpose(by_acceleration.as_ref()), Array::from_fn(|i| -residual.as_ref()[i]))
    }

    fn residual_and_stiffness<T: Real>(
        &self,
        q: &X::Coordinates<T>,
        u: &X::Inputs<T>,
        b: &X::Design<T>,
    ) -> (X::Coordinates<T>, Square<Self, T>) {
        let columns: Square<Self, T> =
            Array::from_fn(|j| slopes(&self.residual::<Dual<T>>(&unit(q, j), &fixed(u), &fixed(b))));
        (self.residual(q, u, b), transpose(columns.as_ref()))
    }

    fn linear<T: Real>(&self, q: &X::Coordinates<T>, u: &X::Inputs<T>, b: &X::Design<T>) -> Linear<Square<Self, T>> {
        let (x, u_, b_) = (fixed(q), fixed(u), fixed(b));
        let rest: X::Coordinates<T> = zeros();
        let zero = fixed(&rest);
        let by_acceleration: Square<Self, T> =
            Array::from_fn(|j| slopes(&self.motion_residual::<Dual<T>>(&unit(&rest, j), &zero, &x, &u_, &b_)));
        let by_velocity: Square<Self, T> =
            Array::from_fn(|j| slopes(&self.motion_residual::<Dual<T>>(&zero, &unit(&rest, j), &x, &u_, &b_)));
        Linear {
            mass: transpose(by_acceleration.as_ref()),
            damping: transpose(by_velocity.as_ref()),
            stiffness: self.residual_and_stiffness(q, u, b).1,
        }
    }

    fn residual_partials<T: Real>(
        &self,
        q: &X::Coordinates<T>,
        u: &X::Inputs<T>,
        b: &X::Design<T>,
    ) -> ResidualPartialsOf<Self, T> {
        let by_input: X::Inputs<X::Coordinates<T>> =
            Array::from_fn(|j| slopes(&self.residual::<Dual<T>>(&fixed(q), &unit(u, j), &fixed(b))));
        let by_design: X::Design<X::Coordinates<T>> =
            Array::from_fn(|j| slopes(&self.residual::<Dual<T>>(&fixed(q), &fixed(u), &unit(b, j))));
        (transpose(by_input.as_ref()), transpose(by_design.as_ref()))
    }

    fn linear_partials<T: Real>(
        &self,
        q: &X::Coordinates<T>,
        u: &X::Inputs<T>,
        b: &X::Design<T>,
    ) -> PartialsOf<Self, T> {
        LinearPartials {
            by_coordinate: Array::from_fn(|j| slopes_linear::<X, T>(self.linear(&unit(q, j), &fixed(u), &fixed(b)))),
            by_input: Array::from_fn(|j| slopes_linear::<X, T>(self.linear(&fixed(q), &unit(u, j), &fixed(b)))),
            by_design: Array::from_fn(|j| slopes_linear::<X, T>(self.linear(&fixed(q), &fixed(u), &unit(b, j)))),
        }
    }

    fn linear_along<T: Real>(
        &self,
        q: &X::Coordinates<T>,
        u: &X::Inputs<T>,
        b: &X::Design<T>,
        dq: &X::Coordinates<T>,
        du: &X::Inputs<T>,
        db: &X::Design<T>,
    ) -> Linear<Square<Self, T>> {
        slopes_linear::<X, T>(self.linear(&along(q, dq), &along(u, du), &along(b, db)))
    }

    fn mode_gradient<T: Real>(
        &self,
        q: &X::Coordinates<T>,
        u: &X::Inputs<T>,
        b: &X::Design<T>,
        phi: &X::Coordinates<T>,
        lambda: T,
    ) -> GradientOf<Self, T> {
        let functional = |q: &X::Coordinates<Dual<T>>, u: &X::Inputs<Dual<T>>, b: &X::Design<Dual<T>>| {
            let linear = self.linear(q, u, b);
            let phi: X::Coordinates<Dual<T>> = fixed(phi);
            let stiffness = form(phi.as_ref(), linear.stiffness.as_ref(), phi.as_ref());
            let mass = form(phi.as_ref(), linear.mass.as_ref(), phi.as_ref());
            stiffness - Dual::fixed(lambda) * mass
        };
        gradient!(q, u, b, functional)
    }

    fn pencil_gradient<T: Real>(
        &self,
        q: &X::Coordinates<T>,
        u: &X::Inputs<T>,
        b: &X::Design<T>,
        left: &X::Coordinates<T>,
        acceleration: &X::Coordinates<T>,
        velocity: &X::Coordinates<T>,
        position: &X::Coordinates<T>,
    ) -> GradientOf<Self, T> {
        // The derivative of `left^T g` along the three vectors, taken at rest.
        let rest: X::Coordinates<Dual<T>> = zeros();
        let functional = |q: &X::Coordinates<Dual<T>>, u: &X::Inputs<Dual<T>>, b: &X::Design<Dual<T>>| {
            let [acceleration, velocity, position] =
                [acceleration, velocity, position].map(fixed::<T, X::Coordinates<Dual<T>>>);
            let change: X::Coordinates<Dual<T>> = slopes(&self.motion_residual::<Dual<Dual<T>>>(
                &along(&rest, &acceleration),
                &along(&rest, &velocity),
                &along(q, &position),
                &fixed(u),
                &fixed(b),
            ));
            let left: X::Coordinates<Dual<T>> = fixed(left);
            product(left.as_ref(), change.as_ref())
        };
        gradient!(q, u, b, functional)
    }

    fn residual_gradient<T: Real>(
        &self,
        q: &X::Coordinates<T>,
        u: &X::Inputs<T>,
        b: &X::Design<T>,
        w: &X::Coordinates<T>,
    ) -> GradientOf<Self, T> {
        let functional = |q: &X::Coordinates<Dual<T>>, u: &X::Inputs<Dual<T>>, b: &X::Design<Dual<T>>| {
            let w: X::Coordinates<Dual<T>> = fixed(w);
            product(w.as_ref(), self.residual(q, u, b).as_ref())
        };
        gradient!(q, u, b, functional)
    }

    fn mode_gradient_along<T: Real>(
        &self,
        q: &X::Coordinates<T>,
        u: &X::Inputs<T>,
        b: &X::Design<T>,
        phi: &X::Coordinates<T>,
        lambda: T,
        dq: &X::Coordinates<T>,
        du: &X::Inputs<T>,
        db: &X::Design<T>,
        dphi: &X::Coordinates<T>,
        dlambda: T,
    ) -> GradientOf<Self, T> {
        slopes_gradient::<X, T>(self.mode_gradient(
            &along(q, dq),
            &along(u, du),
            &along(b, db),
            &along(phi, dphi),
            Dual::new(lambda, dlambda),
        ))
    }

    fn pencil_gradient_along<T: Real>(
        &self,
        q: &X::Coordinates<T>,
        u: &X::Inputs<T>,
        b: &X::Design<T>,
        left: &X::Coordinates<T>,
        acceleration: &X::Coordinates<T>,
        velocity: &X::Coordinates<T>,
        position: &X::Coordinates<T>,
        dq: &X::Coordinates<T>,
        du: &X::Inputs<T>,
        db: &X::Design<T>,
        dleft: &X::Coordinates<T>,
        dacceleration: &X::Coordinates<T>,
        dvelocity: &X::Coordinates<T>,
        dposition: &X::Coordinates<T>,
    ) -> GradientOf<Self, T> {
        slopes_gradient::<X, T>(self.pencil_gradient(
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
        q: &X::Coordinates<T>,
        u: &X::Inputs<T>,
        b: &X::Design<T>,
        w: &X::Coordinates<T>,
        dq: &X::Coordinates<T>,
        du: &X::Inputs<T>,
        db: &X::Design<T>,
        dw: &X::Coordinates<T>,
    ) -> GradientOf<Self, T> {
        slopes_gradient::<X, T>(self.residual_gradient(&along(q, dq), &along(u, du), &along(b, db), &along(w, dw)))
    }

    fn violation<T: Real + PartialOrd>(&self, u: &X::Inputs<T>, b: &X::Design<T>) -> Option<Violation<T>> {
        self.0.violation(u, b)
    }

    fn outputs<T: Real>(&self, q: &X::Coordinates<T>, u: &X::Inputs<T>, b: &X::Design<T>) -> X::Outputs<T> {
        self.0.outputs(q, u, b)
    }

    fn output_partials<T: Real>(
        &self,
        q: &X::Coordinates<T>,
        u: &X::Inputs<T>,
        b: &X::Design<T>,
    ) -> (X::Outputs<X::Coordinates<T>>, X::Outputs<X::Inputs<T>>, X::Outputs<X::Design<T>>) {
        let by_coordinate: X::Coordinates<X::Outputs<T>> =
            Array::from_fn(|j| slopes(&self.outputs::<Dual<T>>(&unit(q, j), &fixed(u), &fixed(b))));
        let by_input: X::Inputs<X::Outputs<T>> =
            Array::from_fn(|j| slopes(&self.outputs::<Dual<T>>(&fixed(q), &unit(u, j), &fixed(b))));
        let by_design: X::Design<X::Outputs<T>> =
            Array::from_fn(|j| slopes(&self.outputs::<Dual<T>>(&fixed(q), &fixed(u), &unit(b, j))));
        (transpose(by_coordinate.as_ref()), transpose(by_input.as_ref()), transpose(by_design.as_ref()))
    }

    fn forcing<T: Real>(&self, q: &X::Coordinates<T>, u: &X::Inputs<T>, b: &X::Design<T>) -> Excited<X, T> {
        self.0.forcing(q, u, b)
    }

    fn output_motion<T: Real>(
        &self,
        q: &X::Coordinates<T>,
        u: &X::Inputs<T>,
        b: &X::Design<T>,
    ) -> OutputMotionOf<Self, T> {
        let (x, u, b) = (fixed(q), fixed(u), fixed(b));
        let rest: X::Coordinates<T> = zeros();
        let still: X::Coordinates<Dual<T>> = fixed(&rest);
        let by = |index: usize| {
            let columns: X::Coordinates<X::Outputs<T>> = Array::from_fn(|j| {
                let (mut motion, moved) = ([still, still, x], [&rest, &rest, q][index]);
                motion[index] = unit(moved, j);
                let [acceleration, velocity, position] = &motion;
                slopes(&(self.0).moving_outputs::<Dual<T>>(acceleration, velocity, position, &u, &b))
            });
            transpose(columns.as_ref())
        };
        (by(0), by(1), by(2))
    }

    fn forced_gradient<T: Real>(
        &self,
        q: &X::Coordinates<T>,
        u: &X::Inputs<T>,
        b: &X::Design<T>,
        output: &X::Outputs<T>,
        acceleration: &X::Coordinates<T>,
        velocity: &X::Coordinates<T>,
        position: &X::Coordinates<T>,
        share: &X::Excitations<T>,
        cosine: &X::Coordinates<T>,
        sine: &X::Coordinates<T>,
        direct_cosine: &X::Outputs<T>,
        direct_sine: &X::Outputs<T>,
        frequency: &X::Excitations<T>,
    ) -> GradientOf<Self, T> {
        let functional = |q: &X::Coordinates<Dual<T>>, u: &X::Inputs<Dual<T>>, b: &X::Design<Dual<T>>| {
            let [acceleration, velocity, position, cosine, sine] =
                [acceleration, velocity, position, cosine, sine].map(fixed::<T, X::Coordinates<Dual<T>>>);
            let [output, direct_cosine, direct_sine] =
                [output, direct_cosine, direct_sine].map(fixed::<T, X::Outputs<Dual<T>>>);
            let [share, frequency] = [share, frequency].map(fixed::<T, X::Excitations<Dual<T>>>);
            let (by_a, by_v, by_x) = Mechanism::output_motion::<Dual<T>>(self, q, u, b);
            let mut sum = form(output.as_ref(), by_a.as_ref(), acceleration.as_ref())
                + form(output.as_ref(), by_v.as_ref(), velocity.as_ref())
                + form(output.as_ref(), by_x.as_ref(), position.as_ref());
            let forces = self.0.forcing::<Dual<T>>(q, u, b);
            sum = sum
                + form(share.as_ref(), forces.cosine.as_ref(), cosine.as_ref())
                + form(share.as_ref(), forces.sine.as_ref(), sine.as_ref())
                + form(share.as_ref(), forces.direct_cosine.as_ref(), direct_cosine.as_ref())
                + form(share.as_ref(), forces.direct_sine.as_ref(), direct_sine.as_ref());
            sum + product(frequency.as_ref(), forces.frequency.as_ref())
        };
        gradient!(q, u, b, functional)
    }
}
