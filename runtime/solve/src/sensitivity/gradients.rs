//! Gradients of the forms of the modes at one state: by reverse differentiation, with one kernel call each, or from
//! explicit partial derivatives, which all modes share. A small mechanism has few partials, so they cost less.
//!
//! # The cheaper gradients
//!
//! The adjoint needs one gradient of a form per mode. For a small mechanism all explicit partials together cost less
//! than a reverse pass per mode. The costs in the description settle the choice when a user's code is compiled
//! (`sensitivity/gradients.rs`).

use super::pencil::ComplexGradient;
use crate::algebra::Matrix;
use crate::kernels::{Costs, PartialMatrices, Sizes, entries_of, parts};
use crate::mechanism::Linear;
use crate::modes::Family;
use crate::{Complex, Mode};

/// Where the gradients of all modes come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[doc(hidden)]
pub enum Source {
    /// Explicit partials of the matrices and of the residual.
    Partials,
    /// Reverse differentiation for the forms, explicit partials for the residual.
    ResidualPartials,
    /// Reverse differentiation for everything.
    Reverse,
}

impl Source {
    /// The cheapest source for the modes of a mechanism.
    #[doc(hidden)]
    pub fn cheapest(costs: Costs, sizes: Sizes, family: Family) -> Self {
        let n = sizes.coordinates;
        let variables = sizes.inputs + sizes.design;
        // Operations per mode with partials, and gradients needed per mode without them.
        let (matrices, form, residual, forces) = match family {
            Family::Undamped => (2 * n * (n + 1) * (n + variables), (costs.mode_gradient, 1), 2 * n * variables, 1),
            Family::General => (6 * n * n * (n + variables), (costs.pencil_gradient, 4), 4 * n * variables, 2),
        };
        let force = (costs.residual_gradient, forces);
        if pays(n, (costs.linear_partials, matrices), form) {
            Self::Partials
        } else if pays(n, (costs.residual_partials, residual), force) {
            Self::ResidualPartials
        } else {
            Self::Reverse
        }
    }
}

/// Whether one call of `shared` plus `use_of_it` operations per mode costs less than `calls` of `separate` per mode.
fn pays(modes: usize, (shared, use_of_it): (Option<usize>, usize), (separate, calls): (Option<usize>, usize)) -> bool {
    match (shared, separate) {
        (Some(shared), Some(separate)) => shared + modes * use_of_it < modes * calls * separate,
        _ => false,
    }
}

/// The changes of matrices of size `n` with each variable, one after the other.
#[inline(always)]
fn changes(n: usize, all: &[f64]) -> impl ExactSizeIterator<Item = &[f64]> {
    all.chunks_exact(entries_of(n).max(1))
}

/// `phi^T (Khat - lambda Mhat) phi` with vector and eigenvalue held fixed.
pub(super) struct Form<'a> {
    n: usize,
    lambda: f64,
    /// `phi_i phi_j` for each element on the diagonal and both elements beside it, those below standing for both.
    weights: &'a [f64],
}

impl<'a> Form<'a> {
    /// Of an undamped shape; `weights` is room for `n * n` numbers.
    #[inline(always)]
    pub(super) fn new(n: usize, phi: &[Complex], lambda: f64, weights: &'a mut [f64]) -> Self {
        for i in 0..n {
            for j in 0..i {
                weights[i * n + j] = 2.0 * phi[i].re * phi[j].re;
            }
            weights[i * n + i] = phi[i].re * phi[i].re;
        }
        Self { n, lambda, weights }
    }

    /// The changes of the matrices with each variable, one after the other.
    #[inline(always)]
    pub(super) fn changes<'b>(&self, all: &'b [f64]) -> impl ExactSizeIterator<Item = &'b [f64]> {
        changes(self.n, all)
    }

    /// `phi^T (dKhat - lambda dMhat) phi` for a symmetric change of the matrices.
    #[inline(always)]
    pub(super) fn rate(&self, change: &[f64]) -> f64 {
        let n = self.n;
        let Linear { mass, stiffness, .. } = parts(&change[..entries_of(n)]);
        let mut sum = -0.0;
        for i in 0..n {
            for k in i * n..=i * (n + 1) {
                sum += self.weights[k] * (stiffness[k] - self.lambda * mass[k]);
            }
        }
        sum
    }
}

/// Gradient of `psi^T (s^2 Mhat + s Chat + Khat) phi` from explicit partials, with vectors and eigenvalue held fixed.
pub(crate) fn of_general(partials: &PartialMatrices, mode: &Mode, gradient: &mut ComplexGradient) {
    let n = mode.shape.len();
    let s = mode.s;
    let left = mode.left();
    let weights = Matrix::from_fn(n, n, |i, j| left[i] * mode.shape[j]);
    let rate = |change: &[f64]| {
        let (mut k, mut c, mut m) = (Complex::ZERO, Complex::ZERO, Complex::ZERO);
        let Linear { mass, damping, stiffness } = parts(change);
        let elements = stiffness.iter().zip(damping).zip(mass);
        for (weight, ((stiffness, damping), mass)) in weights.as_flattened().iter().zip(elements) {
            k += weight * stiffness;
            c += weight * damping;
            m += weight * mass;
        }
        k + s * (c + s * m)
    };
    let [re, im] = gradient;
    for (re, im, changes) in [
        (&mut re.coordinates, &mut im.coordinates, partials.by_coordinate()),
        (&mut re.inputs, &mut im.inputs, partials.by_input()),
        (&mut re.design, &mut im.design, partials.by_design()),
    ] {
        for ((re, im), change) in re.iter_mut().zip(im).zip(self::changes(n, changes)) {
            Complex { re: *re, im: *im } = rate(change);
        }
    }
}
