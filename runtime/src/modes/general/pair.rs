//! One eigenvalue and its two vectors, found from the pencil itself: a singular matrix shows its null vectors in its
//! triangular factors, and Newton's method on the Rayleigh functional takes out what the eigenvalue has of the rounding of
//! the whole linearisation.

use num_complex::Complex64;

use super::linearisation::Linearisation;
use super::lu::Lu;
use super::pencil::{Pencil, Products, bound, modulus};

/// An eigenvalue with what its vectors say about it.
#[derive(Clone, Copy)]
pub(super) struct Pair {
    pub(super) s: Complex64,
    /// It stands for itself and its conjugate.
    pub(super) conjugate: bool,
    /// Step that Newton's method would take from `s`.
    pub(super) newton: Complex64,
    /// `psi^T (2 s M + C) phi`.
    pub(super) slope: Complex64,
    /// Sums of the absolute terms in `psi^T (2 s M + C) phi` and in `psi^T M phi`.
    pub(super) slope_terms: f64,
    pub(super) mass_terms: f64,
    /// Bound on the rounding in `psi^T Q(s) phi`.
    pub(super) rounding: f64,
    /// Distance within which `Q` is the same but for rounding.
    pub(super) reach: f64,
    /// The same by the greatest elements of the matrices.
    reach_overall: f64,
    /// Error of second order, from the residuals of both vectors.
    pub(super) second: f64,
    /// Product of the sizes of both residuals.
    product: f64,
    /// Greatest relative residual of the two vectors.
    pub(super) residual: f64,
    /// It stands for a cluster, which has told its error.
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

    /// Error of `s` that the rounding of the pencil's elements causes, to first order.
    pub(super) fn doubt(&self) -> f64 {
        if self.rounding == 0.0 {
            0.0
        } else {
            self.rounding / modulus(self.slope)
        }
    }

    /// What the residuals of both vectors together make of the eigenvalue, where `neighbour` is the least pivot besides the
    /// one that vanishes.
    fn second_order(&self, neighbour: f64) -> f64 {
        if self.product == 0.0 || neighbour == f64::INFINITY {
            0.0
        } else {
            self.product / (neighbour * modulus(self.slope))
        }
    }

    /// Rounding of `s` itself.
    pub(super) fn own(&self) -> f64 {
        f64::EPSILON * modulus(self.s) + ZERO
    }

    /// Distance within which the eigenvalue lies, unless it is almost multiple or the vectors are not its own.
    pub(super) fn radius(&self) -> f64 {
        let radius = 2.0 * (self.doubt() + modulus(self.newton)) + self.second;
        radius.min(1e6 * self.reach_overall)
    }
}

/// Everything that finding pairs needs, in slices.
pub(super) struct Solver<'a> {
    pub(super) pencil: Pencil<'a>,
    pub(super) linearisation: Linearisation<'a>,
    pub(super) q: &'a mut [Complex64],
    pub(super) order: &'a mut [usize],
    pub(super) of_right: Products<'a>,
    pub(super) of_left: Products<'a>,
    /// `n^2` numbers each, for clusters and solves.
    pub(super) basis_right: &'a mut [Complex64],
    pub(super) basis_left: &'a mut [Complex64],
    pub(super) cross: &'a mut [Complex64],
}

/// Improvements of one pair.
/// What is less than this may be zero in a scaled pencil.
pub(super) const ZERO: f64 = 1e-30;
/// Terms that are less than this are zero in a scaled pencil.
const NOTHING: f64 = 1e-60;
const STEPS: usize = 8;
/// Vectors of a worse conditioned eigenvalue may belong to another one.
const MODERATE: f64 = 1e8;
/// Residual beyond which the vectors are improved.
pub(super) const INACCURATE: f64 = 1e-13;

impl Solver<'_> {
    /// Relative rounding error of a component of `Q(s) x`.
    pub(super) fn relative(&self) -> f64 {
        (self.pencil.n as f64 + 4.0) * f64::EPSILON
    }

    /// Rounding error of an eigenvalue of the linearisation with this condition number.
    pub(super) fn noise(&self, condition: f64) -> f64 {
        8.0 * f64::EPSILON * self.linearisation.size * condition
    }

    /// The pair that starts from `s`, `gap` away from the next eigenvalue.
    pub(super) fn pair(
        &mut self,
        start: Complex64,
        gap: f64,
        right: &mut [Complex64],
        left: &mut [Complex64],
    ) -> Pair {
        let n = self.pencil.n;
        let mut s = start;
        let mut pair = Pair::NONE;
        let (mut moved, mut last) = (0.0, f64::INFINITY);
        for count in 0..=STEPS {
            self.pencil.at(s, self.q);
            let lu = Lu::new(n, self.q, self.order);
            lu.null_right(1, 0, right);
            lu.null_left(1, 0, left);
            let neighbour = if n < 2 {
                f64::INFINITY
            } else {
                lu.pivot(n - 2) * lu.unit
            };
            pair = self.examine(s, right, left);
            pair.second = pair.second_order(neighbour);
            let step = modulus(pair.newton);
            if !step.is_finite() || count == STEPS {
                break;
            }
            let doubt = pair.doubt();
            if step <= doubt && doubt > 1e-3 * gap {
                // Almost multiple: the step is rounding, and the mean of the linearisation is better.
                break;
            }
            moved += step;
            if moved > 0.25 * gap {
                pair.condition = self.condition(&pair, right, left);
                let explained = pair.condition <= MODERATE && moved <= self.noise(pair.condition);
                if !explained || doubt > 0.125 * step || step > 0.5 * last {
                    break;
                }
            }
            let next = s - pair.newton;
            if start.im > 0.0 && next.im <= 0.0 {
                break;
            }
            s = next;
            last = step;
            if step * pair.slope_terms <= 4.0 * pair.rounding {
                let moved = self.measure(s, left);
                if moved.residual <= INACCURATE {
                    pair = Pair {
                        second: pair.second,
                        ..moved
                    };
                    break;
                }
            }
        }
        if start.im == 0.0 && pair.s.norm_sqr() < ZERO * ZERO && pair.s != Complex64::ZERO {
            let zero = self.measure(Complex64::ZERO, left);
            if zero.residual < pair.residual {
                pair = Pair {
                    second: pair.second,
                    ..zero
                };
            }
        }
        if pair.residual > INACCURATE {
            pair = self.inverse_iteration(pair, right, left);
        }
        if start.im > 0.0 {
            pair.conjugate = true;
        }
        pair.condition = self.condition(&pair, right, left);
        pair
    }

    /// One step of inverse iteration for both vectors; keeps what is better.
    #[cold]
    fn inverse_iteration(
        &mut self,
        pair: Pair,
        right: &mut [Complex64],
        left: &mut [Complex64],
    ) -> Pair {
        let n = self.pencil.n;
        self.examine(pair.s, right, left);
        self.pencil.at(pair.s, self.q);
        let lu = Lu::new(n, self.q, self.order);
        let (new_right, new_left) = (&mut self.basis_right[..n], &mut self.basis_left[..n]);
        lu.solve(self.of_right.mass, new_right, &mut self.cross[..n]);
        lu.solve_transposed(self.of_left.mass, new_left, &mut self.cross[..n]);
        self.pencil.multiply(new_right, false, &mut self.of_right);
        normalise(new_right, &mut self.of_right);
        self.pencil.multiply(new_left, true, &mut self.of_left);
        normalise(new_left, &mut self.of_left);
        let improved = self.measure(pair.s, &self.basis_left[..n]);
        if improved.residual < pair.residual {
            right.copy_from_slice(&self.basis_right[..n]);
            left.copy_from_slice(&self.basis_left[..n]);
            Pair {
                second: pair.second,
                ..improved
            }
        } else {
            pair
        }
    }

    /// Normalises both vectors and measures them with `s`.
    pub(super) fn examine(
        &mut self,
        s: Complex64,
        right: &mut [Complex64],
        left: &mut [Complex64],
    ) -> Pair {
        self.pencil.multiply(right, false, &mut self.of_right);
        normalise(right, &mut self.of_right);
        self.pencil.multiply(left, true, &mut self.of_left);
        normalise(left, &mut self.of_left);
        self.measure(s, left)
    }

    /// Measures `s` with vectors whose products are known.
    pub(super) fn measure(&self, s: Complex64, left: &[Complex64]) -> Pair {
        let n = self.pencil.n;
        let (of_right, of_left) = (&self.of_right, &self.of_left);
        let (mut value, mut slope) = (Complex64::ZERO, Complex64::ZERO);
        let (mut terms, mut slope_terms, mut mass_terms) = (0.0, 0.0, 0.0);
        let (mut by_right, mut by_left) = (Residual::NONE, Residual::NONE);
        for (i, &x) in left.iter().enumerate() {
            let (part, part_terms) = (of_right.value(s, i), of_right.terms(s, i));
            value += x * part;
            slope += x * of_right.slope(s, i);
            let size = bound(x);
            terms += size * part_terms;
            slope_terms += size * of_right.slope_terms(s, i);
            mass_terms += size * of_right.mass_terms(i);
            by_right.add(part, part_terms);
            by_left.add(of_left.value(s, i), of_left.terms(s, i));
        }
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

    pub(super) fn condition(
        &mut self,
        pair: &Pair,
        right: &[Complex64],
        left: &[Complex64],
    ) -> f64 {
        self.linearisation
            .condition(pair.s, right, left, pair.slope, self.cross)
    }

    /// Whether rounding of the vectors, whose products are known, explains the residual: a vector that `K` takes to zero
    /// has nothing but rounding in the rows that act, and their terms are no measure.
    pub(super) fn is_rounding(
        &self,
        s: Complex64,
        right: &[Complex64],
        left: &[Complex64],
        margin: f64,
    ) -> bool {
        let allowed = margin * self.relative() * self.pencil.size(s);
        let most = |products: &Products| {
            (0..self.pencil.n).fold(0.0_f64, |most, i| most.max(bound(products.value(s, i))))
        };
        let largest = |x: &[Complex64]| x.iter().fold(0.0_f64, |most, x| most.max(bound(*x)));
        most(&self.of_right) <= allowed * largest(right)
            && most(&self.of_left) <= allowed * largest(left)
    }
}

/// The `d` with `d (slope + d mass) = rounding`, about.
fn reach(rounding: f64, slope: f64, mass: f64) -> f64 {
    (rounding / slope).min((rounding / mass).sqrt())
}

/// Scales `x` to `x^H M x = 1`, and its products with it.
pub(super) fn normalise(x: &mut [Complex64], products: &mut Products) {
    let square: f64 = x
        .iter()
        .zip(products.mass.iter())
        .map(|(x, mass)| x.re * mass.re + x.im * mass.im)
        .sum();
    let factor = 1.0 / square.sqrt();
    x.iter_mut().for_each(|x| *x *= factor);
    products.scale(factor);
}

/// What is left of `Q(s) x`.
struct Residual {
    most: f64,
    terms: f64,
    sum: f64,
}

impl Residual {
    const NONE: Self = Self {
        most: 0.0,
        terms: 0.0,
        sum: 0.0,
    };

    fn add(&mut self, value: Complex64, terms: f64) {
        let size = bound(value);
        self.most = self.most.max(size);
        self.terms = self.terms.max(terms);
        self.sum += size;
    }

    /// Greatest component relative to the greatest sum of absolute terms in a row.
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
