//! Counterparts of [`algebra`](super::algebra) for matrices of size one and two, with formulas that use few divisions
//! and roots.

use super::algebra::{self, Row, Square, keep};
use crate::scalar::Lanes;

/// Largest squared tangent of the rotation, and largest relative squared coupling of the masses. The squared cosine
/// between a mode and the nominal one is then at least `(0.995 - 0.1 / 2)^2 / 1.25 = 0.71`, enough to recognise it.
const TURNED: f64 = 0.25;
const COUPLED: f64 = 0.01;

/// A matrix prepared for solving.
pub(crate) enum FactoredMatrix<V: Lanes, const N: usize> {
    /// Size two: the matrix and the inverse of its determinant.
    Two(V, V, V, V),
    Factor(Square<V, N>),
}

impl<V: Lanes, const N: usize> FactoredMatrix<V, N> {
    /// The flag says that the matrix is positive definite, with pivots of at least the share `least`.
    #[inline(always)]
    pub(crate) fn new(n: usize, matrix: &Square<V, N>, least: f64) -> (Self, V) {
        if n == 2 {
            let (a, b, d) = (matrix[0][0], matrix[1][0], matrix[1][1]);
            let inverse = V::constant(1.0) / (a * d - b * b);
            (Self::Two(a, b, d, inverse), definite(n, matrix, least))
        } else {
            let (factor, flag) = algebra::factor(n, matrix, least);
            (Self::Factor(factor), flag)
        }
    }

    /// Solves `matrix x = right`.
    #[inline(always)]
    pub(crate) fn solve(&self, n: usize, right: &Row<V, N>) -> Row<V, N> {
        match self {
            Self::Two(a, b, d, inverse) => {
                let mut x = *right;
                x[0] = (*d * right[0] - *b * right[1]) * *inverse;
                x[1] = (*a * right[1] - *b * right[0]) * *inverse;
                x
            }
            Self::Factor(factor) => algebra::solve(n, factor, right),
        }
    }
}

/// Flags positive definite matrices, given below and on the diagonal, with pivots of at least the share `least`.
#[inline(always)]
pub(crate) fn definite<V: Lanes, const N: usize>(n: usize, matrix: &Square<V, N>, least: f64) -> V {
    if n == 2 {
        let (a, b, d) = (matrix[0][0], matrix[1][0], matrix[1][1]);
        let flag = keep(V::constant(1.0), V::constant(0.0).at_most(a));
        let rest = a * d - b * b;
        keep(flag, ((a * d).abs() * V::constant(least)).at_most(rest))
    } else {
        algebra::factor(n, matrix, least).1
    }
}

/// Counterpart of [`algebra::eigenvalues`].
#[inline(always)]
pub(crate) fn eigenvalues<V: Lanes, const N: usize>(
    n: usize,
    stiffness: &Square<V, N>,
    mass: &Square<V, N>,
) -> (Row<V, N>, V) {
    let (zero, one) = (V::constant(0.0), V::constant(1.0));
    let mut lambda = [zero; N];
    if n == 1 {
        lambda[0] = stiffness[0][0] / mass[0][0];
        (lambda, keep(one, V::constant(0.5).at_most(mass[0][0])))
    } else if n == 2 {
        let (k00, k10, k11) = (stiffness[0][0], stiffness[1][0], stiffness[1][1]);
        let (m00, m10, m11) = (mass[0][0], mass[1][0], mass[1][1]);
        // a = L^-1 stiffness L^-T; its element a_10 is only needed squared, which takes no root.
        let inverse = one / m00;
        let ratio = m10 * inverse;
        let pivot = m11 - ratio * m10;
        let a00 = k00 * inverse;
        let rest = k10 - m10 * a00;
        let under = one / pivot;
        let a11 = (k11 - ratio * (k10 + rest)) * under;
        let square = rest * rest * inverse * under;
        let half = (a11 - a00) * V::constant(0.5);
        let root = (half * half + square).sqrt();
        let sum = half + V::choose(zero.at_most(half), root, -root);
        let shift = square / sum;
        let shift = V::choose(square.at_most(zero), zero, shift);
        lambda[0] = a00 - shift;
        lambda[1] = a11 + shift;
        let coupled = m10 * m10;
        let flag = keep(one, coupled.at_most(m00 * m11 * V::constant(COUPLED)));
        let flag = keep(flag, V::constant(0.5).at_most(m00));
        let flag = keep(flag, V::constant(0.5).at_most(m11));
        let flag = keep(flag, square.at_most(sum * sum * V::constant(TURNED)));
        (lambda, flag)
    } else {
        algebra::eigenvalues(n, stiffness, mass)
    }
}

/// Eigenpairs of `stiffness phi = lambda mass phi`, with matrices as for [`eigenvalues`]; row `r` of the second array
/// is vector `r`, `phi^T mass phi = 1`.
///
/// The flag says that each is clearly the unit vector of its position: squared cosine at least [`algebra::CLEAR`].
#[inline(always)]
pub(crate) fn eigenpairs<V: Lanes, const N: usize>(
    n: usize,
    stiffness: &Square<V, N>,
    mass: &Square<V, N>,
) -> (Row<V, N>, Square<V, N>, V) {
    let (zero, one) = (V::constant(0.0), V::constant(1.0));
    let mut lambda = [zero; N];
    let mut vectors = [[zero; N]; N];
    if n == 1 {
        let inverse = one / mass[0][0];
        lambda[0] = stiffness[0][0] * inverse;
        vectors[0][0] = inverse.sqrt();
        (lambda, vectors, keep(one, zero.at_most(mass[0][0])))
    } else if n == 2 {
        let (k00, k10, k11) = (stiffness[0][0], stiffness[1][0], stiffness[1][1]);
        let (m00, m10, m11) = (mass[0][0], mass[1][0], mass[1][1]);
        // Reciprocals of the diagonal of L, mass = L L^T.
        let r0 = one / m00.sqrt();
        let l10 = m10 * r0;
        let r1 = one / (m11 - l10 * l10).sqrt();
        // a = L^-1 stiffness L^-T
        let a00 = k00 * r0 * r0;
        let across = k10 * r0;
        let rest = across - l10 * a00;
        let a10 = rest * r1;
        let a11 = (k11 - l10 * (across + rest)) * r1 * r1;
        let half = (a11 - a00) * V::constant(0.5);
        let root = (half * half + a10 * a10).sqrt();
        let tangent = a10 / (half + V::choose(zero.at_most(half), root, -root));
        let tangent = V::choose(a10.abs().at_most(zero), zero, tangent);
        let secant = one + tangent * tangent;
        let cosine = one / secant.sqrt();
        let sine = tangent * cosine;
        lambda[0] = a00 - tangent * a10;
        lambda[1] = a11 + tangent * a10;
        // phi = L^-T y with y = (cosine, -sine) and (sine, cosine)
        let (first, second) = (-sine * r1, cosine * r1);
        vectors[0][0] = (cosine - l10 * first) * r0;
        vectors[0][1] = first;
        vectors[1][0] = (sine - l10 * second) * r0;
        vectors[1][1] = second;
        // cos^2 = (L J)_rr^2 / m_rr
        let clear = V::constant(algebra::CLEAR);
        let cosine_squared = cosine * cosine;
        let turned = l10 * sine + cosine * (m11 - l10 * l10) * r1;
        let flag = keep(one, clear.at_most(cosine_squared));
        let flag = keep(flag, (m11 * clear).at_most(turned * turned));
        (lambda, vectors, flag)
    } else {
        algebra::eigenpairs(n, stiffness, mass)
    }
}
