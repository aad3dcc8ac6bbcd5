//! Rules against reference values, grids against moments of the normal distribution and against Smolyak's formula.

use super::*;
use std::collections::BTreeMap;

/// The mean of `z^exponent`: `(exponent - 1)!!` or zero.
fn moment(exponent: u32) -> f64 {
    if exponent % 2 == 1 {
        return 0.0;
    }
    (1..exponent).step_by(2).map(f64::from).product()
}

/// Nodes, node, weight: computed with 50 digits from the three-term recurrence (mpmath). Scaled by `sqrt(1/2)` and `sqrt(pi)`
/// those of 10 nodes are in Abramowitz and Stegun, table 25.10.
const REFERENCE: [(usize, f64, f64); 17] = [
    (10, 0.48493570751549765305, 0.34464233493201904288),
    (10, 1.4659890943911581833, 0.13548370298026773556),
    (10, 2.4843258416389545809, 0.019111580500770285605),
    (10, 3.5818234835519269228, 0.00075807093431221767007),
    (10, 4.8594628283323121502, 4.3106526307182867322e-6),
    (63, 0.39427621554318114781, 0.14556029162597161507),
    (63, 0.78879411019526713911, 0.11536940911860985222),
    (63, 6.4920415085546248653, 1.2134983535332409183e-10),
    (63, 13.122773251777114931, 1.1169151003963276417e-38),
    (63, 13.86336017715451783, 5.8680109554960143265e-43),
    (63, 14.758025457404141256, 2.093098582846016693e-48),
    (64, 0.19558891056727554851, 0.15310831636189678144),
    (64, 0.58688282330529248139, 0.13145323131750089789),
    (64, 6.6493714563417205189, 4.2964262489852520136e-11),
    (64, 13.255649357397284797, 1.9301704298297753957e-39),
    (64, 13.994049908876469471, 9.4769631900430299655e-44),
    (64, 14.886186143339452306, 3.1231879651077211753e-49),
];

#[test]
fn rules_agree_with_reference_values() {
    for (nodes, node, weight) in REFERENCE {
        let rule = gauss_hermite(nodes).unwrap();
        for sign in [-1.0, 1.0] {
            let near = |z: &&f64| (**z - sign * node).abs() < 1e-14 * node;
            let place = rule.nodes.iter().position(|z| near(&z));
            let found = rule.weights[place.expect("a node there")];
            assert!(
                (found / weight - 1.0).abs() < 2e-14,
                "{nodes} {node} {found:e}"
            );
        }
    }
}

/// Moments up to the degree of exactness; the next one differs by `n!` (the norm of the Hermite polynomial).
#[test]
fn rules_are_exact_up_to_their_degree() {
    for nodes in (1..=40).chain([64, 128, 256]) {
        let rule = gauss_hermite(nodes).unwrap();
        assert!(rule.nodes.is_sorted());
        let mean = |exponent: u32| {
            let terms = rule.nodes.iter().zip(&rule.weights);
            terms.map(|(z, w)| w * z.powi(exponent as i32)).sum::<f64>()
        };
        for exponent in 0..(2 * nodes as u32).min(120) {
            let scale = moment(exponent + exponent % 2);
            assert!(
                (mean(exponent) - moment(exponent)).abs() < 2e-13 * scale,
                "{nodes} {exponent}"
            );
        }
        if nodes < 15 {
            let factorial: f64 = (1..=nodes as u32).map(f64::from).product();
            let next = 2 * nodes as u32;
            let missing = moment(next) - mean(next);
            assert!((missing / factorial - 1.0).abs() < 1e-8, "{nodes}");
        }
    }
}

#[test]
fn tensor_grids_are_exact_up_to_their_degrees() {
    let nodes = [2, 1, 4];
    let grid = TensorGrid::new(&nodes).unwrap();
    assert_eq!((grid.points(), grid.dimensions()), (8, 3));
    let monomial = |z: &[f64], e: [u32; 3]| {
        let powers = z.iter().zip(e).map(|(z, e)| z.powi(e as i32));
        powers.product::<f64>()
    };
    for (a, b, c) in (0..5).flat_map(|a| (0..3).flat_map(move |b| (0..9).map(move |c| (a, b, c)))) {
        let mean = grid.integrate(|z| monomial(z, [a, b, c])).unwrap();
        let exact = moment(a) * moment(b) * moment(c);
        let within = a < 4 && b < 2 && c < 8;
        let odd = a % 2 + b % 2 + c % 2 > 0;
        assert_eq!((mean - exact).abs() < 1e-12, within || odd, "{a} {b} {c}");
    }
    assert_eq!(grid.from(8).next_point(), None);
}

#[test]
fn tensor_grids_can_be_entered_anywhere() {
    let grid = TensorGrid::new(&[3, 2, 4]).unwrap();
    let mut all = Vec::new();
    let mut walk = grid.from(0);
    while let Some(node) = walk.next_point() {
        all.push((node.point.to_vec(), node.weight));
    }
    assert_eq!(all.len(), 24);
    for (k, (point, weight)) in all.iter().enumerate() {
        let mut walk = grid.from(k as u64);
        let node = walk.next_point().unwrap();
        assert_eq!((node.point, node.weight), (&point[..], *weight));
    }
}

/// Levels of all variables with a given sum.
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

/// Smolyak's formula as it stands: products of rules, weights of equal points added.
fn smolyak(dimensions: usize, level: usize) -> BTreeMap<Vec<u64>, f64> {
    let mut grid = BTreeMap::new();
    for below in 0..dimensions.min(level + 1) {
        let binomial =
            (0..below).fold(1.0, |b, i| b * (dimensions - 1 - i) as f64 / (i + 1) as f64);
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
                let weight =
                    |grid: &BTreeMap<Vec<u64>, f64>| grid.get(&key).copied().unwrap_or(0.0);
                assert!((node.weight - weight(&fine)).abs() < 1e-12);
                let below = coarse.as_ref().map_or(0.0, weight);
                assert!((node.coarse_weight - below).abs() < 1e-12);
                assert_eq!(seen.insert(key, ()), None, "a point twice");
            }
            assert_eq!(seen.len() as u64, grid.points(), "{dimensions} {level}");
            let present = |(_, weight): &(&Vec<u64>, &f64)| weight.abs() > 1e-12;
            let missing = fine
                .iter()
                .filter(present)
                .find(|(key, _)| !seen.contains_key(*key));
            assert_eq!(missing, None);
        }
    }
}

/// As many as the nested grids of Heiss and Winschel (J. Econometrics 144, 2008, table 1) up to their accuracy level 4.
#[test]
fn sparse_grids_are_small() {
    let points = |d, level| SparseGrid::new(d, level).unwrap().points();
    assert_eq!(
        [0, 1, 2, 3].map(|level| points(10, level)),
        [1, 21, 201, 1201]
    );
    assert_eq!(
        [0, 1, 2, 3].map(|level| points(20, level)),
        [1, 41, 801, 10_001]
    );
    assert_eq!(points(400, 2), 2 * 400 * 400 + 1);
}

/// All monomials of total degree `2 level + 1` in few variables, and the product of `level + 1` squares, which is the first that
/// the grid misses.
#[test]
fn sparse_grids_are_exact_up_to_their_total_degree() {
    for level in 0..=5_u32 {
        let grid = SparseGrid::new(3, level as usize).unwrap();
        for sum in 0..=2 * level as usize + 1 {
            for e in levels(sum, 3) {
                let f = |z: &[f64]| z.iter().zip(&e).map(|(z, e)| z.powi(*e as i32)).product();
                let exact: f64 = e.iter().map(|e| moment(*e as u32)).product();
                let integral = grid.integrate(f).unwrap();
                assert!(
                    (integral.value - exact).abs() < 1e-9 * exact.max(1.0),
                    "{level} {e:?}"
                );
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

/// The mean of `exp(a . z)` is `exp(a . a / 2)`; the difference to the level below exceeds the error.
#[test]
fn smooth_functions_converge() {
    let a = [0.3, -0.2, 0.1, 0.25];
    let exact = (a.iter().map(|a| a * a).sum::<f64>() / 2.0).exp();
    let f = |z: &[f64]| z.iter().zip(a).map(|(z, a)| a * z).sum::<f64>().exp();
    let mut error = f64::INFINITY;
    for level in 0..7 {
        let integral = SparseGrid::new(4, level).unwrap().integrate(f).unwrap();
        let next = (integral.value - exact).abs();
        assert!(
            next < 0.15 * error && next < integral.difference,
            "{level} {next:e}"
        );
        error = next;
    }
    assert!(error < 1e-10);
}

#[test]
fn settings_are_checked() {
    assert!(gauss_hermite(0).is_err() && gauss_hermite(257).is_err());
    assert!(TensorGrid::new(&[]).is_err() && TensorGrid::new(&[2; 64]).is_err());
    assert!(TensorGrid::new(&[2, 0]).is_err());
    assert!(SparseGrid::new(0, 1).is_err());
    assert!(SparseGrid::new(2000, 12).is_err());
    let grid = SparseGrid::new(2, 1).unwrap();
    assert!(matches!(
        grid.integrate(|_| f64::NAN),
        Err(Error::NotFinite { .. })
    ));
}
