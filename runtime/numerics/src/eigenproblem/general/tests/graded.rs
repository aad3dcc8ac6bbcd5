//! The symmetric solver where eigenvalues spread over more orders of magnitude than a double has digits.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

use super::pencils::{below, diagonal, uniform};
use crate::algebra::{Matrix, Vector, dot, times};
use crate::eigenproblem::symmetric;

/// Shapes that are found are those of different modes.
#[test]
fn no_shape_is_found_twice() {
    let rng = &mut ChaCha8Rng::seed_from_u64(31);
    let mut refused = 0;
    for _ in 0..2000 {
        let n = 2 + below(rng, 11) as usize;
        let stiffness: Vec<f64> = (0..n)
            .map(|_| 10.0_f64.powf(9.0 * uniform(rng) + 9.0))
            .collect();
        let rates = Matrix::from_fn(n, n, |_, _| uniform(rng));
        let mass = Matrix::from_fn(n, n, |i, j| (0..n).map(|k| rates[k][i] * rates[k][j]).sum());
        let Ok(pairs) = symmetric::solve(&diagonal(&stiffness), &mass) else {
            refused += 1;
            continue;
        };
        for (r, shape) in pairs.shapes.iter().enumerate() {
            let weighted: Vector = times(&mass, shape);
            for other in pairs.shapes.iter().take(r) {
                let product = dot(other, &weighted);
                assert!(product.abs() < 0.51, "{product} {stiffness:?}");
            }
        }
    }
    assert!((1..100).contains(&refused), "{refused}");
}
