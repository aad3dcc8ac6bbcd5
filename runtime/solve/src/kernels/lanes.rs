//! Kernels of compiled mechanisms at several states at once, in the processor's vectors.
//!
//! Each kernel is a type, and [`evaluate`] takes any of them: a program compiles those that it names, each once for every
//! width of vector. A [`Batch`] holds one number for each of [`WIDTH`] states. Lists of arguments and results are those of
//! [`Kernel`](super::Kernel) and [`MotionKernel`](super::MotionKernel), with a batch in place of each number, and every
//! result is, bit for bit, what the kernel gives for that state alone.
//!
//! ```
//! use eigentol_contract::Mechanism;
//! use eigentol_contract::scalar::{Batch, Instructions};
//! use eigentol_solve::kernels::lanes::{MotionResidual, evaluate};
//!
//! /// Generalised forces of a motion without inputs and design variables at eight states: N or N m, from rad, rad/s, rad/s^2.
//! fn inverse_dynamics<M: Mechanism>(machine: &M, [a, v, q]: [&[Batch]; 3]) -> Vec<Batch> {
//!     let mut forces = vec![Batch::default(); q.len()];
//!     let instructions = Instructions::best();
//!     evaluate(MotionResidual, machine, instructions, &[a, v, q, &[], &[]], &mut [&mut forces]);
//!     forces
//! }
//! ```

use crate::DampingKind;
use crate::mechanism::{self, Array, Description, GradientOf, Mechanism, PartialsOf, Square};
use crate::scalar::{Batch, Instructions, Lanes, Task, WIDTH};

/// A kernel that vectors evaluate.
pub trait LaneKernel {
    /// Name of the method of [`Mechanism`].
    const NAME: &'static str;

    /// Evaluates the kernel at the states from `at` on.
    #[doc(hidden)]
    fn run<M: Mechanism, V: Lanes>(mechanism: &M, arguments: &[&[Batch]], results: &mut [&mut [Batch]], at: usize);
}

/// Operations up to which rustc compiles a kernel for every width of vector in some twenty seconds, a millisecond each. Without
/// optimisation every intermediate result has 64 bytes of the stack, which more would fill.
const MOST: usize = if cfg!(debug_assertions) { 2_000 } else { 20_000 };

/// Evaluates a kernel of a compiled mechanism at [`WIDTH`] states. One that the compiler did not generate, or with more than
/// some 20,000 operations (without optimisation 2,000), is called state by state.
///
/// # Panics
/// On another number of lists, or lists of other lengths, than the kernel has.
#[inline]
pub fn evaluate<K: LaneKernel, M: Mechanism>(
    _kernel: K,
    mechanism: &M,
    instructions: Instructions,
    arguments: &[&[Batch]],
    results: &mut [&mut [Batch]],
) {
    let task = AtStates { mechanism, arguments, results, _kernel };
    if const { operations::<M>(K::NAME) <= MOST } {
        instructions.run(task);
    } else {
        task.run::<f64>();
    }
}

/// [`evaluate`] state by state.
pub(super) fn one_by_one<K: LaneKernel, M: Mechanism>(
    _kernel: K,
    mechanism: &M,
    arguments: &[&[Batch]],
    results: &mut [&mut [Batch]],
) {
    AtStates { mechanism, arguments, results, _kernel }.run::<f64>();
}

/// Operations of a kernel, without bound if the compiler did not generate it.
pub(super) const fn operations<M: Mechanism>(kernel: &str) -> usize {
    match const { &M::DESCRIPTION }.static_kernel(kernel) {
        Some(kernel) => kernel.operations,
        None => usize::MAX,
    }
}

pub(super) const fn damped(description: &Description) -> bool {
    !matches!(description.damping, DampingKind::Zero)
}

/// A kernel as a task for a set of instructions.
struct AtStates<'a, 'b, M, K> {
    mechanism: &'a M,
    arguments: &'a [&'a [Batch]],
    results: &'a mut [&'b mut [Batch]],
    _kernel: K,
}

impl<M: Mechanism, K: LaneKernel> Task for AtStates<'_, '_, M, K> {
    type Output = ();

    #[inline(always)]
    fn run<V: Lanes>(self) {
        for at in (0..WIDTH).step_by(V::WIDTH) {
            K::run::<M, V>(self.mechanism, self.arguments, self.results, at);
        }
    }
}

#[inline(always)]
fn load<V: Lanes, A: Array<V>>(from: &[Batch], at: usize) -> A {
    // Loops, here and below: an iterator adaptor that is not inlined loses the vector instructions.
    let mut vectors = A::filled(V::constant(0.0));
    let from = &from[..A::LEN];
    for (k, vector) in vectors.as_mut().iter_mut().enumerate() {
        *vector = V::load(&from[k], at);
    }
    vectors
}

#[inline(always)]
fn store<V: Lanes>(from: &impl Array<V>, to: &mut [Batch], at: usize) {
    let from = from.as_ref();
    let to = &mut to[..from.len()];
    for (k, from) in from.iter().enumerate() {
        from.store(&mut to[k], at);
    }
}

/// Stores a matrix row by row.
#[inline(always)]
fn store_rows<V: Lanes, R: Array<V>>(from: &impl Array<R>, to: &mut [Batch], at: usize) {
    let from = from.as_ref();
    let to = &mut to[..R::LEN * from.len()];
    for (i, from) in from.iter().enumerate() {
        store(from, &mut to[R::LEN * i..], at);
    }
}

type Room<'a, 'b> = &'a mut &'b mut [Batch];

#[inline(always)]
fn store_gradient<V: Lanes, M: Mechanism>(from: &GradientOf<M, V>, [dq, du, db]: [Room<'_, '_>; 3], at: usize) {
    store(&from.coordinates, dq, at);
    store(&from.inputs, du, at);
    store(&from.design, db, at);
}

/// Stores matrices one after the other. A damping matrix that is always zero is not read, so the kernel need not write
/// it.
#[inline(always)]
fn store_linears<V: Lanes, M: Mechanism>(
    from: &[mechanism::Linear<Square<M, V>>],
    [mass, damping, stiffness]: [Room<'_, '_>; 3],
    at: usize,
) {
    let size = M::Coordinates::<V>::LEN * M::Coordinates::<V>::LEN;
    for (k, from) in from.iter().enumerate() {
        let first = k * size;
        store_rows(&from.mass, &mut mass[first..], at);
        store_rows(&from.stiffness, &mut stiffness[first..], at);
        if const { damped(const { &M::DESCRIPTION }) } {
            store_rows(&from.damping, &mut damping[first..], at);
        }
    }
}

#[inline(always)]
fn store_partials<V: Lanes, M: Mechanism>(from: &PartialsOf<M, V>, to: [[Room<'_, '_>; 3]; 3], at: usize) {
    let [by_coordinate, by_input, by_design] = to;
    store_linears::<V, M>(from.by_coordinate.as_ref(), by_coordinate, at);
    store_linears::<V, M>(from.by_input.as_ref(), by_input, at);
    store_linears::<V, M>(from.by_design.as_ref(), by_design, at);
}

/// Calls a kernel in its inlined form, which vectors need, or in the form compiled for callers with a single state.
macro_rules! call {
    ($v:ident: $m:ident.$kernel:ident or $inlined:ident $arguments:tt) => {
        if const { $v::WIDTH > 1 } { $m.$inlined::<$v> $arguments } else { $m.$kernel::<$v> $arguments }
    };
}

/// Defines kernels: the lists they take, and how what they return is stored.
macro_rules! kernels {
    ($m:ident: $machine:ident, $v:ident, $at:ident; $(
        $(#[doc = $text:literal])*
        $kernel:ident $name:literal [$($argument:ident),*] -> [$($result:ident),*] $body:block
    )*) => {$(
        $(#[doc = $text])*
        #[derive(Clone, Copy, Debug)]
        pub struct $kernel;

        impl LaneKernel for $kernel {
            const NAME: &'static str = $name;

            #[inline(always)]
            fn run<$machine: Mechanism, $v: Lanes>(
                $m: &$machine,
                arguments: &[&[Batch]],
                results: &mut [&mut [Batch]],
                $at: usize,
            ) {
                let ([$($argument),*], [$($result),*]) = (arguments, results) else {
                    panic!("wrong number of lists");
                };
                $(let $argument = &load($argument, $at);)*
                $body
            }
        }
    )*};
}

kernels! {
    m: M, V, at;
    /// [`Mechanism::residual`].
    Residual "residual" [q, u, b] -> [residual] {
        let x = call!(V: m.residual or residual_inlined(q, u, b));
        store(&x, residual, at);
    }
    /// [`Mechanism::residual_and_stiffness`].
    ResidualAndStiffness "residual_and_stiffness" [q, u, b] -> [residual, stiffness] {
        let x = call!(V: m.residual_and_stiffness or residual_and_stiffness_inlined(q, u, b));
        store(&x.0, residual, at);
        store_rows(&x.1, stiffness, at);
    }
    /// [`Mechanism::linear`]. A damping matrix that is always zero is not written, here and in its derivatives.
    Linear "linear" [q, u, b] -> [mass, damping, stiffness] {
        let x = call!(V: m.linear or linear_inlined(q, u, b));
        store_linears::<V, M>(&[x], [mass, damping, stiffness], at);
    }
    /// [`Mechanism::residual_parts`] and [`Mechanism::linear`].
    PartsAndLinear "linear" [q, u, b] -> [inertia, applied, m0, c0, k0] {
        let x = call!(V: m.residual_parts or residual_parts_inlined(q, u, b));
        store(&x.inertia, inertia, at);
        store(&x.applied, applied, at);
        let x = call!(V: m.linear or linear_inlined(q, u, b));
        store_linears::<V, M>(&[x], [m0, c0, k0], at);
    }
    /// [`Mechanism::residual_partials`].
    ResidualPartials "residual_partials" [q, u, b] -> [g1, g2] {
        let x = call!(V: m.residual_partials or residual_partials_inlined(q, u, b));
        store_rows(&x.0, g1, at);
        store_rows(&x.1, g2, at);
    }
    /// [`Mechanism::linear_partials`]: for all coordinates, then for inputs and design variables, the derivatives of mass,
    /// of damping and of stiffness by one variable after the other. They stand on the stack together, 64 bytes an entry.
    LinearPartials "linear_partials" [q, u, b] -> [m0, c0, k0, m1, c1, k1, m2, c2, k2] {
        let x = call!(V: m.linear_partials or linear_partials_inlined(q, u, b));
        store_partials::<V, M>(&x, [[m0, c0, k0], [m1, c1, k1], [m2, c2, k2]], at);
    }
    /// [`Mechanism::partials`]: the lists of [`LinearPartials`], then those of [`ResidualPartials`].
    Partials "linear_partials" [q, u, b] -> [m0, c0, k0, m1, c1, k1, m2, c2, k2, g1, g2] {
        let x = call!(V: m.linear_partials or linear_partials_inlined(q, u, b));
        store_partials::<V, M>(&x, [[m0, c0, k0], [m1, c1, k1], [m2, c2, k2]], at);
        let x = call!(V: m.residual_partials or residual_partials_inlined(q, u, b));
        store_rows(&x.0, g1, at);
        store_rows(&x.1, g2, at);
    }
    /// [`Mechanism::mode_gradient`].
    ModeGradient "mode_gradient" [q, u, b, phi, lambda] -> [dq, du, db] {
        let [lambda] = *lambda;
        let x = call!(V: m.mode_gradient or mode_gradient_inlined(q, u, b, phi, lambda));
        store_gradient::<V, M>(&x, [dq, du, db], at);
    }
    /// [`Mechanism::residual_gradient`].
    ResidualGradient "residual_gradient" [q, u, b, w] -> [dq, du, db] {
        let x = call!(V: m.residual_gradient or residual_gradient_inlined(q, u, b, w));
        store_gradient::<V, M>(&x, [dq, du, db], at);
    }
    /// [`Mechanism::pencil_gradient`].
    PencilGradient "pencil_gradient" [q, u, b, w, a, v, y] -> [dq, du, db] {
        let x = call!(V: m.pencil_gradient or pencil_gradient_inlined(q, u, b, w, a, v, y));
        store_gradient::<V, M>(&x, [dq, du, db], at);
    }
    /// [`Mechanism::forced_gradient`].
    ForcedGradient "forced_gradient" [q, u, b, o, a, v, y, share, c, s, dc, ds, w] -> [dq, du, db] {
        let x = call!(V: m.forced_gradient or forced_gradient_inlined(q, u, b, o, a, v, y, share, c, s, dc, ds, w));
        store_gradient::<V, M>(&x, [dq, du, db], at);
    }
    /// [`Mechanism::motion_residual`].
    MotionResidual "motion_residual" [a, v, q, u, b] -> [residual] {
        let x = call!(V: m.motion_residual or motion_residual_inlined(a, v, q, u, b));
        store(&x, residual, at);
    }
    /// [`Mechanism::motion`].
    Motion "motion" [v, q, u, b] -> [mass, right] {
        let x = call!(V: m.motion or motion_inlined(v, q, u, b));
        store_rows(&x.0, mass, at);
        store(&x.1, right, at);
    }
    /// [`Mechanism::motion_linear`].
    MotionLinear "motion_linear" [a, v, q, u, b] -> [mass, damping, stiffness] {
        let x = call!(V: m.motion_linear or motion_linear_inlined(a, v, q, u, b));
        store_rows(&x.mass, mass, at);
        store_rows(&x.damping, damping, at);
        store_rows(&x.stiffness, stiffness, at);
    }
}
