//! Linear equations in disturbed numbers.

use std::ops::Range;

use super::disturbed::Disturbed;

/// What rounding may leave of a coefficient, relative to the largest of its equation, for it to count as zero. Where it
/// may have left more, rounding hides whether there is anything.
const CLEAR: f64 = 1e-6;

/// The solutions of homogeneous linear equations `L x + M y = 0` for `y`.
pub struct NullSpace {
    /// A basis of all `y` for which there is an `x`, as far as rounding lets see.
    pub vectors: Vec<Vec<Disturbed>>,
    /// How many more there may be: equations in which rounding hides whether they take one away. They count as if they did.
    pub hidden: usize,
    /// Rank of `L`.
    pub lead_rank: usize,
}

impl NullSpace {
    /// Solves equations given row by row, with the entries of `L`, `lead` of them, before those of `M`. Each value counts
    /// as zero if its own rounding can explain it (see [`Disturbed::is_rounding`]) and is small, so no unit matters, and
    /// of scale only what rounding hides.
    ///
    /// Gaussian elimination, one equation after the other; the pivot of each is its largest entry, in `L` if that has
    /// any, relative to the largest of the column.
    pub fn new(mut rows: Vec<Vec<Disturbed>>, lead: usize, operations: usize) -> Self {
        scale(&mut rows, operations);
        Self::of_scaled(rows, lead, operations)
    }

    /// The same for equations whose terms are of order one, whatever is left of them.
    pub fn of_scaled(rows: Vec<Vec<Disturbed>>, lead: usize, operations: usize) -> Self {
        let columns = rows.first().map_or(lead, Vec::len);
        let mut sizes = vec![0.0_f64; columns];
        for row in &rows {
            for (size, entry) in sizes.iter_mut().zip(row) {
                *size = size.max(entry.value().abs());
            }
        }
        let mut pivots: Vec<Pivot> = Vec::new();
        let mut hidden = 0;
        let clear = |entry: &Disturbed| !entry.is_rounding(operations);
        let mut waiting = rows;
        // What rounding hides is looked at again once all other equations have been used.
        for last in [false, true] {
            for mut row in std::mem::take(&mut waiting) {
                for pivot in &pivots {
                    pivot.eliminate_from(&mut row);
                }
                for entry in &mut row {
                    if !clear(entry) && entry.rounding(operations) <= CLEAR {
                        *entry = Disturbed::exact(0.0);
                    }
                }
                let largest = |of: Range<usize>, counts: &dyn Fn(&Disturbed) -> bool| {
                    let size = |k: &usize| row[*k].value().abs() / sizes[*k];
                    of.filter(|&k| counts(&row[k])).max_by(|a, b| size(a).total_cmp(&size(b)))
                };
                let any = |entry: &Disturbed| !entry.is_zero();
                let of_lead = largest(0..lead, &clear);
                let sure = last || of_lead.is_some() || largest(0..lead, &any).is_none();
                let column = of_lead.or_else(|| largest(lead..columns, &clear));
                if let Some(column) = column.filter(|_| sure) {
                    pivots.push(Pivot::new(column, &row));
                } else if !last && row.iter().any(any) {
                    waiting.push(row);
                } else if let Some(column) = largest(lead..columns, &any) {
                    hidden += 1;
                    pivots.push(Pivot { column, others: Vec::new() });
                }
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
        Self { vectors, hidden, lead_rank: pivots.iter().filter(|pivot| pivot.column < lead).count() }
    }
}

/// Divides each equation by its largest entry, or by that of all if rounding hides its own.
pub fn scale(rows: &mut [Vec<Disturbed>], operations: usize) {
    let largest = |row: &[Disturbed]| {
        let clear = row.iter().filter(|entry| !entry.is_rounding(operations));
        clear.fold(0.0_f64, |most, entry| most.max(entry.value().abs()))
    };
    let sizes: Vec<f64> = rows.iter().map(|row| largest(row)).collect();
    let most = sizes.iter().fold(0.0_f64, |most, size| most.max(*size));
    for (row, size) in rows.iter_mut().zip(sizes) {
        let size = if size > 0.0 { size } else { most };
        if size > 0.0 {
            let unit = Disturbed::exact(size);
            row.iter_mut().filter(|entry| !entry.is_zero()).for_each(|entry| *entry = *entry / unit);
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
        let others = row.iter().enumerate().filter(|(_, entry)| !entry.is_zero()).filter(|(k, _)| *k != column);
        Self { column, others: others.map(|(k, &entry)| (k, entry / row[column])).collect() }
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
        self.others.iter().map(|&(k, entry)| entry * vector[k]).fold(Disturbed::exact(0.0), |sum, term| sum + term)
    }
}

/// The product of a matrix, given row by row, with vectors: `result[i][k] = sum_j matrix[i][j] vectors[k][j]`.
pub fn times(matrix: &[Vec<Disturbed>], vectors: &[Vec<Disturbed>]) -> Vec<Vec<Disturbed>> {
    let product = |row: &[Disturbed], vector: &[Disturbed]| {
        let present = row.iter().zip(vector).filter(|(a, b)| !a.is_zero() && !b.is_zero());
        present.fold(Disturbed::exact(0.0), |sum, (&a, &b)| sum + a * b)
    };
    matrix.iter().map(|row| vectors.iter().map(|v| product(row, v)).collect()).collect()
}
