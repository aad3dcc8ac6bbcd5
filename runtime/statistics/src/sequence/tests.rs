//! Checks point sets against their definitions and against known integrals.

use proptest::prelude::*;

use super::*;

pub(super) fn points(sequence: &Sequence, from: u64, number: usize) -> Vec<Vec<f64>> {
    let mut walk = sequence.from(from);
    let mut points = Vec::new();
    while let Some(point) = walk.next_point().filter(|_| points.len() < number) {
        points.push(point.to_vec());
    }
    points
}

fn all_kinds(dimensions: usize, seed: u64, stream: u64) -> [Sequence; 3] {
    [
        Sequence::random(dimensions, seed, stream).unwrap(),
        Sequence::latin_hypercube(dimensions, 1000, seed, stream).unwrap(),
        Sequence::sobol(dimensions, seed, stream).unwrap(),
    ]
}

#[test]
fn points_are_addressable() {
    for sequence in all_kinds(5, 3, 1) {
        let walk = points(&sequence, 0, 1000);
        assert_eq!(walk.len(), 1000);
        for first in [1, 2, 63, 64, 500, 999] {
            assert_eq!(points(&sequence, first, 1), walk[first as usize..][..1]);
        }
        let mut alone = [0.0; 5];
        for (k, point) in walk.iter().enumerate() {
            sequence.point(k as u64, &mut alone).unwrap();
            assert_eq!(alone[..], point[..]);
            assert!(point.iter().all(|x| 0.0 < *x && *x < 1.0));
        }
    }
}

/// One point over many streams: its coordinates, those of the next stream and those of another seed. All are uniform
/// and all pairs are uncorrelated, within four standard deviations.
#[test]
fn streams_seeds_and_dimensions_are_independent() {
    let streams = 4000;
    for kind in 0..3 {
        let rows: Vec<Vec<f64>> = (0..streams)
            .map(|stream| {
                let sets = [(1, stream), (1, stream + 1), (2, stream)];
                sets.iter()
                    .flat_map(|&(seed, stream)| {
                        let mut point = [0.0; 3];
                        let sequence = &all_kinds(3, seed, stream)[kind];
                        sequence.point(77, &mut point).unwrap();
                        point.map(|x| 12.0_f64.sqrt() * (x - 0.5))
                    })
                    .collect()
            })
            .collect();
        let mean = |f: &dyn Fn(&[f64]) -> f64| {
            let sum: f64 = rows.iter().map(|row| f(row)).sum();
            sum / streams as f64 * (streams as f64).sqrt()
        };
        for i in 0..9 {
            assert!(mean(&|row| row[i]).abs() < 4.0);
            assert!(mean(&|row| row[i].powi(2) - 1.0).abs() < 4.0 * 0.8_f64.sqrt());
            for j in 0..i {
                assert!(mean(&|row| row[i] * row[j]).abs() < 4.0, "{kind}: {i} {j}");
            }
        }
    }
}

#[test]
fn every_stratum_holds_one_point_of_a_latin_hypercube() {
    for (n, dimensions) in [(1, 3), (2, 3), (7, 20), (1000, 4), (1024, 4)] {
        let sequence = Sequence::latin_hypercube(dimensions, n, 11, 5).unwrap();
        let all = points(&sequence, 0, usize::MAX);
        assert_eq!(all.len() as u64, n);
        for j in 0..dimensions {
            let mut strata: Vec<u64> = all.iter().map(|x| (x[j] * n as f64) as u64).collect();
            strata.sort_unstable();
            assert!(strata.into_iter().eq(0..n));
        }
    }
}

/// Even far out in large samples, the stratum is the permuted number.
#[test]
fn strata_of_large_samples_are_distinct() {
    let n = 1 << 32;
    let sequence = Sequence::latin_hypercube(1, n, 11, 5).unwrap();
    let mut strata: Vec<u64> = points(&sequence, n - 20_000, 20_000).iter().map(|x| (x[0] * n as f64) as u64).collect();
    strata.sort_unstable();
    strata.dedup();
    assert_eq!(strata.len(), 20_000);
}

/// Published in the example of Joe and Kuo's program `sobol.cc`.
#[test]
fn first_points_are_the_published_ones() {
    let published = [
        [0.0, 0.0, 0.0],
        [0.5, 0.5, 0.5],
        [0.75, 0.25, 0.25],
        [0.25, 0.75, 0.75],
        [0.375, 0.375, 0.625],
        [0.875, 0.875, 0.125],
        [0.625, 0.125, 0.875],
        [0.125, 0.625, 0.375],
        [0.1875, 0.3125, 0.9375],
        [0.6875, 0.8125, 0.4375],
    ];
    let sequence = Sequence::unscrambled_sobol(3).unwrap();
    for (point, published) in points(&sequence, 0, 10).iter().zip(published) {
        assert_eq!(point[..], published.map(|x| x + 2.0_f64.powi(-37)));
    }
}

/// The exponent with which the error decreases, and the last error: root mean square over independent randomisations.
fn order(sequence: impl Fn(u64, u64) -> Sequence, f: impl Fn(&[f64]) -> f64, exact: f64) -> f64 {
    let rmse = |n: u64| {
        let streams = 64;
        let squares = (0..streams).map(|stream| {
            let sum: f64 = points(&sequence(n, stream), 0, n as usize).iter().map(|x| f(x)).sum();
            (sum / n as f64 - exact).powi(2)
        });
        (squares.sum::<f64>() / streams as f64).sqrt()
    };
    (rmse(1 << 12) / rmse(1 << 6)).log2() / 6.0
}

#[test]
fn errors_fall_as_theory_says() {
    let product = |x: &[f64]| x.iter().map(|x| x.exp()).product::<f64>();
    let exact = (1.0_f64.exp() - 1.0).powi(2);
    let sobol = order(|_, s| Sequence::sobol(2, 1, s).unwrap(), product, exact);
    assert!((-1.65..-1.35).contains(&sobol), "{sobol}");
    let random = order(|_, s| Sequence::random(2, 1, s).unwrap(), product, exact);
    assert!((-0.6..-0.4).contains(&random), "{random}");

    let sample = |n, s| Sequence::latin_hypercube(2, n, 1, s).unwrap();
    let sum = |x: &[f64]| x.iter().map(|x| x.exp()).sum::<f64>();
    let additive = order(sample, sum, 2.0 * (1.0_f64.exp() - 1.0));
    assert!((-1.6..-1.4).contains(&additive), "{additive}");
    let interaction = order(sample, |x| (x[0] - 0.5) * (x[1] - 0.5), 0.0);
    assert!((-0.6..-0.4).contains(&interaction), "{interaction}");
}

proptest! {
    #[test]
    fn any_latin_hypercube_is_stratified(n in 1..300_u64, seed: u64, stream: u64) {
        let sequence = Sequence::latin_hypercube(2, n, seed, stream).unwrap();
        let all = points(&sequence, 0, usize::MAX);
        for j in 0..2 {
            let mut strata: Vec<u64> = all.iter().map(|x| (x[j] * n as f64) as u64).collect();
            strata.sort_unstable();
            prop_assert!(strata.into_iter().eq(0..n));
        }
    }

    #[test]
    fn any_point_is_the_same_alone_and_on_a_walk(first in 0..1_u64 << 36, seed: u64, stream: u64) {
        let latin = Sequence::latin_hypercube(3, 1 << 32, seed, stream).unwrap();
        for sequence in [Sequence::random(3, seed, stream).unwrap(), latin, Sequence::sobol(3, seed, stream).unwrap()] {
            let mut alone = [0.0; 3];
            for (k, point) in (first..).zip(points(&sequence, first, 4)) {
                sequence.point(k, &mut alone).unwrap();
                prop_assert_eq!(&alone[..], &point[..]);
                prop_assert!(alone.iter().all(|x| 0.0 < *x && *x < 1.0));
            }
        }
    }
}

#[test]
fn settings_are_checked() {
    assert!(Sequence::random(0, 0, 0).is_err());
    assert!(Sequence::latin_hypercube(1, 0, 0, 0).is_err());
    assert!(Sequence::latin_hypercube(1, (1 << 32) + 1, 0, 0).is_err());
    assert!(Sequence::sobol(2049, 0, 0).is_err());
    let last = Sequence::sobol(2048, 0, 0).unwrap();
    assert_eq!(last.dimensions(), 2048);
    let sample = Sequence::latin_hypercube(2, 5, 0, 0).unwrap();
    assert!(sample.point(4, &mut [0.0; 2]).is_ok());
    assert!(matches!(sample.point(5, &mut [0.0; 2]), Err(Error::BeyondLast { index: 5, .. })));
    assert!(sample.point(0, &mut [0.0; 3]).is_err());
    assert!(sample.from(9).next_point().is_none());
    let sobol = Sequence::sobol(1, 0, 0).unwrap();
    assert_eq!(points(&sobol, (1 << 36) - 2, 10).len(), 2);
}

/// The bits are part of the interface, so that stored results can be reproduced.
#[test]
fn bits_are_fixed() {
    let bits = all_kinds(2, 5, 6).map(|s| points(&s, 3, 1)[0][1].to_bits());
    assert_eq!(bits, [4_604_920_890_493_916_600, 4_600_094_095_634_112_294, 4_603_790_039_243_656_292]);
}
