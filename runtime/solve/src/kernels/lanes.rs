//! Kernels of compiled mechanisms at several states at once, in the processor's vectors.
//!
//! Each kernel is a type, and [`evaluate`] takes any of them: a program compiles those that it names, each once for every
//! width of vector. A [`Batch`] holds one number for each of [`WIDTH`] states. Lists of arguments and results are those of
//! [`Kernel`](super::Kernel) and [`MotionKernel`](super::MotionKernel), with a batch in place of each number, and every
//! result is, bit for bit, what the kernel gives for that state alone.
//!
//! ```
//! use eigentol_solve::kernels::lanes::{MotionResidual, evaluate};
//! use eigentol_solve::mechanism::Mechanism;
//! use eigentol_solve::scalar::{Batch, Instructions};
//!
//! /// Generalised forces of a motion without inputs and design variables at eight states: N or N m, from rad, rad/s, rad/s^2.
//! fn inverse_dynamics<M: Mechanism>(machine: &M, [a, v, q]: [&[Batch]; 3]) -> Vec<Batch> {
//!     let mut forces = vec![Batch::default(); q.len()];
//!     let instructions = Instructions::best();
//!     evaluate(MotionResidual, machine, instructions, &[a, v, q, &[], &[]], &mut [&mut forces]);
//!     forces
//! }
//! ```

use core::marker::PhantomData;

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

/// Operations up to which rustc compiles a kernel for every width of vector in some twenty seconds, a millisecond each.
const MOST: usize = 20_000;

/// Evaluates a kernel of a compiled mechanism at [`WIDTH`] states. One that the compiler did not generate, or with more than
/// some 20,000 operations, is called state by state.
///
/// # Panics
/// On another number of lists, or lists of other lengths, than the kernel has.
#[inline]
pub fn evaluate<K: LaneKernel, M: Mechanism>(
    _: K,
    mechanism: &M,
    instructions: Instructions,
    arguments: &[&[Batch]],
    results: &mut [&mut [Batch]],
) {
    let task = AtStates { mechanism, arguments, results, kernel: PhantomData::<K> };
    if const { operations::<M>(K::NAME) <= MOST } {
        instructions.run(task);
    } else {
        task.run::<f64>();
    }
}

/// [`evaluate`] state by state.
pub(super) fn one_by_one<K: LaneKernel, M: Mechanism>(
    _: K,
    mechanism: &M,
    arguments: &[&[Batch]],
    results: &mut [&mut [Batch]],
) {
    AtStates { mechanism, arguments, results, kernel: PhantomData::<K> }.run::<f64>();
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
    kernel: PhantomData<K>,
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
fn store<V: Lanes>(from: &[V], to: &mut [Batch], at: usize) {
    let to = &mut to[..from.len()];
    for (k, from) in from.iter().enumerate() {
        from.store(&mut to[k], at);
    }
}

/// Stores a matrix row by row.
#[inline(always)]
fn store_rows<V: Lanes, R: Array<V>>(from: &[R], to: &mut [Batch], at: usize) {
    let to = &mut to[..R::LEN * from.len()];
    for (i, from) in from.iter().enumerate() {
        store(from.as_ref(), &mut to[R::LEN * i..], at);
    }
}

type Room<'a, 'b> = &'a mut &'b mut [Batch];

#[inline(always)]
fn store_gradient<V: Lanes, M: Mechanism>(
    from: &GradientOf<M, V>,
    [coordinates, inputs, design]: [Room<'_, '_>; 3],
    at: usize,
) {
    store(from.coordinates.as_ref(), coordinates, at);
    store(from.inputs.as_ref(), inputs, at);
    store(from.design.as_ref(), design, at);
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
        store_rows(from.mass.as_ref(), &mut mass[first..], at);
        store_rows(from.stiffness.as_ref(), &mut stiffness[first..], at);
        if const { damped(const { &M::DESCRIPTION }) } {
            store_rows(from.damping.as_ref(), &mut damping[first..], at);
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
    ($(
        $(#[doc = $text:literal])*
        $kernel:ident $name:literal [$($argument:ident),*] -> [$($result:ident),*] in ($m:ident, $machine:ident, $at:ident, $v:ident) => $body:block
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
                    panic!("a kernel takes and returns a fixed number of lists");
                };
                $(let $argument = &load($argument, $at);)*
                $body
            }
        }
    )*};
}

kernels! {
    /// [`Mechanism::residual`].
    Residual "residual" [q, u, b] -> [residual] in (m, M, at, V) => {
        let found = call!(V: m.residual or residual_inlined(q, u, b));
        store(found.as_ref(), residual, at);
    }
    /// [`Mechanism::residual_and_stiffness`].
    ResidualAndStiffness "residual_and_stiffness" [q, u, b] -> [residual, stiffness] in (m, M, at, V) => {
        let found = call!(V: m.residual_and_stiffness or residual_and_stiffness_inlined(q, u, b));
        store(found.0.as_ref(), residual, at);
        store_rows(found.1.as_ref(), stiffness, at);
    }
    /// [`Mechanism::linear`]. A damping matrix that is always zero is not written, here and in its derivatives.
    Linear "linear" [q, u, b] -> [mass, damping, stiffness] in (m, M, at, V) => {
        let found = call!(V: m.linear or linear_inlined(q, u, b));
        store_linears::<V, M>(&[found], [mass, damping, stiffness], at);
    }
    /// [`Mechanism::residual_parts`] and [`Mechanism::linear`].
    PartsAndLinear "linear" [q, u, b] -> [inertia, applied, mass, damping, stiffness] in (m, M, at, V) => {
        let found = call!(V: m.residual_parts or residual_parts_inlined(q, u, b));
        store(found.inertia.as_ref(), inertia, at);
        store(found.applied.as_ref(), applied, at);
        let found = call!(V: m.linear or linear_inlined(q, u, b));
        store_linears::<V, M>(&[found], [mass, damping, stiffness], at);
    }
    /// [`Mechanism::residual_partials`].
    ResidualPartials "residual_partials" [q, u, b] -> [by_input, by_design] in (m, M, at, V) => {
        let found = call!(V: m.residual_partials or residual_partials_inlined(q, u, b));
        store_rows(found.0.as_ref(), by_input, at);
        store_rows(found.1.as_ref(), by_design, at);
    }
    /// [`Mechanism::linear_partials`]: for all coordinates, then for inputs and design variables, the derivatives of mass,
    /// of damping and of stiffness by one variable after the other. They stand on the stack together, 64 bytes an entry.
    LinearPartials "linear_partials" [q, u, b] -> [m0, c0, k0, m1, c1, k1, m2, c2, k2] in (m, M, at, V) => {
        let found = call!(V: m.linear_partials or linear_partials_inlined(q, u, b));
        store_partials::<V, M>(&found, [[m0, c0, k0], [m1, c1, k1], [m2, c2, k2]], at);
    }
    /// [`Mechanism::partials`]: the lists of [`LinearPartials`], then those of [`ResidualPartials`].
    Partials "linear_partials" [q, u, b] -> [m0, c0, k0, m1, c1, k1, m2, c2, k2, g1, g2] in (m, M, at, V) => {
        let found = call!(V: m.linear_partials or linear_partials_inlined(q, u, b));
        store_partials::<V, M>(&found, [[m0, c0, k0], [m1, c1, k1], [m2, c2, k2]], at);
        let found = call!(V: m.residual_partials or residual_partials_inlined(q, u, b));
        store_rows(found.0.as_ref(), g1, at);
        store_rows(found.1.as_ref(), g2, at);
    }
    /// [`Mechanism::mode_gradient`].
    ModeGradient "mode_gradient" [q, u, b, phi, lambda] -> [coordinates, inputs, design] in (m, M, at, V) => {
        let [lambda] = *lambda;
        let found = call!(V: m.mode_gradient or mode_gradient_inlined(q, u, b, phi, lambda));
        store_gradient::<V, M>(&found, [coordinates, inputs, design], at);
    }
    /// [`Mechanism::residual_gradient`].
    ResidualGradient "residual_gradient" [q, u, b, w] -> [coordinates, inputs, design] in (m, M, at, V) => {
        let found = call!(V: m.residual_gradient or residual_gradient_inlined(q, u, b, w));
        store_gradient::<V, M>(&found, [coordinates, inputs, design], at);
    }
    /// [`Mechanism::pencil_gradient`].
    PencilGradient "pencil_gradient" [q, u, b, w, a, v, x] -> [coordinates, inputs, design] in (m, M, at, V) => {
        let found = call!(V: m.pencil_gradient or pencil_gradient_inlined(q, u, b, w, a, v, x));
        store_gradient::<V, M>(&found, [coordinates, inputs, design], at);
    }
    /// [`Mechanism::forced_gradient`].
    ForcedGradient "forced_gradient" [q, u, b, o, a, v, x, share, c, s, dc, ds, w] -> [coordinates, inputs, design] in (m, M, at, V) => {
        let found = call!(V: m.forced_gradient or forced_gradient_inlined(q, u, b, o, a, v, x, share, c, s, dc, ds, w));
        store_gradient::<V, M>(&found, [coordinates, inputs, design], at);
    }
    /// [`Mechanism::motion_residual`].
    MotionResidual "motion_residual" [acceleration, velocity, q, u, b] -> [residual] in (m, M, at, V) => {
        let found = call!(V: m.motion_residual or motion_residual_inlined(acceleration, velocity, q, u, b));
        store(found.as_ref(), residual, at);
    }
    /// [`Mechanism::motion`].
    Motion "motion" [velocity, q, u, b] -> [mass, right] in (m, M, at, V) => {
        let found = call!(V: m.motion or motion_inlined(velocity, q, u, b));
        store_rows(found.0.as_ref(), mass, at);
        store(found.1.as_ref(), right, at);
    }
    /// [`Mechanism::motion_linear`].
    MotionLinear "motion_linear" [acceleration, velocity, q, u, b] -> [mass, damping, stiffness] in (m, M, at, V) => {
        let found = call!(V: m.motion_linear or motion_linear_inlined(acceleration, velocity, q, u, b));
        store_rows(found.mass.as_ref(), mass, at);
        store_rows(found.damping.as_ref(), damping, at);
        store_rows(found.stiffness.as_ref(), stiffness, at);
    }
}
