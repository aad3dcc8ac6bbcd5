//! Symmetric three-by-three matrices: principal values, and the conditions for an inertia to belong to a body.

/// Three numbers along the axes of a frame.
pub type Vector = [f64; 3];
/// Rows of three numbers.
pub type Matrix = [Vector; 3];

/// A matrix from its entries.
pub(super) fn matrix(entry: impl Fn(usize, usize) -> f64) -> Matrix {
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| entry(i, j)))
}

/// Entry of the identity matrix.
pub(super) fn identity(i: usize, j: usize) -> f64 {
    if i == j { 1.0 } else { 0.0 }
}

pub(super) fn product(a: &Matrix, b: &Matrix) -> Matrix {
    matrix(|i, j| (0..3).map(|k| a[i][k] * b[k][j]).sum())
}

pub(super) fn product_with_vector(a: &Matrix, v: Vector) -> Vector {
    [0, 1, 2].map(|i| (0..3).map(|k| a[i][k] * v[k]).sum())
}

pub(super) fn transposed(a: &Matrix) -> Matrix {
    matrix(|i, j| a[j][i])
}

pub(super) fn trace(a: &Matrix) -> f64 {
    (0..3).map(|i| a[i][i]).sum()
}

/// Principal values in ascending order, and their axes as columns in the same order (Jacobi 1846).
pub fn principal(symmetric: &Matrix) -> (Vector, Matrix) {
    let (mut a, mut axes) = (*symmetric, matrix(identity));
    // Convergence is quadratic: a few sweeps reach the last digit.
    for _ in 0..16 {
        for (p, q) in [(0, 1), (1, 2), (0, 2)] {
            if a[p][q] == 0.0 {
                continue;
            }
            let ratio = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
            let tan = ratio.signum() / (ratio.abs() + ratio.hypot(1.0));
            let cos = 1.0 / tan.hypot(1.0);
            let sin = tan * cos;
            let turn = matrix(|i, j| match (i, j) {
                _ if i == j && (i == p || i == q) => cos,
                _ if (i, j) == (p, q) => sin,
                _ if (i, j) == (q, p) => -sin,
                _ => identity(i, j),
            });
            a = product(&product(&transposed(&turn), &a), &turn);
            axes = product(&axes, &turn);
        }
    }
    let mut order = [0, 1, 2];
    order.sort_by(|&i, &j| a[i][i].total_cmp(&a[j][j]));
    (order.map(|k| a[k][k]), matrix(|i, j| axes[i][order[j]]))
}

/// The second moment `tr(J)/2 1 - J`, the integral of `r r^T dm`, of an inertia `J`.
pub(super) fn second_moment(inertia: &Matrix) -> Matrix {
    let half = trace(inertia) / 2.0;
    matrix(|i, j| half * identity(i, j) - inertia[i][j])
}

/// The inertia `tr(S) 1 - S` of a second moment `S`.
pub(super) fn inertia(second: &Matrix) -> Matrix {
    let trace = trace(second);
    matrix(|i, j| trace * identity(i, j) - second[i][j])
}

/// Whether principal moments, in ascending order, belong to a body. Mass is nowhere negative, so each is at most the
/// sum of the other two, and then none is negative. Rounding may leave a flat body slightly short.
fn belongs_to_a_body([a, b, c]: Vector) -> bool {
    a + b - c >= -2e-9 * (a + b + c).abs() && a + b + c >= 0.0
}

/// Whether a body can have this inertia about its centre of mass.
pub fn is_inertia_of_a_body(inertia: &Matrix) -> bool {
    belongs_to_a_body(principal(inertia).0)
}

/// The possible inertia of a body that differs least from this one (Frobenius norm); it has the same principal axes.
pub fn nearest_of_a_body(inertia: &Matrix) -> Matrix {
    let ([a, b, c], axes) = principal(inertia);
    let short = (c - a - b) / 3.0;
    let nearest = if belongs_to_a_body([a, b, c]) {
        return *inertia;
    } else if a + short >= 0.0 {
        // Flat body.
        [a + short, b + short, c - short]
    } else {
        // Slender body.
        let both = ((b + c) / 2.0).max(0.0);
        [0.0, both, both]
    };
    matrix(|i, j| (0..3).map(|k| nearest[k] * axes[i][k] * axes[j][k]).sum())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn full([xx, yy, zz, xy, yz, xz]: [f64; 6]) -> Matrix {
        [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]
    }

    fn possible(entries: [f64; 6]) -> bool {
        belongs_to_a_body(principal(&full(entries)).0)
    }

    fn near(a: &Matrix, b: &Matrix) -> bool {
        a.iter().flatten().zip(b.iter().flatten()).all(|(a, b)| (a - b).abs() < 1e-14)
    }

    /// `[[2, -1, 0], [-1, 2, -1], [0, -1, 2]]` has the eigenvalues 2 - sqrt 2, 2, 2 + sqrt 2.
    #[test]
    fn principal_values_and_axes() {
        let a = full([2.0, 2.0, 2.0, -1.0, -1.0, 0.0]);
        let (values, axes) = principal(&a);
        let root = 2.0_f64.sqrt();
        for (value, exact) in values.into_iter().zip([2.0 - root, 2.0, 2.0 + root]) {
            assert!((value - exact).abs() < 1e-14);
        }
        let diagonal = matrix(|i, j| values[i] * identity(i, j));
        assert!(near(&product(&product(&axes, &diagonal), &transposed(&axes)), &a));
        assert!(near(&product(&transposed(&axes), &axes), &matrix(identity)));
    }

    #[test]
    fn inertias_of_bodies() {
        assert!(possible([1.0, 1.0, 2.0, 0.0, 0.0, 0.0]));
        assert!(possible([1.0, 1.0, 0.0, 0.0, 0.0, 0.0]));
        assert!(possible([0.0; 6]));
        // A slender bar along (1, 1, 1): J = 1 - n n^T.
        let third = 1.0 / 3.0;
        let (moment, product) = (1.0 - third, -third);
        assert!(possible([moment, moment, moment, product, product, product]));
    }

    #[test]
    fn inertias_of_no_body() {
        for entries in [
            [1.0, 1.0, 2.1, 0.0, 0.0, 0.0],
            [-1.0, 1.0, 1.0, 0.0, 0.0, 0.0],
            [1.0, 1.0, 1.0, 0.6, 0.6, 0.6],
            [1.0, 1.0, 1.0, 0.0, 0.0, 0.9],
            [0.0, 0.0, 0.0, 0.1, 0.0, 0.0],
            [-1.0, -1.0, -1.0, 0.0, 0.0, 0.0],
        ] {
            assert!(!possible(entries), "{entries:?}");
        }
    }

    /// Compares with a search over a grid of possible bodies, `J = diag(b + c, a + c, a + b)` with `a, b, c >= 0`.
    #[test]
    fn nothing_is_nearer_than_the_nearest() {
        for given in [[1.0, 1.0, 3.0], [1.0, -1.0, 1.0], [0.1, 0.2, 2.0], [-3.0, 1.0, 1.5], [-1.0; 3]] {
            let [x, y, z] = given;
            let nearest = nearest_of_a_body(&full([x, y, z, 0.0, 0.0, 0.0]));
            let moments = [nearest[0][0], nearest[1][1], nearest[2][2]];
            assert!(belongs_to_a_body(principal(&nearest).0), "{nearest:?}");
            let distance = |other: Vector| -> f64 { other.iter().zip(given).map(|(a, b)| (a - b).powi(2)).sum() };
            let steps = 60;
            let value = |k: usize| 2.0 * k as f64 / steps as f64;
            let mut least = f64::INFINITY;
            for a in (0..=steps).map(value) {
                for b in (0..=steps).map(value) {
                    for c in (0..=steps).map(value) {
                        least = least.min(distance([b + c, a + c, a + b]));
                    }
                }
            }
            // A grid of 1/30 finds the optimum up to the square of its width.
            let shortest = distance(moments);
            assert!(shortest <= least + 1e-12 && shortest >= least - 0.01, "{given:?}: {shortest} {least}");
        }
    }
}
