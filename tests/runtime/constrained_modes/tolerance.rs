//! Tolerances of mechanisms with constraints match those in minimal coordinates, sample by sample.

use eigentol::tolerance::Outcome;
use eigentol::{Coordinate, Error, Input, Study};

use crate::common::derived::Derived;
use crate::constrained_modes::compare::near;
use crate::constrained_modes::holonomic::{Chain, ChainByAngles, Spherical, SphericalByPlane};
use crate::constrained_modes::minimal::held::Held;
use crate::constrained_modes::rolling::{Caster, DrivenDisk};

fn omega<M>() -> Input<M> {
    Input::new(0)
}

fn chain() -> Study<Derived<Chain>> {
    let start = [0.24, 0.76, 0.5, 1.2, 0.0, 0.0];
    start
        .iter()
        .enumerate()
        .fold(Study::new(Derived(Chain)), |study, (i, &value)| study.guess(Coordinate::new(i), value))
        .input(omega(), 1.5)
}

fn angles() -> Study<Derived<ChainByAngles>> {
    Study::new(Derived(ChainByAngles)).start(Coordinate::new(0), 0.3).start(Coordinate::new(1), 0.4).input(omega(), 1.5)
}

#[test]
fn first_and_second_order_are_those_of_minimal_coordinates() {
    let (own, other) = (chain(), angles());
    let (a, b) = (own.first_order().unwrap(), other.first_order().unwrap());
    assert_eq!(a.modes.len(), 2);
    for (a, b) in a.modes.iter().zip(&b.modes) {
        let [sigma, other] = [a, b].map(|mode| mode.frequency().unwrap().sigma);
        near(sigma, other, 1e-10, other);
        near(a.distance_to_critical, b.distance_to_critical, 1e-9, b.distance_to_critical);
        near(a.distance_to_neighbour, b.distance_to_neighbour, 1e-9, b.distance_to_neighbour);
    }
    let (a, b) = (own.summary().unwrap(), other.summary().unwrap());
    assert_eq!(a.trusted(), b.trusted());
    for (a, b) in a.second.modes.iter().zip(&b.second.modes) {
        let (a, b) = (a.as_ref().unwrap(), b.as_ref().unwrap());
        let (a, b) = (&a.frequency.moments, &b.frequency.moments);
        let sigma = b.sigma;
        near(a.mean, b.mean, 1e-10, sigma);
        near(a.sigma, sigma, 1e-10, sigma);
        near(a.skewness, b.skewness, 1e-9, 1.0);
        near(a.excess_kurtosis, b.excess_kurtosis, 1e-9, 1.0);
    }
    assert!(!a.to_string().is_empty() && !b.to_string().is_empty());
}

#[test]
fn every_sample_is_that_of_minimal_coordinates() {
    let sampled = |seed| {
        let own = chain().samples(600).seed(seed).keep_samples(true);
        let other = angles().samples(600).seed(seed).keep_samples(true);
        (own.monte_carlo().unwrap(), other.monte_carlo().unwrap())
    };
    let (own, other) = sampled(7);
    assert_eq!(own.counts.stable, 600);
    for (a, b) in own.all.unwrap().iter().zip(&other.all.unwrap()) {
        assert_eq!(a.design, b.design);
        assert_eq!(a.outcome, Outcome::Stable);
        for (a, b) in a.frequencies.iter().zip(&b.frequencies) {
            near(a.unwrap(), b.unwrap(), 1e-10, b.unwrap());
        }
    }
    let first = chain().first_order().unwrap();
    for (sampled, first) in own.modes.iter().zip(&first.modes) {
        let (sampled, first) = (sampled.as_ref().unwrap(), first.frequency().unwrap());
        // 600 samples determine a standard deviation to 3 %.
        near(sampled.sigma.unwrap(), first.sigma, 0.12, first.sigma);
        near(sampled.mean, first.mean, 0.15, first.sigma);
    }
}

#[test]
fn damped_samples_are_those_of_minimal_coordinates() {
    let own = Study::new(Derived(Spherical))
        .guess(Coordinate::new(2), 1.1)
        .start(Coordinate::new(0), 0.1)
        .input(omega(), 0.8)
        .samples(300)
        .keep_samples(true)
        .monte_carlo()
        .unwrap();
    let other = Study::new(Derived(SphericalByPlane))
        .start(Coordinate::new(0), 0.1)
        .input(omega(), 0.8)
        .samples(300)
        .keep_samples(true)
        .monte_carlo()
        .unwrap();
    assert_eq!(own.counts, other.counts);
    for (a, b) in own.all.unwrap().iter().zip(&other.all.unwrap()) {
        for (a, b) in a.eigenvalues.iter().zip(&b.eigenvalues) {
            let (a, b) = (a.unwrap(), b.unwrap());
            near(a.re, b.re, 1e-9, b.norm());
            near(a.im, b.im, 1e-9, b.norm());
        }
    }
}

/// First order against samples for a caster.
#[test]
fn a_caster_varies_as_its_first_order_says() {
    let study = Study::new(Derived(Caster)).input(omega(), 2.0).samples(1500).seed(3);
    let first = study.first_order().unwrap();
    let sampled = study.monte_carlo().unwrap();
    assert_eq!(sampled.counts.total(), 1500);
    let mut oscillating = 0;
    for (sampled, first) in sampled.modes.iter().zip(&first.modes) {
        let (Some(sampled), Some(first)) = (sampled, &first.frequency()) else {
            continue;
        };
        oscillating += 1;
        near(sampled.sigma.unwrap(), first.sigma, 0.1, first.sigma);
    }
    assert_eq!(oscillating, 1);
}

/// Every question has an answer even without modes.
#[test]
fn a_held_mechanism_has_no_modes_and_no_surprises() {
    let study = Study::new(Derived(Held)).guess(Coordinate::new(0), 0.5).guess(Coordinate::new(1), 0.7).samples(50);
    assert!(study.first_order().unwrap().modes.is_empty());
    assert!(study.second_order().unwrap().modes.is_empty());
    let summary = study.summary().unwrap();
    assert!(summary.trusted());
    println!("{summary}");
    let sampled = study.monte_carlo().unwrap();
    assert_eq!(sampled.counts.stable, 50);
    assert!(sampled.modes.is_empty());
    println!("{sampled}");
    let sweep = study.sweep(omega(), &[0.0, 1.0, 2.0]).unwrap();
    assert!(sweep.points.iter().all(|point| point.modes.as_ref().unwrap().modes.is_empty()));
    println!("{sweep}");
    println!("{}", study.campbell(omega(), &[0.5, 1.0, 2.0], &[1.0]).unwrap());
    assert!(study.crossings(omega(), 0.5, 3.0, 1.0).unwrap().is_empty());
    assert!(study.whirls().unwrap().is_empty());
    assert!(matches!(study.mode_curvature(0), Err(Error::NoSuchMode { .. })));
}

/// A driven disk from standstill to rolling: the same modes all along, and their Campbell diagram.
#[test]
fn modes_with_speeds_keep_their_identity_along_a_sweep() {
    let start = [0.0, 0.3, 1.0];
    let study = start
        .iter()
        .enumerate()
        .fold(Study::new(Derived(DrivenDisk)), |study, (i, &value)| study.guess(Coordinate::new(i), value));
    let values: Vec<f64> = (0..30).map(|k| 1.5 + 0.1 * f64::from(k)).collect();
    let sweep = study.sweep(omega(), &values).unwrap();
    let mut weaving: Option<(usize, f64)> = None;
    for point in &sweep.points {
        let modes = point.modes.as_ref().unwrap();
        assert_eq!(modes.modes.len(), 2);
        let mode = modes.modes.iter().find(|mode| mode.frequency().is_some()).unwrap();
        if let Some((label, omega)) = weaving {
            assert_eq!(mode.label, label);
            assert!(mode.s.im > omega);
        }
        weaving = Some((mode.label, mode.s.im));
    }
    println!("{sweep}");
    println!("{}", sweep.points[3].modes.as_ref().unwrap());
}
