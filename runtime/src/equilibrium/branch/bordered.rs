//! Triangular factors of a square matrix with `B` more rows and columns: where `Khat` is singular, the bordered matrix
//! is not.
#![allow(
    clippy::needless_range_loop,
    reason = "index loops read as the formulas they are"
)]

use core::ops::{Index, IndexMut};

use crate::array::Square;

/// `N + B` things in one sequence.
#[derive(Clone, Copy)]
struct Joined<T, const N: usize, const B: usize> {
    head: [T; N],
    tail: [T; B],
}

impl<T: Copy, const N: usize, const B: usize> Joined<T, N, B> {
    fn swap(&mut self, i: usize, j: usize) {
        let kept = self[i];
        self[i] = self[j];
        self[j] = kept;
    }
}

impl<T, const N: usize, const B: usize> Index<usize> for Joined<T, N, B> {
    type Output = T;
    fn index(&self, i: usize) -> &T {
        if i < N {
            &self.head[i]
        } else {
            &self.tail[i - N]
        }
    }
}

impl<T, const N: usize, const B: usize> IndexMut<usize> for Joined<T, N, B> {
    fn index_mut(&mut self, i: usize) -> &mut T {
        if i < N {
            &mut self.head[i]
        } else {
            &mut self.tail[i - N]
        }
    }
}

type Row<const N: usize, const B: usize> = Joined<f64, N, B>;

impl<const N: usize, const B: usize> Row<N, B> {
    fn largest(&self) -> f64 {
        let all = self.head.iter().chain(&self.tail);
        all.fold(0.0, |most: f64, value| most.max(value.abs()))
    }
}

/// `P [core columns; rows corner] = L U`.
pub(crate) struct Bordered<const N: usize, const B: usize> {
    factors: Joined<Row<N, B>, N, B>,
    order: Joined<usize, N, B>,
    odd: bool,
}

impl<const N: usize, const B: usize> Bordered<N, B> {
    const SIZE: usize = N + B;

    /// Factors the matrix; `None` when a pivot does not rise above the rounding of its own row. `columns[j]` is the
    /// `j`-th added column, `rows[i]` the `i`-th added row.
    pub(crate) fn new(
        core: &Square<N>,
        columns: [&[f64; N]; B],
        rows: [&[f64; N]; B],
        corner: [[f64; B]; B],
    ) -> Option<Self> {
        let threshold = 8.0 * Self::SIZE as f64 * f64::EPSILON;
        let mut factors = Joined {
            head: core::array::from_fn(|i| Joined {
                head: core[i],
                tail: columns.map(|column| column[i]),
            }),
            tail: core::array::from_fn(|i| Joined {
                head: *rows[i],
                tail: corner[i],
            }),
        };
        let mut order = Joined {
            head: core::array::from_fn(|i| i),
            tail: core::array::from_fn(|i| N + i),
        };
        let mut size = Joined {
            head: factors.head.each_ref().map(Row::largest),
            tail: factors.tail.each_ref().map(Row::largest),
        };
        let mut odd = false;
        for k in 0..Self::SIZE {
            let (mut best, mut most) = (k, -1.0);
            for i in k..Self::SIZE {
                let relative = factors[i][k].abs() / size[i];
                if relative > most {
                    (best, most) = (i, relative);
                }
            }
            if most <= threshold || !most.is_finite() {
                return None;
            }
            if best != k {
                factors.swap(k, best);
                order.swap(k, best);
                size.swap(k, best);
                odd = !odd;
            }
            let pivot = factors[k];
            for i in k + 1..Self::SIZE {
                let row = &mut factors[i];
                let factor = row[k] / pivot[k];
                row[k] = factor;
                for j in k + 1..Self::SIZE {
                    row[j] -= factor * pivot[j];
                }
            }
        }
        Some(Self {
            factors,
            order,
            odd,
        })
    }

    pub(crate) fn solve(&self, right: &[f64; N], border: [f64; B]) -> ([f64; N], [f64; B]) {
        let right = Joined {
            head: *right,
            tail: border,
        };
        let mut x = Joined {
            head: self.order.head.map(|i| right[i]),
            tail: self.order.tail.map(|i| right[i]),
        };
        for i in 0..Self::SIZE {
            for k in 0..i {
                x[i] -= self.factors[i][k] * x[k];
            }
        }
        for i in (0..Self::SIZE).rev() {
            for k in i + 1..Self::SIZE {
                x[i] -= self.factors[i][k] * x[k];
            }
            x[i] /= self.factors[i][i];
        }
        (x.head, x.tail)
    }

    /// Solves with the transposed matrix.
    pub(crate) fn solve_transposed(
        &self,
        right: &[f64; N],
        border: [f64; B],
    ) -> ([f64; N], [f64; B]) {
        let mut y = Joined {
            head: *right,
            tail: border,
        };
        for i in 0..Self::SIZE {
            for k in 0..i {
                y[i] -= self.factors[k][i] * y[k];
            }
            y[i] /= self.factors[i][i];
        }
        for i in (0..Self::SIZE).rev() {
            for k in i + 1..Self::SIZE {
                y[i] -= self.factors[k][i] * y[k];
            }
        }
        let mut x = y;
        for i in 0..Self::SIZE {
            x[self.order[i]] = y[i];
        }
        (x.head, x.tail)
    }

    /// Whether the determinant is negative.
    pub(crate) fn negative_determinant(&self) -> bool {
        (0..Self::SIZE).fold(self.odd, |negative, i| {
            negative != (self.factors[i][i] < 0.0)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CORE: Square<2> = [[1.0, 2.0], [2.0, 4.0]];

    #[test]
    fn solves_where_the_core_is_singular() {
        let Some(lu) = Bordered::new(
            &CORE,
            [&[1.0, 0.5], &[0.0, 3.0]],
            [&[2.0, -1.0], &[0.3, 1.0]],
            [[0.0, 1.0], [0.5, 0.0]],
        ) else {
            panic!("regular")
        };
        let full = [
            [1.0, 2.0, 1.0, 0.0],
            [2.0, 4.0, 0.5, 3.0],
            [2.0, -1.0, 0.0, 1.0],
            [0.3, 1.0, 0.5, 0.0],
        ];
        let x = [1.0, -2.0, 3.0, 0.7];
        let forward: [f64; 4] = core::array::from_fn(|i| (0..4).map(|j| full[i][j] * x[j]).sum());
        let backward: [f64; 4] = core::array::from_fn(|j| (0..4).map(|i| full[i][j] * x[i]).sum());
        let solutions = [
            lu.solve(&[forward[0], forward[1]], [forward[2], forward[3]]),
            lu.solve_transposed(&[backward[0], backward[1]], [backward[2], backward[3]]),
        ];
        for (head, tail) in solutions {
            for (found, expected) in head.iter().chain(&tail).zip(x) {
                assert!((found - expected).abs() < 1e-14);
            }
        }
        assert!(lu.negative_determinant());
    }

    #[test]
    fn the_determinant_has_its_sign() {
        // det [1 2 1; 2 4 0; 0 1 0] = 2.
        let det = |last: f64| {
            Bordered::new(&CORE, [&[1.0, 0.0]], [&[0.0, last]], [[0.0]])
                .map(|lu| lu.negative_determinant())
        };
        assert_eq!(det(1.0), Some(false));
        assert_eq!(det(-1.0), Some(true));
        assert_eq!(det(0.0), None);
    }
}
