//! The contract between compile time and run time: what generated code provides.

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
    /// Generated for small mechanisms; of a large one each column is differentiated by itself, as here.
    fn motion_linear<T: Real>(
        &self,
        acceleration: &[T; N],
        velocity: &[T; N],
        q: &[T; N],
        u: &[T; U],
        b: &[T; P],
    ) -> Linear<T, N> {
        let fixed = |x: &[T; N]| x.map(Dual::fixed);
        let (u, b) = (u.map(Dual::fixed), b.map(Dual::fixed));
        let column = |list: usize, k: usize| {
            let mut arguments = [fixed(acceleration), fixed(velocity), fixed(q)];
            arguments[list][k].slope = T::constant(1.0);
            let [acceleration, velocity, q] = &arguments;
            self.motion_residual(acceleration, velocity, q, &u, &b)
                .map(|entry| entry.slope)
        };
        let matrix = |list: usize| {
            let columns: [[T; N]; N] = from_fn(|j| column(list, j));
            from_fn(|i| from_fn(|j| columns[j][i]))
        };
        Linear {
            mass: matrix(0),
            damping: matrix(1),
            stiffness: matrix(2),
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

    /// Directional derivatives of `Mhat`, `Chat` and `Khat` along (`dq`, `du`, `db`).
    fn linear_along<T: Real>(
        &self,
        q: &[T; N],
        u: &[T; U],
        b: &[T; P],
        dq: &[T; N],
        du: &[T; U],
        db: &[T; P],
    ) -> Linear<T, N>;

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
    ) -> Gradient<T, N, U, P>;

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
    ) -> Gradient<T, N, U, P>;

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
    ) -> Gradient<T, N, U, P>;

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

/// A physical requirement that is not met.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Violation<T> {
    /// What is wrong, for example `mass of bar1`.
    pub quantity: &'static str,
    /// What it has to be, for example `positive`.
    pub requirement: &'static str,
    /// What it is, SI.
    pub value: T,
}

/// How far a joint is from the pose in which its coordinates fail.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PoseMargin<T> {
    /// Name of the joint.
    pub joint: &'static str,
    /// Volume spanned by its three unit axes: one when they are perpendicular, zero in the singular pose.
    pub margin: T,
}

/// The residual at rest in two parts, `g = inertia - applied` (eq. 10).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RestParts<T, const N: usize> {
    /// `B_R^T (M Bdot_D u + gyroscopic terms)`: N or N m by coordinate.
    pub inertia: [T; N],
    /// `B_R^T Q`: gravity, springs and dampers.
    pub applied: [T; N],
}

/// Linearised mass, damping and stiffness (eqs. 15-17), or a derivative of the three.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Linear<T, const N: usize> {
    /// `Mhat`, symmetric.
    pub mass: [[T; N]; N],
    /// `Chat`.
    pub damping: [[T; N]; N],
    /// `Khat`.
    pub stiffness: [[T; N]; N],
}

impl<T: Copy + Default, const N: usize> Default for Linear<T, N> {
    fn default() -> Self {
        let zero = [[T::default(); N]; N];
        Self {
            mass: zero,
            damping: zero,
            stiffness: zero,
        }
    }
}

/// Explicit partial derivatives of the linearised matrices; `by_coordinate[k]` is the derivative by coordinate `k`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinearPartials<T, const N: usize, const U: usize, const P: usize> {
    /// By each free coordinate.
    pub by_coordinate: [Linear<T, N>; N],
    /// By each input.
    pub by_input: [Linear<T, N>; U],
    /// By each design variable.
    pub by_design: [Linear<T, N>; P],
}

impl<T: Copy + Default, const N: usize, const U: usize, const P: usize> Default
    for LinearPartials<T, N, U, P>
{
    fn default() -> Self {
        Self {
            by_coordinate: [Linear::default(); N],
            by_input: [Linear::default(); U],
            by_design: [Linear::default(); P],
        }
    }
}

/// Partial derivatives of one scalar by everything it depends on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gradient<T, const N: usize, const U: usize, const P: usize> {
    /// By each free coordinate.
    pub coordinates: [T; N],
    /// By each input.
    pub inputs: [T; U],
    /// By each design variable.
    pub design: [T; P],
}

impl<T: Copy + Default, const N: usize, const U: usize, const P: usize> Default
    for Gradient<T, N, U, P>
{
    fn default() -> Self {
        Self {
            coordinates: [T::default(); N],
            inputs: [T::default(); U],
            design: [T::default(); P],
        }
    }
}

/// What a mechanism is made of, and what the compiler proved about it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Description {
    /// Name of the declared type.
    pub name: &'static str,
    /// Unknowns, in the order of `q`: the free coordinates and, where there are any, speeds and reactions.
    pub coordinates: &'static [CoordinateInfo],
    /// Inputs, in the order of `u`.
    pub inputs: &'static [InputInfo],
    /// Design variables, in the order of `b`.
    pub design: &'static [DesignInfo],
    /// Outputs, in the order of [`Mechanism::outputs`].
    pub outputs: &'static [OutputInfo],
    /// `Khat` is symmetric for every design, input and position.
    pub symmetric_stiffness: bool,
    /// What `Chat` can be.
    pub damping: DampingKind,
    /// The generated functions and their cost.
    pub kernels: &'static [KernelInfo],
}

/// What the compiler proved about `Chat`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DampingKind {
    /// Zero for every design, input and position.
    Zero,
    /// Skew-symmetric: gyroscopic coupling without dissipation.
    Gyroscopic,
    /// Anything else.
    General,
}

/// A unit of measure: a value in SI is the value in this unit times `scale`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unit {
    /// As declared, for example `mm` or `N*m/rad`; empty for a pure number.
    pub symbol: &'static str,
    /// SI value of one unit.
    pub scale: f64,
}

/// An unknown of the steady motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoordinateInfo {
    /// Declared name; of a reaction the constraint's, with the component where it has several: `pin.x`.
    pub name: &'static str,
    /// Of a coordinate `rad` or `m`, of a speed `rad/s` or `m/s`, of a reaction `N` or `N*m`.
    pub unit: Unit,
    /// What it is.
    pub role: Role,
}

/// What an unknown is, and with it the equation in the same place of the residual.
///
/// The unknowns stand in this order: coordinates, speeds, reactions of constraints on positions, reactions of
/// constraints on velocities. With `q` the coordinates, `v` the speeds, `mu` the reactions the residual is
///
/// ```text
/// g(qddot, vdot, qdot, q, v) + Phi_q^T mu_1 + A_q^T mu_2     by coordinate
/// g_v(qddot, vdot, qdot, q, v) + A_v^T mu_2                  by speed
/// Phi(q)                                                     by constraint on positions
/// A_q(q) qdot + A_v(q) v + a(q)                              by constraint on velocities
/// ```
///
/// In the arguments `velocity` and `acceleration` of [`Mechanism::motion_residual`] the place of a speed `v` holds `vdot`
/// and nothing, that of a reaction nothing; so `Mhat`, `Chat`, `Khat` are the derivatives of the whole by the second, first
/// and no time derivative of all unknowns. Without speeds and constraints on velocities
/// `Khat = [[K_c, Phi_q^T], [Phi_q, 0]]`, `K_c = d(g + Phi_q^T mu)/dq`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// A coordinate that rests in steady motion; the equation is that of its motion.
    Position,
    /// The speed of a coordinate that runs at a constant rate, on which nothing depends; the equation is that of its motion.
    Speed,
    /// The multiplier of a constraint `Phi(q) = 0` on positions, which is the equation.
    PositionReaction,
    /// The multiplier of a constraint on velocities, which is the equation: rolling, or the coupling of running coordinates.
    VelocityReaction,
}

/// An input: an operating parameter chosen at run time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InputInfo {
    /// Declared name.
    pub name: &'static str,
    /// Declared unit; kernels take SI.
    pub unit: Unit,
}

/// A design variable.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DesignInfo {
    /// Declared name.
    pub name: &'static str,
    /// Declared unit; kernels take SI.
    pub unit: Unit,
    /// Nominal value, SI.
    pub nominal: f64,
    /// Half-width of the declared tolerance, SI; zero when none is declared.
    pub tolerance: f64,
}

/// A declared output.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OutputInfo {
    /// Declared name.
    pub name: &'static str,
    /// SI unit of the value.
    pub unit: Unit,
}

/// The cost of one generated function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct KernelInfo {
    /// Method name.
    pub name: &'static str,
    /// Additions, subtractions and multiplications.
    pub operations: usize,
    /// Divisions, roots and elementary functions.
    pub functions: usize,
}

/// Index of a free coordinate of a mechanism.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Coordinate(pub usize);

/// Index of an input of a mechanism.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Input(pub usize);

/// Index of a design variable of a mechanism.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct DesignVariable(pub usize);

/// Index of an output of a mechanism.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Output(pub usize);
