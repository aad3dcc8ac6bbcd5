//! A scaled pencil `Q(s) = s^2 M + s C + K`, quadratic or of first order, and what one pair of vectors says about it.

use num_complex::Complex64;

/// `Q(s) = s^2 M + s C + K`, matrices row by row; of first order `M = 0`, `C = I`.
pub(super) struct Pencil<'a> {
    pub(super) n: usize,
    pub(super) degree: Degree,
    pub(super) mass: &'a [f64],
    pub(super) damping: &'a [f64],
    pub(super) stiffness: &'a [f64],
    /// Greatest element of each.
    pub(super) largest: [f64; 3],
}

/// The greatest power of `s` in a pencil.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Degree {
    One,
    Two,
}

impl Degree {
    /// Number of eigenvalues of a pencil of size `n`.
    pub(super) fn eigenvalues(self, n: usize) -> usize {
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
}

/// A cheap bound on `|z|`, exact for real numbers and at most `sqrt(2) |z|`.
pub(super) fn bound(z: Complex64) -> f64 {
    z.re.abs() + z.im.abs()
}

/// `|z|` for numbers of a scaled pencil, whose squares are within range.
pub(super) fn modulus(z: Complex64) -> f64 {
    z.norm_sqr().sqrt()
}

impl Pencil<'_> {
    /// `Q(s)` into `q`.
    pub(super) fn at(&self, s: Complex64, q: &mut [Complex64]) {
        let square = s * s;
        for (i, q) in q.iter_mut().enumerate() {
            let (m, c) = (self.mass[i], self.damping[i]);
            *q = Complex64::new(
                square.re * m + (s.re * c + self.stiffness[i]),
                square.im * m + s.im * c,
            );
        }
    }

    /// Products with `x` from the right, or with `x^T` from the left.
    pub(super) fn multiply(&self, x: &[Complex64], transposed: bool, into: &mut Products) {
        let n = self.n;
        let (across, along) = if transposed { (1, n) } else { (n, 1) };
        for i in 0..n {
            let mut sums = [Complex64::ZERO; 3];
            let mut terms = [0.0; 3];
            for (j, &x) in x.iter().enumerate() {
                let at = i * across + j * along;
                let size = bound(x);
                let elements = [self.mass[at], self.damping[at], self.stiffness[at]];
                for (k, element) in elements.into_iter().enumerate() {
                    sums[k] += x * element;
                    terms[k] += size * element.abs();
                }
            }
            [into.mass[i], into.damping[i], into.stiffness[i]] = sums;
            [
                into.mass_terms[i],
                into.damping_terms[i],
                into.stiffness_terms[i],
            ] = terms;
        }
    }

    /// The size of what `2 s M + C` is summed from.
    pub(super) fn slope_size(&self, s: Complex64) -> f64 {
        2.0 * bound(s) * self.largest[0] + self.largest[1]
    }

    /// Size of the eigenvalues that a change of `Q(s)` as a whole could make.
    pub(super) fn rate(&self, s: Complex64) -> f64 {
        match self.degree {
            Degree::One => self.size(s) / self.largest[1],
            Degree::Two => (self.size(s) / self.largest[0]).sqrt(),
        }
    }

    /// Product of a vector with the matrix that measures vectors: of the greatest power of `s`.
    pub(super) fn weighed<'p>(&self, products: &'p Products) -> &'p [Complex64] {
        match self.degree {
            Degree::One => products.damping,
            Degree::Two => products.mass,
        }
    }

    /// Greatest elements of `M`, `C` and `K` weighed with `|s|`: the size of what `Q(s)` is summed from.
    pub(super) fn size(&self, s: Complex64) -> f64 {
        let size = bound(s);
        size * size * self.largest[0] + size * self.largest[1] + self.largest[2]
    }
}

impl<'a> Products<'a> {
    /// Takes `3 n` complex and `3 n` real numbers.
    pub(super) fn new(n: usize, complex: &'a mut [Complex64], real: &'a mut [f64]) -> Self {
        let (mass, complex) = complex.split_at_mut(n);
        let (damping, stiffness) = complex.split_at_mut(n);
        let (mass_terms, real) = real.split_at_mut(n);
        let (damping_terms, stiffness_terms) = real.split_at_mut(n);
        Self {
            mass,
            damping,
            stiffness,
            mass_terms,
            damping_terms,
            stiffness_terms,
        }
    }

    pub(super) fn scale(&mut self, factor: f64) {
        for products in [&mut *self.mass, self.damping, self.stiffness] {
            products.iter_mut().for_each(|x| *x *= factor);
        }
        for terms in [
            &mut *self.mass_terms,
            self.damping_terms,
            self.stiffness_terms,
        ] {
            terms.iter_mut().for_each(|x| *x *= factor);
        }
    }

    /// Component `i` of `Q(s) x`.
    pub(super) fn value(&self, s: Complex64, i: usize) -> Complex64 {
        s * (s * self.mass[i] + self.damping[i]) + self.stiffness[i]
    }

    /// Component `i` of `(2 s M + C) x`.
    pub(super) fn slope(&self, s: Complex64, i: usize) -> Complex64 {
        s * self.mass[i] * 2.0 + self.damping[i]
    }

    /// Sum of the absolute terms in component `i` of `Q(s) x`.
    pub(super) fn terms(&self, s: Complex64, i: usize) -> f64 {
        let size = bound(s);
        size * (size * self.mass_terms[i] + self.damping_terms[i]) + self.stiffness_terms[i]
    }

    /// Sum of the absolute terms in component `i` of `(2 s M + C) x`.
    pub(super) fn slope_terms(&self, s: Complex64, i: usize) -> f64 {
        2.0 * bound(s) * self.mass_terms[i] + self.damping_terms[i]
    }

    /// Sum of the absolute terms in component `i` of `M x`.
    pub(super) fn mass_terms(&self, i: usize) -> f64 {
        self.mass_terms[i]
    }
}
