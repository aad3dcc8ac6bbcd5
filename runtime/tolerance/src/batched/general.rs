//! Damped modes, one state in each lane: every eigenvalue of `Q(s) = s^2 M + s C + K` with its vectors, by inverse
//! iteration from the pair of a nearby pencil. A pair is accepted by the residuals of its vectors, regardless of how it
//! was found.

#[cfg(test)]
mod tests;

use num_complex::Complex64;

use super::algebra::{Square, keep};
use super::complex::Complex;
use crate::eigenproblem::{INACCURATE, Reference, ReferencePair};
use crate::modes::EIGENVALUE_SHARE;
use crate::scalar::Lanes;

/// Longest relative step that nearby vectors can predict.
const NEAR: f64 = 0.1;
/// Maximum number of inverse iterations, each of which multiplies the errors of the vectors by the distance of the
/// eigenvalue.
const STEPS: usize = 4;
/// Eigenvalues closer than this, relative to their size, are left to the solver for one state.
const APART: f64 = 1e-4;
/// Largest accepted relative error of an eigenvalue: so much smaller than the distances between eigenvalues that the
/// solver for one state accepts it too.
const ACCURATE: f64 = 1e-6;
/// Replaces a vanishing pivot.
const TINY: f64 = 1e-100;
/// By how much a mode must resemble its own predecessor more than any other.
const OWN: f64 = 1e-6;

type Vector<V, const N: usize> = [Complex<V>; N];
type Matrix<V, const N: usize> = [Vector<V, N>; N];

/// The three matrices, in the units of a [`Reference`].
pub(crate) struct Pencil<V, const N: usize> {
    n: usize,
    /// `M`, `C`, `K`.
    matrices: [Square<V, N>; 3],
}

/// Products of the three matrices with a vector, and the sums of absolute terms in them.
struct Products<V, const N: usize> {
    sums: [Vector<V, N>; 3],
    terms: [[V; N]; 3],
}

/// How accurate an eigenvalue is, judged from its pair of vectors.
struct Measure<V> {
    /// Newton step.
    newton: Complex<V>,
    /// Estimated error of the eigenvalue beyond `newton` and [`Self::product`].
    doubt: V,
    /// `|psi^T Q'(s) phi|^2`
    slope: V,
    /// Product of the sizes of both residuals.
    product: V,
    /// The residuals of both vectors are rounding.
    accurate: V,
}

/// A pair in every lane.
#[derive(Clone, Copy)]
struct Pair<V, const N: usize> {
    s: Complex<V>,
    error: V,
    /// `phi^H M phi` of the known vector.
    size: V,
    /// `phi` and `M phi`.
    right: Vector<V, N>,
    weighed: Vector<V, N>,
}

/// Eigenvalues in the order of the nearby ones, with their possible errors, 1/s; as many as there are, across both
/// rows.
pub(crate) type Eigenvalues<V, const N: usize> = [[(Complex<V>, V); N]; 2];

impl<V: Lanes, const N: usize> Pencil<V, N> {
    /// The pencil of a mechanism's matrices.
    #[inline(always)]
    pub(crate) fn new(n: usize, mut matrices: [Square<V, N>; 3], reference: &Reference) -> Self {
        let (units, by_rate) = (&reference.units[..n], 1.0 / reference.rate);
        let mut factor = 1.0;
        for matrix in &mut matrices {
            for i in 0..n {
                for j in 0..n {
                    matrix[i][j] = matrix[i][j] * V::constant(units[i] * units[j] * factor);
                }
            }
            factor *= by_rate;
        }
        Self { n, matrices }
    }

    /// All eigenvalues. The flag says that each is accurate, and clear of all others and of the axes. It also says that
    /// each belongs to the nearby mode at its position and to no other, by shape and, if modes are `damped`, by
    /// eigenvalue.
    #[inline(always)]
    pub(crate) fn eigenvalues(&self, reference: &Reference, damped: bool) -> (Eigenvalues<V, N>, V) {
        let (zero, n) = (V::constant(0.0), self.n);
        let none = Complex::constant(Complex64::ZERO);
        let blank = Pair { s: none, error: zero, size: zero, right: [none; N], weighed: [none; N] };
        let mut storage = [[blank; N]; 2];
        let slots = storage.as_flattened_mut();
        let mut flag = V::constant(1.0);
        let pairs = &reference.pairs[..reference.pairs.len().min(slots.len())];
        let continued = &mut slots[..pairs.len()];
        for (slot, known) in continued.iter_mut().zip(pairs) {
            let (pair, pair_flag) = self.pair(known);
            flag = keep(flag, V::constant(1.0).at_most(pair_flag));
            *slot = pair;
        }
        flag = told_apart(continued, flag);
        flag = recognised((n, damped), pairs, continued, flag);
        let mut all = [[(none, zero); N]; 2];
        let rate = V::constant(reference.rate);
        for (to, pair) in all.as_flattened_mut().iter_mut().zip(&*continued) {
            *to = (pair.s.times(rate), pair.error * rate);
        }
        (all, flag)
    }

    /// The pair that continues a known one, and the flag.
    #[inline(always)]
    fn pair(&self, known: &ReferencePair) -> (Pair<V, N>, V) {
        let (zero, one, n) = (V::constant(0.0), V::constant(1.0), self.n);
        let mut right = [Complex::constant(Complex64::ZERO); N];
        let mut left = right;
        for i in 0..n {
            right[i] = Complex::constant(known.right[i]);
            left[i] = Complex::constant(known.left[i]);
        }
        let (mut of_right, mut of_left) = (self.times(&right), self.transposed_times(&left));
        let size = inner(n, &right, &of_right.sums[0]).re;
        let start = Complex::constant(known.s);
        // Newton's method on the Rayleigh functional with the known vectors.
        let step = of_right.step(n, start, &left);
        let mut s = start - step;
        let near = V::constant(NEAR * NEAR * known.s.norm_sqr());
        let mut flag = keep(one, step.square().at_most(near));
        let (mut done, mut error) = (zero, zero);
        let mut kept = Pair { s, error, size, right, weighed: of_right.sums[0] };
        for _ in 0..STEPS {
            let (factors, neighbour) = self.factors(s, known);
            right = factors.solve(&of_right.slope(n, s));
            left = factors.solve_transposed(&of_left.slope(n, s));
            scale(n, &mut right);
            scale(n, &mut left);
            (of_right, of_left) = (self.times(&right), self.transposed_times(&left));
            s = s - of_right.step(n, s, &left);
            let now = of_right.measure(n, s, &left, &of_left);
            let root = now.slope.sqrt();
            error = now.doubt
                + V::constant(2.0) * now.newton.square().sqrt()
                + now.product / (neighbour * root)
                + V::constant(f64::EPSILON) * s.square().sqrt();
            // A finished lane is left unchanged, so that none depends on the others.
            let open = done.at_most(zero);
            kept.s = Complex::choose(open, s, kept.s);
            kept.error = V::choose(open, error, kept.error);
            for i in 0..n {
                kept.right[i] = Complex::choose(open, right[i], kept.right[i]);
                kept.weighed[i] = Complex::choose(open, of_right.sums[0][i], kept.weighed[i]);
            }
            done = V::choose(open, now.accurate, done);
            if V::every(one.at_most(done)) {
                break;
            }
        }
        flag = keep(flag, one.at_most(done));
        let rate = kept.s.square().sqrt();
        flag = keep(flag, kept.error.at_most(V::constant(ACCURATE) * rate));
        (kept, flag)
    }

    #[inline(always)]
    fn times(&self, x: &Vector<V, N>) -> Products<V, N> {
        self.products(
            x,
            #[inline(always)]
            |matrix, i, j| matrix[i][j],
        )
    }

    #[inline(always)]
    fn transposed_times(&self, x: &Vector<V, N>) -> Products<V, N> {
        self.products(
            x,
            #[inline(always)]
            |matrix, i, j| matrix[j][i],
        )
    }

    #[inline(always)]
    fn products(&self, x: &Vector<V, N>, element: impl Fn(&Square<V, N>, usize, usize) -> V) -> Products<V, N> {
        let (zero, n) = (V::constant(0.0), self.n);
        let mut products = Products { sums: [[Complex { re: zero, im: zero }; N]; 3], terms: [[zero; N]; 3] };
        let mut bounds = [zero; N];
        for j in 0..n {
            bounds[j] = x[j].bound();
        }
        for (k, matrix) in self.matrices.iter().enumerate() {
            for i in 0..n {
                let first = element(matrix, i, 0);
                let mut sum = x[0].times(first);
                let mut terms = bounds[0] * first.abs();
                for j in 1..n {
                    let factor = element(matrix, i, j);
                    sum = sum + x[j].times(factor);
                    terms = terms + bounds[j] * factor.abs();
                }
                products.sums[k][i] = sum;
                products.terms[k][i] = terms;
            }
        }
        products
    }

    /// Triangular factors of `Q(s)`, and its smallest pivot apart from the last.
    #[inline(always)]
    fn factors<'k>(&self, s: Complex<V>, known: &'k ReferencePair) -> (Factors<'k, V, N>, V) {
        let n = self.n;
        let square = s * s;
        let [mass, damping, stiffness] = &self.matrices;
        let mut q = [[Complex::constant(Complex64::ZERO); N]; N];
        let (rows, columns) = (&known.rows[..n], &known.columns[..n]);
        for (q, &i) in q[..n].iter_mut().zip(rows) {
            for (q, &j) in q[..n].iter_mut().zip(columns) {
                let (m, c) = (mass[i][j], damping[i][j]);
                *q = Complex { re: square.re * m + (s.re * c + stiffness[i][j]), im: square.im * m + s.im * c };
            }
        }
        let tiny = V::constant(TINY);
        let replacement = Complex::constant(Complex64::new(TINY, 0.0));
        let mut neighbour = V::constant(f64::MAX);
        for k in 0..n {
            let (pivot, size) = (q[k][k], q[k][k].bound());
            let inverse = Complex::choose(size.at_most(tiny), replacement, pivot).inverse();
            q[k][k] = inverse;
            if k + 1 < n {
                neighbour = V::choose(size.at_most(neighbour), size, neighbour);
            }
            for i in k + 1..n {
                let factor = q[i][k] * inverse;
                q[i][k] = factor;
                for j in k + 1..n {
                    q[i][j] = q[i][j] - factor * q[k][j];
                }
            }
        }
        let factors = Factors { n, factors: q, rows, columns };
        (factors, neighbour)
    }
}

/// `L` below the diagonal, `U` above, inverse pivots on it; rows and columns in the order of elimination.
struct Factors<'k, V, const N: usize> {
    n: usize,
    factors: Matrix<V, N>,
    rows: &'k [usize],
    columns: &'k [usize],
}

impl<V: Lanes, const N: usize> Factors<'_, V, N> {
    #[inline(always)]
    fn solve(&self, right: &Vector<V, N>) -> Vector<V, N> {
        let (n, q) = (self.n, &self.factors);
        let mut x = *right;
        for i in 0..n {
            let mut sum = right[self.rows[i]];
            for j in 0..i {
                sum = sum - q[i][j] * x[j];
            }
            x[i] = sum;
        }
        for i in (0..n).rev() {
            let mut sum = x[i];
            for j in i + 1..n {
                sum = sum - q[i][j] * x[j];
            }
            x[i] = sum * q[i][i];
        }
        let mut result = x;
        for i in 0..n {
            result[self.columns[i]] = x[i];
        }
        result
    }

    #[inline(always)]
    fn solve_transposed(&self, right: &Vector<V, N>) -> Vector<V, N> {
        let (n, q) = (self.n, &self.factors);
        let mut x = *right;
        for i in 0..n {
            let mut sum = right[self.columns[i]];
            for j in 0..i {
                sum = sum - q[j][i] * x[j];
            }
            x[i] = sum * q[i][i];
        }
        for i in (0..n).rev() {
            let mut sum = x[i];
            for j in i + 1..n {
                sum = sum - q[j][i] * x[j];
            }
            x[i] = sum;
        }
        let mut result = x;
        for i in 0..n {
            result[self.rows[i]] = x[i];
        }
        result
    }
}

impl<V: Lanes, const N: usize> Products<V, N> {
    /// Component `i` of `Q(s) x`.
    #[inline(always)]
    fn value(&self, s: Complex<V>, i: usize) -> Complex<V> {
        let [mass, damping, stiffness] = &self.sums;
        s * (s * mass[i] + damping[i]) + stiffness[i]
    }

    /// `(2 s M + C) x`
    #[inline(always)]
    fn slope(&self, n: usize, s: Complex<V>) -> Vector<V, N> {
        let [mass, damping, _] = &self.sums;
        let twice = s + s;
        let mut slope = *damping;
        for i in 0..n {
            slope[i] = slope[i] + twice * mass[i];
        }
        slope
    }

    /// `psi^T Q(s) phi` divided by `psi^T (2 s M + C) phi`; `self` holds the products with `phi`.
    #[inline(always)]
    fn step(&self, n: usize, s: Complex<V>, left: &Vector<V, N>) -> Complex<V> {
        let slopes = self.slope(n, s);
        let (mut value, mut slope) = (left[0] * self.value(s, 0), left[0] * slopes[0]);
        for i in 1..n {
            value = value + left[i] * self.value(s, i);
            slope = slope + left[i] * slopes[i];
        }
        value * slope.inverse()
    }

    #[inline(always)]
    fn measure(&self, n: usize, s: Complex<V>, left: &Vector<V, N>, of_left: &Products<V, N>) -> Measure<V> {
        let zero = V::constant(0.0);
        let none = Complex { re: zero, im: zero };
        let slopes = self.slope(n, s);
        let (mut value, mut slope, mut terms) = (none, none, zero);
        for i in 0..n {
            value = value + left[i] * self.value(s, i);
            slope = slope + left[i] * slopes[i];
            terms = terms + left[i].bound() * self.terms(s, i);
        }
        let relative = V::constant((n as f64 + 4.0) * f64::EPSILON);
        let square = slope.square();
        let (right_sum, right_accurate) = self.residual(n, s);
        let (left_sum, left_accurate) = of_left.residual(n, s);
        Measure {
            newton: value * slope.inverse(),
            doubt: relative * terms / square.sqrt(),
            slope: square,
            product: right_sum * left_sum,
            accurate: right_accurate * left_accurate,
        }
    }

    /// The sum of the components of `Q(s) x`, and whether the largest is rounding of its terms.
    #[inline(always)]
    fn residual(&self, n: usize, s: Complex<V>) -> (V, V) {
        let zero = V::constant(0.0);
        let (mut sum, mut most, mut greatest) = (zero, zero, zero);
        for i in 0..n {
            let size = self.value(s, i).bound();
            let terms = self.terms(s, i);
            sum = sum + size;
            most = V::choose(size.at_most(most), most, size);
            greatest = V::choose(terms.at_most(greatest), greatest, terms);
        }
        let accurate = most.at_most(greatest * V::constant(INACCURATE));
        (sum, keep(V::constant(1.0), accurate))
    }

    /// Sum of the absolute terms in component `i` of `Q(s) x`.
    #[inline(always)]
    fn terms(&self, s: Complex<V>, i: usize) -> V {
        let size = s.bound();
        let [mass, damping, stiffness] = &self.terms;
        size * (size * mass[i] + damping[i]) + stiffness[i]
    }
}

/// `x^H y`
#[inline(always)]
fn inner<V: Lanes, const N: usize>(n: usize, x: &Vector<V, N>, y: &Vector<V, N>) -> Complex<V> {
    let mut sum = x[0].conjugate() * y[0];
    for i in 1..n {
        sum = sum + x[i].conjugate() * y[i];
    }
    sum
}

/// Scales the largest component to about one.
#[inline(always)]
fn scale<V: Lanes, const N: usize>(n: usize, x: &mut Vector<V, N>) {
    let mut most = x[0].bound();
    for i in 1..n {
        let size = x[i].bound();
        most = V::choose(size.at_most(most), most, size);
    }
    let factor = V::constant(1.0) / most;
    for x in &mut x[..n] {
        *x = x.times(factor);
    }
}

/// Keeps the flag where every eigenvalue is clear of all others, and either real or clearly not real: then it is clear
/// of the conjugates too.
#[inline(always)]
fn told_apart<V: Lanes, const N: usize>(pairs: &[Pair<V, N>], mut flag: V) -> V {
    let zero = V::constant(0.0);
    for (i, own) in pairs.iter().enumerate() {
        let clear = V::constant(APART) * own.s.square().sqrt();
        let least = clear * clear;
        let real = keep(V::constant(1.0), own.s.im.abs().at_most(zero));
        let size = V::constant(0.5) * clear;
        let oscillates = keep(V::constant(1.0), size.at_most(own.s.im));
        flag = keep(flag, V::constant(1.0).at_most(real + oscillates));
        for (j, other) in pairs.iter().enumerate() {
            if i != j {
                let distance = (own.s - other.s).square();
                flag = keep(flag, least.at_most(distance));
            }
        }
    }
    flag
}

/// Keeps the flag where each mode resembles the known one at its position more than any other, as measured by
/// [`assurance`](crate::modes::assurance): modes are then matched as they would be one by one.
#[inline(always)]
fn recognised<V: Lanes, const N: usize>(
    (n, damped): (usize, bool),
    known: &[ReferencePair],
    pairs: &[Pair<V, N>],
    mut flag: V,
) -> V {
    if known.len() == 1 {
        return flag;
    }
    let mut thresholds = [[V::constant(0.0); N]; 2];
    let thresholds = &mut thresholds.as_flattened_mut()[..pairs.len()];
    let measured = own_sizes(n, pairs);
    let measured = &measured.as_flattened()[..pairs.len()];
    for (j, threshold) in thresholds.iter_mut().enumerate() {
        let (size, rate) = measured[j];
        let assurance = assurance((n, damped), &known[j], &pairs[j], pairs[j].size * size, rate);
        *threshold = assurance - V::constant(OWN);
    }
    for i in 0..pairs.len() {
        for j in 0..pairs.len() {
            if i != j {
                let (size, rate) = measured[j];
                let scale = pairs[i].size * size;
                let other = assurance((n, damped), &known[i], &pairs[j], scale, rate);
                flag = keep(flag, other.at_most(thresholds[i]));
                flag = keep(flag, other.at_most(thresholds[j]));
            }
        }
    }
    flag
}

/// `phi^H M phi` and `|s|` of each pair.
#[inline(always)]
fn own_sizes<V: Lanes, const N: usize>(n: usize, pairs: &[Pair<V, N>]) -> [[(V, V); N]; 2] {
    let zero = V::constant(0.0);
    let mut sizes = [[(zero, zero); N]; 2];
    for (sizes, pair) in sizes.as_flattened_mut().iter_mut().zip(pairs) {
        let size = inner(n, &pair.right, &pair.weighed).re;
        *sizes = (size, pair.s.square().sqrt());
    }
    sizes
}

/// Similarity of a found mode to a known one; `scale` is the product of `phi^H M phi` of both, `rate` its own `|s|`.
#[inline(always)]
fn assurance<V: Lanes, const N: usize>(
    (n, damped): (usize, bool),
    known: &ReferencePair,
    pair: &Pair<V, N>,
    scale: V,
    rate: V,
) -> V {
    let mut product = Complex::constant(known.right[0].conj()) * pair.weighed[0];
    for k in 1..n {
        product = product + Complex::constant(known.right[k].conj()) * pair.weighed[k];
    }
    let shapes = product.square() / scale;
    if !damped {
        return shapes;
    }
    let eigenvalue = Complex::constant(known.s);
    let own_rate = V::constant(known.s.norm());
    let turned = (eigenvalue.conjugate() * pair.s).re / (own_rate * rate);
    let phase = V::constant(0.5) + V::constant(0.5) * turned;
    let distance = (eigenvalue - pair.s).square().sqrt() / (own_rate + rate);
    shapes * phase * (V::constant(1.0) - V::constant(EIGENVALUE_SHARE) * distance)
}
