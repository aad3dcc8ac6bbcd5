//! Linear equations in disturbed numbers.

use super::disturbed::Disturbed;

/// The solutions of homogeneous linear equations `L x + M y = 0` for `y`.
pub struct NullSpace {
    /// A basis of all `y` for which there is an `x`.
    pub vectors: Vec<Vec<Disturbed>>,
    /// Rank of `L`.
    pub lead_rank: usize,
}

impl NullSpace {
    /// Solves equations given row by row, with the entries of `L`, `lead` of them, before those of `M`. Each value counts
    /// as zero if its own rounding can explain it (see [`Disturbed::is_rounding`]), so no unit and no scale matters.
    ///
    /// Gaussian elimination, one equation after the other; the pivot of each is its largest entry, in `L` if that has
    /// any, relative to the largest of the column.
    pub fn new(rows: Vec<Vec<Disturbed>>, lead: usize, operations: usize) -> Self {
        let columns = rows.first().map_or(lead, Vec::len);
        let mut sizes = vec![0.0_f64; columns];
        for row in &rows {
            for (size, entry) in sizes.iter_mut().zip(row) {
                *size = size.max(entry.value().abs());
            }
        }
        let mut pivots: Vec<Pivot> = Vec::new();
        for mut row in rows {
            for pivot in &pivots {
                pivot.eliminate_from(&mut row);
            }
            for entry in row.iter_mut().filter(|entry| entry.is_rounding(operations)) {
                *entry = Disturbed::exact(0.0);
            }
            let largest = |columns: std::ops::Range<usize>| {
                let size = |k: &usize| row[*k].value().abs() / sizes[*k];
                let present = columns.filter(|&k| !row[k].is_zero());
                present.max_by(|a, b| size(a).total_cmp(&size(b)))
            };
            if let Some(column) = largest(0..lead).or_else(|| largest(lead..columns)) {
                pivots.push(Pivot::new(column, &row));
            }
        }
        let is_pivot = |k: usize| pivots.iter().any(|pivot| pivot.column == k);
        let mut vectors = Vec::new();
        for free in (lead..columns).filter(|&k| !is_pivot(k)) {
            let mut vector = vec![Disturbed::exact(0.0); columns];
            vector[free] = Disturbed::exact(1.0);
            for pivot in pivots.iter().rev().filter(|pivot| pivot.column >= lead) {
                vector[pivot.column] = -pivot.others_times(&vector);
            }
            vectors.push(vector.split_off(lead));
        }
        Self {
            vectors,
            lead_rank: pivots.iter().filter(|pivot| pivot.column < lead).count(),
        }
    }
}

/// An equation that gives the unknown of one column from others, with the coefficient one.
struct Pivot {
    column: usize,
    others: Vec<(usize, Disturbed)>,
}

impl Pivot {
    fn new(column: usize, row: &[Disturbed]) -> Self {
        let present = row.iter().enumerate().filter(|(_, entry)| !entry.is_zero());
        let others = present.filter(|(k, _)| *k != column);
        Self {
            column,
            others: others.map(|(k, &entry)| (k, entry / row[column])).collect(),
        }
    }

    fn eliminate_from(&self, row: &mut [Disturbed]) {
        let factor = row[self.column];
        if factor.is_zero() {
            return;
        }
        row[self.column] = Disturbed::exact(0.0);
        for &(k, entry) in &self.others {
            row[k] = row[k] - factor * entry;
        }
    }

    fn others_times(&self, vector: &[Disturbed]) -> Disturbed {
        let terms = self.others.iter().map(|&(k, entry)| entry * vector[k]);
        terms.fold(Disturbed::exact(0.0), |sum, term| sum + term)
    }
}

/// The product of a matrix, given row by row, with vectors: `result[i][k] = sum_j matrix[i][j] vectors[k][j]`.
pub fn times(matrix: &[Vec<Disturbed>], vectors: &[Vec<Disturbed>]) -> Vec<Vec<Disturbed>> {
    let product = |row: &[Disturbed], vector: &[Disturbed]| {
        let pairs = row.iter().zip(vector);
        let present = pairs.filter(|(a, b)| !a.is_zero() && !b.is_zero());
        present.fold(Disturbed::exact(0.0), |sum, (&a, &b)| sum + a * b)
    };
    let row = |row: &Vec<Disturbed>| vectors.iter().map(|v| product(row, v)).collect();
    matrix.iter().map(row).collect()
}
