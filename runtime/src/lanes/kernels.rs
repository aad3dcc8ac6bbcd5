//! The kernels that sweeps and Monte Carlo need, at all states of a batch.

use super::batch::{Store, load};
use super::instructions::Task;
use super::{Batch, Instructions, Vector, WIDTH};
use crate::{DampingKind, Description, Gradient, Linear, LinearPartials, Mechanism};

/// A function that runs a kernel on vectors, and the task behind it.
macro_rules! kernel {
    (
        $(#[$doc:meta])*
        $name:ident $task:ident ($($argument:ident: $kind:ty),*) -> $output:ty,
        |$mechanism:ident, $q:ident, $u:ident, $b:ident, $at:ident| $call:expr
        $(, stored by $store:expr)?
    ) => {
        $(#[$doc])*
        #[allow(clippy::too_many_arguments)]
        pub fn $name<M, const N: usize, const U: usize, const P: usize, const O: usize>(
            instructions: Instructions,
            mechanism: &M,
            q: &[Batch; N],
            u: &[Batch; U],
            b: &[Batch; P],
            $($argument: &$kind,)*
            out: &mut $output,
        ) where
            M: Mechanism<N, U, P, O>,
        {
            let generated = const { generated(&M::DESCRIPTION, stringify!($name)) };
            let instructions = if generated { instructions } else { Instructions::SCALAR };
            instructions.run($task::<M, N, U, P, O> { mechanism, q, u, b, $($argument,)* out });
        }

        struct $task<'a, M, const N: usize, const U: usize, const P: usize, const O: usize> {
            mechanism: &'a M,
            q: &'a [Batch; N],
            u: &'a [Batch; U],
            b: &'a [Batch; P],
            $($argument: &'a $kind,)*
            out: &'a mut $output,
        }

        impl<M, const N: usize, const U: usize, const P: usize, const O: usize> Task
            for $task<'_, M, N, U, P, O>
        where
            M: Mechanism<N, U, P, O>,
        {
            type Output = ();

            #[inline(always)]
            fn run<V: Vector>(self) {
                let Self { mechanism: $mechanism, $($argument,)* .. } = self;
                for $at in (0..WIDTH).step_by(V::WIDTH) {
                    let $q: &[V; N] = &load(self.q, $at);
                    let ($u, $b): (&[V; U], &[V; P]) = (&load(self.u, $at), &load(self.b, $at));
                    kernel!(@store $($store)?)(self.out, &$call, $at);
                }
            }
        }
    };
    (@store) => { Store::store };
    (@store $store:expr) => { $store };
}

kernel! {
    /// [`Mechanism::residual_and_stiffness`] at every state: `q`, `u`, `b` as there.
    residual_and_stiffness ResidualAndStiffness () -> ([Batch; N], [[Batch; N]; N]),
    |m, q, u, b, at| m.residual_and_stiffness_inlined(q, u, b)
}
kernel! {
    /// [`Mechanism::linear`] at every state.
    linear LinearTask () -> Linear<Batch, N>,
    |m, q, u, b, at| m.linear_inlined(q, u, b),
    stored by store_linear::<V, M, N, U, P, O>
}
kernel! {
    /// [`Mechanism::residual_partials`] at every state.
    residual_partials ResidualPartials () -> ([[Batch; U]; N], [[Batch; P]; N]),
    |m, q, u, b, at| m.residual_partials_inlined(q, u, b)
}
kernel! {
    /// [`Mechanism::linear_partials`] at every state; without vectors where these are not written out, because the mechanism
    /// is large.
    linear_partials LinearPartialsTask () -> LinearPartials<Batch, N, U, P>,
    |m, q, u, b, at| m.linear_partials_inlined(q, u, b)
}
kernel! {
    /// [`Mechanism::mode_gradient`] at every state, `phi` and `lambda` of the state's own mode.
    mode_gradient ModeGradient (phi: [Batch; N], lambda: Batch) -> Gradient<Batch, N, U, P>,
    |m, q, u, b, at| m.mode_gradient_inlined(q, u, b, &load(phi, at), V::load(lambda, at))
}
kernel! {
    /// [`Mechanism::residual_gradient`] at every state.
    residual_gradient ResidualGradient (w: [Batch; N]) -> Gradient<Batch, N, U, P>,
    |m, q, u, b, at| m.residual_gradient_inlined(q, u, b, &load(w, at))
}

/// Stores matrices; a damping matrix that is always zero is not read, so that the kernel need not write it.
#[inline(always)]
fn store_linear<V, M, const N: usize, const U: usize, const P: usize, const O: usize>(
    out: &mut Linear<Batch, N>,
    linear: &Linear<V, N>,
    at: usize,
) where
    V: Vector,
    M: Mechanism<N, U, P, O>,
{
    out.mass.store(&linear.mass, at);
    out.stiffness.store(&linear.stiffness, at);
    if const { matches!(M::DESCRIPTION.damping, DampingKind::Zero) } {
        if at == 0 {
            out.damping = [[Batch::all(0.0); N]; N];
        }
    } else {
        out.damping.store(&linear.damping, at);
    }
}

/// Whether the compiler generated this kernel, and with it the form that is inlined; a kernel written by hand is called as
/// it is, and vectors would only slow it down.
pub(crate) const fn generated(description: &Description, kernel: &str) -> bool {
    description.kernel(kernel).is_some()
}
