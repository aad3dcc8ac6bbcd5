//! Symmetric matrices of a small size `n`, one in each lane. A flag is a vector of ones, with zeros in the lanes that
//! failed.
//!
//! Sizes are arguments of functions that are inlined at the call site: for a caller with constant `n` the loops have
//! constant length, see [`for_size!`].

use crate::algebra::Matrix;
use crate::scalar::{Batch, Lanes};

/// Maximum number of unknowns of a mechanism whose sweeps are solved side by side.
pub(crate) const LARGEST: usize = 8;

/// One number for each unknown; entries from `n` on are meaningless.
pub(crate) type Row<V, const N: usize> = [V; N];
/// A matrix of size `n`.
pub(crate) type Square<V, const N: usize> = [Row<V, N>; N];

/// Compiles `$work` for each small number `$n` of unknowns, a constant there, with arrays of size `$N`; once for all
/// larger ones.
macro_rules! for_size {
    ($count:expr, |$n:ident, $N:ident| $work:expr) => {
        match $count {
            1 => for_size!(@1, 1, $n, $N, $work),
            2 => for_size!(@2, 2, $n, $N, $work),
            3 => for_size!(@3, 3, $n, $N, $work),
            count => {
                const LARGEST: usize = $crate::batched::algebra::LARGEST;
                for_size!(@LARGEST, count.min(LARGEST), $n, $N, $work)
            }
        }
    };
    (@$size:expr, $count:expr, $n:ident, $N:ident, $work:expr) => {{
        const $N: usize = $size;
        let $n = $count;
        $work
    }};
}
pub(crate) use for_size;

/// Like [`for_size!`], for arrays of size `N`.
#[inline(always)]
pub(crate) fn for_size_up_to<const N: usize>(n: usize, mut work: impl FnMut(usize)) {
    match n {
        1 if N == SMALLEST => work(1),
        2 if N == SMALLEST => work(2),
        3 if N == SMALLEST => work(3),
        n => work(n.min(N)),
    }
}

/// The smallest array size, for which code is compiled for each number of unknowns except the largest.
const SMALLEST: usize = 4;

/// Converts an `n` by `n` matrix to one of small fixed size.
#[inline(always)]
pub(crate) fn small<const N: usize>(n: usize, matrix: &Matrix) -> Square<f64, N> {
    let entries = &matrix.as_flattened()[..n * n];
    let mut rows = [[0.0; N]; N];
    for i in 0..n {
        rows[i][..n].copy_from_slice(&entries[i * n..(i + 1) * n]);
    }
    rows
}

/// The first entries of each batch.
#[inline(always)]
pub(crate) fn load<V: Lanes, const N: usize>(n: usize, from: &[Batch], at: usize) -> Row<V, N> {
    let from = &from[..n];
    let mut row = [V::constant(0.0); N];
    for i in 0..n {
        row[i] = V::load(&from[i], at);
    }
    row
}

/// Loads the first entries of a matrix, row by row.
#[inline(always)]
pub(crate) fn load_matrix<V: Lanes, const N: usize>(n: usize, from: &[Batch], at: usize) -> Square<V, N> {
    let mut rows = [[V::constant(0.0); N]; N];
    let from = &from[..n * n];
    for i in 0..n {
        for j in 0..n {
            rows[i][j] = V::load(&from[i * n + j], at);
        }
    }
    rows
}

/// Stores the first entries.
#[inline(always)]
pub(crate) fn store<V: Lanes, const N: usize>(n: usize, row: &Row<V, N>, to: &mut [Batch], at: usize) {
    let to = &mut to[..n];
    for i in 0..n {
        row[i].store(&mut to[i], at);
    }
}

/// Off-diagonal elements count as zero below this share of the diagonal, squared.
const NEGLIGIBLE: f64 = 1e-33;
/// Maximum number of rotation sweeps; three suffice for nearly diagonal matrices.
const SWEEPS: usize = 8;
/// Smallest squared cosine between a mode and the nominal one; individual modes are recognised from 0.6 on.
const RECOGNISED: f64 = 0.7;
/// Smallest squared cosine if two states that are compared with a third must be recognised in each other: vectors
/// within 13 degrees of it are within 26 of each other, squared cosine above 0.8.
pub(crate) const CLEAR: f64 = 0.95;

/// `flag` where `mask` holds, otherwise zero.
#[inline(always)]
pub(crate) fn keep<V: Lanes>(flag: V, mask: V::Mask) -> V {
    V::choose(mask, flag, V::constant(0.0))
}

/// `matrix = L D L^T`: `L` below the diagonal, inverse pivots on it. The flag says that every pivot is positive, and at
/// least the share `least` of its diagonal element.
#[inline(always)]
pub(crate) fn factor<V: Lanes, const N: usize>(n: usize, matrix: &Square<V, N>, least: f64) -> (Square<V, N>, V) {
    let (zero, one) = (V::constant(0.0), V::constant(1.0));
    let mut factor = [[zero; N]; N];
    let mut pivots = [zero; N];
    let mut flag = one;
    for i in 0..n {
        let mut pivot = matrix[i][i];
        for j in 0..i {
            // `scaled` is L_ij D_j until its own turn is over.
            let mut scaled = matrix[i][j];
            for k in 0..j {
                scaled = scaled - factor[i][k] * factor[j][k] * pivots[k];
            }
            factor[i][j] = scaled * factor[j][j];
            pivot = pivot - factor[i][j] * scaled;
        }
        flag = keep(flag, (matrix[i][i].abs() * V::constant(least)).at_most(pivot));
        pivots[i] = pivot;
        factor[i][i] = one / pivot;
    }
    (factor, flag)
}

/// Solves `L D L^T x = right`.
#[inline(always)]
pub(crate) fn solve<V: Lanes, const N: usize>(n: usize, factor: &Square<V, N>, right: &Row<V, N>) -> Row<V, N> {
    let mut x = *right;
    for i in 0..n {
        for j in 0..i {
            x[i] = x[i] - factor[i][j] * x[j];
        }
    }
    for i in (0..n).rev() {
        x[i] = x[i] * factor[i][i];
        for j in i + 1..n {
            x[i] = x[i] - factor[j][i] * x[j];
        }
    }
    x
}

/// `basis^T matrix basis` for a symmetric matrix, below and on the diagonal; the basis vectors are the rows of `basis`.
#[inline(always)]
pub(crate) fn congruent<V: Lanes, const N: usize>(
    n: usize,
    matrix: &Square<V, N>,
    basis: &Square<f64, N>,
) -> Square<V, N> {
    let zero = V::constant(0.0);
    let mut result = [[zero; N]; N];
    for r in 0..n {
        let mut image = [zero; N];
        for i in 0..n {
            // Sums start with their first term, because adding to zero would cost an operation.
            image[i] = matrix[i][0] * V::constant(basis[r][0]);
            for j in 1..n {
                image[i] = image[i] + matrix[i][j] * V::constant(basis[r][j]);
            }
        }
        for s in r..n {
            result[s][r] = image[0] * V::constant(basis[s][0]);
            for i in 1..n {
                result[s][r] = result[s][r] + image[i] * V::constant(basis[s][i]);
            }
        }
    }
    result
}

/// Eigenvalues of `stiffness phi = lambda mass phi`, in the order of the unit vectors to which the eigenvectors are
/// close.
///
/// `mass` must be close to the identity and both matrices nearly diagonal, given below and on the diagonal. The flag
/// says that the rotations converged and that each eigenvector is close enough.
#[inline(always)]
pub(crate) fn eigenvalues<V: Lanes, const N: usize>(
    n: usize,
    stiffness: &Square<V, N>,
    mass: &Square<V, N>,
) -> (Row<V, N>, V) {
    let (lambda, _, flag) = rotated(n, stiffness, mass, RECOGNISED);
    (lambda, flag)
}

/// Like [`eigenvalues`], with the vectors, one per row, `phi^T mass phi = 1`; the flag requires them to be closer,
/// [`CLEAR`].
#[inline(always)]
pub(crate) fn eigenpairs<V: Lanes, const N: usize>(
    n: usize,
    stiffness: &Square<V, N>,
    mass: &Square<V, N>,
) -> (Row<V, N>, Square<V, N>, V) {
    let (lambda, images, flag) = rotated(n, stiffness, mass, CLEAR);
    let (factor, _) = factor(n, mass, 0.0);
    let mut vectors = [[V::constant(0.0); N]; N];
    for r in 0..n {
        let mut image = [V::constant(0.0); N];
        for i in 0..n {
            image[i] = images[i][r];
        }
        vectors[r] = solve(n, &factor, &image);
    }
    (lambda, vectors, flag)
}

/// Eigenvalues and, in each column, `mass phi` of the corresponding vector; the flag as above, for a squared cosine of
/// `least`.
#[inline(always)]
fn rotated<V: Lanes, const N: usize>(
    n: usize,
    stiffness: &Square<V, N>,
    mass: &Square<V, N>,
    least: f64,
) -> (Row<V, N>, Square<V, N>, V) {
    let (zero, one) = (V::constant(0.0), V::constant(1.0));
    // mass = L L^T; the rows of `vectors` are those of L, rotated later.
    let mut vectors = [[zero; N]; N];
    let mut flag = one;
    for i in 0..n {
        for j in 0..=i {
            let mut sum = mass[i][j];
            for k in 0..j {
                sum = sum - vectors[i][k] * vectors[j][k];
            }
            if j < i {
                vectors[i][j] = sum / vectors[j][j];
            } else {
                flag = keep(flag, V::constant(0.5).at_most(sum));
                vectors[i][i] = sum.sqrt();
            }
        }
    }
    // a = L^-1 stiffness L^-T
    let mut a = *stiffness;
    for i in 0..n {
        for j in 0..i {
            a[j][i] = a[i][j];
        }
    }
    for column in 0..n {
        for i in 0..n {
            for k in 0..i {
                a[i][column] = a[i][column] - vectors[i][k] * a[k][column];
            }
            a[i][column] = a[i][column] / vectors[i][i];
        }
    }
    for row in &mut a[..n] {
        for i in 0..n {
            for k in 0..i {
                row[i] = row[i] - vectors[i][k] * row[k];
            }
            row[i] = row[i] / vectors[i][i];
        }
    }
    for i in 0..n {
        for j in 0..i {
            let mean = (a[i][j] + a[j][i]) * V::constant(0.5);
            (a[i][j], a[j][i]) = (mean, mean);
        }
    }
    let mut at_rest = zero;
    for _ in 0..SWEEPS {
        at_rest = one;
        for p in 0..n {
            for q in p + 1..n {
                let small = rotate(n, &mut a, &mut vectors, p, q);
                at_rest = keep(at_rest, small);
            }
        }
        if V::every(one.at_most(at_rest)) {
            break;
        }
    }
    flag = keep(flag, one.at_most(at_rest));
    for r in 0..n {
        let share = vectors[r][r] * vectors[r][r];
        flag = keep(flag, (mass[r][r] * V::constant(least)).at_most(share));
    }
    let mut lambda = [zero; N];
    for (r, lambda) in lambda[..n].iter_mut().enumerate() {
        *lambda = a[r][r];
    }
    (lambda, vectors, flag)
}

/// Rotates in the plane of `p` and `q` by the small angle that makes `a_pq` zero. Where it already counts as zero
/// nothing changes, as the returned mask says, so that lanes do not affect each other.
#[inline(always)]
fn rotate<V: Lanes, const N: usize>(
    n: usize,
    a: &mut Square<V, N>,
    vectors: &mut Square<V, N>,
    p: usize,
    q: usize,
) -> V::Mask {
    let (zero, one) = (V::constant(0.0), V::constant(1.0));
    let off = a[p][q];
    let small = (off * off).at_most((a[p][p] * a[q][q]).abs() * V::constant(NEGLIGIBLE));
    let half = (a[q][q] - a[p][p]) * V::constant(0.5);
    let root = (half * half + off * off).sqrt();
    let tangent = off / (half + V::choose(zero.at_most(half), root, -root));
    let tangent = V::choose(small, zero, tangent);
    let cosine = one / (one + tangent * tangent).sqrt();
    let sine = tangent * cosine;
    a[p][p] = a[p][p] - tangent * off;
    a[q][q] = a[q][q] + tangent * off;
    (a[p][q], a[q][p]) = (zero, zero);
    for k in 0..n {
        if k != p && k != q {
            let (x, y) = (a[k][p], a[k][q]);
            (a[k][p], a[k][q]) = (cosine * x - sine * y, sine * x + cosine * y);
            (a[p][k], a[q][k]) = (a[k][p], a[k][q]);
        }
    }
    for row in &mut vectors[..n] {
        let (x, y) = (row[p], row[q]);
        (row[p], row[q]) = (cosine * x - sine * y, sine * x + cosine * y);
    }
    small
}
