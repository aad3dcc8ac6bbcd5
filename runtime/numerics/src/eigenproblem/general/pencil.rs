//! A scaled pencil `Q(s) = s^2 M + s C + K`, quadratic or first-order, and its products with vectors.

use num_complex::Complex64;

use crate::algebra::for_size;
use crate::scalar::Real;

/// `Q(s) = s^2 M + s C + K`, with matrices row by row; a first-order pencil has `M = 0`, `C = I`.
pub(super) struct Pencil<'a> {
    pub(super) n: usize,
    pub(super) degree: Degree,
    pub(super) mass: &'a [f64],
    pub(super) damping: &'a [f64],
    pub(super) stiffness: &'a [f64],
    /// All three matrices again, column by column.
    pub(super) transposed: [&'a [f64]; 3],
    /// Largest element of each matrix.
    pub(super) largest: [f64; 3],
}

/// The highest power of `s` in a pencil.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Degree {
    One,
    Two,
}

impl Degree {
    /// Number of eigenvalues of a pencil of size `n`.
    pub(crate) fn eigenvalues(self, n: usize) -> usize {
        match self {
            Self::One => n,
            Self::Two => 2 * n,
        }
    }
}

/// Products of the three matrices with one vector, and the sums of the absolute terms in them.
pub(super) struct Products<'a> {
    pub(super) mass: &'a mut [Complex64],
    pub(super) damping: &'a mut [Complex64],
    pub(super) stiffness: &'a mut [Complex64],
    mass_terms: &'a mut [f64],
    damping_terms: &'a mut [f64],
    stiffness_terms: &'a mut [f64],
    /// Room for the parts of a vector.
    parts: &'a mut [f64],
}

/// A cheap bound on `|z|`, exact for real numbers and at most `sqrt(2) |z|`.
#[inline]
pub(super) fn bound(z: Complex64) -> f64 {
    z.re.abs() + z.im.abs()
}

/// `|z|` for numbers of a scaled pencil, whose squares are within range.
#[inline]
pub(super) fn modulus(z: Complex64) -> f64 {
    z.norm_sqr().sqrt()
}

impl Pencil<'_> {
    /// Writes `Q(s)` to `q`.
    pub(super) fn at(&self, s: Complex64, q: &mut [Complex64]) {
        let square = s * s;
        for (i, q) in q.iter_mut().enumerate() {
            let (m, c) = (self.mass[i], self.damping[i]);
            *q = Complex64::new(square.re * m + (s.re * c + self.stiffness[i]), square.im * m + s.im * c);
        }
    }

    /// `(2 s M + C) x`, or `(2 s M + C)^T x`.
    pub(super) fn slope_times(&self, s: Complex64, x: &[Complex64], transposed: bool, into: &mut [Complex64]) {
        let [mass, damping, _] = self.matrices(transposed);
        for_size(
            self.n,
            #[inline(always)]
            |n| {
                let (x, into) = (&x[..n], &mut into[..n]);
                let (mass, damping) = (&mass[..n * n], &damping[..n * n]);
                for i in 0..n {
                    let (mut m, mut c) = (Complex64::ZERO, Complex64::ZERO);
                    for j in 0..n {
                        m += x[j] * mass[i * n + j];
                        c += x[j] * damping[i * n + j];
                    }
                    into[i] = s * m * 2.0 + c;
                }
            },
        );
    }

    fn matrices(&self, transposed: bool) -> [&[f64]; 3] {
        if transposed { self.transposed } else { [self.mass, self.damping, self.stiffness] }
    }

    /// Products with `x` from the right or with `x^T` from the left.
    pub(super) fn multiply(&self, x: &[Complex64], transposed: bool, into: &mut Products) {
        let matrices = self.matrices(transposed);
        if self.n > SMALL {
            f64::run(
                #[inline(always)]
                || large_products(matrices, x, into),
            );
            return;
        }
        for_size(
            self.n,
            #[inline(always)]
            |n| products(n, matrices, x, into),
        );
    }

    /// Size of the terms of `2 s M + C`.
    pub(super) fn slope_size(&self, s: Complex64) -> f64 {
        2.0 * bound(s) * self.largest[0] + self.largest[1]
    }

    /// Size of the eigenvalue change that a change of `Q(s)` as a whole could cause.
    pub(super) fn rate(&self, s: Complex64) -> f64 {
        match self.degree {
            Degree::One => self.size(s) / self.largest[1],
            Degree::Two => (self.size(s) / self.largest[0]).sqrt(),
        }
    }

    /// Product of a vector with the matrix that normalises vectors, the one of the highest power of `s`.
    pub(super) fn weighed<'p>(&self, products: &'p Products) -> &'p [Complex64] {
        match self.degree {
            Degree::One => products.damping,
            Degree::Two => products.mass,
        }
    }

    /// Largest elements of `M`, `C` and `K` weighted with powers of `|s|`: the size of the terms of `Q(s)`.
    pub(super) fn size(&self, s: Complex64) -> f64 {
        let size = bound(s);
        size * size * self.largest[0] + size * self.largest[1] + self.largest[2]
    }
}

#[inline(always)]
fn products(n: usize, matrices: [&[f64]; 3], x: &[Complex64], into: &mut Products) {
    let (x, [mass, damping, stiffness]) = (&x[..n], matrices);
    for (matrix, sums, terms) in [
        (mass, &mut *into.mass, &mut *into.mass_terms),
        (damping, into.damping, into.damping_terms),
        (stiffness, into.stiffness, into.stiffness_terms),
    ] {
        let (matrix, sums, terms) = (&matrix[..n * n], &mut sums[..n], &mut terms[..n]);
        for i in 0..n {
            let (mut sum, mut size) = (Complex64::ZERO, 0.0);
            for j in 0..n {
                let element = matrix[i * n + j];
                sum += x[j] * element;
                size += bound(x[j]) * element.abs();
            }
            (sums[i], terms[i]) = (sum, size);
        }
    }
}

/// Like [`products`], with the parts of `x` in vectors of their own, and several terms of a sum side by side.
#[inline(always)]
fn large_products(matrices: [&[f64]; 3], x: &[Complex64], into: &mut Products) {
    let n = x.len();
    let (re, rest) = into.parts.split_at_mut(n);
    let (im, size) = rest.split_at_mut(n);
    for (i, &x) in x.iter().enumerate() {
        (re[i], im[i], size[i]) = (x.re, x.im, bound(x));
    }
    for (matrix, sums, terms) in [
        (matrices[0], &mut *into.mass, &mut *into.mass_terms),
        (matrices[1], into.damping, into.damping_terms),
        (matrices[2], into.stiffness, into.stiffness_terms),
    ] {
        let rows = matrix.chunks_exact(n);
        for ((row, sum), terms) in rows.zip(sums).zip(terms) {
            let mut parts = [[0.0; PARTS]; 3];
            let (row, row_rest) = row.as_chunks::<PARTS>();
            let (re, re_rest) = re.as_chunks::<PARTS>();
            let (im, im_rest) = im.as_chunks::<PARTS>();
            let (size, size_rest) = size.as_chunks::<PARTS>();
            for (((a, re), im), size) in row.iter().zip(re).zip(im).zip(size) {
                for k in 0..PARTS {
                    parts[0][k] += a[k] * re[k];
                    parts[1][k] += a[k] * im[k];
                    parts[2][k] += a[k].abs() * size[k];
                }
            }
            let [mut of_re, mut of_im, mut of_size] = parts.map(|x| (x[0] + x[2]) + (x[1] + x[3]));
            for (((a, re), im), size) in row_rest.iter().zip(re_rest).zip(im_rest).zip(size_rest) {
                of_re += a * re;
                of_im += a * im;
                of_size += a.abs() * size;
            }
            (*sum, *terms) = (Complex64::new(of_re, of_im), of_size);
        }
    }
}

/// Up to this size, the order of the sums is that of the indices.
const SMALL: usize = 8;
/// Terms of a sum that are summed side by side.
const PARTS: usize = 4;

impl<'a> Products<'a> {
    /// Uses `3 n` complex and `6 n` real numbers.
    pub(super) fn new(n: usize, complex: &'a mut [Complex64], real: &'a mut [f64]) -> Self {
        let (mass, complex) = complex.split_at_mut(n);
        let (damping, stiffness) = complex.split_at_mut(n);
        let (mass_terms, real) = real.split_at_mut(n);
        let (damping_terms, real) = real.split_at_mut(n);
        let (stiffness_terms, parts) = real.split_at_mut(n);
        Self { mass, damping, stiffness, mass_terms, damping_terms, stiffness_terms, parts }
    }

    pub(super) fn scale(&mut self, factor: f64) {
        for products in [&mut *self.mass, self.damping, self.stiffness] {
            products.iter_mut().for_each(|x| *x *= factor);
        }
        for terms in [&mut *self.mass_terms, self.damping_terms, self.stiffness_terms] {
            terms.iter_mut().for_each(|x| *x *= factor);
        }
    }

    /// Component `i` of `Q(s) x`.
    #[inline]
    pub(super) fn value(&self, s: Complex64, i: usize) -> Complex64 {
        s * (s * self.mass[i] + self.damping[i]) + self.stiffness[i]
    }

    /// Component `i` of `(2 s M + C) x`.
    #[inline]
    pub(super) fn slope(&self, s: Complex64, i: usize) -> Complex64 {
        s * self.mass[i] * 2.0 + self.damping[i]
    }

    /// Sum of the absolute terms in component `i` of `Q(s) x`.
    #[inline]
    pub(super) fn terms(&self, s: Complex64, i: usize) -> f64 {
        let size = bound(s);
        size * (size * self.mass_terms[i] + self.damping_terms[i]) + self.stiffness_terms[i]
    }

    /// Sum of the absolute terms in component `i` of `(2 s M + C) x`.
    #[inline]
    pub(super) fn slope_terms(&self, s: Complex64, i: usize) -> f64 {
        2.0 * bound(s) * self.mass_terms[i] + self.damping_terms[i]
    }

    /// Sum of the absolute terms in component `i` of `M x`.
    #[inline]
    pub(super) fn mass_terms(&self, i: usize) -> f64 {
        self.mass_terms[i]
    }
}
