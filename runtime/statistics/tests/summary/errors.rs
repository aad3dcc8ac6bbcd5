//! A refused operation leaves everything unchanged.

use eigentol_statistics::Error;
use eigentol_statistics::summary::{Chunk, LARGEST, Partial, Plan, Sketch, Sorted, chunks};

use crate::common::{gathered, plan};

#[test]
fn overlaps_are_named() -> Result<(), Error> {
    let mut partial = gathered(100..1000)?;
    let before = partial.clone();
    for (samples, start, end) in [
        (0..101, 100, 101),
        (999..1200, 999, 1000),
        (300..310, 300, 310),
        (0..5000, 100, 1000),
        (512..768, 512, 768),
        (100..101, 100, 101),
    ] {
        assert_eq!(partial.merge(gathered(samples)?), Err(Error::Overlap { start, end }));
        assert_eq!(partial, before);
    }
    for samples in [0..101, 512..768, 300..310, 999..1024] {
        let chunk = Chunk::new(&plan()?, samples.clone())?;
        let (start, end) = (samples.start.max(100), samples.end.min(1000));
        assert_eq!(partial.add(&chunk), Err(Error::Overlap { start, end }));
    }
    assert_eq!(partial, before);
    partial.merge(gathered(0..100)?)?;
    partial.merge(gathered(1000..1024)?)?;
    assert_eq!(partial, gathered(0..1024)?);
    Ok(())
}

#[test]
fn ranges_and_gaps() -> Result<(), Error> {
    let mut partial = gathered(10..20)?;
    partial.merge(gathered(250..600)?)?;
    partial.merge(gathered(20..21)?)?;
    assert_eq!(partial.ranges(), [10..21, 250..600]);
    assert_eq!(partial.missing(0..700), [0..10, 21..250, 600..700]);
    assert_eq!(partial.missing(15..300), [21..250]);
    assert_eq!(partial.missing(300..500), []);
    assert_eq!(partial.missing(700..710), [700..710]);
    assert_eq!(Partial::new(plan()?).missing(3..5), [3..5]);
    assert_eq!(chunks(5..5).count(), 0);
    assert_eq!(chunks(u64::MAX - 1..u64::MAX).collect::<Vec<_>>(), [u64::MAX - 1..u64::MAX]);
    Ok(())
}

#[test]
fn values_that_are_no_numbers_are_named() -> Result<(), Error> {
    let plan = Plan::new(2).sketch(1, 0.0, 1.0)?;
    for (bad, text) in [(f64::NAN, "NaN"), (f64::NEG_INFINITY, "-inf"), (2e300, "2000000")] {
        for samples in [256..512, 300..400] {
            let mut chunk = Chunk::new(&plan, samples)?;
            chunk.set(310, 0, Some(1.0))?;
            chunk.set(333, 1, Some(bad))?;
            chunk.set(340, 1, Some(LARGEST))?;
            let mut partial = Partial::new(plan.clone());
            let found = partial.add(&chunk);
            let Err(Error::Value { quantity: 1, sample: 333, value }) = found else {
                panic!("{found:?}");
            };
            assert!(value.starts_with(text), "{value}");
            assert_eq!(partial, Partial::new(plan.clone()));
            chunk.set(333, 1, None)?;
            partial.add(&chunk)?;
            let statistics = partial.statistics(1)?.expect("a value");
            assert_eq!((statistics.count, statistics.max), (1, LARGEST));
        }
    }
    Ok(())
}

#[test]
fn plans_must_agree() -> Result<(), Error> {
    let mut partial = gathered(0..10)?;
    assert_eq!(partial.merge(Partial::new(Plan::new(3))), Err(Error::OtherPlan));
    assert_eq!(partial.add(&Chunk::new(&Plan::new(1), 20..30)?), Err(Error::OtherPlan));
    assert!(partial.statistics(3).is_err() && partial.moments(3).is_err());
    assert!(partial.covariance(0, 0).is_err() && Plan::new(2).covariances(&[0], &[2]).is_err());
    assert!(Plan::new(2).sketch(2, 0.0, 1.0).is_err());
    let unasked = partial.statistics(1)?.expect("values");
    assert!(unasked.quantile(0.5).is_err() && unasked.sketch().is_none());
    Ok(())
}

#[test]
fn arguments_out_of_range() -> Result<(), Error> {
    let plan = Plan::new(1).outcomes(1);
    for samples in [5..5, 0..257, 255..257, (1 << 60) - 1..(1 << 60) + 1] {
        assert!(Chunk::new(&plan, samples).is_err());
    }
    let mut chunk = Chunk::new(&plan, 10..20)?;
    assert!(chunk.set(20, 0, None).is_err() && chunk.set(10 + 256, 0, None).is_err());
    assert!(chunk.set(10, 1, None).is_err() && chunk.count(1, 1).is_err());
    let wrong = Error::WrongLength { kind: "values of samples", found: 3, expected: 10 };
    assert_eq!(chunk.set_all(0, &[0.0; 3]), Err(wrong));
    assert!(Sketch::new(f64::NAN, 1.0).is_err() && Sketch::new(0.0, f64::INFINITY).is_err());
    assert!(Sketch::new(0.0, 0.0).is_err() && Sketch::new(0.0, -1.0).is_err());
    let mut sketch = Sketch::new(0.0, 1.0)?;
    assert!(sketch.add(&[1.0, f64::NAN]).is_err() && sketch.count() == 0);
    assert_eq!(sketch.quantile(0.5), Err(Error::NoValues));
    assert_eq!(sketch.cdf(0.5), Err(Error::NoValues));
    assert_eq!(sketch.histogram(3), Err(Error::NoValues));
    assert_eq!(sketch.merge(&Sketch::new(0.0, 2.0)?), Err(Error::OtherPlan));
    sketch.add(&[1.0])?;
    for p in [-0.1, 1.1, f64::NAN] {
        assert!(sketch.quantile(p).is_err() && Sorted::new(vec![1.0])?.quantile(p).is_err());
        assert!(sketch.quantile_interval(p, 0.5).is_err() && sketch.quantile_interval(0.5, p).is_err());
    }
    assert!(sketch.cdf(f64::NAN).is_err() && sketch.histogram(0).is_err());
    assert!(Sorted::new(vec![f64::INFINITY]).is_err());
    assert_eq!(Sorted::new(vec![])?.quantile(0.5), Err(Error::NoValues));
    Ok(())
}
