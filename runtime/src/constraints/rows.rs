//! The row space of a few rows, by pivoted Gram-Schmidt with reorthogonalisation: rank, null space, dependencies,
//! least-squares solutions.
#![allow(
    clippy::needless_range_loop,
    reason = "index loops read as the formulas they are"
)]

use crate::array::{Cholesky, Square, add_scaled, dot, largest};

/// What may remain of a row that others explain, relative to the row itself. Rows of compiled constraints carry rounding
/// of some 1e-15, which nearly dependent neighbours amplify; rows that differ by less than this have no use as two.
const DEPENDENT: f64 = 1e-10;
/// The same for rows that may become dependent nearby.
pub(crate) const NEARLY: f64 = 1e-2;
/// A row this much smaller than the greatest is zero but for rounding.
const VANISHING: f64 = 1e-13;
/// Least share of a column in the balanced metric: what is fainter is not blown up, lest its rounding count as independence.
const FAINT: f64 = 1e-4;

/// `count` rows `h_k` of `N` columns, of which `rank` are independent, in the metric `sum (scale_j x_j)^2` of vectors `x`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rows<const N: usize> {
    pub(crate) count: usize,
    pub(crate) rank: usize,
    /// Least share of a row, of those taken into the basis, that the ones before did not explain; one for a single row.
    pub(crate) least: f64,
    /// The row numbers: independent ones first, in the order of elimination, then the dependent ones.
    pub(crate) order: [usize; N],
    /// Euclidean norm of each row over `scale`: what makes rows of different units comparable. One for a zero row.
    pub(crate) size: [f64; N],
    scale: [f64; N],
    /// The rows over `size` and `scale`.
    row: Square<N>,
    /// The first `rank`: orthonormal basis of the row space, in columns times `scale`.
    unit: Square<N>,
    /// `unit[i] = sum_k combination[i][k] h_k / (size_k scale)`.
    combination: Square<N>,
    /// The first `count - rank`: orthonormal left null vectors of the rows over `size`.
    dependency: Square<N>,
}

impl<const N: usize> Rows<N> {
    /// Of rows that are known to be independent.
    pub(crate) fn independent(
        count: usize,
        row: impl Fn(usize) -> [f64; N],
        scale: [f64; N],
    ) -> Self {
        Self::with_threshold(count, row, scale, 0.0)
    }

    /// In the metric in which the greatest share of a row that each column has is one: the one to decide ranks in, because
    /// it does not depend on units, nor on masses.
    pub(crate) fn balanced(count: usize, row: impl Fn(usize) -> [f64; N]) -> Self {
        let mut scale = [0.0_f64; N];
        for k in 0..count.min(N) {
            let row = row(k);
            let size = largest(&row);
            for j in 0..N {
                if size > 0.0 {
                    scale[j] = scale[j].max(row[j].abs() / size);
                }
            }
        }
        let scale = scale.map(|value| value.max(FAINT));
        Self::with_threshold(count, row, scale, DEPENDENT)
    }

    /// In the metric of these scales.
    pub(crate) fn new(count: usize, row: impl Fn(usize) -> [f64; N], scale: [f64; N]) -> Self {
        Self::with_threshold(count, row, scale, DEPENDENT)
    }

    /// As [`Self::new`]; rows that nearly depend on others count as dependent.
    pub(crate) fn nearly(count: usize, row: impl Fn(usize) -> [f64; N], scale: [f64; N]) -> Self {
        Self::with_threshold(count, row, scale, NEARLY)
    }

    fn with_threshold(
        count: usize,
        row: impl Fn(usize) -> [f64; N],
        scale: [f64; N],
        threshold: f64,
    ) -> Self {
        let count = count.min(N);
        let mut rest = [[0.0; N]; N];
        let mut size = [1.0; N];
        for k in 0..count {
            rest[k] = over(&row(k), &scale);
            size[k] = norm(&rest[k]);
        }
        let greatest = size[..count].iter().fold(0.0, |a: f64, &b| a.max(b));
        for k in 0..count {
            if size[k] > VANISHING * greatest {
                rest[k] = rest[k].map(|value| value / size[k]);
            } else {
                rest[k] = [0.0; N];
                size[k] = if greatest > 0.0 { greatest } else { 1.0 };
            }
        }
        let row = rest;
        let mut made = [[0.0; N]; N];
        for k in 0..count {
            made[k][k] = 1.0;
        }
        let mut rows = Self {
            count,
            rank: 0,
            least: 1.0,
            order: core::array::from_fn(|k| k),
            size,
            scale,
            row,
            unit: [[0.0; N]; N],
            combination: [[0.0; N]; N],
            dependency: [[0.0; N]; N],
        };
        rows.eliminate(&mut rest, &mut made, threshold);
        for i in rows.rank..count {
            let mut left = made[rows.order[i]];
            for _ in 0..2 {
                for known in &rows.dependency[..i - rows.rank] {
                    left = add_scaled(&left, -dot(known, &left), known);
                }
                left = normalised(&left);
            }
            rows.dependency[i - rows.rank] = left;
        }
        rows
    }

    /// Takes the greatest remaining row into the basis until what remains is rounding. `made` says how each remaining
    /// row is made of the given ones.
    fn eliminate(&mut self, rest: &mut Square<N>, made: &mut Square<N>, threshold: f64) {
        for i in 0..self.count {
            let mut best = i;
            for k in i + 1..self.count {
                if norm(&rest[self.order[k]]) > norm(&rest[self.order[best]]) {
                    best = k;
                }
            }
            let pivot = self.order[best];
            // Against the basis once more: what is left of a small remainder is not orthogonal to it.
            for known in 0..self.rank {
                let along = dot(&self.unit[known], &rest[pivot]);
                rest[pivot] = add_scaled(&rest[pivot], -along, &self.unit[known]);
                made[pivot] = add_scaled(&made[pivot], -along, &self.combination[known]);
            }
            let left = norm(&rest[pivot]);
            if left.is_nan() || left <= threshold {
                return;
            }
            self.order.swap(i, best);
            self.unit[i] = rest[pivot].map(|value| value / left);
            self.combination[i] = made[pivot].map(|value| value / left);
            self.rank = i + 1;
            self.least = self.least.min(left);
            for k in i + 1..self.count {
                let other = self.order[k];
                let along = dot(&self.unit[i], &rest[other]);
                rest[other] = add_scaled(&rest[other], -along, &self.unit[i]);
                made[other] = add_scaled(&made[other], -along, &self.combination[i]);
            }
        }
    }

    /// Basis vector `i` of the row space, raised by the metric: `x = sum_i c_i normal(i)` is what is orthogonal, in the
    /// metric, to the null space.
    pub(crate) fn normal(&self, i: usize) -> [f64; N] {
        over(&self.unit[i], &self.scale)
    }

    /// The direction `x` of the row space that the rows hold least, and how: `w` by row with `sum_k w_k h_k = ` the covector
    /// of `x`, so that `sum_k w_k h_k . x = 1`. Both are zero without rows.
    pub(crate) fn weakest(&self) -> ([f64; N], [f64; N]) {
        match self.rank.checked_sub(1) {
            Some(last) => (
                self.normal(last),
                core::array::from_fn(|k| self.combination[last][k] / self.size[k]),
            ),
            None => ([0.0; N], [0.0; N]),
        }
    }

    /// A vector in the units of the metric: its norm is the length in the metric.
    pub(crate) fn scaled(&self, x: &[f64; N]) -> [f64; N] {
        core::array::from_fn(|j| x[j] * self.scale[j])
    }

    /// How many rows the others explain.
    pub(crate) fn dependent(&self) -> usize {
        self.count - self.rank
    }

    /// Left null vector `k`, `sum_i n_i h_i = 0`, in terms of the rows as given.
    pub(crate) fn null_left(&self, k: usize) -> [f64; N] {
        core::array::from_fn(|i| self.dependency[k][i] / self.size[i])
    }

    /// The same times the squares of the sizes: what a gauge is made of, and a measure of contradiction (`null_left` and
    /// this one have the product one).
    pub(crate) fn null_left_scaled(&self, k: usize) -> [f64; N] {
        core::array::from_fn(|i| self.dependency[k][i] * self.size[i])
    }

    /// Basis of the null space over the first `columns` columns, orthonormal in the metric: `columns - rank` vectors. Later
    /// columns of the rows have to be zero.
    pub(crate) fn null_basis(&self, columns: usize) -> Square<N> {
        let mut basis = [[0.0; N]; N];
        // What remains of each unit vector after projection on the null space; the greatest comes next.
        let mut rest: Square<N> =
            core::array::from_fn(|j| core::array::from_fn(|i| if i == j { 1.0 } else { 0.0 }));
        let known = &self.unit[..self.rank];
        for vector in &mut rest[..columns] {
            *vector = orthogonal(vector, known);
        }
        for i in 0..columns.saturating_sub(self.rank) {
            let mut best = 0;
            for j in 1..columns {
                // A margin keeps the first of equals, whatever rounding says.
                if norm(&rest[j]) > norm(&rest[best]) * (1.0 + 1e-9) {
                    best = j;
                }
            }
            let mut next = normalised(&rest[best]);
            next = normalised(&orthogonal(&orthogonal(&next, known), &basis[..i]));
            basis[i] = next;
            for vector in &mut rest[..columns] {
                *vector = add_scaled(vector, -dot(vector, &next), &next);
            }
        }
        for vector in &mut basis {
            *vector = over(vector, &self.scale);
        }
        basis
    }

    /// The shortest `x` with `h_k x = right_k` for the independent rows, in the metric.
    pub(crate) fn shortest_of_independent(&self, right: &[f64; N]) -> [f64; N] {
        let mut wanted = [0.0; N];
        for &k in &self.order[..self.rank] {
            wanted[k] = right[k] / self.size[k];
        }
        self.solution(&wanted)
    }

    /// The shortest `x` with `h_k x = right_k`, in the metric; of rows that contradict each other the least squares, each
    /// row over its size.
    pub(crate) fn shortest(&self, right: &[f64; N]) -> [f64; N] {
        let mut wanted: [f64; N] = core::array::from_fn(|k| {
            if k < self.count {
                right[k] / self.size[k]
            } else {
                0.0
            }
        });
        for left in &self.dependency[..self.dependent()] {
            wanted = add_scaled(&wanted, -dot(left, &wanted), left);
        }
        self.solution(&wanted)
    }

    /// From values over sizes, by the independent rows.
    fn solution(&self, wanted: &[f64; N]) -> [f64; N] {
        let mut x = [0.0; N];
        for i in 0..self.rank {
            x = add_scaled(&x, dot(&self.combination[i], wanted), &self.unit[i]);
        }
        over(&x, &self.scale)
    }

    /// `x = sum_k h_k right_k` in the metric, rows over their sizes as `right` is: the way on which the squares of what rows
    /// leave open fall fastest. In units of the metric.
    pub(crate) fn descent(&self, right: &[f64; N]) -> [f64; N] {
        let mut x = [0.0; N];
        for k in 0..self.count {
            x = add_scaled(&x, right[k], &self.row[k]);
        }
        x
    }

    /// `x` with the least `sum_k (h_k x / size_k - right_k)^2 + damping |x|^2` in the metric: [`Self::shortest`] with a
    /// damper, for rows over their sizes.
    pub(crate) fn damped(&self, right: &[f64; N], damping: f64) -> Option<[f64; N]> {
        let normal: Square<N> = core::array::from_fn(|i| {
            core::array::from_fn(|j| {
                dot(&self.row[i], &self.row[j]) + if i == j { damping } else { 0.0 }
            })
        });
        let z = Cholesky::new(&normal).ok()?.solve(right);
        Some(over(&self.descent(&z), &self.scale))
    }

    /// Multipliers `mu` with `sum_k mu_k h_k = force` in the sense of least squares (forces over `scale`), the shortest in
    /// `mu_k size_k`.
    pub(crate) fn multipliers(&self, force: &[f64; N]) -> [f64; N] {
        let force = over(force, &self.scale);
        let mut mu = [0.0; N];
        for i in 0..self.rank {
            mu = add_scaled(&mu, dot(&self.unit[i], &force), &self.combination[i]);
        }
        for left in &self.dependency[..self.dependent()] {
            mu = add_scaled(&mu, -dot(left, &mu), left);
        }
        core::array::from_fn(|k| mu[k] / self.size[k])
    }
}

/// `vector` without its part in the span of orthonormal `known`.
fn orthogonal<const N: usize>(vector: &[f64; N], known: &[[f64; N]]) -> [f64; N] {
    let mut left = *vector;
    for _ in 0..2 {
        for direction in known {
            left = add_scaled(&left, -dot(direction, &left), direction);
        }
    }
    left
}

fn over<const N: usize>(vector: &[f64; N], scale: &[f64; N]) -> [f64; N] {
    core::array::from_fn(|j| vector[j] / scale[j])
}

fn norm<const N: usize>(vector: &[f64; N]) -> f64 {
    dot(vector, vector).sqrt()
}

fn normalised<const N: usize>(vector: &[f64; N]) -> [f64; N] {
    let size = norm(vector);
    vector.map(|value| if size > 0.0 { value / size } else { 0.0 })
}
