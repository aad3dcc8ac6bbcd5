//! Eigenproblems without the zeros of free directions.
//!
//! Along directions `Z` that nothing resists, with `W^T K = 0`, a pencil has zeros that no solver finds to better than
//! the root of rounding, because most are double: such a motion drifts. They are taken out exactly. Where also
//! `W^T C Z = 0`, the equations `W^T` divided by `s` give `W^T (s M + C) phi = 0`. With `phi = Y e + Z a` and
//! `A = (W^T M Z)^-1` they determine `s a = -A W^T (s M + C) Y e`, and the other equations become a pencil of `e`,
//!
//! ```text
//! M' = V^T (M - M Z A W^T M) Y
//! C' = V^T (C - M Z A W^T C - C Z A W^T M) Y
//! K' = V^T (K - C Z A W^T C) Y
//! ```
//!
//! where `V` and `Y` complete `W` and `Z`. It has the other eigenvalues, and the symmetries of the first if `V = Y`, which
//! selects coordinates, completes both. Where `W` differs from `Z`, as under follower loads, `V = Y - Z A W^T M Y`: so
//! `M' = V^T M V` is symmetric and positive definite as `M` is. A motion that is damped but not held (`W^T C Z` regular)
//! has a single zero, which stays in the pencil.
//!
//! # Zeros are taken out exactly
//!
//! A motion that drifts has a double zero, which no solver finds to better than the root of rounding. With the free
//! directions known, `modes/deflation.rs` writes the pencil of the other motions, with the same symmetries; its roots
//! are as accurate as if the zeros had never been there. The rolling and coasting system of first order loses its zeros
//! in the same way.
//!
//! Under a thrust that turns with a free machine, `W^T M Z` may be singular: a turn of the whole, which nothing resists,
//! accelerates it across, and the zero of this motion has a chain of four vectors. There is no pencil without it, but
//! the system of first order loses two more zeros in the same way, as often as there are any.
#![allow(clippy::needless_range_loop, reason = "index loops read as the formulas they are")]

use std::borrow::Cow;

use num_complex::Complex64;

use crate::algebra::{Lu, Matrix, Vector, add_to, dot, is_symmetric, times};
use crate::eigenproblem::{EigenproblemError, Pairs, Root, symmetric};
use crate::free::NullSpace;
use crate::kernels::Linear;
use crate::rounding::of_form;

/// Share of its terms below which a damping of a free direction counts as zero.
const UNDAMPED: f64 = 1e-10;
/// Square of a component of a null vector below which it counts as zero.
const NOTHING: f64 = 1e-24;
/// What elimination may leave of a matrix along its zeros, relative to the terms in it.
const REMAINDER: f64 = 1e-6;

/// The pencil of a mechanism without the zeros of motions that drift.
struct Deflated<'a> {
    linear: &'a Linear,
    /// `Z` and `W`.
    right: Vec<Vector>,
    left: Vec<Vector>,
    /// `A`.
    inverse: Matrix,
    /// The coordinates that `Y` selects.
    kept: Vec<usize>,
    /// `V`, one vector for each; `None` if it is `Y`.
    test: Option<Vec<Vector>>,
}

impl<'a> Deflated<'a> {
    /// Without these directions; `None` if there are none, or if they move no mass.
    fn new(linear: &'a Linear, (right, left): (Vec<Vector>, Vec<Vector>)) -> Option<Self> {
        if right.is_empty() {
            return None;
        }
        let mass = &linear.mass;
        let inverse = inverse(&product(&left, mass, &right))?;
        let size = Vector::from_fn(mass.row_count(), |i| mass[i][i].abs().sqrt());
        let kept = others(right.iter().map(|x: &Vector| x.iter().zip(&size).map(|(x, size)| x * size).collect()));
        let mut deflated = Self { linear, right, left, inverse, kept, test: None };
        if deflated.left != deflated.right {
            deflated.test = Some(deflated.projected());
        }
        Some(deflated)
    }

    /// `Y - Z A W^T M Y`.
    fn projected(&self) -> Vec<Vector> {
        let mass = &self.linear.mass;
        let images: Vec<Vector> = self.left.iter().map(|w| times_left(w, mass)).collect();
        let vector = |&kept: &usize| {
            let mut vector = Vector::zeros(mass.row_count());
            vector[kept] = 1.0;
            for (row, z) in self.inverse.iter().zip(&self.right) {
                let amount: f64 = row.iter().zip(&images).map(|(inverse, image)| inverse * image[kept]).sum();
                add_to(&mut vector, -amount, z);
            }
            vector
        };
        self.kept.iter().map(vector).collect()
    }

    fn pencil(&self) -> Linear {
        let Linear { mass, damping, stiffness } = self.linear;
        let (m, c) = (self.images(mass), self.images(damping));
        let kept = &self.kept;
        let block = |matrix: &Matrix, pairs: &[(&Images, &Images)]| {
            let element = |i: usize, j: usize| {
                pairs.iter().fold(matrix[i][j], |sum, (of_right, of_left)| sum - self.coupling(of_right, of_left, i, j))
            };
            let Some(test) = &self.test else {
                let mut reduced = Matrix::from_fn(kept.len(), kept.len(), |i, j| element(kept[i], kept[j]));
                restore_symmetry(&mut reduced, matrix);
                return reduced;
            };
            let rows = Matrix::from_fn(kept.len(), matrix.row_count(), |j, i| element(i, kept[j]));
            Matrix::from_fn(kept.len(), kept.len(), |i, j| dot(&test[i], &rows[j]))
        };
        let mut pencil = Linear {
            mass: block(mass, &[(&m, &m)]),
            damping: block(damping, &[(&m, &c), (&c, &m)]),
            stiffness: block(stiffness, &[(&c, &c)]),
        };
        restore_symmetry(&mut pencil.mass, mass);
        pencil
    }

    /// `matrix Z` and `W^T matrix`.
    fn images(&self, matrix: &Matrix) -> Images {
        Images {
            right: self.right.iter().map(|z| times(matrix, z)).collect(),
            left: self.left.iter().map(|w| times_left(w, matrix)).collect(),
        }
    }

    /// Element `i`, `j` of `P Z A W^T Q`.
    fn coupling(&self, p: &Images, q: &Images, i: usize, j: usize) -> f64 {
        let mut sum = 0.0;
        for (a, of_right) in p.right.iter().enumerate() {
            for (b, of_left) in q.left.iter().enumerate() {
                sum += of_right[i] * self.inverse[a][b] * of_left[j];
            }
        }
        sum
    }

    /// `phi` of `e`.
    fn right(&self, s: Complex64, e: &[Complex64]) -> Vector<Complex64> {
        let mut phi = placed(self.linear.mass.column_count(), &self.kept, e);
        let along: Vec<Complex64> = (self.left.iter())
            .map(|w| {
                let terms = times_left(w, &self.linear.mass);
                let damping = times_left(w, &self.linear.damping);
                product_with(&terms, &phi) + product_with(&damping, &phi) / s
            })
            .collect();
        for (a, z) in self.right.iter().enumerate() {
            let amount: Complex64 = self.inverse[a].iter().zip(&along).map(|(inverse, along)| along * inverse).sum();
            for (phi, z) in phi.iter_mut().zip(z) {
                *phi -= amount * z;
            }
        }
        phi
    }

    /// `psi` of the left vector of the deflated pencil.
    fn left(&self, s: Complex64, e: &[Complex64]) -> Vector<Complex64> {
        let mut psi = match &self.test {
            None => placed(self.linear.mass.row_count(), &self.kept, e),
            Some(test) => {
                let mut psi = Vector::zeros(self.linear.mass.row_count());
                for (amount, vector) in e.iter().zip(test) {
                    psi.iter_mut().zip(vector).for_each(|(psi, value)| *psi += amount * value);
                }
                psi
            }
        };
        let along: Vec<Complex64> = (self.right.iter())
            .map(|z| {
                let terms = times(&self.linear.mass, z);
                let damping = times(&self.linear.damping, z);
                product_with(&terms, &psi) + product_with(&damping, &psi) / s
            })
            .collect();
        for (b, w) in self.left.iter().enumerate() {
            let amount: Complex64 = along.iter().enumerate().map(|(a, along)| along * self.inverse[a][b]).sum();
            for (psi, w) in psi.iter_mut().zip(w) {
                *psi -= amount * w;
            }
        }
        psi
    }
}

struct Images {
    right: Vec<Vector>,
    left: Vec<Vector>,
}

/// The pencil without the zeros of motions that drift, itself if there are none; `None` if some of these motions drift
/// faster and faster, for which there is no such pencil.
pub(crate) fn deflated(linear: &Linear, count: usize) -> Option<Cow<'_, Linear>> {
    let Some(split) = Split::new(linear, count) else {
        return Some(Cow::Borrowed(linear));
    };
    if split.accelerates(linear) {
        return None;
    }
    let deflated = Deflated::new(linear, split.drifting).map(|deflated| deflated.pencil());
    Some(deflated.map_or(Cow::Borrowed(linear), Cow::Owned))
}

/// Whether motions along `count` free directions drift faster and faster: their roots are those of a system of first
/// order.
pub(crate) fn accelerates(linear: &Linear, count: usize) -> bool {
    Split::new(linear, count).is_some_and(|split| split.accelerates(linear))
}

/// The roots of a pencil with `count` free directions, those of the motions that drift first; `solve` finds the roots
/// of the rest.
pub(crate) fn roots(
    linear: &Linear,
    count: usize,
    solve: impl FnOnce(&Linear) -> Result<Vec<Root>, EigenproblemError>,
) -> Result<Vec<Root>, EigenproblemError> {
    let Some(split) = Split::new(linear, count) else {
        return solve(linear);
    };
    let standing = |(right, left): &(Vec<Vector>, Vec<Vector>)| -> Vec<Root> {
        right.iter().zip(left).map(|(z, w)| standing(z, w)).collect()
    };
    let damped = standing(&split.damped);
    let drifting = standing(&split.drifting);
    let zeros = damped.len();
    let (mut zero_roots, rest) = match Deflated::new(linear, split.drifting) {
        Some(deflated) => {
            let mut rest = solve(&deflated.pencil())?;
            for root in rest.iter_mut().skip(zeros) {
                root.right = deflated.right(root.s, &root.right);
                root.left = deflated.left(root.s, &root.left);
            }
            (drifting, rest)
        }
        None => (Vec::new(), solve(linear)?),
    };
    zero_roots.extend(damped);
    // The smallest of the others are the zeros of the damped motions, known exactly.
    zero_roots.extend(rest.into_iter().skip(zeros));
    for root in &mut zero_roots {
        for vector in [&mut root.right, &mut root.left] {
            super::normalisation::normalise_by_mass(vector, &linear.mass);
        }
    }
    Ok(zero_roots)
}

/// The eigenpairs of symmetric matrices with `count` free directions, which come first.
#[inline(always)]
pub(crate) fn pairs(
    stiffness: &Matrix,
    mass: &Matrix,
    count: usize,
    pairs: &mut Pairs,
) -> Result<(), EigenproblemError> {
    if count == 0 {
        return symmetric::solve_into(stiffness, mass, pairs);
    }
    pairs_with_zeros(stiffness, mass, count, pairs)
}

fn pairs_with_zeros(
    stiffness: &Matrix,
    mass: &Matrix,
    count: usize,
    pairs: &mut Pairs,
) -> Result<(), EigenproblemError> {
    let n = mass.row_count();
    let linear = Linear { mass: mass.clone(), damping: Matrix::zeros(n, n), stiffness: stiffness.clone() };
    let split = Split::new(&linear, count);
    let Some(deflated) = split.and_then(|split| Deflated::new(&linear, split.drifting)) else {
        return symmetric::solve_into(stiffness, mass, pairs);
    };
    let pencil = deflated.pencil();
    let mut rest = Pairs::default();
    symmetric::solve_into(&pencil.stiffness, &pencil.mass, &mut rest)?;
    let free = orthonormal_in(mass, &deflated.right);
    let zeros = || free.iter().map(|_| 0.0);
    pairs.lambda = zeros().chain(rest.lambda.iter().copied()).collect();
    pairs.errors = zeros().chain(rest.errors.iter().copied()).collect();
    pairs.residuals = zeros().chain(rest.residuals.iter().copied()).collect();
    pairs.shapes = Matrix::zeros(n, n);
    for (to, shape) in pairs.shapes.iter_mut().zip(&free) {
        to.copy_from_slice(shape);
    }
    for (to, shape) in pairs.shapes.iter_mut().skip(free.len()).zip(rest.shapes.iter()) {
        let shape = shape.iter().map(|x| Complex64::from(*x));
        // Without damping the vector does not depend on the eigenvalue.
        let lifted = deflated.right(Complex64::ONE, &shape.collect::<Vec<_>>());
        for (to, value) in to.iter_mut().zip(&lifted) {
            *to = value.re;
        }
    }
    // Elements of the smaller matrices are what is left of greater terms; those of the whole ones know their rounding.
    for r in free.len()..n {
        let (off, rounding) = quotient(&linear, pairs.lambda[r], &pairs.shapes[r]);
        if off.is_finite() {
            pairs.lambda[r] += off;
            pairs.errors[r] = pairs.errors[r].max(rounding + 2.0 * off.abs());
        }
    }
    for shape in pairs.shapes.iter_mut() {
        symmetric::fix_sign(shape);
    }
    Ok(())
}

/// `phi^T (K - lambda M) phi` and a bound on its rounding, per `phi^T M phi = 1`.
pub(super) fn quotient(linear: &Linear, lambda: f64, phi: &[f64]) -> (f64, f64) {
    let (k, m) = (times(&linear.stiffness, phi), times(&linear.mass, phi));
    let size = dot(phi, &m);
    let numerator = dot(phi, &k) - lambda * size;
    let rounding = of_form(&linear.stiffness, phi) + lambda.abs() * of_form(&linear.mass, phi);
    (numerator / size, rounding / size)
}

/// The roots of `A x = s x` with `count` free directions, which come first; `solve` finds the roots of the rest. The
/// elements of `A` are sums of `terms` of these sizes.
///
/// Along `A Z = 0` with `x = Y e + Z a`, the equations at the places that `Y` leaves out determine `s a`, and the others
/// become `A' e = s e`. If such a motion drifts, its zero is double, and `A'` still has the second one: it is taken out
/// in the same way. So are those after it, of a motion that a load accelerates which turns with another free one. Two
/// of these are a motion of its own that nothing resists.
pub(crate) fn first_order_roots(
    (matrix, terms): (&Matrix, &Matrix),
    count: usize,
    solve: impl FnOnce(&Matrix) -> Result<Vec<Root>, EigenproblemError>,
) -> Result<Vec<Root>, EigenproblemError> {
    let mut space = NullSpace::of(matrix, count);
    if count == 0 || space.remainder > REMAINDER {
        return solve(matrix);
    }
    let mut roots = Vec::new();
    let mut levels: Vec<WithoutZeros> = Vec::new();
    let mut left_over = count;
    while left_over > 0 && space.remainder <= REMAINDER {
        let (right, left) = (&space.right[..left_over], &space.left[..left_over]);
        // With the first zeros of motions that drift belong the second ones, with every third a fourth.
        if levels.len().is_multiple_of(2) {
            roots.extend(right.iter().zip(left).map(|(z, w)| {
                let mut root = standing(z, w);
                for level in levels.iter().rev() {
                    root.right = placed(level.size(), &level.kept, &root.right);
                    root.left = placed(level.size(), &level.kept, &root.left);
                }
                root
            }));
        }
        let whole = match levels.last() {
            Some(level) => (&level.matrix, &level.terms),
            None => (matrix, terms),
        };
        let next = left_over - NullSpace::rank(&products(&space, left_over));
        let rest = WithoutZeros::new(whole, &space, left_over);
        left_over = next;
        space = NullSpace::of(&rest.matrix, left_over);
        levels.push(rest);
    }
    let innermost = levels.last().map_or(matrix, |level| &level.matrix);
    for mut root in solve(innermost)? {
        let moved = levels.last().map(|level| level.moves(&root));
        root.error = moved.map_or(root.error, |moved| root.error.max(moved));
        for level in levels.iter().rev() {
            root.right = level.right(root.s, &root.right);
            root.left = level.left(&root.left);
        }
        roots.push(root);
    }
    Ok(roots)
}

/// A matrix without some of its zero eigenvalues.
struct WithoutZeros {
    matrix: Matrix,
    /// The sizes of the terms of its elements, which may cancel.
    terms: Matrix,
    /// `Z`.
    zeros: Vec<Vector>,
    kept: Vec<usize>,
    /// `(Z at the places left out)^-1`, one row for each vector.
    inverse: Matrix,
    left_out: Vec<usize>,
    /// The rows of the whole matrix at the places left out, over the places kept.
    rows: Matrix,
}

impl WithoutZeros {
    /// Without the first `count` zeros of its null space.
    fn new((whole, terms): (&Matrix, &Matrix), space: &NullSpace, count: usize) -> Self {
        let zeros = &space.right[..count];
        let kept = others(space.basis[..count].iter().cloned());
        let n = whole.row_count();
        let left_out: Vec<usize> = (0..n).filter(|i| !kept.contains(i)).collect();
        let at = Matrix::from_fn(left_out.len(), zeros.len(), |i, k| zeros[k][left_out[i]]);
        let inverse = inverse(&at).unwrap_or_default();
        let rows = Matrix::from_fn(left_out.len(), kept.len(), |i, j| whole[left_out[i]][kept[j]]);
        let amounts = Matrix::from_fn(zeros.len(), kept.len(), |k, j| {
            (0..left_out.len()).fold(0.0, |sum, i| sum + inverse[k][i] * rows[i][j])
        });
        let added = |first: &Matrix, size: fn(f64) -> f64| {
            Matrix::from_fn(kept.len(), kept.len(), |i, j| {
                let numbered = zeros.iter().enumerate();
                numbered.fold(first[kept[i]][kept[j]], |sum, (k, z)| sum + size(-z[kept[i]] * amounts[k][j]))
            })
        };
        Self {
            matrix: added(whole, |term| term),
            terms: added(terms, f64::abs),
            zeros: zeros.to_vec(),
            kept,
            inverse,
            left_out,
            rows,
        }
    }

    fn size(&self) -> usize {
        self.kept.len() + self.left_out.len()
    }

    /// How far the rounding of its elements may move an eigenvalue.
    fn moves(&self, root: &Root) -> f64 {
        let rate = root.left.iter().zip(&root.right).map(|(l, r)| l * r).sum::<Complex64>().norm();
        let moved = root.left.iter().zip(self.terms.iter()).fold(0.0, |sum, (l, row)| {
            sum + l.norm() * row.iter().zip(&root.right).map(|(term, r)| term * r.norm()).sum::<f64>()
        });
        f64::EPSILON * moved / rate
    }

    fn right(&self, s: Complex64, e: &[Complex64]) -> Vector<Complex64> {
        let mut x = placed(self.size(), &self.kept, e);
        let images: Vec<Complex64> = self.rows.iter().map(|row| product_with(row, e)).collect();
        for (k, z) in self.zeros.iter().enumerate() {
            let amount = product_with(&self.inverse[k], &images) / s;
            for (x, z) in x.iter_mut().zip(z) {
                *x += amount * z;
            }
        }
        x
    }

    fn left(&self, e: &[Complex64]) -> Vector<Complex64> {
        let mut y = placed(self.size(), &self.kept, e);
        let along: Vec<Complex64> = self.zeros.iter().map(|z| product_with(z, &y)).collect();
        for (i, &index) in self.left_out.iter().enumerate() {
            y[index] = -along.iter().enumerate().map(|(k, along)| along * self.inverse[k][i]).sum::<Complex64>();
        }
        y
    }
}

/// `W^T Z` of the first `count` null vectors, with what is rounding set to zero.
fn products(space: &NullSpace, count: usize) -> Matrix {
    // In the units of the elimination, in which the vectors are of order one.
    let clear = |(x, dual): (&f64, &f64)| if (x * dual).abs() <= NOTHING { 0.0 } else { *x };
    let cleared = |vectors: &[Vector], duals: &[Vector]| -> Vec<Vector> {
        vectors.iter().zip(duals).take(count).map(|(x, dual)| x.iter().zip(dual).map(clear).collect()).collect()
    };
    let right = cleared(&space.right, &space.rows);
    let left = cleared(&space.left, &space.columns);
    Matrix::from_fn(left.len(), right.len(), |i, j| {
        let terms = left[i].iter().zip(&right[j]).fold(0.0, |sum, (w, z)| sum + (w * z).abs());
        let product = dot(&left[i], &right[j]);
        if product.abs() <= UNDAMPED * terms { 0.0 } else { product }
    })
}

/// Whether a root is that of [`standing`].
pub(crate) fn is_standing(root: &Root) -> bool {
    root.s == Complex64::ZERO && root.condition.is_infinite()
}

/// The root of a motion along which the mechanism stays where it is put, or drifts.
fn standing(motion: &[f64], balance: &[f64]) -> Root {
    let complex = |x: &[f64]| x.iter().map(|x| Complex64::from(*x)).collect();
    Root {
        s: Complex64::ZERO,
        right: complex(motion),
        left: complex(balance),
        residual: 0.0,
        error: 0.0,
        condition: f64::INFINITY,
    }
}

/// Right and left free directions, split by whether damping couples them.
struct Split {
    drifting: (Vec<Vector>, Vec<Vector>),
    damped: (Vec<Vector>, Vec<Vector>),
}

impl Split {
    /// `None` if there are none.
    fn new(linear: &Linear, count: usize) -> Option<Self> {
        if count == 0 {
            return None;
        }
        // Where nothing resists more than these motions, which of them are meant is arbitrary.
        let NullSpace { right, left, remainder, .. } = NullSpace::of(&linear.stiffness, count);
        if remainder > REMAINDER {
            return None;
        }
        let coupled = product_without_rounding(&linear.damping, &right, &left);
        let space = NullSpace::of(&coupled, 0);
        let both = |of_right: &[Vector], of_left: &[Vector]| (combined(&right, of_right), combined(&left, of_left));
        let across = |space: &[Vector]| {
            let rows = Matrix::from_fn(right.len(), right.len(), |i, j| space.get(i).map_or(0.0, |x| x[j]));
            NullSpace::of(&rows, 0).right
        };
        Some(Self {
            drifting: both(&space.right, &space.left),
            damped: both(&across(&space.right), &across(&space.left)),
        })
    }

    /// Whether `W^T M Z` is singular: a motion that drifts turns a load, which accelerates another.
    fn accelerates(&self, linear: &Linear) -> bool {
        let (right, left) = &self.drifting;
        NullSpace::rank(&product_without_rounding(&linear.mass, right, left)) < right.len()
    }
}

/// `W^T matrix Z`, with what is rounding set to zero.
fn product_without_rounding(matrix: &Matrix, right: &[Vector], left: &[Vector]) -> Matrix {
    let mut coupled = product(left, matrix, right);
    let sizes = |all: &[Vector]| -> Vec<Vector> { all.iter().map(|x| x.map(f64::abs)).collect() };
    let terms = product(&sizes(left), &matrix.map(f64::abs), &sizes(right));
    for (entry, terms) in coupled.as_flattened_mut().iter_mut().zip(terms.as_flattened()) {
        if entry.abs() <= UNDAMPED * terms {
            *entry = 0.0;
        }
    }
    coupled
}

/// Sums of vectors by their shares.
fn combined(all: &[Vector], shares: &[Vector]) -> Vec<Vector> {
    let sum = |shares: &Vector| {
        let mut sum = Vector::zeros(all[0].len());
        for (share, vector) in shares.iter().zip(all) {
            add_to(&mut sum, *share, vector);
        }
        sum
    };
    shares.iter().map(sum).collect()
}

/// `W^T matrix Z`.
fn product(left: &[Vector], matrix: &Matrix, right: &[Vector]) -> Matrix {
    let images: Vec<Vector> = right.iter().map(|z| times(matrix, z)).collect();
    Matrix::from_fn(left.len(), right.len(), |i, j| dot(&left[i], &images[j]))
}

fn times_left(w: &[f64], matrix: &Matrix) -> Vector {
    let mut sum = Vector::zeros(matrix.column_count());
    for (w, row) in w.iter().zip(matrix.iter()) {
        add_to(&mut sum, *w, row);
    }
    sum
}

fn product_with(x: &[f64], y: &[Complex64]) -> Complex64 {
    x.iter().zip(y).map(|(x, y)| y * x).sum()
}

fn inverse(matrix: &Matrix) -> Option<Matrix> {
    let factors = Lu::new(matrix)?;
    let n = matrix.row_count();
    let unit = |k: usize| Vector::from_fn(n, |i| if i == k { 1.0 } else { 0.0 });
    let columns: Vec<Vector> = (0..n).map(|k| factors.solve(&unit(k))).collect();
    let mut inverted = Matrix::from_fn(n, n, |i, j| columns[j][i]);
    restore_symmetry(&mut inverted, matrix);
    Some(inverted)
}

/// Makes `matrix` exactly symmetric or skew-symmetric if `like` is.
fn restore_symmetry(matrix: &mut Matrix, like: &Matrix) {
    let skew = || (0..like.row_count()).all(|i| (0..=i).all(|j| like[i][j] == -like[j][i]));
    let sign = if is_symmetric(like) {
        1.0
    } else if skew() {
        -1.0
    } else {
        return;
    };
    for i in 0..matrix.row_count() {
        for j in 0..=i {
            let mean = 0.5 * (matrix[i][j] + sign * matrix[j][i]);
            (matrix[i][j], matrix[j][i]) = (mean, sign * mean);
        }
    }
}

/// Indices that remain after eliminating, for each vector, its largest remaining component (in comparable units).
fn others(vectors: impl IntoIterator<Item = Vector>) -> Vec<usize> {
    let mut rest: Vec<Vector> = vectors.into_iter().collect();
    let mut kept: Vec<usize> = (0..rest.first().map_or(0, |x| x.len())).collect();
    for k in 0..rest.len() {
        let weight = |i: usize| rest[k][i].abs();
        // A margin makes the first of equal ones win, regardless of rounding.
        let pivot =
            (kept.iter().copied()).reduce(|best, i| if weight(i) > weight(best) * (1.0 + 1e-9) { i } else { best });
        let Some(pivot) = pivot else {
            return kept;
        };
        kept.retain(|&i| i != pivot);
        let pivot_vector = rest[k].clone();
        for other in &mut rest[k + 1..] {
            let factor = -other[pivot] / pivot_vector[pivot];
            add_to(other, factor, &pivot_vector);
        }
    }
    kept
}

fn placed(n: usize, places: &[usize], values: &[Complex64]) -> Vector<Complex64> {
    let mut vector = Vector::zeros(n);
    for (&index, value) in places.iter().zip(values) {
        vector[index] = *value;
    }
    vector
}

/// Vectors made orthonormal in the mass matrix.
fn orthonormal_in(mass: &Matrix, vectors: &[Vector]) -> Vec<Vector> {
    let mut basis: Vec<Vector> = Vec::new();
    for vector in vectors {
        let mut vector = vector.clone();
        for _ in 0..2 {
            for other in &basis {
                let along = dot(&times(mass, other), &vector);
                add_to(&mut vector, -along, other);
            }
        }
        let size = dot(&vector, &times(mass, &vector)).sqrt();
        basis.push(vector.map(|value| value / size));
    }
    basis
}
