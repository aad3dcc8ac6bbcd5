//! The paper's single rotating pendulum with every method written by hand:
//! `g = J (qddot - Omega^2 sin q cos q) + m g L/2 sin q`, `J = m L^2/3`. Design variables: `m`, `l`.

use eigentol::{
    DampingKind, Description, Gradient, GradientOf, Linear, LinearPartials, Mechanism, OutputInfo, PartialsOf, Real,
    RestParts, Shared, Violation,
};

use super::dual::Dual;
use super::{GRAVITY, KILOGRAM, METRE, RAD, SPEED, coordinate, description, design, input, positive};

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pendulum;

/// `3 g / (2 L)` for `L = 1 m`: the square of the critical speed.
pub const W: f64 = 1.5 * GRAVITY;

fn c<T: Real>(value: f64) -> T {
    T::constant(value)
}

/// Moment of inertia and first moment times gravity, `m g L/2`.
fn moments<T: Real>(b: &[T; 2]) -> (T, T) {
    (b[0] * b[1] * b[1] / c(3.0), b[0] * b[1] * c(GRAVITY / 2.0))
}

fn one<T: Real>(mass: T, stiffness: T) -> Linear<[[T; 1]; 1]> {
    Linear { mass: [[mass]], damping: [[c(0.0)]], stiffness: [[stiffness]] }
}

fn lift<T: Real, const C: usize>(x: &[T; C], dx: &[T; C]) -> [Dual<T>; C] {
    std::array::from_fn(|i| Dual::new(x[i], dx[i]))
}

fn slopes<T: Real>(x: GradientOf<Pendulum, Dual<T>>) -> GradientOf<Pendulum, T> {
    Gradient {
        coordinates: x.coordinates.map(|value| value.slope),
        inputs: x.inputs.map(|value| value.slope),
        design: x.design.map(|value| value.slope),
    }
}

impl Mechanism for Pendulum {
    sizes!(1, 1, 2, 1);
    type Picture<T: Copy> = [T; 0];

    const DESCRIPTION: Description = description!(
        "Pendulum",
        &[coordinate("theta", RAD)],
        &[input("omega", SPEED)],
        &[design("m", KILOGRAM, 3.0, 0.0), design("l", METRE, 1.0, 0.03)],
        true,
        DampingKind::Zero,
        &[OutputInfo { name: Shared::Static("tip_radius"), unit: METRE }]
    );

    fn residual<T: Real>(&self, q: &[T; 1], u: &[T; 1], b: &[T; 2]) -> [T; 1] {
        let parts = self.residual_parts(q, u, b);
        [parts.inertia[0] - parts.applied[0]]
    }

    fn residual_parts<T: Real>(&self, q: &[T; 1], u: &[T; 1], b: &[T; 2]) -> RestParts<[T; 1]> {
        let ((sin, cos), (j, s)) = (q[0].sin_cos(), moments(b));
        RestParts { inertia: [-(j * u[0] * u[0] * sin * cos)], applied: [-(s * sin)] }
    }

    fn motion_residual<T: Real>(
        &self,
        acceleration: &[T; 1],
        _: &[T; 1],
        q: &[T; 1],
        u: &[T; 1],
        b: &[T; 2],
    ) -> [T; 1] {
        [moments(b).0 * acceleration[0] + self.residual(q, u, b)[0]]
    }

    fn motion<T: Real>(&self, _: &[T; 1], q: &[T; 1], u: &[T; 1], b: &[T; 2]) -> ([[T; 1]; 1], [T; 1]) {
        ([[moments(b).0]], [-self.residual(q, u, b)[0]])
    }

    fn residual_and_stiffness<T: Real>(&self, q: &[T; 1], u: &[T; 1], b: &[T; 2]) -> ([T; 1], [[T; 1]; 1]) {
        let ((sin, cos), (j, s)) = (q[0].sin_cos(), moments(b));
        let j_u = j * u[0] * u[0];
        ([sin * (s - j_u * cos)], [[s * cos - j_u * (cos * cos - sin * sin)]])
    }

    fn linear<T: Real>(&self, q: &[T; 1], u: &[T; 1], b: &[T; 2]) -> Linear<[[T; 1]; 1]> {
        one(moments(b).0, self.residual_and_stiffness(q, u, b).1[0][0])
    }

    fn residual_partials<T: Real>(&self, q: &[T; 1], u: &[T; 1], b: &[T; 2]) -> ([[T; 1]; 1], [[T; 2]; 1]) {
        let gradient = self.residual_gradient(q, u, b, &[c(1.0)]);
        ([gradient.inputs], [gradient.design])
    }

    fn linear_partials<T: Real>(&self, q: &[T; 1], u: &[T; 1], b: &[T; 2]) -> PartialsOf<Self, T> {
        let ((sin, cos), (j, s)) = (q[0].sin_cos(), moments(b));
        let square = u[0] * u[0];
        let double = cos * cos - sin * sin;
        let two = c::<T>(2.0);
        LinearPartials {
            by_coordinate: [one(c(0.0), c::<T>(4.0) * j * square * sin * cos - s * sin)],
            by_input: [one(c(0.0), -(two * j * u[0] * double))],
            by_design: [
                one(j / b[0], (s * cos - j * square * double) / b[0]),
                one(two * j / b[1], (s * cos - two * j * square * double) / b[1]),
            ],
        }
    }

    fn linear_along<T: Real>(
        &self,
        q: &[T; 1],
        u: &[T; 1],
        b: &[T; 2],
        dq: &[T; 1],
        du: &[T; 1],
        db: &[T; 2],
    ) -> Linear<[[T; 1]; 1]> {
        let p = self.linear_partials(q, u, b);
        let sum = |pick: fn(&Linear<[[T; 1]; 1]>) -> T| {
            pick(&p.by_coordinate[0]) * dq[0]
                + pick(&p.by_input[0]) * du[0]
                + pick(&p.by_design[0]) * db[0]
                + pick(&p.by_design[1]) * db[1]
        };
        one(sum(|x| x.mass[0][0]), sum(|x| x.stiffness[0][0]))
    }

    fn mode_gradient<T: Real>(
        &self,
        q: &[T; 1],
        u: &[T; 1],
        b: &[T; 2],
        phi: &[T; 1],
        lambda: T,
    ) -> GradientOf<Self, T> {
        let p = self.linear_partials(q, u, b);
        let square = phi[0] * phi[0];
        let value = |x: &Linear<[[T; 1]; 1]>| square * (x.stiffness[0][0] - lambda * x.mass[0][0]);
        Gradient {
            coordinates: [value(&p.by_coordinate[0])],
            inputs: [value(&p.by_input[0])],
            design: [value(&p.by_design[0]), value(&p.by_design[1])],
        }
    }

    fn pencil_gradient<T: Real>(
        &self,
        q: &[T; 1],
        u: &[T; 1],
        b: &[T; 2],
        left: &[T; 1],
        acceleration: &[T; 1],
        _: &[T; 1],
        position: &[T; 1],
    ) -> GradientOf<Self, T> {
        let p = self.linear_partials(q, u, b);
        let value =
            |x: &Linear<[[T; 1]; 1]>| left[0] * (x.mass[0][0] * acceleration[0] + x.stiffness[0][0] * position[0]);
        Gradient {
            coordinates: [value(&p.by_coordinate[0])],
            inputs: [value(&p.by_input[0])],
            design: [value(&p.by_design[0]), value(&p.by_design[1])],
        }
    }

    fn residual_gradient<T: Real>(&self, q: &[T; 1], u: &[T; 1], b: &[T; 2], w: &[T; 1]) -> GradientOf<Self, T> {
        let ((sin, cos), (j, s)) = (q[0].sin_cos(), moments(b));
        let (residual, stiffness) = self.residual_and_stiffness(q, u, b);
        let two = c::<T>(2.0);
        Gradient {
            coordinates: [w[0] * stiffness[0][0]],
            inputs: [-(w[0] * two * j * u[0] * sin * cos)],
            design: [w[0] * residual[0] / b[0], w[0] * sin * (s - two * j * u[0] * u[0] * cos) / b[1]],
        }
    }

    fn mode_gradient_along<T: Real>(
        &self,
        q: &[T; 1],
        u: &[T; 1],
        b: &[T; 2],
        phi: &[T; 1],
        lambda: T,
        dq: &[T; 1],
        du: &[T; 1],
        db: &[T; 2],
        dphi: &[T; 1],
        dlambda: T,
    ) -> GradientOf<Self, T> {
        slopes(self.mode_gradient(
            &lift(q, dq),
            &lift(u, du),
            &lift(b, db),
            &lift(phi, dphi),
            Dual::new(lambda, dlambda),
        ))
    }

    fn pencil_gradient_along<T: Real>(
        &self,
        q: &[T; 1],
        u: &[T; 1],
        b: &[T; 2],
        left: &[T; 1],
        acceleration: &[T; 1],
        velocity: &[T; 1],
        position: &[T; 1],
        dq: &[T; 1],
        du: &[T; 1],
        db: &[T; 2],
        dleft: &[T; 1],
        dacceleration: &[T; 1],
        dvelocity: &[T; 1],
        dposition: &[T; 1],
    ) -> GradientOf<Self, T> {
        slopes(self.pencil_gradient(
            &lift(q, dq),
            &lift(u, du),
            &lift(b, db),
            &lift(left, dleft),
            &lift(acceleration, dacceleration),
            &lift(velocity, dvelocity),
            &lift(position, dposition),
        ))
    }

    fn residual_gradient_along<T: Real>(
        &self,
        q: &[T; 1],
        u: &[T; 1],
        b: &[T; 2],
        w: &[T; 1],
        dq: &[T; 1],
        du: &[T; 1],
        db: &[T; 2],
        dw: &[T; 1],
    ) -> GradientOf<Self, T> {
        slopes(self.residual_gradient(&lift(q, dq), &lift(u, du), &lift(b, db), &lift(w, dw)))
    }

    fn violation<T: Real + PartialOrd>(&self, _: &[T; 1], b: &[T; 2]) -> Option<Violation<T>> {
        positive(&[(b[0], "mass of bar"), (b[1], "length of bar")])
    }

    fn outputs<T: Real>(&self, q: &[T; 1], _: &[T; 1], b: &[T; 2]) -> [T; 1] {
        [b[1] * q[0].sin()]
    }

    fn output_partials<T: Real>(&self, q: &[T; 1], _: &[T; 1], b: &[T; 2]) -> ([[T; 1]; 1], [[T; 1]; 1], [[T; 2]; 1]) {
        let (sin, cos) = q[0].sin_cos();
        ([[b[1] * cos]], [[c(0.0)]], [[c(0.0), sin]])
    }
}
