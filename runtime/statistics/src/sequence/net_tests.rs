//! Checks Sobol' points in elementary intervals.

use proptest::prelude::*;

use super::Sequence;
use super::tests::points;

/// Every elementary interval of volume `2^(t-m)` contains `2^t` of `2^m` points.
fn is_net(points: &[Vec<f64>], m: u32, t: u32) -> bool {
    let dimensions = points[0].len();
    let balanced = |digits: &[u32]| {
        let mut counts = vec![0_u64; 1 << (m - t)];
        for point in points {
            let cell = point.iter().zip(digits).fold(0, |cell, (x, digits)| {
                let side = (1_u64 << digits) as f64;
                cell << digits | (x * side) as usize
            });
            counts[cell] += 1;
        }
        counts.into_iter().all(|count| count == 1 << t)
    };
    shares(m - t, dimensions).iter().all(|digits| balanced(digits))
}

/// All ways to distribute a number of digits among dimensions.
fn shares(digits: u32, dimensions: usize) -> Vec<Vec<u32>> {
    if dimensions == 1 {
        return vec![vec![digits]];
    }
    let with = |first: u32| {
        let rest = shares(digits - first, dimensions - 1);
        rest.into_iter().map(move |rest| [vec![first], rest].concat())
    };
    (0..=digits).flat_map(with).collect()
}

/// The quality parameter of the Sobol' sequence is the sum of (degree - 1) over its polynomials (Sobol' 1967): the
/// degrees are 0, 1, 2, 3, 3, and the first dimension counts as degree 1.
#[test]
fn points_form_nets() {
    for (dimensions, t) in [(1, 0), (2, 0), (3, 1), (4, 3), (5, 5)] {
        for m in [t, t + 1, t + 4, 10] {
            for block in [0, 1, 5] {
                let number = 1 << m;
                let plain = Sequence::unscrambled_sobol(dimensions).unwrap();
                assert!(is_net(&points(&plain, block * number, number as usize), m, t));
                for stream in 0..3 {
                    let sequence = Sequence::sobol(dimensions, 17, stream).unwrap();
                    let points = points(&sequence, block * number, number as usize);
                    assert!(is_net(&points, m, t), "{dimensions} {m} {block} {stream}");
                }
            }
        }
    }
    let random = Sequence::random(2, 17, 0).unwrap();
    assert!(!is_net(&points(&random, 0, 64), 6, 0));
}

proptest! {
    #[test]
    fn any_aligned_block_is_a_net(m in 0..9_u32, block in 0..1_u64 << 27, seed: u64, stream: u64) {
        let sequence = Sequence::sobol(2, seed, stream).unwrap();
        prop_assert!(is_net(&points(&sequence, block << m, 1 << m), m, 0));
    }
}
