//! Inverse iteration of the symmetric solver.

use super::pencils::{diagonal, identity};
use crate::eigenproblem::symmetric::{refine, solve};

/// Inaccurate pairs become accurate; none becomes another one that is there already.
#[test]
fn refined_pairs_are_accurate_and_different() {
    let (stiffness, mass) = (diagonal(&[1.0, 3.0, 8.0]), identity(3));
    let mut pairs = solve(&stiffness, &mass).unwrap();
    pairs.lambda[1] += 1e-4;
    pairs.shapes[1].copy_from_slice(&[1e-3, 1.0, -2e-3]);
    refine(&stiffness, &mass, &mut pairs, &[1]);
    assert!((pairs.lambda[1] - 3.0).abs() < 1e-14);
    assert!(pairs.shapes[1][0].abs() < 1e-14 && pairs.shapes[1][2].abs() < 1e-14);
    let lost = [0.1, 0.99, 0.0];
    pairs.lambda[0] = 2.9;
    pairs.shapes[0].copy_from_slice(&lost);
    refine(&stiffness, &mass, &mut pairs, &[0]);
    assert!(pairs.lambda[0] == 2.9 && pairs.shapes[0] == lost);
}
