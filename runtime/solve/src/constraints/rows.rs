//! The row space of a few rows, by pivoted Gram-Schmidt with reorthogonalisation: rank, null space, dependencies,
//! least-squares solutions.
#![allow(clippy::needless_range_loop, reason = "index loops read as the formulas they are")]

use crate::algebra::{Cholesky, Matrix, Vector, add_to, dot, largest};

/// Relative remainder below which a row counts as explained by others. Rows of compiled constraints carry rounding of
/// about 1e-15, which nearly dependent neighbours amplify; rows that differ by less than this are of no use as two.
const DEPENDENT: f64 = 1e-10;
/// Rows closer to dependent than this may lose rank at a neighbouring configuration.
const NEARLY: f64 = 1e-2;
/// A row smaller than the largest one by this factor is zero up to rounding.
const VANISHING: f64 = 1e-13;
/// Size of a row, relative to the largest one, below which it may vanish nearby: the counterpart of [`NEARLY`] for one
/// row alone. Rows of other units than the largest are rarely this small.
const FADING: f64 = 1e-5;
/// Smallest share of a column in the balanced metric: fainter columns are not scaled up, so that their rounding cannot
/// pass for independence.
const FAINT: f64 = 1e-4;

/// Rows `h_k`, of which `rank` are independent, in the metric `sum (scale_j x_j)^2` of vectors `x`.
#[derive(Clone, Debug)]
pub(crate) struct Rows {
    pub(crate) rank: usize,
    /// Smallest share, among the rows taken into the basis, that the preceding rows did not explain; one for a single
    /// row.
    pub(crate) least: f64,
    /// The row numbers: independent ones first, in the order of elimination, then the dependent ones.
    pub(crate) order: Vec<usize>,
    /// Euclidean norm of each row divided by `scale`, which makes rows of different units comparable. For a zero row it
    /// is the largest of the others; one if all are zero.
    pub(crate) size: Vector,
    scale: Vector,
    /// The rows divided by `size` and `scale`.
    row: Matrix,
    /// The first `rank` rows are an orthonormal basis of the space that the rows divided by `scale` span. The others
    /// are rounding.
    unit: Matrix,
    /// The first `rank` rows satisfy `unit[i] = sum_k combination[i][k] h_k / (size_k scale)`. The others are
    /// orthonormal left null vectors of the rows divided by `size`.
    combination: Matrix,
}

impl Rows {
    /// Rows that are known to be independent.
    pub(crate) fn independent(rows: Matrix, scale: Vector) -> Self {
        Self::with_threshold(rows, scale, 0.0)
    }

    /// Rows in the metric in which the largest share that each column has of a row is one. Ranks are decided in this
    /// metric, because it depends neither on units nor on masses.
    pub(crate) fn balanced(rows: Matrix) -> Self {
        let mut scale = Vector::filled(rows.column_count(), FAINT);
        for row in rows.iter() {
            let size = largest(row);
            if size > 0.0 {
                for (scale, value) in scale.iter_mut().zip(row) {
                    *scale = scale.max(value.abs() / size);
                }
            }
        }
        Self::with_threshold(rows, scale, DEPENDENT)
    }

    /// Rows in the metric of these scales.
    pub(crate) fn new(rows: Matrix, scale: Vector) -> Self {
        Self::with_threshold(rows, scale, DEPENDENT)
    }

    /// Like [`Self::new`], but rows that nearly depend on others count as dependent.
    pub(crate) fn nearly(rows: Matrix, scale: Vector) -> Self {
        Self::with_threshold(rows, scale, NEARLY)
    }

    fn with_threshold(mut rows: Matrix, scale: Vector, threshold: f64) -> Self {
        let count = rows.row_count();
        for row in rows.iter_mut() {
            divide_each(row, &scale);
        }
        let mut size: Vector = rows.iter().map(norm).collect();
        let greatest = largest(&size);
        for (row, size) in rows.iter_mut().zip(&mut size) {
            if *size > VANISHING * greatest {
                divide(row, *size);
            } else {
                row.fill(0.0);
                *size = if greatest > 0.0 { greatest } else { 1.0 };
            }
        }
        let mut this = Self {
            rank: 0,
            least: 1.0,
            order: (0..count).collect(),
            size,
            scale,
            unit: rows.clone(),
            row: rows,
            combination: Matrix::from_fn(count, count, |k, i| if i == k { 1.0 } else { 0.0 }),
        };
        this.eliminate(threshold);
        for i in this.rank..count {
            for _ in 0..2 {
                for known in this.rank..i {
                    let (known, left) = pair(&mut this.combination, known, i);
                    let along = dot(known, left);
                    add_to(left, -along, known);
                }
                normalise(&mut this.combination[i]);
            }
        }
        this
    }

    /// Takes the largest remaining row into the basis until only rounding remains.
    fn eliminate(&mut self, threshold: f64) {
        for i in 0..self.count() {
            let mut best = i;
            let mut most = norm(&self.unit[i]);
            for k in i + 1..self.count() {
                let size = norm(&self.unit[k]);
                if size > most {
                    (best, most) = (k, size);
                }
            }
            // Orthogonalises once more: a small remainder is not orthogonal to the basis.
            for known in 0..i {
                self.take_off(known, best);
            }
            let left = norm(&self.unit[best]);
            if left.is_nan() || left <= threshold {
                return;
            }
            self.order.swap(i, best);
            self.unit.swap(i, best);
            self.combination.swap(i, best);
            divide(&mut self.unit[i], left);
            divide(&mut self.combination[i], left);
            self.rank = i + 1;
            self.least = self.least.min(left);
            for k in i + 1..self.count() {
                self.take_off(i, k);
            }
        }
    }

    /// Subtracts the direction of basis vector `i` from remaining row `k`, and from its combination too.
    fn take_off(&mut self, i: usize, k: usize) {
        let (unit, rest) = pair(&mut self.unit, i, k);
        let along = dot(unit, rest);
        add_to(rest, -along, unit);
        let (combination, made) = pair(&mut self.combination, i, k);
        add_to(made, -along, combination);
    }

    /// The basis vectors with their combinations of rows.
    fn basis(&self) -> impl Iterator<Item = (&[f64], &[f64])> {
        self.unit.iter().zip(self.combination.iter()).take(self.rank)
    }

    /// The left null vectors of the rows divided by `size`.
    fn dependencies(&self) -> impl Iterator<Item = &[f64]> {
        self.combination.iter().skip(self.rank)
    }

    /// Number of rows.
    pub(crate) fn count(&self) -> usize {
        self.order.len()
    }

    /// Basis vector `i` of the row space, raised by the metric: the vectors `x = sum_i c_i normal(i)` are orthogonal,
    /// in the metric, to the null space.
    pub(crate) fn normal(&self, i: usize) -> Vector {
        let mut normal = Vector::from(&self.unit[i]);
        divide_each(&mut normal, &self.scale);
        normal
    }

    /// Numbers of the basis vectors that the rows hardly support: the last one, if it nearly depends on the others, and
    /// those of rows that nearly vanish.
    pub(crate) fn hardly_supported(&self) -> impl Iterator<Item = usize> {
        let faint = FADING * largest(&self.size);
        (0..self.rank).filter(move |&i| {
            let last = i + 1 == self.rank;
            self.size[self.order[i]] <= faint || last && self.least <= NEARLY
        })
    }

    /// Basis vector `i` as a direction `x` of the row space, and the combination of rows that supports it.
    ///
    /// The combination `w`, by row, has `sum_k w_k h_k` equal to the covector of `x`, so that `sum_k w_k h_k . x = 1`.
    pub(crate) fn support(&self, i: usize) -> (Vector, Vector) {
        let mut combination = Vector::from(&self.combination[i]);
        divide_each(&mut combination, &self.size);
        (self.normal(i), combination)
    }

    /// Converts a vector to the units of the metric: its norm is then its length in the metric.
    pub(crate) fn scaled(&self, x: &[f64]) -> Vector {
        x.iter().zip(&self.scale).map(|(x, scale)| x * scale).collect()
    }

    /// The unit in which the metric measures `x_j`.
    pub(crate) fn scale(&self, j: usize) -> f64 {
        self.scale[j]
    }

    /// Converts a covector to the units of the metric.
    pub(crate) fn scaled_down(&self, force: &[f64]) -> Vector {
        let mut force = Vector::from(force);
        divide_each(&mut force, &self.scale);
        force
    }

    /// Whether these multiples of the rows as given cancel up to a share of them, in the metric.
    pub(crate) fn cancel(&self, multiples: &[f64], share: f64) -> bool {
        let scaled: Vector = multiples.iter().zip(&self.size).map(|(n, size)| n * size).collect();
        norm(&self.descent(&scaled)) / norm(&scaled) <= share
    }

    /// Number of rows explained by the others.
    pub(crate) fn dependent(&self) -> usize {
        self.count() - self.rank
    }

    /// Left null vector `k`, `sum_i n_i h_i = 0`, for the rows as given.
    pub(crate) fn null_left(&self, k: usize) -> Vector {
        let mut left = Vector::from(&self.combination[self.rank + k]);
        divide_each(&mut left, &self.size);
        left
    }

    /// [`Self::null_left`] times the squares of the sizes: the basis of a gauge and a measure of contradiction (the
    /// product of the two vectors is one).
    pub(crate) fn null_left_scaled(&self, k: usize) -> Vector {
        let left = self.combination[self.rank + k].iter().zip(&self.size);
        left.map(|(left, size)| left * size).collect()
    }

    /// Basis of the null space over the first `columns` columns, orthonormal in the metric: `columns - rank` vectors.
    /// The remaining columns of the rows must be zero.
    pub(crate) fn null_basis(&self, columns: usize) -> Vec<Vector> {
        let n = self.scale.len();
        let known = || self.unit.iter().take(self.rank);
        let mut basis: Vec<Vector> = Vec::new();
        // Remainders of the unit vectors after projection onto the null space; the largest comes next.
        let mut rest = Matrix::from_fn(columns, n, |j, i| if i == j { 1.0 } else { 0.0 });
        for vector in rest.iter_mut() {
            make_orthogonal(vector, known);
        }
        for _ in 0..columns.saturating_sub(self.rank) {
            let mut best = 0;
            let mut most = norm(&rest[0]);
            for j in 1..columns {
                let size = norm(&rest[j]);
                // A margin makes the first of equal ones win, regardless of rounding.
                if size > most * (1.0 + 1e-9) {
                    (best, most) = (j, size);
                }
            }
            let mut next = Vector::from(&rest[best]);
            normalise(&mut next);
            make_orthogonal(&mut next, known);
            make_orthogonal(&mut next, || basis.iter().map(|vector| &vector[..]));
            normalise(&mut next);
            for vector in rest.iter_mut() {
                let along = dot(vector, &next);
                add_to(vector, -along, &next);
            }
            basis.push(next);
        }
        for vector in &mut basis {
            divide_each(vector, &self.scale);
        }
        basis
    }

    /// The shortest `x`, in the metric, with `h_k x = right_k` for the independent rows.
    pub(crate) fn shortest_of_independent(&self, right: &[f64]) -> Vector {
        let mut wanted = Vector::zeros(self.count());
        for &k in &self.order[..self.rank] {
            wanted[k] = right[k] / self.size[k];
        }
        self.solution(&wanted)
    }

    /// The shortest `x`, in the metric, with `h_k x = right_k`; the least-squares solution, each row divided by its
    /// size, if rows contradict each other.
    pub(crate) fn shortest(&self, right: &[f64]) -> Vector {
        let mut wanted = Vector::from(right);
        divide_each(&mut wanted, &self.size);
        for left in self.dependencies() {
            let along = dot(left, &wanted);
            add_to(&mut wanted, -along, left);
        }
        self.solution(&wanted)
    }

    /// The solution from scaled values of the independent rows.
    fn solution(&self, wanted: &[f64]) -> Vector {
        let mut x = Vector::zeros(self.scale.len());
        for (unit, combination) in self.basis() {
            add_to(&mut x, dot(combination, wanted), unit);
        }
        divide_each(&mut x, &self.scale);
        x
    }

    /// `x = sum_k h_k right_k` in the metric, with rows and `right` divided by the sizes: the direction in which the
    /// squared gaps of the rows fall fastest. In units of the metric.
    pub(crate) fn descent(&self, right: &[f64]) -> Vector {
        let mut x = Vector::zeros(self.scale.len());
        for (row, right) in self.row.iter().zip(right) {
            add_to(&mut x, *right, row);
        }
        x
    }

    /// The `x` with the smallest `sum_k (h_k x / size_k - right_k)^2 + damping |x|^2` in the metric: a damped
    /// [`Self::shortest`], for rows divided by their sizes.
    pub(crate) fn damped(&self, right: &[f64], damping: f64) -> Option<Vector> {
        let count = self.count();
        let normal =
            Matrix::from_fn(count, count, |i, j| dot(&self.row[i], &self.row[j]) + if i == j { damping } else { 0.0 });
        let z = Cholesky::new(&normal).ok()?.solve(right);
        let mut x = self.descent(&z);
        divide_each(&mut x, &self.scale);
        Some(x)
    }

    /// Least-squares multipliers `mu` with `sum_k mu_k h_k = force` (forces divided by `scale`), the shortest in
    /// `mu_k size_k`.
    pub(crate) fn multipliers(&self, force: &[f64]) -> Vector {
        let mut force = Vector::from(force);
        divide_each(&mut force, &self.scale);
        let mut mu = Vector::zeros(self.count());
        for (unit, combination) in self.basis() {
            add_to(&mut mu, dot(unit, &force), combination);
        }
        for left in self.dependencies() {
            let along = dot(left, &mu);
            add_to(&mut mu, -along, left);
        }
        divide_each(&mut mu, &self.size);
        mu
    }
}

/// Subtracts from a vector its part in the span of the orthonormal `known`.
fn make_orthogonal<'a, K>(vector: &mut [f64], known: impl Fn() -> K)
where
    K: Iterator<Item = &'a [f64]>,
{
    for _ in 0..2 {
        for direction in known() {
            let along = dot(direction, vector);
            add_to(vector, -along, direction);
        }
    }
}

/// Row `k`, mutable, and row `i` before it.
fn pair(matrix: &mut Matrix, i: usize, k: usize) -> (&[f64], &mut [f64]) {
    let n = matrix.column_count();
    let (before, rest) = matrix.as_flattened_mut().split_at_mut(k * n);
    (&before[i * n..(i + 1) * n], &mut rest[..n])
}

/// Divides each value by its scale.
fn divide_each(values: &mut [f64], scales: &[f64]) {
    for (value, scale) in values.iter_mut().zip(scales) {
        *value /= scale;
    }
}

fn divide(values: &mut [f64], by: f64) {
    for value in values {
        *value /= by;
    }
}

fn norm(vector: &[f64]) -> f64 {
    dot(vector, vector).sqrt()
}

fn normalise(vector: &mut [f64]) {
    let size = norm(vector);
    if size > 0.0 {
        divide(vector, size);
    } else {
        vector.fill(0.0);
    }
}
