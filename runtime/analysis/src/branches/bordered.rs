//! Triangular factors of a square matrix bordered by `B` rows and columns: where `Khat` is singular, the bordered
//! matrix is not.

use core::array;

use crate::algebra::{Lu, Matrix, Vector};

/// Factors of `[core columns; rows corner]`.
pub(crate) struct Bordered<const B: usize = 1> {
    factors: Lu,
}

impl<const B: usize> Bordered<B> {
    /// Factorises the matrix; `None` if it is singular up to rounding. `columns[j]` is the
    /// `j`-th added column, `rows[i]` the `i`-th added row.
    pub(crate) fn new(core: &Matrix, columns: [&[f64]; B], rows: [&[f64]; B], corner: [[f64; B]; B]) -> Option<Self> {
        let n = core.row_count();
        let whole = Matrix::from_fn(n + B, n + B, |i, j| match (i < n, j < n) {
            (true, true) => core[i][j],
            (true, false) => columns[j - n][i],
            (false, true) => rows[i - n][j],
            (false, false) => corner[i - n][j - n],
        });
        Lu::of(whole).map(|factors| Self { factors })
    }

    pub(crate) fn solve(&self, right: &[f64], border: [f64; B]) -> (Vector, [f64; B]) {
        parted(&self.factors.solve(&joined(right, border)))
    }

    /// Solves with the transposed matrix.
    pub(crate) fn solve_transposed(&self, right: &[f64], border: [f64; B]) -> (Vector, [f64; B]) {
        parted(&self.factors.solve_transposed(&joined(right, border)))
    }

    /// Whether the determinant is negative.
    pub(crate) fn negative_determinant(&self) -> bool {
        self.factors.negative_determinant()
    }
}

fn joined<const B: usize>(head: &[f64], tail: [f64; B]) -> Vector {
    head.iter().copied().chain(tail).collect()
}

fn parted<const B: usize>(whole: &[f64]) -> (Vector, [f64; B]) {
    let (head, tail) = whole.split_at(whole.len() - B);
    (head.into(), array::from_fn(|j| tail[j]))
}

#[cfg(test)]
mod tests {
    use super::*;

    const CORE: [[f64; 2]; 2] = [[1.0, 2.0], [2.0, 4.0]];

    #[test]
    fn solves_where_the_core_is_singular() {
        let Some(lu) = Bordered::new(
            &CORE.into(),
            [&[1.0, 0.5], &[0.0, 3.0]],
            [&[2.0, -1.0], &[0.3, 1.0]],
            [[0.0, 1.0], [0.5, 0.0]],
        ) else {
            panic!("regular")
        };
        let full = [[1.0, 2.0, 1.0, 0.0], [2.0, 4.0, 0.5, 3.0], [2.0, -1.0, 0.0, 1.0], [0.3, 1.0, 0.5, 0.0]];
        let x = [1.0, -2.0, 3.0, 0.7];
        let forward: [f64; 4] = array::from_fn(|i| (0..4).map(|j| full[i][j] * x[j]).sum());
        let backward: [f64; 4] = array::from_fn(|j| (0..4).map(|i| full[i][j] * x[i]).sum());
        let solutions = [
            lu.solve(&[forward[0], forward[1]], [forward[2], forward[3]]),
            lu.solve_transposed(&[backward[0], backward[1]], [backward[2], backward[3]]),
        ];
        for (head, tail) in solutions {
            for (solved, expected) in head.iter().chain(&tail).zip(x) {
                assert!((solved - expected).abs() < 1e-14);
            }
        }
        assert!(lu.negative_determinant());
    }

    #[test]
    fn the_determinant_has_its_sign() {
        // det [1 2 1; 2 4 0; 0 1 0] = 2.
        let det = |last: f64| {
            Bordered::new(&CORE.into(), [&[1.0, 0.0]], [&[0.0, last]], [[0.0]]).map(|lu| lu.negative_determinant())
        };
        assert_eq!(det(1.0), Some(false));
        assert_eq!(det(-1.0), Some(true));
        assert_eq!(det(0.0), None);
    }
}
