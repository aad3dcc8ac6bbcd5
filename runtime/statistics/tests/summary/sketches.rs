//! Sketch quantiles are within their stated errors of the quantiles of sorted values.

use eigentol_statistics::Error;
use eigentol_statistics::summary::{Sketch, Sorted};
use proptest::prelude::*;

use crate::common::{normal, uniform};

const SHARES: [f64; 13] = [0.0, 1e-4, 0.01, 0.1, 0.25, 0.4, 0.5, 0.501, 0.75, 0.9, 0.999, 0.9999, 1.0];

fn sketch(values: &[f64], reference: f64, scale: f64) -> Result<Sketch, Error> {
    let mut sketch = Sketch::new(reference, scale)?;
    sketch.add(values)?;
    Ok(sketch)
}

/// Checks all estimates against the sorted values.
fn check(name: &str, values: &[f64], reference: f64, scale: f64) -> Result<(), Error> {
    let (sketch, sorted) = (sketch(values, reference, scale)?, Sorted::new(values.to_vec())?);
    for p in SHARES {
        let (found, exact) = (sketch.quantile(p)?, sorted.quantile(p)?);
        assert!((found.value - exact).abs() <= found.error, "{name}, {p}: {found:?}, exact {exact}");
        // The promised error, for the neighbours of the quantile.
        let position = (values.len() - 1) as f64 * p;
        let neighbours = [position.floor(), position.ceil()].map(|rank| sorted.values()[rank as usize]);
        let bound = neighbours.map(|value| {
            let deviation = (value - reference).abs();
            let rounding = 4.0 * f64::EPSILON * (value.abs() + reference.abs());
            f64::max(deviation / 256.0, scale * 0.5_f64.powi(23)) + rounding
        });
        assert!(found.error <= 1.0001 * bound[0].max(bound[1]), "{name}, {p}: {found:?}, bound {bound:?}");
        let inside = sketch.cdf(exact)?;
        let share = sorted.cdf(exact)?;
        assert!((inside.value - share).abs() <= inside.error + 1e-15, "{name}, {p}: {inside:?}, exact {share}");
    }
    assert_eq!(sketch.quantile(0.0)?.value, sorted.values()[0]);
    assert_eq!(sketch.quantile(1.0)?.value, sorted.values()[values.len() - 1]);
    let histogram = sketch.histogram(20)?;
    let mut sum = 0.0;
    for (edge, share) in histogram.edges[1..].iter().zip(&histogram.shares) {
        sum += share;
        let known = sketch.cdf(*edge)?;
        assert!((sum - sorted.cdf(*edge)?).abs() <= known.error + 1e-12, "{name} at {edge}");
    }
    assert!((sum - 1.0).abs() < 1e-12 && histogram.shares.iter().all(|share| *share >= 0.0));
    Ok(())
}

#[test]
fn of_many_distributions() -> Result<(), Error> {
    let count = 20_000;
    let of = |value: &dyn Fn(u64) -> f64| -> Vec<f64> { (0..count).map(value).collect() };
    let sign = |k| if uniform(30, k) < 0.3 { -1.0 } else { 1.0 };
    let bimodal = of(&|k| 10.0 + sign(k) * (5.0 + 0.01 * normal(31, k)));
    let magnitudes = of(&|k| sign(k) * 10_f64.powf(600.0 * uniform(32, k) - 300.0));
    let on_reference = of(&|k| if k % 2 == 0 { 3.0 } else { 3.0 + normal(33, k) });
    let grid = of(&|k| (k % 5) as f64);
    let normals = of(&|k| 100.0 + normal(34, k));
    let tails = of(&|k| (std::f64::consts::PI * (uniform(35, k) - 0.5)).tan());
    let large = of(&|k| 1e8 + 1e-4 * normal(36, k));
    let signed_zeros = of(&|k| if k % 2 == 0 { 0.0 } else { -0.0 });
    for (name, values, reference, scale) in [
        ("normal", &normals, 100.0, 1.0),
        ("normal, reference aside", &normals, 97.0, 1.0),
        ("normal, reference far away", &normals, 0.0, 1.0),
        ("normal, reference beyond all", &normals, 1e4, 1.0),
        ("normal, scale too small", &normals, 100.0, 1e-12),
        ("normal, scale too large", &normals, 100.0, 1e5),
        ("normal, scale much too large", &normals, 100.0, 1e12),
        ("bimodal", &bimodal, 10.0, 1.0),
        ("magnitudes", &magnitudes, 0.0, 1.0),
        ("magnitudes, small scale", &magnitudes, 0.0, 1e-300),
        ("on the reference", &on_reference, 3.0, 1.0),
        ("grid", &grid, 2.0, 1.0),
        ("tails", &tails, 0.0, 1.0),
        ("large mean", &large, 1e8, 1e-4),
        ("signed zeros", &signed_zeros, 0.0, 1.0),
    ] {
        check(name, values, reference, scale)?;
    }
    Ok(())
}

#[test]
fn resolution_for_normal_values() -> Result<(), Error> {
    let values: Vec<f64> = (0..100_000).map(|k| 50.0 + 0.2 * normal(37, k)).collect();
    let (sketch, sorted) = (sketch(&values, 50.0, 0.2)?, Sorted::new(values)?);
    for (p, limit) in [(0.5, 1e-5), (0.16, 0.004), (0.84, 0.004), (0.001, 0.013), (0.999, 0.013)] {
        let value = sketch.quantile(p)?;
        assert!(value.error <= limit * 0.2, "{p}: {value:?}");
        // With many values per bucket, interpolation is much better than its bound.
        if (0.1..0.9).contains(&p) {
            let exact = sorted.quantile(p)?;
            assert!((value.value - exact).abs() <= 0.1 * limit * 0.2 + 2e-6, "{p}: {value:?}, exact {exact}");
        }
    }
    Ok(())
}

#[test]
fn zeros_of_either_sign_are_the_same_in_any_order() -> Result<(), Error> {
    let mut texts = Vec::new();
    for [first, second] in [[0.0, -0.0], [-0.0, 0.0]] {
        let mut all = sketch(&[first], 1.0, 1.0)?;
        all.merge(&sketch(&[second], 1.0, 1.0)?)?;
        texts.push(format!("{all:?}"));
    }
    assert_eq!(texts[0], texts[1]);
    Ok(())
}

#[test]
fn values_that_are_all_the_same_are_exact() -> Result<(), Error> {
    for (value, reference) in [(5.0, 5.0), (5.1, 5.0), (-0.3, 0.0), (1e300, -1e300), (1e-300, 0.0)] {
        let sketch = sketch(&[value; 300], reference, 1.0)?;
        for p in SHARES {
            let quantile = sketch.quantile(p)?;
            assert_eq!((quantile.value, quantile.error), (value, 0.0));
        }
        assert_eq!((sketch.cdf(value)?.value, sketch.cdf(value - 1e-3 * value.abs())?.value), (1.0, 0.0));
        let histogram = sketch.histogram(7)?;
        assert_eq!((histogram.edges, histogram.shares), (vec![value, value], vec![1.0]));
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 100, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn of_any_values(
        values in prop::collection::vec((-40_i32..40, -50_i32..50), 1..400),
        reference in -40_i32..40,
        scale in -10_i32..10,
    ) {
        // Few different numbers, many powers of two, and values on bucket edges and on the reference.
        let values: Vec<f64> = values.iter().map(|(n, e)| f64::from(*n) * 2_f64.powi(*e / 4)).collect();
        check("any", &values, f64::from(reference), 2_f64.powi(scale))?;
    }

    #[test]
    fn merged_in_any_order(
        values in prop::collection::vec(-1e3..1e3_f64, 1..300),
        cuts in prop::collection::vec(0_usize..300, 3),
        zeros in any::<bool>(),
    ) {
        let mut values = values;
        if zeros {
            values.extend([0.0, -0.0]);
        }
        let mut cuts: Vec<usize> = cuts.into_iter().map(|cut| cut.min(values.len())).collect();
        cuts.sort_unstable();
        let whole = sketch(&values, 1.5, 1e-3)?;
        let parts = [&values[..cuts[0]], &values[cuts[0]..cuts[1]], &values[cuts[1]..cuts[2]], &values[cuts[2]..]];
        let parts: Result<Vec<Sketch>, Error> = parts.into_iter().map(|part| sketch(part, 1.5, 1e-3)).collect();
        let parts = parts?;
        let (mut forwards, mut backwards) = (Sketch::new(1.5, 1e-3)?, Sketch::new(1.5, 1e-3)?);
        for (part, last) in parts.iter().zip(parts.iter().rev()) {
            forwards.merge(part)?;
            backwards.merge(last)?;
        }
        prop_assert_eq!(&forwards, &whole);
        prop_assert_eq!(&backwards, &whole);
        let bits = |sketch: &Sketch| sketch.quantile(0.0).map(|least| least.value.to_bits());
        prop_assert_eq!(bits(&forwards)?, bits(&backwards)?);
    }
}
