//! Sampling runs in parts: any split and order, stopped and resumed, gives the same bits; parts of other runs are
//! refused.
#![allow(clippy::single_range_in_vec_init, reason = "lists of ranges")]

mod exact;
mod responses;
mod written;

use std::ops::Range;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use eigentol::kernels::BatchKernels;
use eigentol::scalar::Instructions;
use eigentol::tolerance::PartialMonteCarlo;
use eigentol::{Coordinate, DesignVariable, Error, Input, Study, mechanism};
use proptest::prelude::*;

use crate::common::derived::Derived;
use crate::common::models::Plate;
use crate::side_by_side::Rotor;

const SAMPLES: u64 = 3000;

mechanism! {
    mechanism Bar {
        input omega: rad/s;
        design m = 3.0 kg;
        design l = 1.0 m +/- 3%;
        gravity 9.81 m/s^2 along -z;
        body shaft: massless;
        body bar: rod(mass: m, length: l, along: -z);
        joint spin: revolute(z) from ground to shaft, driven at omega;
        joint theta: revolute(y) from shaft to bar;
    }
}

mod heavier {
    use super::mechanism;

    mechanism! {
        /// The same names, another gravity.
        pub(crate) mechanism Bar {
            input omega: rad/s;
            design m = 3.0 kg;
            design l = 1.0 m +/- 3%;
            gravity 9.82 m/s^2 along -z;
            body shaft: massless;
            body bar: rod(mass: m, length: l, along: -z);
            joint spin: revolute(z) from ground to shaft, driven at omega;
            joint theta: revolute(y) from shaft to bar;
        }
    }
}

fn bar() -> Study<Bar> {
    Study::new(Bar).input(Bar::omega, 3.0).samples(SAMPLES as usize).seed(7)
}

/// Some of the samples diverge, and none is solved in vectors.
fn plate() -> Study<Derived<Plate>> {
    Study::new(Derived(Plate))
        .input(Input::new(0), 8.5)
        .tolerance(DesignVariable::new(1), 12.0)
        .samples(SAMPLES as usize)
}

/// The ranges between the cuts, in the order given by the keys.
fn ranges(mut cuts: Vec<u64>, order: &[u64]) -> Vec<Range<u64>> {
    cuts.extend([0, SAMPLES]);
    cuts.sort_unstable();
    let mut all: Vec<Range<u64>> = cuts.windows(2).map(|ends| ends[0]..ends[1]).collect();
    all.sort_by_key(|range| order[range.start as usize % order.len()] ^ range.end);
    all
}

fn merged<M: BatchKernels>(study: &Study<M>, parts: impl IntoIterator<Item = Range<u64>>) -> PartialMonteCarlo {
    let mut all = study.samples_between(0..0).unwrap();
    for (k, range) in parts.into_iter().enumerate() {
        let sampling = study.sampling().range(Some(range)).threads(1 + k % 3);
        all.merge(study.sample_modes(&sampling).unwrap()).unwrap();
    }
    all
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn any_split_and_order_gives_the_same_bits(
        cuts in prop::collection::vec(0..=SAMPLES, 0..12),
        order in prop::collection::vec(any::<u64>(), 1..8),
        keep in any::<bool>(),
    ) {
        let parts = ranges(cuts, &order);
        let study = bar().keep_samples(keep);
        let all = merged(&study, parts.clone());
        prop_assert_eq!(all.ranges(), [0..SAMPLES]);
        prop_assert!(all.check_complete().is_ok() && all.missing().is_empty());
        prop_assert!(all == study.samples_between(0..SAMPLES).unwrap());
        let (result, whole) = (all.result(), study.monte_carlo().unwrap());
        prop_assert!(result.side_by_side);
        prop_assert!(result == whole);
        let alone = study.vectors(None);
        prop_assert!(merged(&alone, parts).result() == alone.monte_carlo().unwrap());
    }
}

/// General modes, of which some are solved one by one.
#[test]
fn damped_samples_of_any_split_have_the_same_bits() {
    let rotor = |omega| Study::new(Rotor).input(Rotor::omega, omega);
    for study in [rotor(300.0), rotor(520.0).tolerance(Rotor::lag, 3e-5)] {
        let study = study.samples(SAMPLES as usize).keep_samples(true);
        let whole = study.monte_carlo().unwrap();
        assert!(whole.side_by_side);
        let all = merged(&study, [2000..SAMPLES, 0..3, 3..257, 257..2000]);
        assert!(all.result() == whole);
    }
}

#[test]
fn outcomes_are_merged_too() {
    let study = plate();
    let whole = study.monte_carlo().unwrap();
    assert!(whole.counts.divergent > 100 && !whole.side_by_side);
    let all = merged(&study, [2000..3000, 0..3, 3..2000]);
    assert!(all.result() == whole);
}

/// With any number of threads, a stopped run contains every sample that it counted, reports that it was stopped, and
/// can be resumed.
#[test]
fn a_run_that_is_stopped_can_be_resumed() {
    for threads in [1, 2, 3] {
        for vectors in [None, Some(Instructions::best())] {
            let study = bar().samples(20_000).vectors(vectors).keep_samples(true);
            let whole = study.samples_between(0..20_000).unwrap();
            let (stop, seen) = (AtomicBool::new(false), AtomicUsize::new(0));
            let progress = |number| {
                if seen.fetch_add(number, Ordering::Relaxed) + number > 4000 {
                    stop.store(true, Ordering::Relaxed);
                }
            };
            let sampling = study.sampling().threads(threads);
            let watched = sampling.clone().progress(Some(&progress)).stop(Some(&stop));
            let mut part = study.sample_modes(&watched).unwrap();
            let result = part.result();
            let done: u64 = part.ranges().iter().map(|range| range.end - range.start).sum();
            assert!((4001..20_000).contains(&result.samples), "{}", result.samples);
            assert_eq!(result.samples as u64, done);
            assert_eq!(result.samples, seen.load(Ordering::Relaxed));
            assert_eq!((result.planned, result.counts.total()), (20_000, result.samples));
            assert_eq!(result.all.as_ref().map(Vec::len), Some(result.samples));
            assert!(result.to_string().contains("20000 samples were asked for"));
            assert!(
                matches!(part.check_complete(), Err(Error::SamplesMissing { missing }) if missing == part.missing())
            );
            // Stopped again immediately: nothing is lost.
            let before = part.clone();
            study.resume_samples(&mut part, &watched).unwrap();
            assert!(part == before);
            study.resume_samples(&mut part, &sampling).unwrap();
            assert!(part == whole);
            assert!(!part.result().to_string().contains("Not complete"));
        }
    }
}

/// A result reports the settings needed to draw its samples again, whether it was drawn at once, merged from
/// parts, or written and read.
#[test]
fn a_result_says_how_its_samples_were_drawn() {
    let study = bar().seed(7).stream(3);
    let whole = study.monte_carlo().unwrap();
    assert_eq!(whole.drawn(), "3000 samples, seed 7, stream 3");
    assert_eq!(whole.ranges, [0..3000]);
    assert!(whole.to_string().contains(": Monte Carlo with re-solved equilibria, 3000 samples, seed 7, stream 3: "));
    let mut part = study.samples_between(100..300).unwrap();
    part.merge(study.samples_between(1000..1001).unwrap()).unwrap();
    let text = serde_json::to_string(&part).expect("numbers and lists");
    let read: PartialMonteCarlo = serde_json::from_str(&text).expect("what was written");
    let result = read.result();
    assert_eq!(result.drawn(), "201 samples, seed 7, stream 3, numbers 100 to 299 and 1000");
    let again = bar().seed(result.seed).stream(result.stream);
    assert!(merged(&again, result.ranges.clone()).result() == result);
    assert_eq!(bar().seed(u64::MAX).samples(2).monte_carlo().unwrap().seed, u64::MAX);
    // A file without this information is not ours.
    for fact in ["seed", "stream"] {
        let without = text.replacen(&format!("[\"{fact}\","), "[\"other\",", 1);
        assert_ne!(without, text);
        assert!(serde_json::from_str::<PartialMonteCarlo>(&without).is_err(), "{fact}");
    }
}

#[test]
fn gaps_and_overlaps_are_named() {
    let study = bar();
    let mut all = study.samples_between(100..300).unwrap();
    all.merge(study.samples_between(1000..1001).unwrap()).unwrap();
    assert_eq!(all.missing(), [0..100, 300..1000, 1001..3000]);
    assert_eq!(
        all.check_complete().unwrap_err().to_string(),
        "samples are missing: 0 to below 100, 300 to below 1000, 1001 to below 3000"
    );
    let before = all.clone();
    let refused = all.merge(study.samples_between(250..2000).unwrap()).unwrap_err();
    assert_eq!(refused, Error::SamplesOverlap { start: 250, end: 300 });
    assert!(all == before);
    for range in [2000..3001, Range { start: 9, end: 8 }] {
        let refused = study.samples_between(range);
        assert!(matches!(refused, Err(Error::Setting { setting: "range", .. })));
    }
}

/// The error names the difference.
#[test]
fn parts_of_other_runs_are_refused() {
    let part = |study: &Study<Bar>| study.samples_between(0..10).unwrap();
    let own = bar().samples_between(10..20).unwrap();
    let theta: Coordinate<Bar> = Coordinate::new(0);
    for (what, other) in [
        ("seed", bar().seed(8)),
        ("stream", bar().stream(8)),
        ("samples", bar().samples(3001)),
        ("method", bar().vectors(None)),
        ("samples kept", bar().keep_samples(true)),
        ("input `omega`", bar().input(Bar::omega, 3.0001)),
        ("design variable `m`", bar().design(Bar::m, 2.9)),
        ("tolerance of `l`", bar().tolerance(Bar::l, 0.02)),
        ("tolerance of `l`", bar().sigma_level(2.0)),
        ("equilibrium", bar().input(Bar::omega, 5.0).start(theta, -1.0)),
    ] {
        let mut own = own.clone();
        if what == "equilibrium" {
            // Swung out to the other side.
            own = part(&bar().input(Bar::omega, 5.0).start(theta, 1.0));
        }
        let before = own.clone();
        let refused = own.merge(part(&other)).unwrap_err();
        assert!(matches!(&refused, Error::OtherRun { what: found, .. } if found == what), "{refused}");
        assert!(own == before);
        let mut done = before.clone();
        assert!(other.resume_samples(&mut done, &other.sampling()).is_err() && done == before);
    }
    let heavier = Study::new(heavier::Bar).input(heavier::Bar::omega, 3.0).samples(SAMPLES as usize).seed(7);
    let refused = own.clone().merge(heavier.samples_between(0..10).unwrap());
    assert!(matches!(refused, Err(Error::OtherRun { what, .. }) if what == "kernels"));
    let refused = own.clone().merge(plate().samples_between(0..10).unwrap());
    assert!(matches!(refused, Err(Error::OtherRun { what, .. }) if what == "mechanism"));
    let facts: Vec<_> = own.fingerprint().facts().collect();
    assert!(facts.contains(&("seed", "7")) && facts.contains(&("input `omega`", "3")));
}
