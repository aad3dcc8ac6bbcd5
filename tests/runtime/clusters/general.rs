//! General modes: whirling pairs, approaching flutter, defective and overdamped roots.

use std::f64::consts::PI;

use eigentol::clusters::clusters;
use eigentol::clusters::modal_couplings;
use eigentol::{Complex, DesignVariable, Error, Family, Input, Quantity, Study, modes};

use super::{agree, close, run, sorted, within};
use crate::common::derived::Derived;
use crate::common::models::{Follower, Plate};

const OMEGA: Input<Derived<Plate>> = Input::new(0);
const M: DesignVariable<Derived<Plate>> = DesignVariable::new(0);
const KX: DesignVariable<Derived<Plate>> = DesignVariable::new(1);
const KY: DesignVariable<Derived<Plate>> = DesignVariable::new(2);
const DAMPING: DesignVariable<Derived<Plate>> = DesignVariable::new(3);
const STIFFNESS: DesignVariable<Derived<Follower>> = DesignVariable::new(0);

/// `kx = ky = 50`, `m = 0.5`: 10 rad/s in both directions at rest; the stiffnesses have standard deviation 0.4.
fn plate(speed: f64, damping: f64) -> Study<Derived<Plate>> {
    Study::new(Derived(Plate))
        .family(Family::General)
        .sigma_level(1.0)
        .input(OMEGA, speed)
        .design(KX, 50.0)
        .design(KY, 50.0)
        .design(DAMPING, damping)
        .tolerance(M, 0.0)
        .tolerance(KX, 0.4)
        .tolerance(KY, 0.4)
}

#[test]
fn speed_splits_a_double_frequency_by_plus_and_minus_the_speed() {
    let study = plate(0.0, 0.0);
    let (state, found) = (study.equilibrium().unwrap(), study.modes().unwrap());
    let couplings = modal_couplings(study.mechanism(), &state, &found, &[0, 1]).unwrap();
    // Eigenvalues of the matrix of derivatives by the speed: +-i, so trace 0 and determinant 1.
    let [a, b, c, d] = *couplings.by_input[0].as_flattened() else { panic!("two modes") };
    within((a + d).norm(), 0.0, 1e-13);
    within((a * d - b * c - 1.0).norm(), 0.0, 1e-12);
    let tolerances = study.tolerances().unwrap();
    let found = clusters(study.mechanism(), &state, &found, &tolerances).unwrap();
    let mean = found[0].mean.as_ref().unwrap();
    within((mean.value - Complex::new(0.0, 10.0)).norm(), 0.0, 1e-13);
    within(mean.by_input[0].norm(), 0.0, 1e-13);
    // ds/dk = i / (2 m omega), half of it for each; sorted like two normal values.
    within((mean.by_design[KX.index()] - Complex::new(0.0, 0.05)).norm(), 0.0, 1e-13);
    let sigma = 0.4 / 10.0;
    close(mean.sigma_im, sigma / 2.0_f64.sqrt(), 1e-12);
    let frequency = &found[0].spread.as_ref().unwrap().frequency;
    let highest = frequency.highest().unwrap().value.as_ref().unwrap();
    within(highest.mean, 10.0 + sigma / PI.sqrt(), 4.0 * sigma / 64.0);
    let expected = sigma * (1.0 - 1.0 / PI).sqrt();
    within(highest.sigma.unwrap(), expected, 4.0 * sigma / 64.0);
}

#[test]
fn whirling_pairs_agree_with_monte_carlo() {
    for (speed, damping) in [(0.0, 0.0), (0.01, 0.0), (0.03, 0.1), (0.05, 0.3)] {
        let mut study = plate(speed, damping).tolerance(M, 0.002);
        if damping > 0.0 {
            study = study.tolerance(DAMPING, 0.05);
        }
        let found = study.clusters().unwrap();
        let [found] = found.as_slice() else { panic!("{found:?}") };
        assert_eq!(found.modes, [0, 1]);
        let spread = found.spread.as_ref().unwrap();
        let sampled = run(&study);
        agree(&spread.frequency, &sorted(&sampled, |s| s.im), 0.02);
        if damping > 0.0 {
            let ratio = spread.damping_ratio.as_ref().unwrap();
            agree(ratio, &sorted(&sampled, |s| -s.re / s.norm()), 0.02);
        }
    }
    // Forward and backward whirl at 4 rad/s are 8 rad/s apart.
    assert_eq!(plate(4.0, 0.0).clusters().unwrap(), []);
}

#[test]
fn the_mean_damping_ratio_moves_as_each_of_two_equal_ones() {
    let study = plate(0.0, 0.2).tolerance(DAMPING, 0.02);
    let found = study.clusters().unwrap();
    let mean = found[0].mean.as_ref().unwrap();
    // s = -c/2m +- i sqrt(k/m - (c/2m)^2): Re s = -0.2.
    close(mean.value.re, -0.2, 1e-12);
    close(mean.by_design[DAMPING.index()].re, -1.0, 1e-11);
    let ratio = mean.damping_ratio.as_ref().unwrap();
    // c / (2 sqrt(k m)), and its derivatives by c, kx and ky.
    close(ratio.mean, 0.02, 1e-12);
    let by_stiffness = 0.5 * 0.02 / 50.0 * 0.4 / 2.0_f64.sqrt();
    close(ratio.sigma, (0.02 / 10.0_f64).hypot(by_stiffness), 1e-9);
}

/// Ziegler's column loses stability at `load / stiffness = (7 - sqrt 8) / 2`, where two frequencies merge:
/// `2 lambda^2 + (2 p - 7 k) lambda + k^2 = 0`.
fn critical_load() -> f64 {
    0.5 * (7.0 - 8.0_f64.sqrt())
}

fn column(load: f64) -> Study<Derived<Follower>> {
    Study::new(Derived(Follower)).sigma_level(3.0).input(Input::new(0), load).tolerance(STIFFNESS, 0.01)
}

/// The two `s` with positive imaginary part at a given stiffness.
fn column_roots(load: f64, k: f64) -> [Complex; 2] {
    let (b, root) = (7.0 * k - 2.0 * load, Complex::from((7.0 * k - 2.0 * load).powi(2) - 8.0 * k * k).sqrt());
    [-1.0, 1.0].map(|sign| {
        let s = (-(b + sign * root) / 4.0).sqrt();
        if s.im < 0.0 { -s } else { s }
    })
}

/// Mean and standard deviation of the sorted frequencies by quadrature over the stiffness.
fn column_moments(load: f64) -> [(f64, f64); 2] {
    let mut sums = [[0.0; 2]; 2];
    let mut weight = 0.0;
    for i in -40_000..=40_000 {
        let z = f64::from(i) / 5000.0;
        let density = (-0.5 * z * z).exp();
        let mut roots = column_roots(load, 1.0 + z * 0.01 / 3.0).map(|s| s.im);
        roots.sort_by(f64::total_cmp);
        weight += density;
        for (sum, root) in sums.iter_mut().zip(roots) {
            sum[0] += density * root;
            sum[1] += density * root * root;
        }
    }
    sums.map(|[first, second]| {
        let mean = first / weight;
        (mean, (second / weight - mean * mean).sqrt())
    })
}

#[test]
fn merging_frequencies_agree_with_monte_carlo_and_count_flutter() {
    // Flutter is 0.9 standard deviations of the stiffness away.
    let study = column(0.997 * critical_load());
    let found = study.clusters().unwrap();
    let [found] = found.as_slice() else { panic!("{found:?}") };
    // The distance is the first-order distance of the discriminant from zero.
    let discriminant = |k: f64| (7.0 * k - 2.0 * 0.997 * critical_load()).powi(2) - 8.0 * k * k;
    let slope = (discriminant(1.0 + 1e-6) - discriminant(1.0 - 1e-6)) / 2e-6;
    let distance = discriminant(1.0) / (slope * 0.01 / 3.0);
    close(found.distance, distance, 0.02);
    let spread = found.spread.as_ref().unwrap();
    let sampled = run(&study);
    agree(&spread.frequency, &sorted(&sampled, |s| s.im), 0.02);
    agree(spread.growth.as_ref().unwrap(), &sorted(&sampled, |s| s.re), 0.05);
    let share = |count: usize| count as f64 / 4096.0;
    assert_eq!(sampled.counts.total(), 4096);
    within(share(spread.unstable), share(sampled.counts.flutter), 0.05);
    within(share(spread.unstable), 0.184, 0.03);
}

#[test]
fn next_to_a_defective_root_the_spread_is_right_or_refused() {
    let (mut right, mut refused) = (0, 0);
    for power in 2..16 {
        for side in [-1.0, 1.0] {
            let load = critical_load() * (1.0 + side * 10.0_f64.powi(-power));
            let study = column(load);
            let found = study.clusters().unwrap();
            let [found] = found.as_slice() else {
                // Far enough before flutter, or both roots far beyond it.
                assert!(power == 2, "{power} {side}");
                continue;
            };
            match &found.spread {
                Ok(spread) => {
                    right += 1;
                    let expected = column_moments(load);
                    for (member, (mean, sigma)) in spread.frequency.members.iter().zip(expected) {
                        let value = member.value.as_ref().unwrap();
                        within(value.mean, mean, 0.1 * sigma);
                        within(value.sigma.unwrap(), sigma, 0.1 * sigma);
                    }
                }
                Err(error) => {
                    refused += 1;
                    assert!(matches!(error, Error::Defective { modes } if *modes == [0, 1]));
                    assert!(found.defective() && found.mean.is_none());
                }
            }
        }
    }
    assert!(right >= 6 && refused >= 4, "{right} {refused}");
}

#[test]
fn a_defective_root_has_no_sigma() {
    let study = column(critical_load());
    let found = study.clusters().unwrap();
    assert_eq!(found.len(), 1);
    assert_eq!((found[0].modes.as_slice(), found[0].distance), (&[0, 1][..], 0.0));
    assert!(found[0].defective() && found[0].mean.is_none());
    for mode in &study.sensitivities().unwrap().modes {
        assert!(mode.clustered && mode.s().is_none() && mode.frequency().is_none());
    }
    let first = study.first_order().unwrap();
    assert!(!first.trusted());
    for mode in &first.modes {
        assert!(mode.clustered && mode.frequency().is_none() && mode.lambda.sigma == f64::INFINITY);
        assert_eq!(mode.distance_to_neighbour, 0.0);
    }
    let summary = study.summary().unwrap();
    for text in [first.to_string(), summary.to_string(), found[0].to_string(), format!("{summary:?}")] {
        assert!(!text.contains("NaN"), "{text}");
    }
    assert!(summary.to_string().contains("defective"));
}

#[test]
fn overdamped_roots_form_a_pair() {
    // The x direction alone at rest: s = -c/2m +- sqrt((c/2m)^2 - kx/m), critical at c = 8.944.
    let study = plate(0.0, 9.0)
        .design(KX, 40.0)
        .design(KY, 4000.0)
        .tolerance(KX, 0.0)
        .tolerance(KY, 0.0)
        .tolerance(DAMPING, 0.05);
    let found = study.clusters().unwrap();
    let [found] = found.as_slice() else { panic!("{found:?}") };
    assert!(found.eigenvalues.iter().all(|s| s.im == 0.0));
    let spread = found.spread.as_ref().unwrap();
    let growth = spread.growth.as_ref().unwrap();
    let highest = growth.highest().unwrap().value.as_ref().unwrap();
    let (mut sum, mut weight, mut oscillating) = (0.0, 0.0, 0.0);
    for i in -40_000..=40_000 {
        let z = f64::from(i) / 5000.0;
        let density = (-0.5 * z * z).exp();
        let rate = 9.0 + 0.05 * z;
        let inside = rate * rate - 80.0;
        sum += density * (inside.max(0.0).sqrt() - rate);
        weight += density;
        oscillating += if inside < 0.0 { density } else { 0.0 };
    }
    within(highest.mean, sum / weight, 5.0 * highest.standard_error.unwrap());
    let frequency = spread.frequency.highest().unwrap();
    let share = frequency.value.as_ref().unwrap().count as f64 / 4096.0;
    within(share, oscillating / weight, 0.03);
    assert_eq!(spread.frequency.lowest().unwrap().without, 4096);
    assert_eq!(spread.unstable, 0);
}

#[test]
fn critically_damped_roots_are_defective() {
    // c = 2 sqrt(k m) in one direction, then in both: one or two double roots at -10.
    let both = plate(0.0, 10.0);
    let one = both.clone().design(KY, 4000.0);
    for (study, count) in [(one, 2), (both, 4)] {
        let found = study.clusters().unwrap();
        let [found] = found.as_slice() else { panic!("{found:?}") };
        assert!(found.defective(), "{found:?}");
        assert!(found.modes.len() == count || found.modes.len() == count / 2);
        let summary = study.summary().unwrap();
        assert!(!format!("{summary:?} {summary}").contains("NaN"));
        for mode in &found.modes {
            assert!(summary.first.modes[*mode].growth().is_none());
        }
    }
    // Equal overdamped motions are double roots, but not defective.
    let found = plate(0.0, 20.0).clusters().unwrap();
    assert_eq!(found.len(), 2);
    assert!(found.iter().all(|cluster| cluster.spread.is_ok()));
}

#[test]
fn a_pair_of_a_general_family_meets_the_undamped_one() {
    let study = plate(0.0, 0.0).design(KY, 50.5);
    let general = study.clone().clusters().unwrap();
    let undamped = study.family(Family::Undamped).clusters().unwrap();
    let of = |k: usize, cluster_tolerance: &eigentol::clusters::ClusterTolerance| {
        let spread = cluster_tolerance.spread.as_ref().unwrap();
        spread.frequency.members[k].value.clone().unwrap()
    };
    for k in 0..2 {
        let (a, b) = (of(k, &general[0]), of(k, &undamped[0]));
        within(a.mean, b.mean, 2e-4);
        close(a.sigma.unwrap(), b.sigma.unwrap(), 1e-2);
    }
    close(general[0].distance, undamped[0].distance, 1e-2);
}

#[test]
fn modes_that_do_not_exist_are_refused() {
    let study = plate(0.0, 0.0);
    let (state, found) = (study.equilibrium().unwrap(), study.modes().unwrap());
    let missing = modal_couplings(study.mechanism(), &state, &found, &[0, 2]);
    assert!(matches!(missing, Err(Error::NoSuchMode { mode: 2, count: 2 })));
    assert!(Quantity::Frequency.of(&found.modes[0]).is_some());
    assert_eq!(modes::clusters(&found, 1e-6)[..], [true, true]);
}
