//! Gradients of the forms of the modes and of the residual at one state: by reverse differentiation, one kernel call for
//! each, or from explicit partial derivatives, which all modes share. A small mechanism has few partials, and they cost
//! less; which way is cheaper is known when the mechanism is compiled.

use core::marker::PhantomData;

use crate::{Complex, Description, Gradient, Linear, LinearPartials, Mechanism, Mode, Real};

/// What an elementary function costs, in additions and multiplications.
const FUNCTION: usize = 40;

/// Additions and multiplications of a kernel; `None` where it is not written out.
const fn cost(description: &Description, name: &str) -> Option<usize> {
    match description.kernel(name) {
        Some(kernel) => Some(kernel.operations + FUNCTION * kernel.functions),
        None => None,
    }
}

/// Whether one call of `shared` with `use_of_it` operations for each mode costs less than `calls` of `own` for each mode.
const fn pays(
    description: &Description,
    modes: usize,
    (shared, use_of_it): (&str, usize),
    (own, calls): (&str, usize),
) -> bool {
    match (cost(description, shared), cost(description, own)) {
        (Some(shared), Some(own)) => shared + modes * use_of_it < modes * calls * own,
        _ => false,
    }
}

/// Which way is cheaper for a mechanism.
pub(crate) struct Cheaper<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    PhantomData<M>,
);

impl<M, const N: usize, const U: usize, const P: usize, const O: usize> Cheaper<M, N, U, P, O>
where
    M: Mechanism<N, U, P, O>,
{
    /// Explicit partials of the residual for undamped modes.
    pub(super) const RESIDUAL: bool = pays(
        &M::DESCRIPTION,
        N,
        ("residual_partials", 2 * N * (U + P)),
        ("residual_gradient", 1),
    );
    /// Explicit partials of the matrices for undamped modes.
    pub(crate) const MATRICES: bool = pays(
        &M::DESCRIPTION,
        N,
        ("linear_partials", 2 * N * (N + 1) * (N + U + P)),
        ("mode_gradient", 1),
    );
    /// Explicit partials of the residual for general modes.
    pub(super) const RESIDUAL_GENERAL: bool = pays(
        &M::DESCRIPTION,
        N,
        ("residual_partials", 4 * N * (U + P)),
        ("residual_gradient", 2),
    );
    /// Explicit partials of the matrices for general modes.
    pub(super) const MATRICES_GENERAL: bool = pays(
        &M::DESCRIPTION,
        N,
        ("linear_partials", 6 * N * N * (N + U + P)),
        ("pencil_gradient", 4),
    );
}

/// Gradient of `phi^T (Khat - lambda Mhat) phi`, vector and eigenvalue held fixed, from explicit partials.
#[inline(always)]
pub(crate) fn of_undamped<T: Real, const N: usize, const U: usize, const P: usize>(
    partials: &LinearPartials<T, N, U, P>,
    phi: &[T; N],
    lambda: T,
    symmetric: bool,
) -> Gradient<T, N, U, P> {
    let mut products = [[T::constant(0.0); N]; N];
    for i in 0..N {
        for j in 0..N {
            products[i][j] = phi[i] * phi[j];
        }
    }
    Gradient {
        coordinates: rates(&partials.by_coordinate, &products, lambda, symmetric),
        inputs: rates(&partials.by_input, &products, lambda, symmetric),
        design: rates(&partials.by_design, &products, lambda, symmetric),
    }
}

/// `phi^T (dKhat - lambda dMhat) phi` of each change.
#[inline(always)]
#[allow(
    clippy::needless_range_loop,
    reason = "rows and columns of several matrices"
)]
fn rates<T: Real, const N: usize, const K: usize>(
    changes: &[Linear<T, N>; K],
    products: &[[T; N]; N],
    lambda: T,
    symmetric: bool,
) -> [T; K] {
    let mut rates = [T::constant(0.0); K];
    for (rate, change) in rates.iter_mut().zip(changes) {
        let (mut own, mut mixed) = (T::constant(-0.0), T::constant(-0.0));
        for i in 0..N {
            own = own + products[i][i] * (change.stiffness[i][i] - lambda * change.mass[i][i]);
            for j in 0..i {
                let (a, b) = (change.stiffness[i][j], change.stiffness[j][i]);
                let stiffness = if symmetric {
                    a
                } else {
                    T::constant(0.5) * (a + b)
                };
                mixed = mixed + products[i][j] * (stiffness - lambda * change.mass[i][j]);
            }
        }
        *rate = own + (mixed + mixed);
    }
    rates
}

/// Gradient of `psi^T (s^2 Mhat + s Chat + Khat) phi`, vectors and eigenvalue held fixed, from explicit partials.
#[inline]
pub(super) fn of_general<const N: usize, const U: usize, const P: usize>(
    partials: &LinearPartials<f64, N, U, P>,
    mode: &Mode<N>,
) -> Gradient<Complex, N, U, P> {
    let s = mode.s;
    let weights: [[Complex; N]; N] =
        core::array::from_fn(|i| core::array::from_fn(|j| mode.left[i] * mode.shape[j]));
    let rate = |change: &Linear<f64, N>| {
        let mut parts = [Complex::default(); 3];
        let Linear {
            mass,
            damping,
            stiffness,
        } = change;
        for (sum, matrix) in parts.iter_mut().zip([stiffness, damping, mass]) {
            for i in 0..N {
                for j in 0..N {
                    *sum += weights[i][j] * matrix[i][j];
                }
            }
        }
        parts[0] + s * (parts[1] + s * parts[2])
    };
    Gradient {
        coordinates: core::array::from_fn(|k| rate(&partials.by_coordinate[k])),
        inputs: core::array::from_fn(|k| rate(&partials.by_input[k])),
        design: core::array::from_fn(|k| rate(&partials.by_design[k])),
    }
}
