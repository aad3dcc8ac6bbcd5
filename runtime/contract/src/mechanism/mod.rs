//! The contract between compile time and run time: what generated code provides.

mod array;
mod description;
mod handles;
mod picture;
mod results;
#[cfg(feature = "serde")]
mod serial;
mod shared;
mod tolerance;

pub use array::Array;
pub use description::{
    CoordinateInfo, CorrelationInfo, DampingKind, Description, DesignInfo, ExcitationInfo, InputInfo, KernelInfo,
    LineKind, OutputInfo, RingInfo, Role, SpanInfo, Unit,
};
pub use handles::{Any, Coordinate, DesignVariable, Excitation, Input, Output};
pub use picture::{
    BeamInfo, BodyInfo, ElementInfo, JointInfo, LinkInfo, PictureInfo, PointInfo, SolidInfo, SolidKind, WheelInfo,
};
pub use results::{Forcing, Gradient, Linear, LinearPartials, PoseMargin, RestParts, Sizes, Violation, Zeros};
pub use shared::{List, Shared, Text};
pub use tolerance::{Law, ToleranceInfo};

use crate::Real;
use crate::scalar::Dual;

/// A matrix with a row and a column for each unknown.
pub type Square<M, T> = <M as Mechanism>::Coordinates<<M as Mechanism>::Coordinates<T>>;
/// [`LinearPartials`] of a mechanism.
pub type PartialsOf<M, T> = LinearPartials<
    <M as Mechanism>::Coordinates<Linear<Square<M, T>>>,
    <M as Mechanism>::Inputs<Linear<Square<M, T>>>,
    <M as Mechanism>::Design<Linear<Square<M, T>>>,
>;
/// Partial derivatives of the residual with respect to every input and every design variable, one row per unknown.
pub type ResidualPartialsOf<M, T> = (
    <M as Mechanism>::Coordinates<<M as Mechanism>::Inputs<T>>,
    <M as Mechanism>::Coordinates<<M as Mechanism>::Design<T>>,
);
/// [`Gradient`] of a mechanism.
pub type GradientOf<M, T> =
    Gradient<<M as Mechanism>::Coordinates<T>, <M as Mechanism>::Inputs<T>, <M as Mechanism>::Design<T>>;

/// [`Forcing`] of a mechanism.
pub type ForcingOf<M, T> = Forcing<
    <M as Mechanism>::Excitations<<M as Mechanism>::Coordinates<T>>,
    <M as Mechanism>::Excitations<T>,
    <M as Mechanism>::Excitations<<M as Mechanism>::Outputs<T>>,
>;
/// Derivatives of the outputs by acceleration, velocity and position, one row per output.
pub type OutputMotionOf<M, T> = (
    <M as Mechanism>::Outputs<<M as Mechanism>::Coordinates<T>>,
    <M as Mechanism>::Outputs<<M as Mechanism>::Coordinates<T>>,
    <M as Mechanism>::Outputs<<M as Mechanism>::Coordinates<T>>,
);

/// Forms of methods that are inlined at the call site; each calls the method.
macro_rules! inlined {
    ($($(#[$attribute:meta])* $inlined:ident: $kernel:ident($(&$moving:ident)* $($argument:ident: $kind:ty),*) -> $result:ty;)*) => {$(
        $(#[$attribute])*
        #[doc(hidden)]
        #[inline(always)]
        fn $inlined<T: Real>(
            &self,
            $($moving: &Self::Coordinates<T>,)*
            q: &Self::Coordinates<T>,
            u: &Self::Inputs<T>,
            b: &Self::Design<T>,
            $($argument: $kind),*
        ) -> $result {
            self.$kernel($($moving,)* q, u, b, $($argument),*)
        }
    )*};
}

/// A compiled mechanism with `N` free coordinates, `U` inputs, `P` design variables, `O` outputs and `E`
/// excitations.
///
/// Implemented by `mechanism!`. Every method is straight-line arithmetic over plain arrays: no allocation, no branch,
/// no panic. All quantities are SI, angles in radians. Conventions for all methods:
///
/// - `q`: free coordinates, `u`: inputs, `b`: design variables, in the order of [`Mechanism::DESCRIPTION`];
/// - matrices are arrays of rows; `matrix[i][j]` is the derivative of residual `i` with respect to coordinate `j`;
/// - the residual is `g(qddot, qdot, q; u, b) = M* qddot + h` (eq. 12): zero along a motion, positive when inertia
///   exceeds the applied forces.
///
/// A method never fails: outside its domain (a negative length under a root, NaN as input) it returns NaN or infinity,
/// which the solvers of this crate turn into typed errors.
#[allow(clippy::too_many_arguments, clippy::type_complexity)]
pub trait Mechanism: Clone + Sync + Sized {
    /// A number for each of the `N` unknowns.
    type Coordinates<T: Copy>: Array<T>;
    /// A number for each of the `U` inputs.
    type Inputs<T: Copy>: Array<T>;
    /// A number for each of the `P` design variables.
    type Design<T: Copy>: Array<T>;
    /// A number for each of the `O` outputs.
    type Outputs<T: Copy>: Array<T>;
    /// A number for each of the `E` excitations.
    type Excitations<T: Copy>: Array<T>;
    /// The numbers computed by [`Mechanism::picture`].
    type Picture<T: Copy>: Array<T>;

    /// Names, units, nominal values and what the compiler proved.
    const DESCRIPTION: Description;

    /// How to read the numbers of [`Mechanism::picture`].
    const PICTURE: PictureInfo = PictureInfo::EMPTY;

    /// Residual at rest, `g(0, 0, q; u, b)` (eq. 10): zero at a dynamic equilibrium.
    fn residual<T: Real>(
        &self,
        q: &Self::Coordinates<T>,
        u: &Self::Inputs<T>,
        b: &Self::Design<T>,
    ) -> Self::Coordinates<T>;

    /// The residual at rest split into inertia and applied forces: `g = inertia - applied` (eq. 10).
    fn residual_parts<T: Real>(
        &self,
        q: &Self::Coordinates<T>,
        u: &Self::Inputs<T>,
        b: &Self::Design<T>,
    ) -> RestParts<Self::Coordinates<T>>;

    /// The full nonlinear equations of motion, `g(qddot, qdot, q; u, b)` (eq. 12).
    fn motion_residual<T: Real>(
        &self,
        acceleration: &Self::Coordinates<T>,
        velocity: &Self::Coordinates<T>,
        q: &Self::Coordinates<T>,
        u: &Self::Inputs<T>,
        b: &Self::Design<T>,
    ) -> Self::Coordinates<T>;

    /// Generalised mass matrix `M*(q; b)` (eq. 8) and right-hand side `Q* = -h(q, qdot, u; b)` (eq. 9).
    fn motion<T: Real>(
        &self,
        velocity: &Self::Coordinates<T>,
        q: &Self::Coordinates<T>,
        u: &Self::Inputs<T>,
        b: &Self::Design<T>,
    ) -> (Square<Self, T>, Self::Coordinates<T>);

    /// The equations of motion linearised along any motion: `dg/dqddot = M*` (`mass`), `dg/dqdot` (`damping`) and
    /// `dg/dq` (`stiffness`).
    ///
    /// Implicit integration and inverse dynamics with derivatives need these. For zero velocity and acceleration they
    /// are [`Mechanism::linear`]. They are generated up to about 50,000 operations; for a larger mechanism each column
    /// is differentiated separately, as here.
    fn motion_linear<T: Real>(
        &self,
        acceleration: &Self::Coordinates<T>,
        velocity: &Self::Coordinates<T>,
        q: &Self::Coordinates<T>,
        u: &Self::Inputs<T>,
        b: &Self::Design<T>,
    ) -> Linear<Square<Self, T>> {
        let acceleration: Self::Coordinates<Dual<T>> = fixed(acceleration);
        let (velocity, q) = (fixed(velocity), fixed(q));
        let (u, b) = (fixed(u), fixed(b));
        let columns = |of_velocity: bool| -> Square<Self, T> {
            Array::from_fn(|k| {
                let (mut velocity, mut q): (Self::Coordinates<Dual<T>>, Self::Coordinates<Dual<T>>) = (velocity, q);
                let moved = if of_velocity { &mut velocity } else { &mut q };
                moved.as_mut()[k].slope = T::constant(1.0);
                let residual = self.motion_residual(&acceleration, &velocity, &q, &u, &b);
                slopes(&residual)
            })
        };
        Linear {
            mass: self.motion(&values(&velocity), &values(&q), &values(&u), &values(&b)).0,
            damping: transposed::<Self, T>(&columns(true)),
            stiffness: transposed::<Self, T>(&columns(false)),
        }
    }

    /// Residual at rest and its Jacobian `Khat`, as a Newton step needs them.
    fn residual_and_stiffness<T: Real>(
        &self,
        q: &Self::Coordinates<T>,
        u: &Self::Inputs<T>,
        b: &Self::Design<T>,
    ) -> (Self::Coordinates<T>, Square<Self, T>);

    /// `Mhat`, `Chat` and `Khat` (eqs. 15-17).
    fn linear<T: Real>(
        &self,
        q: &Self::Coordinates<T>,
        u: &Self::Inputs<T>,
        b: &Self::Design<T>,
    ) -> Linear<Square<Self, T>>;

    /// Explicit partial derivatives of the residual at rest with respect to every input and design variable.
    fn residual_partials<T: Real>(
        &self,
        q: &Self::Coordinates<T>,
        u: &Self::Inputs<T>,
        b: &Self::Design<T>,
    ) -> ResidualPartialsOf<Self, T>;

    /// Explicit partial derivatives of `Mhat`, `Chat` and `Khat` with respect to every coordinate, input and design
    /// variable.
    ///
    /// Generated for small mechanisms. A large one computes them one direction at a time, as here, because
    /// straight-line code for all of them grows with the cube of its size.
    fn linear_partials<T: Real>(
        &self,
        q: &Self::Coordinates<T>,
        u: &Self::Inputs<T>,
        b: &Self::Design<T>,
    ) -> PartialsOf<Self, T> {
        let (dq, du, db) = (zeros(), zeros(), zeros());
        LinearPartials {
            by_coordinate: Array::from_fn(|k| self.linear_along(q, u, b, &unit(k), &du, &db)),
            by_input: Array::from_fn(|k| self.linear_along(q, u, b, &dq, &unit(k), &db)),
            by_design: Array::from_fn(|k| self.linear_along(q, u, b, &dq, &du, &unit(k))),
        }
    }

    /// [`Mechanism::linear_partials`], written into an existing buffer.
    ///
    /// Sets every entry that can differ from zero and leaves the others unchanged. Start from zeros
    /// ([`LinearPartials::default`]) and keep passing the same buffer, always for the same mechanism: with thousands of
    /// entries, a fifth of the time would go into zeroing them.
    fn linear_partials_into<T: Real>(
        &self,
        q: &Self::Coordinates<T>,
        u: &Self::Inputs<T>,
        b: &Self::Design<T>,
        result: &mut PartialsOf<Self, T>,
    ) {
        *result = self.linear_partials(q, u, b);
    }

    /// [`Mechanism::linear_partials`] and [`Mechanism::residual_partials`] in one call.
    ///
    /// For a small mechanism the sines and other common terms are computed once; a large one computes the two
    /// separately.
    #[inline]
    fn partials<T: Real>(
        &self,
        q: &Self::Coordinates<T>,
        u: &Self::Inputs<T>,
        b: &Self::Design<T>,
    ) -> (PartialsOf<Self, T>, ResidualPartialsOf<Self, T>) {
        if const { few_partials::<Self>() } {
            T::run(
                #[inline(always)]
                || {
                    let matrices = self.linear_partials_inlined(q, u, b);
                    (matrices, self.residual_partials_inlined(q, u, b))
                },
            )
        } else {
            let matrices = self.linear_partials(q, u, b);
            (matrices, self.residual_partials(q, u, b))
        }
    }

    /// Directional derivatives of `Mhat`, `Chat` and `Khat` along (`dq`, `du`, `db`).
    ///
    /// Like the other kernels along a direction, this one is not generated: it is [`Mechanism::linear`] in dual
    /// numbers.
    fn linear_along<T: Real>(
        &self,
        q: &Self::Coordinates<T>,
        u: &Self::Inputs<T>,
        b: &Self::Design<T>,
        dq: &Self::Coordinates<T>,
        du: &Self::Inputs<T>,
        db: &Self::Design<T>,
    ) -> Linear<Square<Self, T>> {
        let (q, u, b) = (along(q, dq), along(u, du), along(b, db));
        let linear: Linear<Square<Self, Dual<T>>> = self.linear(&q, &u, &b);
        linear.map(|matrix| Array::from_fn(|i| slopes(&matrix.as_ref()[i])))
    }

    /// Gradient of `a(q, u, b) = phi^T (Khat - lambda Mhat) phi`, with `phi` and `lambda` held fixed, by reverse
    /// differentiation: all coordinates, inputs and design variables at the cost of a few residuals.
    fn mode_gradient<T: Real>(
        &self,
        q: &Self::Coordinates<T>,
        u: &Self::Inputs<T>,
        b: &Self::Design<T>,
        phi: &Self::Coordinates<T>,
        lambda: T,
    ) -> GradientOf<Self, T>;

    /// Gradient of `left^T (Mhat acceleration + Chat velocity + Khat position)`, with the four vectors held fixed, by
    /// reverse differentiation: all coordinates, inputs and design variables at the cost of a few residuals.
    ///
    /// For a damped mode, `psi^T (s^2 Mhat + s Chat + Khat) phi` with complex `s`, `psi` and `phi` is linear in `left`
    /// and in the other three vectors together. Its gradient takes four calls: real and imaginary part of `psi` with
    /// each of the real and imaginary parts of (`s^2 phi`, `s phi`, `phi`). [`Mechanism::mode_gradient`] is the case
    /// `left` = `position` = `phi`, `acceleration` = `-lambda phi`, `velocity` = 0.
    fn pencil_gradient<T: Real>(
        &self,
        q: &Self::Coordinates<T>,
        u: &Self::Inputs<T>,
        b: &Self::Design<T>,
        left: &Self::Coordinates<T>,
        acceleration: &Self::Coordinates<T>,
        velocity: &Self::Coordinates<T>,
        position: &Self::Coordinates<T>,
    ) -> GradientOf<Self, T>;

    /// Gradient of `w^T g(0, 0, q; u, b)` with `w` held fixed.
    fn residual_gradient<T: Real>(
        &self,
        q: &Self::Coordinates<T>,
        u: &Self::Inputs<T>,
        b: &Self::Design<T>,
        w: &Self::Coordinates<T>,
    ) -> GradientOf<Self, T>;

    /// Directional derivative of [`Mechanism::mode_gradient`] along (`dq`, `du`, `db`, `dphi`, `dlambda`).
    fn mode_gradient_along<T: Real>(
        &self,
        q: &Self::Coordinates<T>,
        u: &Self::Inputs<T>,
        b: &Self::Design<T>,
        phi: &Self::Coordinates<T>,
        lambda: T,
        dq: &Self::Coordinates<T>,
        du: &Self::Inputs<T>,
        db: &Self::Design<T>,
        dphi: &Self::Coordinates<T>,
        dlambda: T,
    ) -> GradientOf<Self, T> {
        let (q, u, b) = (along(q, dq), along(u, du), along(b, db));
        let lambda = Dual { value: lambda, slope: dlambda };
        gradient_slopes::<Self, T>(&self.mode_gradient(&q, &u, &b, &along(phi, dphi), lambda))
    }

    /// Directional derivative of [`Mechanism::pencil_gradient`] along (`dq`, `du`, `db`, `dleft`, `dacceleration`,
    /// `dvelocity`, `dposition`).
    fn pencil_gradient_along<T: Real>(
        &self,
        q: &Self::Coordinates<T>,
        u: &Self::Inputs<T>,
        b: &Self::Design<T>,
        left: &Self::Coordinates<T>,
        acceleration: &Self::Coordinates<T>,
        velocity: &Self::Coordinates<T>,
        position: &Self::Coordinates<T>,
        dq: &Self::Coordinates<T>,
        du: &Self::Inputs<T>,
        db: &Self::Design<T>,
        dleft: &Self::Coordinates<T>,
        dacceleration: &Self::Coordinates<T>,
        dvelocity: &Self::Coordinates<T>,
        dposition: &Self::Coordinates<T>,
    ) -> GradientOf<Self, T> {
        let (q, u, b) = (along(q, dq), along(u, du), along(b, db));
        gradient_slopes::<Self, T>(&self.pencil_gradient(
            &q,
            &u,
            &b,
            &along(left, dleft),
            &along(acceleration, dacceleration),
            &along(velocity, dvelocity),
            &along(position, dposition),
        ))
    }

    /// Directional derivative of [`Mechanism::residual_gradient`] along (`dq`, `du`, `db`, `dw`).
    fn residual_gradient_along<T: Real>(
        &self,
        q: &Self::Coordinates<T>,
        u: &Self::Inputs<T>,
        b: &Self::Design<T>,
        w: &Self::Coordinates<T>,
        dq: &Self::Coordinates<T>,
        du: &Self::Inputs<T>,
        db: &Self::Design<T>,
        dw: &Self::Coordinates<T>,
    ) -> GradientOf<Self, T> {
        let (q, u, b) = (along(q, dq), along(u, du), along(b, db));
        gradient_slopes::<Self, T>(&self.residual_gradient(&q, &u, &b, &along(w, dw)))
    }

    /// How the vibration `q* + Re((real + i imaginary) e^{i w t})`, `w > 0`, moves the bodies that spin.
    ///
    /// Returns `[moment, lateral, torsional, axial, eccentric, moving, still]`. All are zero if nothing rotates, and
    /// exactly so for a mechanism in which no massive body is driven to rotate.
    ///
    /// They are sums over the bodies, with `omega` the angular velocity in the state of rest, `r` and `s` the
    /// displacements along `real` and `imaginary` of the point of the body on its axis of rotation, `theta` its small
    /// rotation, `m` the mass, `a` the arm from the axis to the centre of mass and `J` the moment of inertia about
    /// `omega` through it:
    ///
    /// - `moment = -sum |omega| omega . m (r x s)`,
    /// - `lateral = sum m (|omega x r|^2 + |omega x s|^2) / 2`,
    /// - `torsional = sum (J + m a^2) (omega . theta)^2 / 2` along `real` and `imaginary`,
    /// - `axial = sum m ((omega . r)^2 + (omega . s)^2) / 2`,
    /// - `eccentric = |sum e a|^2 / (sum e sum e (a^2 + J / m))`, between 0 and 1, `e` the share of a body in the three
    ///   sums above: near one if what moves is a body beside its axis, such as a blade,
    /// - `moving = sum e / |omega|^2`, and `still` that sum over the bodies that do not rotate,
    ///
    /// plus in `moment`, `lateral` and `still` the same sums for the small rotations, with `integral |rho|^2 dm` about
    /// the centre of mass in place of `m`: kg m^2 rad^2/s^2 for displacements in metres and radians.
    ///
    /// `moment / lateral` is one if every orbit is a circle in the direction of the spin (forward whirl), minus one if
    /// every orbit is a circle against it (backward whirl), and zero on straight lines. A joint beyond a drive is seen
    /// from the rotating side: coordinates of a rotating shaft give the direction of an orbit relative to the shaft.
    ///
    /// Only the values are meaningful, not derivatives: `|omega|` is a root, whose derivative fails at zero speed.
    fn whirl<T: Real>(
        &self,
        _q: &Self::Coordinates<T>,
        _u: &Self::Inputs<T>,
        _b: &Self::Design<T>,
        _real: &Self::Coordinates<T>,
        _imaginary: &Self::Coordinates<T>,
    ) -> [T; 7] {
        zeros()
    }

    /// Positions of the bodies, and the geometry of bodies, joints and points: the numbers at the positions
    /// [`PictureInfo::computed`] of [`Mechanism::PICTURE`], SI.
    fn picture<T: Real>(
        &self,
        _q: &Self::Coordinates<T>,
        _u: &Self::Inputs<T>,
        _b: &Self::Design<T>,
    ) -> Self::Picture<T> {
        zeros()
    }

    /// The first physical requirement that the inputs and design variables violate: a mass or a length that is not
    /// positive, or an inertia that no body can have. NaN violates every requirement.
    fn violation<T: Real + PartialOrd>(&self, u: &Self::Inputs<T>, b: &Self::Design<T>) -> Option<Violation<T>>;

    /// The joint of three turns or the beam closest to its singular pose; `None` if there is none. The generated equations
    /// stay finite in that pose, but two coordinates have the same effect, and the mass matrix becomes singular.
    fn pose_margin<T: Real + PartialOrd>(
        &self,
        _q: &Self::Coordinates<T>,
        _u: &Self::Inputs<T>,
        _b: &Self::Design<T>,
    ) -> Option<PoseMargin<T>> {
        None
    }

    /// The values that select one of a family of steady motions, of the unknowns at the positions [`Description::held`],
    /// followed by the speeds at which the rings turn about their axes, [`Description::rings`], in `values`.
    fn held_values<T: Real>(&self, _u: &Self::Inputs<T>, _b: &Self::Design<T>, _values: &mut [T]) {}

    /// For each span of [`Description::spans`] the speed of its material, rad/s, then for each of its sections eight numbers,
    /// SI: length; stiffness against bending, twist or stretch, and against shear; mass, or inertia about the axis, and
    /// inertia about a diameter, of a length; time by which the material lags; tension; drag of a length.
    fn spans<T: Real>(&self, _u: &Self::Inputs<T>, _b: &Self::Design<T>, _numbers: &mut [T]) {}

    /// The declared outputs.
    fn outputs<T: Real>(&self, q: &Self::Coordinates<T>, u: &Self::Inputs<T>, b: &Self::Design<T>) -> Self::Outputs<T>;

    /// Explicit partial derivatives of the outputs with respect to every coordinate, input and design variable.
    fn output_partials<T: Real>(
        &self,
        q: &Self::Coordinates<T>,
        u: &Self::Inputs<T>,
        b: &Self::Design<T>,
    ) -> (Self::Outputs<Self::Coordinates<T>>, Self::Outputs<Self::Inputs<T>>, Self::Outputs<Self::Design<T>>);

    /// Directional derivative of [`Mechanism::output_partials`] along (`dq`, `du`, `db`).
    fn output_partials_along<T: Real>(
        &self,
        q: &Self::Coordinates<T>,
        u: &Self::Inputs<T>,
        b: &Self::Design<T>,
        dq: &Self::Coordinates<T>,
        du: &Self::Inputs<T>,
        db: &Self::Design<T>,
    ) -> (Self::Outputs<Self::Coordinates<T>>, Self::Outputs<Self::Inputs<T>>, Self::Outputs<Self::Design<T>>) {
        let (q, u, b) = (along(q, dq), along(u, du), along(b, db));
        let matrices = self.output_partials::<Dual<T>>(&q, &u, &b);
        (
            Array::from_fn(|o| slopes(&matrices.0.as_ref()[o])),
            Array::from_fn(|o| slopes(&matrices.1.as_ref()[o])),
            Array::from_fn(|o| slopes(&matrices.2.as_ref()[o])),
        )
    }

    /// The harmonic forces of every excitation about a state of rest, their frequencies, and what they add to the outputs
    /// directly. Zero, like the next two, without excitations.
    fn forcing<T: Real>(
        &self,
        _q: &Self::Coordinates<T>,
        _u: &Self::Inputs<T>,
        _b: &Self::Design<T>,
    ) -> ForcingOf<Self, T> {
        Forcing {
            cosine: Array::filled(zeros()),
            frequency: zeros(),
            direct_cosine: Array::filled(zeros()),
            sine: Array::filled(zeros()),
            direct_sine: Array::filled(zeros()),
        }
    }

    /// Derivatives of the outputs, as functions of any motion, by acceleration, velocity and position, at rest.
    fn output_motion<T: Real>(
        &self,
        _q: &Self::Coordinates<T>,
        _u: &Self::Inputs<T>,
        _b: &Self::Design<T>,
    ) -> OutputMotionOf<Self, T> {
        let none = Array::filled(zeros());
        (none, none, none)
    }

    /// Gradient of all that a vibration forced by excitations depends on, apart from the matrices, with the arguments
    /// after `b` held fixed, by reverse differentiation. With `output` weights on the outputs `o` and `share` weights on
    /// the excitations `k`, it is the gradient of
    ///
    /// ```text
    /// output . (o_qddot acceleration + o_qdot velocity + o_q position)
    ///     + sum_k share_k (cosine . C_k + sine . S_k + direct_cosine . c_k + direct_sine . s_k) + frequency . w
    /// ```
    ///
    /// where `C`, `S`, `c`, `s`, `w` are the fields of [`Mechanism::forcing`] and the factors have their names.
    fn forced_gradient<T: Real>(
        &self,
        _q: &Self::Coordinates<T>,
        _u: &Self::Inputs<T>,
        _b: &Self::Design<T>,
        _output: &Self::Outputs<T>,
        _acceleration: &Self::Coordinates<T>,
        _velocity: &Self::Coordinates<T>,
        _position: &Self::Coordinates<T>,
        _share: &Self::Excitations<T>,
        _cosine: &Self::Coordinates<T>,
        _sine: &Self::Coordinates<T>,
        _direct_cosine: &Self::Outputs<T>,
        _direct_sine: &Self::Outputs<T>,
        _frequency: &Self::Excitations<T>,
    ) -> GradientOf<Self, T> {
        Gradient { coordinates: zeros(), inputs: zeros(), design: zeros() }
    }

    /// Directional derivative of [`Mechanism::forcing`] along (`dq`, `du`, `db`).
    fn forcing_along<T: Real>(
        &self,
        q: &Self::Coordinates<T>,
        u: &Self::Inputs<T>,
        b: &Self::Design<T>,
        dq: &Self::Coordinates<T>,
        du: &Self::Inputs<T>,
        db: &Self::Design<T>,
    ) -> ForcingOf<Self, T> {
        let (q, u, b) = (along(q, dq), along(u, du), along(b, db));
        let forcing: ForcingOf<Self, Dual<T>> = self.forcing(&q, &u, &b);
        Forcing {
            cosine: Array::from_fn(|k| slopes(&forcing.cosine.as_ref()[k])),
            frequency: slopes(&forcing.frequency),
            direct_cosine: Array::from_fn(|k| slopes(&forcing.direct_cosine.as_ref()[k])),
            sine: Array::from_fn(|k| slopes(&forcing.sine.as_ref()[k])),
            direct_sine: Array::from_fn(|k| slopes(&forcing.direct_sine.as_ref()[k])),
        }
    }

    /// Directional derivative of [`Mechanism::output_motion`] along (`dq`, `du`, `db`).
    fn output_motion_along<T: Real>(
        &self,
        q: &Self::Coordinates<T>,
        u: &Self::Inputs<T>,
        b: &Self::Design<T>,
        dq: &Self::Coordinates<T>,
        du: &Self::Inputs<T>,
        db: &Self::Design<T>,
    ) -> OutputMotionOf<Self, T> {
        let (q, u, b) = (along(q, dq), along(u, du), along(b, db));
        let motion: OutputMotionOf<Self, Dual<T>> = self.output_motion(&q, &u, &b);
        (
            Array::from_fn(|o| slopes(&motion.0.as_ref()[o])),
            Array::from_fn(|o| slopes(&motion.1.as_ref()[o])),
            Array::from_fn(|o| slopes(&motion.2.as_ref()[o])),
        )
    }

    inlined! {
        /// [`Mechanism::residual_and_stiffness`], inlined at the call site (like the others below), as vector instructions
        /// require. Generated code overrides it.
        residual_and_stiffness_inlined: residual_and_stiffness() -> (Self::Coordinates<T>, Square<Self, T>);
        residual_parts_inlined: residual_parts() -> RestParts<Self::Coordinates<T>>;
        linear_inlined: linear() -> Linear<Square<Self, T>>;
        residual_inlined: residual() -> Self::Coordinates<T>;
        motion_residual_inlined: motion_residual(&acceleration &velocity) -> Self::Coordinates<T>;
        motion_inlined: motion(&velocity) -> (Square<Self, T>, Self::Coordinates<T>);
        motion_linear_inlined: motion_linear(&acceleration &velocity) -> Linear<Square<Self, T>>;
        residual_partials_inlined: residual_partials() -> ResidualPartialsOf<Self, T>;
        linear_partials_inlined: linear_partials() -> PartialsOf<Self, T>;
        linear_partials_into_inlined: linear_partials_into(result: &mut PartialsOf<Self, T>) -> ();
        mode_gradient_inlined: mode_gradient(phi: &Self::Coordinates<T>, lambda: T) -> GradientOf<Self, T>;
        residual_gradient_inlined: residual_gradient(w: &Self::Coordinates<T>) -> GradientOf<Self, T>;
        pencil_gradient_inlined: pencil_gradient(
            left: &Self::Coordinates<T>,
            acceleration: &Self::Coordinates<T>,
            velocity: &Self::Coordinates<T>,
            position: &Self::Coordinates<T>
        ) -> GradientOf<Self, T>;
        forced_gradient_inlined: forced_gradient(
            output: &Self::Outputs<T>,
            acceleration: &Self::Coordinates<T>,
            velocity: &Self::Coordinates<T>,
            position: &Self::Coordinates<T>,
            share: &Self::Excitations<T>,
            cosine: &Self::Coordinates<T>,
            sine: &Self::Coordinates<T>,
            direct_cosine: &Self::Outputs<T>,
            direct_sine: &Self::Outputs<T>,
            frequency: &Self::Excitations<T>
        ) -> GradientOf<Self, T>;
    }
}

/// Number of entries of one matrix's derivatives up to which computing all partials in one function pays: more do not
/// stay in registers.
const FEW_PARTIALS: usize = 256;

/// Whether computing all partials in one function pays.
#[doc(hidden)]
pub const fn few_partials<M: Mechanism>() -> bool {
    let n = M::Coordinates::<f64>::LEN;
    let variables = M::Inputs::<f64>::LEN + M::Design::<f64>::LEN;
    n * n * (n + variables) <= FEW_PARTIALS
}

#[inline(always)]
fn zeros<T: Real, A: Array<T>>() -> A {
    A::filled(T::constant(0.0))
}

fn unit<T: Real, A: Array<T>>(k: usize) -> A {
    let mut unit: A = zeros();
    unit.as_mut()[k] = T::constant(1.0);
    unit
}

/// Values that are constant.
fn fixed<T: Real, D: Array<Dual<T>>>(values: &impl Array<T>) -> D {
    D::from_fn(|k| Dual::fixed(values.as_ref()[k]))
}

/// Values that change along a direction.
fn along<T: Real, A: Array<T>, D: Array<Dual<T>>>(values: &A, direction: &A) -> D {
    let mut duals = D::filled(Dual::fixed(T::constant(0.0)));
    for ((dual, value), slope) in duals.as_mut().iter_mut().zip(values.as_ref()).zip(direction.as_ref()) {
        (dual.value, dual.slope) = (*value, *slope);
    }
    duals
}

fn values<T: Real, A: Array<T>>(duals: &impl Array<Dual<T>>) -> A {
    let mut values = A::filled(T::constant(0.0));
    for (value, dual) in values.as_mut().iter_mut().zip(duals.as_ref()) {
        *value = dual.value;
    }
    values
}

fn slopes<T: Real, A: Array<T>>(duals: &impl Array<Dual<T>>) -> A {
    let mut slopes = A::filled(T::constant(0.0));
    for (slope, dual) in slopes.as_mut().iter_mut().zip(duals.as_ref()) {
        *slope = dual.slope;
    }
    slopes
}

fn gradient_slopes<M: Mechanism, T: Real>(gradient: &GradientOf<M, Dual<T>>) -> GradientOf<M, T> {
    Gradient {
        coordinates: slopes(&gradient.coordinates),
        inputs: slopes(&gradient.inputs),
        design: slopes(&gradient.design),
    }
}

fn transposed<M: Mechanism, T: Real>(columns: &Square<M, T>) -> Square<M, T> {
    let rows = columns.as_ref();
    Array::from_fn(|i| Array::from_fn(|j| rows[j].as_ref()[i]))
}
