//! Checks confidence intervals over independent samples, and rejected arguments.

use super::tests::{evaluate, few};
use super::*;
use crate::Error;
use crate::sequence::Sequence;

/// Intervals of 90 per cent over independent samples contain the index about 90 times out of 100 (below 80 or above 98:
/// once in a thousand), and shrink with the square root of the number of rows.
#[test]
fn intervals_hold_the_index() {
    let bootstrap = Bootstrap { resamples: 200, confidence: 0.9, seed: 3 };
    let indices = |rows: u64, stream: u64| {
        let design = SaltelliDesign::new(Sequence::random(4, 8, stream).unwrap(), rows).unwrap();
        let values = evaluate(&design, |u| u[0] + 2.0 * u[1]);
        sobol_indices(2, &values, Estimator::Jansen, bootstrap).unwrap()
    };
    let samples: Vec<SobolIndices> = (0..100).map(|stream| indices(100, stream)).collect();
    let exact = [0.2, 0.8];
    for input in 0..2 {
        for total in [false, true] {
            let held = samples.iter().filter(|sample| {
                let kind = if total { &sample.total } else { &sample.first };
                kind[input].lower <= exact[input] && exact[input] <= kind[input].upper
            });
            let held = held.count();
            assert!((80..=98).contains(&held), "{input} {held}");
        }
    }
    let width = |rows| {
        let widths = (0..10).map(|stream| indices(rows, stream).first[1]);
        widths.map(|e| e.upper - e.lower).sum::<f64>()
    };
    let ratio = width(100) / width(1600);
    assert!((ratio / 4.0 - 1.0).abs() < 0.2, "{ratio}");
}

#[test]
fn wrong_values_are_refused() {
    let indices = |values: &[Option<f64>]| sobol_indices(1, values, Estimator::Martinez, few());
    assert!(matches!(indices(&[Some(1.0); 4]), Err(Error::WrongLength { .. })));
    assert!(matches!(indices(&[Some(0.1); 6]), Err(Error::Constant { .. })));
    assert!(matches!(indices(&[Some(f64::NAN); 6]), Err(Error::NotFinite { .. })));
    assert!(matches!(indices(&[]), Err(Error::TooFew { .. })));
    let holes = [Some(1.0), Some(2.0), Some(3.0), None, Some(1.0), Some(0.0)];
    assert!(matches!(indices(&holes), Err(Error::TooFew { found: 1, .. })));
}
