//! Exact quantiles and their confidence intervals.

use eigentol_statistics::Error;
use eigentol_statistics::summary::{Sketch, Sorted};

use crate::common::uniform;

fn ranks(count: u32, p: f64, confidence: f64) -> Result<Option<(f64, f64, f64)>, Error> {
    let values = Sorted::new((1..=count).rev().map(f64::from).collect())?;
    let interval = values.quantile_interval(p, confidence)?;
    Ok(interval.map(|interval| (interval.lower, interval.upper, interval.coverage)))
}

/// R: `quantile(c(2, 3, 5, 7, 11, 13, 17), type = 7)`; at 1/6 it is the second value, and linear in between.
#[test]
fn quantiles_of_type_seven() -> Result<(), Error> {
    let values = Sorted::new(vec![17.0, 2.0, 13.0, 3.0, 11.0, 5.0, 7.0])?;
    for (p, expected) in [(0.0, 2.0), (0.25, 4.0), (0.5, 7.0), (0.75, 12.0), (1.0, 17.0), (0.9, 14.6), (0.1, 2.6)] {
        assert!((values.quantile(p)? - expected).abs() < 1e-14, "{p}");
    }
    assert_eq!(Sorted::new(vec![4.0])?.quantile(0.3)?, 4.0);
    assert_eq!(values.cdf(7.0)?, 4.0 / 7.0);
    assert_eq!((values.cdf(1.9)?, values.cdf(17.0)?), (0.0, 1.0));
    Ok(())
}

/// Ranks and coverages for medians at 95 percent as tabulated (Conover, Practical Nonparametric Statistics, 3rd
/// edition, section 3.2): exact sums of binomial coefficients.
#[test]
fn intervals_of_medians() -> Result<(), Error> {
    assert_eq!(ranks(5, 0.5, 0.95)?, None);
    for (count, lower, upper, left_out) in [
        (6, 1.0, 6.0, 2.0 / 64.0),
        (8, 1.0, 8.0, 2.0 / 256.0),
        (9, 2.0, 8.0, 20.0 / 512.0),
        (10, 2.0, 9.0, 22.0 / 1024.0),
        (20, 6.0, 15.0, 2.0 * 21_700.0 / 1_048_576.0),
    ] {
        let Some((first, last, coverage)) = ranks(count, 0.5, 0.95)? else {
            panic!("{count} are enough");
        };
        assert_eq!((first, last), (lower, upper), "{count}");
        assert!((coverage - (1.0 - left_out)).abs() < 1e-14, "{count}: {coverage}");
    }
    Ok(())
}

/// Wilks (1941): 59 values are needed for their maximum to exceed the 95 percent quantile with 95 percent confidence,
/// hence 90 percent with both ends; with 58 values there is no upper end.
#[test]
fn intervals_of_tails() -> Result<(), Error> {
    assert_eq!(ranks(58, 0.95, 0.90)?, None);
    let Some((_, upper, _)) = ranks(59, 0.95, 0.90)? else {
        panic!("59 are enough");
    };
    assert_eq!(upper, 59.0);
    let Some((lower, _, _)) = ranks(59, 0.05, 0.90)? else {
        panic!("59 are enough");
    };
    assert_eq!(lower, 1.0);
    Ok(())
}

/// For many values ranks approach those from the normal distribution: `n p -+ z sqrt(n p (1 - p))`.
#[test]
fn intervals_of_many_values() -> Result<(), Error> {
    for (count, p) in [(1_000_000, 0.5), (1_000_000, 0.01), (300_000, 0.999)] {
        let Some((lower, upper, coverage)) = ranks(count, p, 0.99)? else {
            panic!("{count} are enough");
        };
        let (mean, half) = (f64::from(count) * p, 2.575_829_3 * (f64::from(count) * p * (1.0 - p)).sqrt());
        // The skewness of the binomial distribution shifts both ends by about one.
        assert!((lower - (mean - half)).abs() < 2.5 && (upper - (mean + half)).abs() < 2.5, "{lower} {upper}");
        assert!((0.99..0.992).contains(&coverage), "{coverage}");
    }
    Ok(())
}

#[test]
fn intervals_cover_the_quantile_as_often_as_they_say() -> Result<(), Error> {
    for (count, p) in [(40, 0.5), (100, 0.9)] {
        let (experiments, mut covered, mut coverage) = (4000, 0, 0.0);
        for experiment in 0..experiments {
            let values = (0..count).map(|k| uniform(40, experiment * count + k).powi(3)).collect();
            let Some(found) = Sorted::new(values)?.quantile_interval(p, 0.9)? else {
                panic!("{count} are enough");
            };
            coverage = found.coverage;
            covered += u32::from(found.lower <= p.powi(3) && p.powi(3) <= found.upper);
        }
        let share = f64::from(covered) / experiments as f64;
        let error = (coverage * (1.0 - coverage) / experiments as f64).sqrt();
        assert!(coverage >= 0.9 && (share - coverage).abs() < 4.0 * error, "{share} and {coverage}");
    }
    Ok(())
}

#[test]
fn intervals_of_sketches_contain_those_of_values() -> Result<(), Error> {
    let values: Vec<f64> = (0..3000).map(|k| uniform(41, k).powi(2)).collect();
    let mut sketch = Sketch::new(0.3, 0.1)?;
    sketch.add(&values)?;
    let sorted = Sorted::new(values)?;
    for p in [0.05, 0.5, 0.95] {
        let (Some(found), Some(exact)) = (sketch.quantile_interval(p, 0.95)?, sorted.quantile_interval(p, 0.95)?)
        else {
            panic!("3000 are enough");
        };
        assert_eq!(found.coverage, exact.coverage);
        assert!(found.lower <= exact.lower && exact.upper <= found.upper);
        assert!(exact.lower - found.lower < 0.005 && found.upper - exact.upper < 0.005);
    }
    assert_eq!(sketch.quantile_interval(1e-5, 0.95)?, None);
    Ok(())
}
