//! Gradients of the forms of the modes at one state: by reverse differentiation, one kernel call for each, or from explicit
//! partial derivatives, which all modes share. A small mechanism has few partials, and they cost less.

use super::pencil::ComplexGradient;
use crate::algebra::Matrix;
use crate::kernels::{PartialMatrices, entries_of, parts};
use crate::mechanism::Linear;
use crate::modes::Family;
use crate::{Complex, Description, Mode};

/// What an elementary function costs, in additions and multiplications.
const FUNCTION: usize = 40;

/// Where the gradients of all modes come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Source {
    /// From explicit partials of the matrices and of the residual.
    Partials,
    /// Of the forms by reverse differentiation, of the residual from explicit partials.
    ResidualPartials,
    /// By reverse differentiation.
    Reverse,
}

impl Source {
    /// The cheapest one for the modes of a mechanism.
    pub(crate) fn cheapest(description: &Description, family: Family) -> Self {
        let n = description.coordinates.len();
        let variables = description.inputs.len() + description.design.len();
        // What partials take for each mode, and the gradient that it takes without them.
        let (matrices, form, residual, force) = match family {
            Family::Undamped => (
                2 * n * (n + 1) * (n + variables),
                ("mode_gradient", 1),
                2 * n * variables,
                ("residual_gradient", 1),
            ),
            Family::General => (
                6 * n * n * (n + variables),
                ("pencil_gradient", 4),
                4 * n * variables,
                ("residual_gradient", 2),
            ),
        };
        if pays(description, ("linear_partials", matrices), form) {
            Self::Partials
        } else if pays(description, ("residual_partials", residual), force) {
            Self::ResidualPartials
        } else {
            Self::Reverse
        }
    }
}

/// Whether one call of `shared` with `use_of_it` operations for each mode costs less than `calls` of `own` for each mode.
fn pays(
    description: &Description,
    (shared, use_of_it): (&str, usize),
    (own, calls): (&str, usize),
) -> bool {
    let modes = description.coordinates.len();
    match (cost(description, shared), cost(description, own)) {
        (Some(shared), Some(own)) => shared + modes * use_of_it < modes * calls * own,
        _ => false,
    }
}

/// Additions and multiplications of a kernel; `None` where it is not written out.
fn cost(description: &Description, name: &str) -> Option<usize> {
    let kernel = description.kernel(name)?;
    Some(kernel.operations + FUNCTION * kernel.functions)
}

/// The changes of matrices of size `n`, one after the other, with each of the variables.
#[inline(always)]
pub(crate) fn changes(n: usize, all: &[f64]) -> impl ExactSizeIterator<Item = &[f64]> {
    all.chunks_exact(entries_of(n))
}

/// `phi^T (dKhat - lambda dMhat) phi` of a change of matrices of size `n`, vector and eigenvalue held fixed; `dKhat` is
/// `symmetric` or not.
#[inline(always)]
pub(crate) fn rate(n: usize, change: &[f64], phi: &[f64], lambda: f64, symmetric: bool) -> f64 {
    let Linear {
        mass, stiffness, ..
    } = parts(&change[..entries_of(n)]);
    let (mut own, mut mixed) = (-0.0, -0.0);
    for i in 0..n {
        own += phi[i] * phi[i] * (stiffness[i * n + i] - lambda * mass[i * n + i]);
        for j in 0..i {
            let below = stiffness[i * n + j];
            let stiffness = if symmetric {
                below
            } else {
                0.5 * (below + stiffness[j * n + i])
            };
            mixed += phi[i] * phi[j] * (stiffness - lambda * mass[i * n + j]);
        }
    }
    own + (mixed + mixed)
}

/// Gradient of `psi^T (s^2 Mhat + s Chat + Khat) phi`, vectors and eigenvalue held fixed, from explicit partials.
pub(crate) fn of_general(
    partials: &PartialMatrices,
    mode: &Mode,
    gradient: &mut ComplexGradient,
) {
    let n = mode.shape.len();
    let s = mode.s;
    let weights = Matrix::from_fn(n, n, |i, j| mode.left[i] * mode.shape[j]);
    let rate = |change: &[f64]| {
        let (mut k, mut c, mut m) = (Complex::ZERO, Complex::ZERO, Complex::ZERO);
        let Linear {
            mass,
            damping,
            stiffness,
        } = parts(change);
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
        (
            &mut re.coordinates,
            &mut im.coordinates,
            partials.by_coordinate(),
        ),
        (&mut re.inputs, &mut im.inputs, partials.by_input()),
        (&mut re.design, &mut im.design, partials.by_design()),
    ] {
        for ((re, im), change) in re.iter_mut().zip(im).zip(self::changes(n, changes)) {
            Complex { re: *re, im: *im } = rate(change);
        }
    }
}
