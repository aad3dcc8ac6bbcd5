//! The contract between compile time and run time: what generated code provides.

mod description;
mod results;

pub use description::{
    Coordinate, CoordinateInfo, DampingKind, Description, DesignInfo, DesignVariable, Input,
    InputInfo, KernelInfo, Output, OutputInfo, Role, Unit,
};
pub use results::{Gradient, Linear, LinearPartials, PoseMargin, RestParts, Violation};

use core::array::from_fn;

use crate::Real;
use crate::dual::Dual;

/// A compiled mechanism with `N` free coordinates, `U` inputs, `P` design variables and `O` outputs.
///
/// Implemented by `mechanism!`. Every method is a straight line of arithmetic over plain arrays: no allocation, no
/// branch, no panic. All quantities are SI, angles in radians. Arguments everywhere:
///
/// - `q`: free coordinates, `u`: inputs, `b`: design variables, in the order of [`Mechanism::DESCRIPTION`];
/// - matrices are `[[T; N]; N]`, `matrix[i][j]` the derivative of residual `i` by coordinate `j`;
/// - the residual is `g(qddot, qdot, q; u, b) = M* qddot + h` (eq. 12): equal to zero along a motion, positive
///   when inertia exceeds the applied forces.
///
/// A method never fails: outside its domain (a negative length under a root, NaN in) it returns NaN or infinity, which
/// the solvers of this crate turn into typed errors.
pub trait Mechanism<const N: usize, const U: usize, const P: usize, const O: usize>:
    Clone + Sync
{
    /// Names, units, nominal values and what the compiler proved.
    const DESCRIPTION: Description;

    /// Residual at rest, `g(0, 0, q; u, b)` (eq. 10): zero at a dynamic equilibrium.
    fn residual<T: Real>(&self, q: &[T; N], u: &[T; U], b: &[T; P]) -> [T; N];

    /// The residual at rest split into inertia and applied forces: `g = inertia - applied` (eq. 10).
    fn residual_parts<T: Real>(&self, q: &[T; N], u: &[T; U], b: &[T; P]) -> RestParts<T, N>;

    /// The full nonlinear equations of motion, `g(qddot, qdot, q; u, b)` (eq. 12).
    fn motion_residual<T: Real>(
        &self,
        acceleration: &[T; N],
        velocity: &[T; N],
        q: &[T; N],
        u: &[T; U],
        b: &[T; P],
    ) -> [T; N];

    /// Generalised mass matrix `M*(q; b)` (eq. 8) and right-hand side `Q* = -h(q, qdot, u; b)` (eq. 9).
    fn motion<T: Real>(
        &self,
        velocity: &[T; N],
        q: &[T; N],
        u: &[T; U],
        b: &[T; P],
    ) -> ([[T; N]; N], [T; N]);

    /// The equations of motion linearised along any motion: `dg/dqddot = M*` (`mass`), `dg/dqdot` (`damping`) and `dg/dq`
    /// (`stiffness`), what implicit integration and inverse dynamics with derivatives need. Without velocity and
    /// acceleration they are [`Mechanism::linear`].
    ///
    /// Generated up to some 50,000 operations; of a larger mechanism each column is differentiated by itself, as here.
    fn motion_linear<T: Real>(
        &self,
        acceleration: &[T; N],
        velocity: &[T; N],
        q: &[T; N],
        u: &[T; U],
        b: &[T; P],
    ) -> Linear<T, N> {
        let fixed = |x: &[T; N]| x.map(Dual::fixed);
        let still = (fixed(acceleration), u.map(Dual::fixed), b.map(Dual::fixed));
        let column = |list: usize, k: usize| {
            let mut arguments = [fixed(velocity), fixed(q)];
            arguments[list][k].slope = T::constant(1.0);
            let [velocity, q] = &arguments;
            let (acceleration, u, b) = &still;
            self.motion_residual(acceleration, velocity, q, u, b)
                .map(|entry| entry.slope)
        };
        let matrix = |list: usize| {
            let columns: [[T; N]; N] = from_fn(|j| column(list, j));
            from_fn(|i| from_fn(|j| columns[j][i]))
        };
        Linear {
            mass: self.motion(velocity, q, u, b).0,
            damping: matrix(0),
            stiffness: matrix(1),
        }
    }

    /// Residual at rest and its Jacobian `Khat`: what a Newton step needs.
    fn residual_and_stiffness<T: Real>(
        &self,
        q: &[T; N],
        u: &[T; U],
        b: &[T; P],
    ) -> ([T; N], [[T; N]; N]);

    /// `Mhat`, `Chat` and `Khat` (eqs. 15-17).
    fn linear<T: Real>(&self, q: &[T; N], u: &[T; U], b: &[T; P]) -> Linear<T, N>;

    /// Explicit partial derivatives of the residual at rest by every input and design variable.
    fn residual_partials<T: Real>(
        &self,
        q: &[T; N],
        u: &[T; U],
        b: &[T; P],
    ) -> ([[T; U]; N], [[T; P]; N]);

    /// Explicit partial derivatives of `Mhat`, `Chat` and `Khat` by every coordinate, input and design variable.
    ///
    /// Generated for small mechanisms; a large one takes them one direction at a time, as here, because straight-line
    /// code for all of them grows with the cube of its size.
    fn linear_partials<T: Real>(
        &self,
        q: &[T; N],
        u: &[T; U],
        b: &[T; P],
    ) -> LinearPartials<T, N, U, P> {
        let (dq, du, db) = (zeros(), zeros(), zeros());
        LinearPartials {
            by_coordinate: from_fn(|k| self.linear_along(q, u, b, &unit(k), &du, &db)),
            by_input: from_fn(|k| self.linear_along(q, u, b, &dq, &unit(k), &db)),
            by_design: from_fn(|k| self.linear_along(q, u, b, &dq, &du, &unit(k))),
        }
    }

    /// [`Mechanism::linear_partials`] into a result that is there: sets every entry that can differ from zero and leaves the others
    /// as they are. Start from zeros ([`LinearPartials::default`]) and pass the same result on, always of the same mechanism:
    /// of thousands of entries a fifth of the time is setting them to zero.
    fn linear_partials_into<T: Real>(
        &self,
        q: &[T; N],
        u: &[T; U],
        b: &[T; P],
        result: &mut LinearPartials<T, N, U, P>,
    ) {
        *result = self.linear_partials(q, u, b);
    }

    /// [`Mechanism::linear_partials`] and [`Mechanism::residual_partials`] in one: of a small mechanism with the sines, and what
    /// else both need, computed once; a large one is asked for them one after the other.
    #[inline]
    #[allow(clippy::type_complexity)]
    fn partials<T: Real>(
        &self,
        q: &[T; N],
        u: &[T; U],
        b: &[T; P],
    ) -> (LinearPartials<T, N, U, P>, ([[T; U]; N], [[T; P]; N])) {
        if const { N * N * (N + U + P) <= FEW_PARTIALS } {
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

    /// Directional derivatives of `Mhat`, `Chat` and `Khat` along (`dq`, `du`, `db`). Like the other kernels along a direction
    /// not generated: [`Mechanism::linear`] in dual numbers.
    fn linear_along<T: Real>(
        &self,
        q: &[T; N],
        u: &[T; U],
        b: &[T; P],
        dq: &[T; N],
        du: &[T; U],
        db: &[T; P],
    ) -> Linear<T, N> {
        let (q, u, b) = (Dual::along(q, dq), Dual::along(u, du), Dual::along(b, db));
        self.linear(&q, &u, &b).slopes()
    }

    /// Gradient of `a(q, u, b) = phi^T (Khat - lambda Mhat) phi`, `phi` and `lambda` held fixed, by reverse
    /// differentiation: all coordinates, inputs and design variables at the cost of a few residuals.
    fn mode_gradient<T: Real>(
        &self,
        q: &[T; N],
        u: &[T; U],
        b: &[T; P],
        phi: &[T; N],
        lambda: T,
    ) -> Gradient<T, N, U, P>;

    /// Gradient of `left^T (Mhat acceleration + Chat velocity + Khat position)`, the four vectors held fixed, by reverse
    /// differentiation: all coordinates, inputs and design variables at the cost of a few residuals.
    ///
    /// `psi^T (s^2 Mhat + s Chat + Khat) phi` of a damped mode, `s`, `psi` and `phi` complex, is linear in `left` and in
    /// the other three together: its gradient takes four calls, real and imaginary part of `psi` against those of
    /// (`s^2 phi`, `s phi`, `phi`). [`Mechanism::mode_gradient`] is the case `left` = `position` = `phi`, `acceleration`
    /// = `-lambda phi`, `velocity` = 0.
    #[allow(clippy::too_many_arguments)]
    fn pencil_gradient<T: Real>(
        &self,
        q: &[T; N],
        u: &[T; U],
        b: &[T; P],
        left: &[T; N],
        acceleration: &[T; N],
        velocity: &[T; N],
        position: &[T; N],
    ) -> Gradient<T, N, U, P>;

    /// Gradient of `w^T g(0, 0, q; u, b)` with `w` held fixed.
    fn residual_gradient<T: Real>(
        &self,
        q: &[T; N],
        u: &[T; U],
        b: &[T; P],
        w: &[T; N],
    ) -> Gradient<T, N, U, P>;

    /// Directional derivative of [`Mechanism::mode_gradient`] along (`dq`, `du`, `db`, `dphi`, `dlambda`).
    #[allow(clippy::too_many_arguments)]
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
        let (q, u, b) = (Dual::along(q, dq), Dual::along(u, du), Dual::along(b, db));
        let [lambda] = Dual::along(&[lambda], &[dlambda]);
        self.mode_gradient(&q, &u, &b, &Dual::along(phi, dphi), lambda)
            .slopes()
    }

    /// Directional derivative of [`Mechanism::pencil_gradient`] along (`dq`, `du`, `db`, `dleft`, `dacceleration`,
    /// `dvelocity`, `dposition`).
    #[allow(clippy::too_many_arguments)]
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
        let (q, u, b) = (Dual::along(q, dq), Dual::along(u, du), Dual::along(b, db));
        self.pencil_gradient(
            &q,
            &u,
            &b,
            &Dual::along(left, dleft),
            &Dual::along(acceleration, dacceleration),
            &Dual::along(velocity, dvelocity),
            &Dual::along(position, dposition),
        )
        .slopes()
    }

    /// Directional derivative of [`Mechanism::residual_gradient`] along (`dq`, `du`, `db`, `dw`).
    #[allow(clippy::too_many_arguments)]
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
        let (q, u, b) = (Dual::along(q, dq), Dual::along(u, du), Dual::along(b, db));
        self.residual_gradient(&q, &u, &b, &Dual::along(w, dw))
            .slopes()
    }

    /// Whether the vibration `q* + Re((real + i imaginary) e^{i w t})`, `w > 0`, circles in the sense in which the bodies
    /// spin: `[moment, size]`, `-size <= moment <= size` up to rounding.
    ///
    /// `moment / size` is one where every orbit is a circle in the sense of the spin (forward whirl), minus one where it is
    /// a circle against it (backward whirl), zero on straight lines. Both are zero where nothing turns, or where nothing
    /// that turns moves across its axis; so are they, exactly, for a mechanism in which no massive body is driven to turn.
    ///
    /// Sums over the bodies, `omega` the angular velocity in the state of rest, `r` and `s` the displacements of the centre
    /// of mass along `real` and `imaginary`, `m` the mass:
    ///
    /// - `moment = -sum |omega| omega . m (r x s)`,
    /// - `size = sum m (|omega x r|^2 + |omega x s|^2) / 2`,
    ///
    /// and the same of the small rotations with `integral |rho|^2 dm` about the centre of mass for `m`: kg m^2 rad^2/s^2
    /// for displacements in metres and radians. A joint beyond a drive is seen from the turning side: coordinates of a
    /// turning shaft tell the sense in which an orbit runs against the shaft.
    ///
    /// Meant for values, not to be differentiated: `|omega|` is a root, whose derivative fails at zero speed.
    fn whirl<T: Real>(
        &self,
        _q: &[T; N],
        _u: &[T; U],
        _b: &[T; P],
        _real: &[T; N],
        _imaginary: &[T; N],
    ) -> [T; 2] {
        zeros()
    }

    /// The first physical requirement that the inputs and design variables break: a mass or a length that is not
    /// positive, an inertia that no body can have. NaN breaks every requirement.
    fn violation<T: Real + PartialOrd>(&self, u: &[T; U], b: &[T; P]) -> Option<Violation<T>>;

    /// The joint of three turns that is nearest to its singular pose; `None` without such a joint. The generated equations
    /// stay finite there, but two coordinates do the same, and the mass matrix becomes singular.
    fn pose_margin<T: Real + PartialOrd>(
        &self,
        _q: &[T; N],
        _u: &[T; U],
        _b: &[T; P],
    ) -> Option<PoseMargin<T>> {
        None
    }

    /// The declared outputs.
    fn outputs<T: Real>(&self, q: &[T; N], u: &[T; U], b: &[T; P]) -> [T; O];

    /// Explicit partial derivatives of the outputs by every coordinate, input and design variable.
    #[allow(clippy::type_complexity)]
    fn output_partials<T: Real>(
        &self,
        q: &[T; N],
        u: &[T; U],
        b: &[T; P],
    ) -> ([[T; N]; O], [[T; U]; O], [[T; P]; O]);

    /// [`Mechanism::residual_and_stiffness`], and like the others below written where it is called: what vectors of the
    /// processor need. Generated code overrides it.
    #[doc(hidden)]
    #[inline(always)]
    fn residual_and_stiffness_inlined<T: Real>(
        &self,
        q: &[T; N],
        u: &[T; U],
        b: &[T; P],
    ) -> ([T; N], [[T; N]; N]) {
        self.residual_and_stiffness(q, u, b)
    }

    #[doc(hidden)]
    #[inline(always)]
    fn residual_parts_inlined<T: Real>(
        &self,
        q: &[T; N],
        u: &[T; U],
        b: &[T; P],
    ) -> RestParts<T, N> {
        self.residual_parts(q, u, b)
    }

    #[doc(hidden)]
    #[inline(always)]
    fn linear_inlined<T: Real>(&self, q: &[T; N], u: &[T; U], b: &[T; P]) -> Linear<T, N> {
        self.linear(q, u, b)
    }

    #[doc(hidden)]
    #[inline(always)]
    fn residual_partials_inlined<T: Real>(
        &self,
        q: &[T; N],
        u: &[T; U],
        b: &[T; P],
    ) -> ([[T; U]; N], [[T; P]; N]) {
        self.residual_partials(q, u, b)
    }

    #[doc(hidden)]
    #[inline(always)]
    fn linear_partials_inlined<T: Real>(
        &self,
        q: &[T; N],
        u: &[T; U],
        b: &[T; P],
    ) -> LinearPartials<T, N, U, P> {
        self.linear_partials(q, u, b)
    }

    #[doc(hidden)]
    #[inline(always)]
    fn linear_partials_into_inlined<T: Real>(
        &self,
        q: &[T; N],
        u: &[T; U],
        b: &[T; P],
        result: &mut LinearPartials<T, N, U, P>,
    ) {
        self.linear_partials_into(q, u, b, result);
    }

    #[doc(hidden)]
    #[inline(always)]
    fn mode_gradient_inlined<T: Real>(
        &self,
        q: &[T; N],
        u: &[T; U],
        b: &[T; P],
        phi: &[T; N],
        lambda: T,
    ) -> Gradient<T, N, U, P> {
        self.mode_gradient(q, u, b, phi, lambda)
    }

    #[doc(hidden)]
    #[inline(always)]
    fn residual_gradient_inlined<T: Real>(
        &self,
        q: &[T; N],
        u: &[T; U],
        b: &[T; P],
        w: &[T; N],
    ) -> Gradient<T, N, U, P> {
        self.residual_gradient(q, u, b, w)
    }
}

/// Entries of one matrix's derivatives up to which all partials in one function pay: more do not stay in registers.
const FEW_PARTIALS: usize = 256;

fn zeros<T: Real, const K: usize>() -> [T; K] {
    [T::constant(0.0); K]
}

fn unit<T: Real, const K: usize>(k: usize) -> [T; K] {
    from_fn(|i| T::constant(if i == k { 1.0 } else { 0.0 }))
}
