//! Inverse iteration on the Hessenberg form: vectors of the pencil, and their corrections, for `n^2` operations each.

use num_complex::Complex64;

use super::hessenberg::Hessenberg;
use super::linearisation::{Linearisation, Side};
use super::shifted::{Parts, Shifted};

/// Eigenvalues whose vectors are transformed together.
const BLOCK: usize = 8;
/// Columns for each: real and imaginary parts of the right vector, then of the left one.
const COLUMNS: usize = 4;
/// Residual, in units of rounding, of a vector that needs no second step.
const EXACT: f64 = 16.0;

/// Share of the linearisation's size by which a shift stays aside of a multiple eigenvalue, so that rounding does not
/// prefer one of its vectors; and the steps that make up for it.
const ASIDE: f64 = 1e-10;
const STEPS: usize = 3;

pub(super) struct Iteration<'a> {
    form: Hessenberg<'a>,
    shifted: Shifted,
    /// The `s` of its factors.
    shift: Complex64,
    /// Smallest pivot.
    least: f64,
    vector: Parts,
    block: Vec<f64>,
    shapes: Vec<f64>,
    sums: Vec<f64>,
}

impl<'a> Iteration<'a> {
    /// For the Hessenberg `form` of a linearisation.
    pub(super) fn new(form: Hessenberg<'a>, linearisation: &Linearisation) -> Self {
        let n = form.n;
        Self {
            shifted: Shifted::new(n),
            shift: Complex64::new(f64::NAN, 0.0),
            least: f64::EPSILON * linearisation.size,
            vector: Parts::zeros(n),
            block: vec![0.0; n * BLOCK * COLUMNS],
            shapes: vec![0.0; linearisation.n * BLOCK * COLUMNS],
            sums: vec![0.0; BLOCK * COLUMNS],
            form,
        }
    }

    /// Vectors of the pencil for each of some eigenvalues, not normalised.
    pub(super) fn vectors(
        &mut self,
        linearisation: &Linearisation,
        values: &[Complex64],
        right: &mut [Complex64],
        left: &mut [Complex64],
    ) {
        let fill = |this: &mut Self, k: usize, side| {
            this.factor_shifted(values[k]);
            this.iterate(side);
        };
        self.blocks(linearisation, values.len(), fill, (right, left));
    }

    /// Independent vectors of one eigenvalue, as many as fit, if there are as many.
    pub(super) fn bases(
        &mut self,
        linearisation: &Linearisation,
        s: Complex64,
        right: &mut [Complex64],
        left: &mut [Complex64],
    ) {
        let count = right.len() / linearisation.n;
        self.factor_shifted(s + ASIDE * linearisation.size);
        let fill = |this: &mut Self, k: usize, side| this.iterate_from(side, k);
        self.blocks(linearisation, count, fill, (right, left));
    }

    /// Transforms the vectors that `fill` makes, in blocks.
    fn blocks(
        &mut self,
        linearisation: &Linearisation,
        count: usize,
        mut fill: impl FnMut(&mut Self, usize, Side),
        (right, left): (&mut [Complex64], &mut [Complex64]),
    ) {
        let n = linearisation.n;
        for first in (0..count).step_by(BLOCK) {
            let members = BLOCK.min(count - first);
            let columns = COLUMNS * members;
            for q in 0..members {
                for (side, at) in [(Side::Right, 0), (Side::Left, 2)] {
                    fill(self, first + q, side);
                    let parts = self.vector.re.iter().zip(&self.vector.im);
                    let rows = self.block.chunks_exact_mut(columns);
                    for (row, (&re, &im)) in rows.zip(parts) {
                        row[COLUMNS * q + at] = re;
                        row[COLUMNS * q + at + 1] = im;
                    }
                }
            }
            let block = &mut self.block[..self.form.n * columns];
            self.form.rotate_columns(columns, block, &mut self.sums[..columns]);
            let shapes = &mut self.shapes[..n * columns];
            linearisation.shapes(columns, block, shapes);
            for (i, row) in shapes.chunks_exact(columns).enumerate() {
                for (q, parts) in row.chunks_exact(COLUMNS).enumerate() {
                    let offset = (first + q) * n + i;
                    right[offset] = Complex64::new(parts[0], parts[1]);
                    left[offset] = Complex64::new(parts[2], parts[3]);
                }
            }
        }
    }

    /// One or two steps of inverse iteration from a vector of ones.
    fn iterate(&mut self, side: Side) {
        let x = &mut self.vector;
        let n = x.re.len() as f64;
        x.fill(1.0);
        match side {
            // The exchanges and `L` are the first half of a step from another vector.
            Side::Right => self.shifted.solve_upper(x),
            Side::Left => self.shifted.solve_transposed(x),
        }
        let length = x.length();
        x.scale(1.0 / length);
        if length * EXACT * self.least < 2.0 * n.sqrt() {
            self.step(side);
        }
    }

    /// Condition number of an eigenvalue.
    pub(super) fn condition(&mut self, s: Complex64) -> f64 {
        self.factor_shifted(s);
        self.iterate(Side::Right);
        let right = self.vector.clone();
        self.iterate(Side::Left);
        1.0 / right.dot(&self.vector).norm()
    }

    /// Steps of inverse iteration from vector `k` of an orthogonal family.
    fn iterate_from(&mut self, side: Side, k: usize) {
        self.vector.fill(1.0);
        for (i, x) in self.vector.re.iter_mut().enumerate() {
            // The signs of Walsh's functions.
            *x = if (i & k).count_ones() % 2 == 1 { -1.0 } else { 1.0 };
        }
        (0..STEPS).for_each(|_| self.step(side));
    }

    fn step(&mut self, side: Side) {
        let x = &mut self.vector;
        match side {
            Side::Right => self.shifted.solve(x),
            Side::Left => self.shifted.solve_transposed(x),
        }
        x.scale(1.0 / x.length());
    }

    /// Factors `H - s` for corrections near `s`.
    pub(super) fn factor_shifted(&mut self, s: Complex64) {
        if self.shift != s {
            self.shifted.factor(self.form.h, s, self.least);
            self.shift = s;
        }
    }

    /// Replaces a residual `r` by the approximate `d` with `Q d = -r`, or `Q^T d = -r`, at the aim.
    pub(super) fn correct(&mut self, linearisation: &Linearisation, side: Side, rest: &mut [Complex64]) {
        let x = &mut self.vector;
        linearisation.load(side, rest, x);
        self.form.rotate_back(x);
        match side {
            Side::Right => self.shifted.solve(x),
            Side::Left => self.shifted.solve_transposed(x),
        }
        self.form.rotate(x);
        linearisation.unload(side, x, rest);
    }
}
