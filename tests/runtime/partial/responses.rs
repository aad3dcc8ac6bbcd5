//! Quantities of modes as responses: sampled in vectors where Monte Carlo does so.

use eigentol::kernels::SummaryKernels;
use eigentol::propagation::{Samples, sampled};
use eigentol::response::{Response, Responses};
use eigentol::scalar::Instructions;
use eigentol::sweep::Range;
use eigentol::tolerance::Distribution;
use eigentol::tolerance::{Points, Sampling};
use eigentol::{Quantity, Study};
use proptest::prelude::*;

use super::{Bar, bar, plate, ranges};
use crate::side_by_side::Rotor;

const FREQUENCY: Response = Response::Mode { mode: 0, quantity: Quantity::Frequency };

fn how(samples: &Samples) -> &str {
    let mut facts = samples.fingerprint().facts();
    facts.find(|fact| fact.0 == "solved").expect("a fact").1
}

/// The same samples, solved one by one.
fn alone<M: SummaryKernels>(study: &Study<M>, sampling: &Sampling<'_>) -> Samples {
    let (at, modes) = (&study.equilibrium().unwrap(), &study.modes().unwrap());
    let responses = Responses::new(study.mechanism(), at, modes, vec![FREQUENCY]).unwrap();
    sampled(&responses, &study.tolerances().unwrap(), sampling).unwrap()
}

fn close(a: Option<f64>, b: Option<f64>, scale: f64) {
    let (a, b) = (a.expect("a number"), b.expect("a number"));
    assert!((a - b).abs() <= 1e-10 * scale, "{a} {b}");
}

#[test]
fn side_by_side_as_one_by_one() {
    let uniform = Distribution::uniform(0.9, 1.2).unwrap();
    for (study, side_by_side) in [
        (bar(), true),
        // Some bars are so long or short that the batch cannot guarantee them.
        (bar().tolerance(Bar::l, 0.7), true),
        (bar().distribution(Bar::l, uniform).tolerance(Bar::m, 0.2), true),
        // Hanging just below the critical speed: not a clear minimum.
        (bar().input(Bar::omega, 3.83), false),
    ] {
        for points in [Points::Random, Points::LatinHypercube, Points::Sobol] {
            let sampling = Sampling::default().points(points).samples(2048).threads(2);
            let own = study.sample_responses(&[FREQUENCY], &sampling).unwrap();
            let other = alone(&study, &sampling);
            assert_eq!(how(&other), "one by one");
            if side_by_side {
                assert_eq!(how(&own), "side by side");
                assert!(own.clone().merge(alone(&study, &sampling.clone().range(Some(0..0)))).is_err());
            }
            assert_eq!(own.counts(), other.counts());
            let (own, other) = (own.propagation().unwrap(), other.propagation().unwrap());
            let [a, b] = [&own, &other].map(|all| all.spreads[0].clone().expect("it swings"));
            close(Some(a.mean.value), Some(b.mean.value), 1.0);
            close(a.sigma.map(|sigma| sigma.value), b.sigma.map(|sigma| sigma.value), 1.0);
            close(a.skewness.map(|skewness| skewness.value), b.skewness.map(|skewness| skewness.value), 100.0);
            close(own.covariance[0][0], other.covariance[0][0], 1.0);
            close(own.with_design[0][1], other.with_design[0][1], 1.0);
            assert_eq!(a.share, b.share);
        }
    }
    // Another quantity of the mode, a response that is not one, and a mechanism that is not solved in vectors.
    let growth = Response::Mode { mode: 0, quantity: Quantity::Growth };
    let sampling = Sampling::default().samples(64);
    let study = bar();
    let both = study.sample_responses(&[FREQUENCY, growth], &sampling);
    assert_eq!(how(&both.unwrap()), "side by side");
    let critical = Response::Critical(Range::new(Bar::omega.any(), 1.0, 6.0));
    let both = study.sample_responses(&[FREQUENCY, critical], &sampling);
    assert_eq!(how(&both.unwrap()), "one by one");
    let plate = plate().sample_responses(&[FREQUENCY], &sampling);
    assert_eq!(how(&plate.unwrap()), "one by one");
}

/// Any instruction set gives the same bits as the best one; `None` gives those of designs solved one by one.
#[test]
fn questions_about_responses_use_the_vectors_that_are_chosen() {
    let rotor = Study::new(Rotor).input(Rotor::omega, 300.0).samples(500);
    for study in [rotor.clone(), rotor.tolerance(Rotor::omega, 1.0)] {
        let alone = study.clone().vectors(None);
        for set in Instructions::available() {
            let own = study.clone().vectors(Some(set));
            answers(&study, &own, true);
            answers(&alone, &own, false);
        }
    }
    let study = bar().vectors(None);
    let sampling = Sampling::default().points(Points::Sobol).samples(512);
    let own = study.sample_responses(&[FREQUENCY], &sampling).unwrap();
    assert_eq!(how(&own), "one by one");
    assert!(own == alone(&study, &sampling));
}

/// Whether every answer of two studies has the same bits, or none has.
#[track_caller]
fn answers<M: SummaryKernels>(a: &Study<M>, b: &Study<M>, same: bool) {
    let wanted = &[FREQUENCY];
    let equal = [
        a.propagate(wanted).unwrap() == b.propagate(wanted).unwrap(),
        a.influence(wanted).unwrap() == b.influence(wanted).unwrap(),
    ];
    assert_eq!(equal, [same; 2]);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]

    #[test]
    fn any_split_and_order_gives_the_same_bits(
        cuts in prop::collection::vec(0..=3000_u64, 0..8),
        order in prop::collection::vec(any::<u64>(), 1..8),
        points in prop::sample::select(vec![Points::Random, Points::LatinHypercube, Points::Sobol]),
    ) {
        let study = bar();
        let sampling = Sampling::default().points(points).samples(3000);
        let total = sampling.total().unwrap();
        let run = |range, threads| {
            let own = sampling.clone().range(range).threads(threads);
            study.sample_responses(&[FREQUENCY], &own).unwrap()
        };
        let mut all = run(Some(0..0), 1);
        for (k, range) in ranges(cuts, &order).into_iter().enumerate() {
            let range = range.start.min(total)..range.end.min(total);
            all.merge(run(Some(range), 1 + k % 3)).unwrap();
        }
        prop_assert!(all.check_complete().is_ok());
        prop_assert!(all == run(None, 0));
    }
}
