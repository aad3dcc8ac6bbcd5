//! Sparse grids against Smolyak's formula and against moments of the normal distribution.

use std::collections::BTreeMap;

use super::tests::moment;
use super::*;

/// All combinations of levels with a given sum.
fn levels(sum: usize, dimensions: usize) -> Vec<Vec<usize>> {
    if dimensions == 1 {
        return vec![vec![sum]];
    }
    (0..=sum)
        .flat_map(|first| {
            let rest = levels(sum - first, dimensions - 1).into_iter();
            rest.map(move |rest| [vec![first], rest].concat())
        })
        .collect()
}

/// Smolyak's formula taken literally: products of rules, adding weights of equal points.
fn smolyak(dimensions: usize, level: usize) -> BTreeMap<Vec<u64>, f64> {
    let mut grid = BTreeMap::new();
    for below in 0..dimensions.min(level + 1) {
        let binomial = (0..below).fold(1.0, |b, i| b * (dimensions - 1 - i) as f64 / (i + 1) as f64);
        let coefficient = if below % 2 == 0 { binomial } else { -binomial };
        for levels in levels(level - below, dimensions) {
            let nodes: Vec<usize> = levels.iter().map(|l| 2 * l.div_ceil(2) + 1).collect();
            let product = TensorGrid::new(&nodes).unwrap();
            let mut walk = product.from(0);
            while let Some(Node { point, weight }) = walk.next_point() {
                let key = point.iter().map(|z| z.to_bits()).collect();
                *grid.entry(key).or_insert(0.0) += coefficient * weight;
            }
        }
    }
    grid
}

#[test]
fn sparse_grids_are_smolyaks() {
    for (dimensions, top) in [(1, 9), (2, 8), (3, 6), (5, 4)] {
        for level in 0..=top {
            let grid = SparseGrid::new(dimensions, level).unwrap();
            let fine = smolyak(dimensions, level);
            let coarse = level.checked_sub(1).map(|level| smolyak(dimensions, level));
            let mut walk = grid.walk();
            let mut seen = BTreeMap::new();
            while let Some(node) = walk.next_point() {
                let key: Vec<u64> = node.point.iter().map(|z| z.to_bits()).collect();
                let weight = |grid: &BTreeMap<Vec<u64>, f64>| grid.get(&key).copied().unwrap_or(0.0);
                assert!((node.weight - weight(&fine)).abs() < 1e-12);
                let below = coarse.as_ref().map_or(0.0, weight);
                assert!((node.coarse_weight - below).abs() < 1e-12);
                assert_eq!(seen.insert(key, ()), None, "a point twice");
            }
            assert_eq!(seen.len() as u64, grid.points(), "{dimensions} {level}");
            let present = |(_, weight): &(&Vec<u64>, &f64)| weight.abs() > 1e-12;
            let missing = fine.iter().filter(present).find(|(key, _)| !seen.contains_key(*key));
            assert_eq!(missing, None);
        }
    }
}

/// The point counts equal those of the nested grids of Heiss and Winschel (J. Econometrics 144, 2008, table 1) up to
/// their accuracy level 4.
#[test]
fn sparse_grids_are_small() {
    let points = |d, level| SparseGrid::new(d, level).unwrap().points();
    assert_eq!([0, 1, 2, 3].map(|level| points(10, level)), [1, 21, 201, 1201]);
    assert_eq!([0, 1, 2, 3].map(|level| points(20, level)), [1, 41, 801, 10_001]);
    assert_eq!(points(400, 2), 2 * 400 * 400 + 1);
}

/// All monomials of total degree `2 level + 1` in few variables, and the product of `level + 1` squares, the first
/// monomial that the grid misses.
#[test]
fn sparse_grids_are_exact_up_to_their_total_degree() {
    for level in 0..=5_u32 {
        let grid = SparseGrid::new(3, level as usize).unwrap();
        for sum in 0..=2 * level as usize + 1 {
            for e in levels(sum, 3) {
                let f = |z: &[f64]| z.iter().zip(&e).map(|(z, e)| z.powi(*e as i32)).product();
                let exact: f64 = e.iter().map(|e| moment(*e as u32)).product();
                let integral = grid.integrate(f).unwrap();
                assert!((integral.value - exact).abs() < 1e-9 * exact.max(1.0), "{level} {e:?}");
                if sum + 2 <= 2 * level as usize + 1 {
                    assert!(integral.difference < 1e-9 * exact.max(1.0));
                }
            }
        }
    }
    for level in 0..4 {
        let grid = SparseGrid::new(6, level).unwrap();
        let squares = |n: usize| move |z: &[f64]| z[..n].iter().map(|z| z * z).product::<f64>();
        let missed = grid.integrate(squares(level + 1)).unwrap();
        assert!(missed.value.abs() < 1e-12);
        if level > 0 {
            let met = grid.integrate(squares(level)).unwrap();
            assert!((met.value - 1.0).abs() < 1e-12 && (met.difference - 1.0).abs() < 1e-12);
        }
    }
}

/// The magnitudes of the weights sum to about ten thousand: plain summation would leave an error above 1e-10.
#[test]
fn sums_stay_accurate_in_many_dimensions() {
    let grid = SparseGrid::new(60, 3).unwrap();
    assert_eq!(grid.points(), 281_201);
    let one = grid.integrate(|_| 1.0).unwrap();
    assert!((one.value - 1.0).abs() < 1e-11 && one.difference < 1e-11);
    let mut walk = grid.walk();
    let (mut moduli, mut sum) = (0.0, 0.0);
    while let Some(node) = walk.next_point() {
        moduli += node.weight.abs();
        sum += node.weight;
    }
    assert!((5e3..2e4).contains(&moduli), "{moduli}");
    assert!((sum - 1.0_f64).abs() > 1e-10, "{sum}");
}

/// The mean of `exp(a . z)` is `exp(a . a / 2)`; the difference from the next lower level exceeds the error.
#[test]
fn smooth_functions_converge() {
    let a = [0.3, -0.2, 0.1, 0.25];
    let exact = (a.iter().map(|a| a * a).sum::<f64>() / 2.0).exp();
    let f = |z: &[f64]| z.iter().zip(a).map(|(z, a)| a * z).sum::<f64>().exp();
    let mut error = f64::INFINITY;
    for level in 0..7 {
        let integral = SparseGrid::new(4, level).unwrap().integrate(f).unwrap();
        let next = (integral.value - exact).abs();
        assert!(next < 0.15 * error && next < integral.difference, "{level} {next:e}");
        error = next;
    }
    assert!(error < 1e-10);
}
