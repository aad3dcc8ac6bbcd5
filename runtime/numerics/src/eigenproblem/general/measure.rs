//! How accurate an eigenvalue is, judged from its pair of vectors.

use num_complex::Complex64;

use super::pencil::{Pencil, Products, bound, modulus};
use super::solver::PairSolver;
use crate::algebra::for_size;

/// Terms below this are zero in a scaled pencil.
const NOTHING: f64 = 1e-60;
/// Values below this may be zero in a scaled pencil.
pub(super) const ZERO: f64 = 1e-30;

/// An eigenvalue with its measured accuracy.
#[derive(Clone, Copy)]
pub(super) struct Pair {
    pub(super) s: Complex64,
    /// It represents itself and its conjugate.
    pub(super) conjugate: bool,
    /// Newton step from `s`.
    pub(super) newton: Complex64,
    /// `psi^T (2 s M + C) phi`.
    pub(super) slope: Complex64,
    /// Sums of the absolute terms in `psi^T (2 s M + C) phi` and in `psi^T M phi`.
    pub(super) slope_terms: f64,
    pub(super) mass_terms: f64,
    /// Bound on the rounding in `psi^T Q(s) phi`.
    pub(super) rounding: f64,
    /// Distance within which `Q` is the same up to rounding.
    pub(super) reach: f64,
    /// The same distance, based on the largest elements of the matrices.
    pub(super) reach_overall: f64,
    /// Second-order error, from the residuals of both vectors.
    pub(super) second: f64,
    /// Product of the sizes of both residuals.
    pub(super) product: f64,
    /// Largest relative residual of the two vectors.
    pub(super) residual: f64,
    /// It represents a cluster, whose error is known.
    pub(super) merged: bool,
    pub(super) condition: f64,
    pub(super) error: f64,
}

impl Pair {
    pub(super) const NONE: Self = Self {
        s: Complex64::ZERO,
        conjugate: false,
        newton: Complex64::ZERO,
        slope: Complex64::ZERO,
        slope_terms: 0.0,
        mass_terms: 0.0,
        rounding: 0.0,
        reach: 0.0,
        reach_overall: 0.0,
        second: 0.0,
        product: 0.0,
        residual: 0.0,
        merged: false,
        condition: 1.0,
        error: 0.0,
    };

    /// First-order error of `s` caused by rounding of the pencil's elements.
    pub(super) fn doubt(&self) -> f64 {
        if self.rounding == 0.0 { 0.0 } else { self.rounding / modulus(self.slope) }
    }

    /// Whether the next step would be pure rounding.
    pub(super) fn is_settled(&self) -> bool {
        modulus(self.newton) * self.slope_terms <= 4.0 * self.rounding
    }

    /// Second-order error of the eigenvalue from the residuals of both vectors, where `neighbour` is the smallest pivot
    /// apart from the vanishing one.
    pub(super) fn second_order(&self, neighbour: f64) -> f64 {
        if self.product == 0.0 || neighbour == f64::INFINITY {
            0.0
        } else {
            self.product / (neighbour * modulus(self.slope))
        }
    }

    /// Rounding of `s` itself.
    pub(super) fn rounding(&self) -> f64 {
        f64::EPSILON * modulus(self.s) + ZERO
    }

    /// Distance within which the eigenvalue lies, unless it is almost multiple or the vectors belong to another one.
    pub(super) fn radius(&self) -> f64 {
        let radius = 2.0 * (self.doubt() + modulus(self.newton)) + self.second;
        radius.min(1e6 * self.reach_overall)
    }
}

impl PairSolver<'_> {
    /// Normalises both vectors and measures them with `s`.
    pub(super) fn examine(&mut self, s: Complex64, right: &mut [Complex64], left: &mut [Complex64]) -> Pair {
        self.pencil.multiply(right, false, &mut self.of_right);
        normalise(&self.pencil, right, &mut self.of_right);
        self.pencil.multiply(left, true, &mut self.of_left);
        normalise(&self.pencil, left, &mut self.of_left);
        self.measure(s, left)
    }

    /// Measures `s` with vectors whose products are already computed.
    pub(super) fn measure(&self, s: Complex64, left: &[Complex64]) -> Pair {
        let n = self.pencil.n;
        let Sums { value, slope, terms, slope_terms, mass_terms, by_right, by_left } = for_size(
            n,
            #[inline(always)]
            |n| Sums::of(n, s, left, &self.of_right, &self.of_left),
        );
        let residual = by_right.relative().max(by_left.relative());
        let rounding = self.relative() * (terms + NOTHING);
        let overall = 16.0 * n as f64 * f64::EPSILON * self.pencil.size(s);
        let reach_overall = reach(overall, self.pencil.slope_size(s), self.pencil.largest[0]);
        Pair {
            s,
            newton: if value == Complex64::ZERO {
                value
            } else if slope == Complex64::ZERO {
                Complex64::new(f64::INFINITY, 0.0)
            } else {
                value / slope
            },
            slope,
            slope_terms,
            mass_terms,
            rounding,
            reach: reach(16.0 * rounding, slope_terms, mass_terms).min(reach_overall),
            reach_overall,
            residual,
            product: by_right.sum * by_left.sum,
            ..Pair::NONE
        }
    }

    pub(super) fn condition(&mut self, pair: &Pair, right: &[Complex64], left: &[Complex64]) -> f64 {
        self.linearisation.condition(pair.s, right, left, pair.slope, self.cross)
    }

    /// Whether rounding of the vectors, whose products are already computed, explains the residual: a vector that `K`
    /// maps to zero has nothing but rounding in the active rows, so their terms are no measure.
    pub(super) fn is_rounding(&self, s: Complex64, right: &[Complex64], left: &[Complex64], margin: f64) -> bool {
        let allowed = margin * self.relative() * self.pencil.size(s);
        let most =
            |products: &Products| (0..self.pencil.n).fold(0.0_f64, |most, i| most.max(bound(products.value(s, i))));
        let largest = |x: &[Complex64]| x.iter().fold(0.0_f64, |most, x| most.max(bound(*x)));
        most(&self.of_right) <= allowed * largest(right) && most(&self.of_left) <= allowed * largest(left)
    }
}

/// Sums over the products with both vectors.
struct Sums {
    /// `psi^T Q(s) phi` and `psi^T (2 s M + C) phi`.
    value: Complex64,
    slope: Complex64,
    /// Sums of the absolute terms in both, and in `psi^T M phi`.
    terms: f64,
    slope_terms: f64,
    mass_terms: f64,
    /// Residuals of `Q(s) phi` and of `psi^T Q(s)`.
    by_right: Residual,
    by_left: Residual,
}

impl Sums {
    #[inline(always)]
    fn of(n: usize, s: Complex64, left: &[Complex64], of_right: &Products, of_left: &Products) -> Self {
        let mut sums = Self {
            value: Complex64::ZERO,
            slope: Complex64::ZERO,
            terms: 0.0,
            slope_terms: 0.0,
            mass_terms: 0.0,
            by_right: Residual::NONE,
            by_left: Residual::NONE,
        };
        for (i, &x) in left[..n].iter().enumerate() {
            let (part, part_terms) = (of_right.value(s, i), of_right.terms(s, i));
            sums.value += x * part;
            sums.slope += x * of_right.slope(s, i);
            let size = bound(x);
            sums.terms += size * part_terms;
            sums.slope_terms += size * of_right.slope_terms(s, i);
            sums.mass_terms += size * of_right.mass_terms(i);
            sums.by_right.add(part, part_terms);
            sums.by_left.add(of_left.value(s, i), of_left.terms(s, i));
        }
        sums
    }
}

/// The approximate `d` with `d (slope + d mass) = rounding`.
fn reach(rounding: f64, slope: f64, mass: f64) -> f64 {
    (rounding / slope).min((rounding / mass).sqrt())
}

/// Scales `x` to `x^H M x = 1` (`x^H x = 1` for a first-order pencil), together with its products.
pub(super) fn normalise(pencil: &Pencil, x: &mut [Complex64], products: &mut Products) {
    let square: f64 = x.iter().zip(pencil.weighed(products)).map(|(x, mass)| x.re * mass.re + x.im * mass.im).sum();
    let factor = 1.0 / square.sqrt();
    x.iter_mut().for_each(|x| *x *= factor);
    products.scale(factor);
}

/// The residual `Q(s) x`.
struct Residual {
    most: f64,
    terms: f64,
    sum: f64,
}

impl Residual {
    const NONE: Self = Self { most: 0.0, terms: 0.0, sum: 0.0 };

    fn add(&mut self, value: Complex64, terms: f64) {
        let size = bound(value);
        self.most = self.most.max(size);
        self.terms = self.terms.max(terms);
        self.sum += size;
    }

    /// Largest component relative to the largest sum of absolute terms in a row.
    fn relative(&self) -> f64 {
        if self.sum == 0.0 {
            0.0
        } else if self.sum.is_finite() && self.terms.is_finite() {
            self.most / self.terms
        } else {
            f64::INFINITY
        }
    }
}
