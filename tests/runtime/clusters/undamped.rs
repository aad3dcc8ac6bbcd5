//! Undamped modes: repeated, nearly repeated, veering, crossing and well-separated ones; three at once.

use std::f64::consts::PI;

use eigentol::clusters::ClusterTolerance;
use eigentol::{DesignVariable, Study};

use super::{agree, close, run, sorted, within};
use crate::common::derived::Derived;
use crate::common::models::{Pair, Triple};

const K1: DesignVariable<Derived<Pair>> = DesignVariable::new(0);
const K2: DesignVariable<Derived<Pair>> = DesignVariable::new(1);
const C: DesignVariable<Derived<Pair>> = DesignVariable::new(2);

type PairStudy = Study<Derived<Pair>>;

/// The pair at `k1 = 100`, `k2 = 100 + gap`, `c = mean`, with standard deviations `sigma` of `k1`, `k2` and `c`.
fn pair(gap: f64, mean: f64, sigma: [f64; 3]) -> PairStudy {
    Study::new(Derived(Pair))
        .sigma_level(1.0)
        .design(K2, 100.0 + gap)
        .design(C, mean)
        .tolerance(K1, sigma[0])
        .tolerance(K2, sigma[1])
        .tolerance(C, sigma[2])
}

fn only(mut cluster_tolerances: Vec<ClusterTolerance>) -> ClusterTolerance {
    assert_eq!(cluster_tolerances.len(), 1, "{cluster_tolerances:?}");
    cluster_tolerances.remove(0)
}

#[test]
fn a_coupling_that_splits_a_double_frequency_is_half_normal() {
    // lambda = 100 -+ |c|.
    let found = only(pair(0.0, 0.0, [0.0, 0.0, 1.0]).clusters().unwrap());
    assert_eq!((found.modes.as_slice(), found.distance), (&[0, 1][..], 0.0));
    let mean = found.mean.unwrap();
    close(mean.value.re, 100.0, 1e-14);
    within(mean.sigma_re, 0.0, 1e-14);
    close(mean.frequency.unwrap().mean, 10.0, 1e-14);
    let spread = found.spread.unwrap();
    let lambda = spread.lambda.unwrap();
    let (low, high) = (lambda.lowest().unwrap(), lambda.highest().unwrap());
    let (low, high) = (low.value.as_ref().unwrap(), high.value.as_ref().unwrap());
    let (half, sigma) = ((2.0 / PI).sqrt(), (1.0 - 2.0 / PI).sqrt());
    within(high.mean, 100.0 + half, 4.0 * sigma / 64.0);
    within(low.mean, 100.0 - half, 4.0 * sigma / 64.0);
    within(high.sigma.unwrap(), sigma, 4.0 * sigma / 64.0);
    within(low.sigma.unwrap(), sigma, 4.0 * sigma / 64.0);
    assert!(low.max <= 100.0 && high.min >= 100.0);
    let splitting = spread.frequency.splitting.unwrap();
    within(splitting.mean, half / 10.0, 4.0 * sigma / 640.0);
}

#[test]
fn the_mean_has_the_derivatives_of_the_trace() {
    let study = pair(0.7, 0.3, [0.8, 0.4, 1.0]);
    let found = only(study.clusters().unwrap());
    let mean = found.mean.unwrap();
    close(mean.value.re, 100.35, 1e-14);
    for (slope, expected) in mean.by_design.iter().zip([0.5, 0.5, 0.0]) {
        within(slope.re, expected, 1e-13);
        assert_eq!(slope.im, 0.0);
    }
    close(mean.sigma_re, 0.5 * 0.8_f64.hypot(0.4), 1e-13);
    let frequency = mean.frequency.unwrap();
    close(frequency.mean, 100.35_f64.sqrt(), 1e-14);
    close(frequency.sigma, 0.5 * mean.sigma_re / frequency.mean, 1e-13);
}

#[test]
fn clusters_agree_with_monte_carlo_of_the_whole_problem() {
    for (gap, mean, sigma) in [
        (0.0, 0.0, [0.6, 0.9, 1.0]),
        (0.5, 0.0, [0.0, 0.0, 1.0]),
        (1.0, 0.0, [0.0, 0.0, 1.0]),
        (3.0, 0.0, [0.0, 0.0, 1.0]),
        (3.0, 0.0, [1.0, 0.5, 1.0]),
        // Crossing: nothing mixes them.
        (1.0, 0.0, [1.0, 1.0, 0.0]),
        // Veering at its closest.
        (0.0, 1.0, [1.0, 1.0, 0.0]),
        (0.5, 1.0, [0.5, 0.5, 0.5]),
    ] {
        let study = pair(gap, mean, sigma);
        let found = only(study.clusters().unwrap());
        let spread = found.spread.unwrap();
        assert_eq!((spread.unstable, spread.unsolved), (0, 0));
        agree(&spread.frequency, &sorted(&run(&study), |s| s.im), 0.0);
    }
}

#[test]
fn what_mixes_modes_counts_as_well_as_what_moves_them_apart() {
    // At first order nothing moves lambda_1 - lambda_2: first order alone sees no neighbour.
    let study = pair(2.0, 0.0, [0.0, 0.0, 1.0]);
    let first = study.first_order().unwrap();
    assert!(first.trusted() && first.modes[0].frequency().unwrap().sigma < 1e-12);
    close(only(study.clusters().unwrap()).distance, 1.0, 1e-12);
    // sigma(k2 - k1) = 0.5, 2 sigma(c) = 2.
    let both = pair(2.0, 0.0, [0.3, 0.4, 1.0]);
    close(only(both.clusters().unwrap()).distance, 0.8, 1e-12);
    // Beyond TRUSTED_DISTANCE = 4.5 they are not a cluster, and second order captures the small remaining effect.
    assert_eq!(pair(8.99, 0.0, [0.0, 0.0, 1.0]).clusters().unwrap().len(), 1);
    let far = pair(9.01, 0.0, [0.0, 0.0, 1.0]);
    assert_eq!(far.clusters().unwrap(), []);
    let second = far.second_order().unwrap();
    let sigma = second.modes[1].as_ref().unwrap().frequency.moments.sigma;
    let values: Vec<f64> = sorted(&run(&far), |s| s.im).iter().map(|s| s[1]).collect();
    close(sigma, super::Moments::of(&values).sigma, 0.15);
    assert_eq!(pair(50.0, 0.0, [1.0; 3]).clusters().unwrap(), []);
}

#[test]
fn without_tolerances_only_rounding_makes_a_cluster() {
    let equal = only(pair(0.0, 0.0, [0.0; 3]).clusters().unwrap());
    let frequency = equal.spread.unwrap().frequency;
    let highest = frequency.highest().unwrap().value.as_ref().unwrap();
    close(highest.mean, 10.0, 1e-14);
    within(highest.sigma.unwrap(), 0.0, 1e-14);
    assert_eq!(pair(1e-5, 0.0, [0.0; 3]).clusters().unwrap().len(), 1);
    assert_eq!(pair(1e-3, 0.0, [0.0; 3]).clusters().unwrap(), []);
}

#[test]
fn three_equal_modes_have_order_statistics() {
    // Three independent normal values: the mean of the largest is 3 / (2 sqrt(pi)), the variance of the middle one 1 -
    // sqrt(3)/pi.
    let study = Study::new(Derived(Triple));
    let found = only(study.clusters().unwrap());
    assert_eq!(found.modes, [0, 1, 2]);
    close(found.mean.unwrap().sigma_re, 1.0 / 3.0_f64.sqrt(), 1e-13);
    let lambda = found.spread.unwrap().lambda.unwrap();
    let member = |k: usize| lambda.members[k].value.as_ref().unwrap();
    let shift = 1.5 / PI.sqrt();
    for (k, mean) in [(0, -shift), (1, 0.0), (2, shift)] {
        within(member(k).mean, 100.0 + mean, 4.0 * 0.75 / 64.0);
    }
    let sigma = (1.0 - 3.0_f64.sqrt() / PI).sqrt();
    within(member(1).sigma.unwrap(), sigma, 0.05);
}

#[test]
fn three_modes_that_mix_agree_with_monte_carlo() {
    let coupled = |k3: f64| {
        let study = Study::new(Derived(Triple)).design(DesignVariable::new(2), k3);
        (3..6).fold(study, |study, k| study.tolerance(DesignVariable::new(k), 2.0))
    };
    let study = coupled(101.0);
    let spread = only(study.clusters().unwrap()).spread.unwrap();
    agree(&spread.frequency, &sorted(&run(&study), |s| s.im), 0.0);
    // With the third one far away, a pair remains.
    let pair = only(coupled(150.0).clusters().unwrap());
    assert_eq!(pair.modes, [0, 1]);
    // A chain 1 - 2 - 3 with distant ends is one cluster.
    let chain = Study::new(Derived(Triple)).design(DesignVariable::new(0), 94.0).design(DesignVariable::new(2), 106.0);
    let found = only(chain.clusters().unwrap());
    assert_eq!(found.modes, [0, 1, 2]);
    close(found.distance, 6.0 / 2.0_f64.sqrt(), 1e-12);
}

#[test]
fn the_same_study_gives_the_same_bits() {
    let study = pair(1.0, 0.0, [0.3, 0.4, 1.0]);
    assert_eq!(study.clusters().unwrap(), study.clusters().unwrap());
}
